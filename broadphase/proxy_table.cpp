#include "proxy_table.h"

#include <algorithm>
#include <bit>
#include <cassert>
#include <functional>

#include "../shapes/room.h"

namespace swept::inline SWEPT_PRECISION {

Status refusalOf(const Aabb& box) {
    if (!isFinite(box.lower) || !isFinite(box.upper)) { return {StatusCode::notFinite, "box"}; }
    return {StatusCode::outOfRange, "box"};
}

Result<ProxyId> ProxyTable::add(const Aabb& box, ProxyKind kind) {
    std::uint32_t slot = 0;
    makeRoomForOne();
    if (!free_.empty()) {
        std::pop_heap(free_.begin(), free_.end(), std::greater<>{});
        slot = free_.back();
        free_.pop_back();
    } else {
        if (kindBits_.size() >= std::numeric_limits<std::uint32_t>::max()) {
            return Status{StatusCode::noIdsLeft, "box"};
        }
        slot = slotCount();
        kindBits_.push_back(0);
        listed_.push_back(0);
        boxes_.push_back(kNoBox);
        if (keepsKnown_) { known_.push_back(kNoBox); }
    }
    kindBits_[slot] = kindBit(kind);
    boxes_[slot] = box;
    markMoved(slot);
    return static_cast<ProxyId>(slot);
}

/// For one slot more, and so that all of them may be marked, or free.
void ProxyTable::makeRoomForOne() {
    const std::size_t count = kindBits_.size() + (free_.empty() ? 1 : 0);
    makeRoom(kindBits_, count);
    makeRoom(listed_, count);
    makeRoom(boxes_, count);
    if (keepsKnown_) { makeRoom(known_, count); }
    makeRoom(moved_, count);
    makeRoom(free_, count);
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
