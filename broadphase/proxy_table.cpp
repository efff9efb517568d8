#include "proxy_table.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <functional>

namespace swept::inline SWEPT_PRECISION {

Status refusalOf(const Aabb& box) {
    if (!isFinite(box.lower) || !isFinite(box.upper)) { return {StatusCode::notFinite, "box"}; }
    return {StatusCode::outOfRange, "box"};
}

Result<ProxyId> ProxyTable::add(const Aabb& box, ProxyKind kind) {
    std::uint32_t slot = 0;
    if (!free_.empty()) {
        std::pop_heap(free_.begin(), free_.end(), std::greater<>{});
        slot = free_.back();
        free_.pop_back();
    } else {
        if (kindBits_.size() >= std::numeric_limits<std::uint32_t>::max()) {
            return Status{StatusCode::outOfMemory, "box"};
        }
        slot = slotCount();
        kindBits_.push_back(0);
        listed_.push_back(0);
        boxes_.push_back(kNoBox);
        if (keepsKnown_) { known_.push_back(kNoBox); }
        moved_.reserve(kindBits_.capacity());
        free_.reserve(kindBits_.capacity());
    }
    kindBits_[slot] = kindBit(kind);
    boxes_[slot] = box;
    markMoved(slot);
    return static_cast<ProxyId>(slot);
}

void ProxyTable::release(ProxyId id) {
    assert(holds(id) && "only a taken slot can be freed");
    const auto slot = static_cast<std::uint32_t>(id);
    kindBits_[slot] = 0;
    boxes_[slot] = kNoBox;
    if (keepsKnown_) { known_[slot] = kNoBox; }
    free_.push_back(slot);
    std::push_heap(free_.begin(), free_.end(), std::greater<>{});
}

ProxyKind ProxyTable::kindOf(ProxyId id) const {
    assert(holds(id) && "a free slot has no kind");
    return static_cast<ProxyKind>(std::countr_zero(kindBits_[static_cast<std::uint32_t>(id)]));
}

void ProxyTable::move(ProxyId id, const Aabb& box) {
    const auto slot = static_cast<std::uint32_t>(id);
    boxes_[slot] = box;
    markMoved(slot);
}

void ProxyTable::renew(ProxyId id) {
    const auto slot = static_cast<std::uint32_t>(id);
    if (keepsKnown_) { known_[slot] = kNoBox; }
    markMoved(slot);
}

void ProxyTable::markMoved(std::uint32_t slot) {
    if (listed_[slot] != 0) { return; }
    listed_[slot] = 1;
    moved_.push_back(slot);
}

std::span<const std::uint32_t> ProxyTable::sortedMoved() {
    std::erase_if(moved_, [this](std::uint32_t slot) {
        const bool freed = kindBits_[slot] == 0;
        if (freed) { listed_[slot] = 0; }
        return freed;
    });
    std::sort(moved_.begin(), moved_.end());
    return moved_;
}

void ProxyTable::finishPairs() {
    for (const std::uint32_t slot : moved_) {
        listed_[slot] = 0;
        if (keepsKnown_) { known_[slot] = boxes_[slot]; }
    }
    moved_.clear();
}

std::size_t ProxyTable::memoryBytes() const {
    return bytesOf(kindBits_) + bytesOf(listed_) + bytesOf(boxes_) + bytesOf(known_) + bytesOf(moved_) + bytesOf(free_);
}

}  // namespace swept::inline SWEPT_PRECISION
