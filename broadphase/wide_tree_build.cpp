#include <algorithm>

#include "../shapes/bit_cast.h"
#include "proxy_table.h"
#include "wide_tree.h"

namespace swept::inline SWEPT_PRECISION {

namespace {

/// Boxes of one class differ by less than a factor of four in their longer side.
std::uint32_t sizeClassOf(float longerSide) {
    constexpr int kFirstExponentBit = 23;
    return bitCast<std::uint32_t>(longerSide) >> (kFirstExponentBit + 1);
}

/// Nothing here may be infinite: a difference of infinities has no place in an order.
float toFloat(Real x) {
    constexpr Real kMost = static_cast<Real>(std::numeric_limits<float>::max());
    return static_cast<float>(std::clamp(x, -kMost, kMost));
}

/// Orders items between two places so that each node of the implicit tree gets what lies together: halves at the median
/// of the wider axis, at the border between two nodes of `capacity` places.
template <class Item>
void halve(Item* items, std::uint32_t first, std::uint32_t last, std::uint32_t capacity) {
    while (last - first > kWide || (first >> kLaneBits) != ((last - 1) >> kLaneBits)) {
        const std::uint32_t firstNode = first / capacity;
        const std::uint32_t endNode = (last - 1) / capacity + 1;
        if (endNode - firstNode == 1) {
            capacity /= kWide;
            continue;
        }
        float lowX = items[first].x;
        float highX = lowX;
        float lowY = items[first].y;
        float highY = lowY;
        for (std::uint32_t i = first + 1; i < last; ++i) {
            lowX = std::min(lowX, items[i].x);
            highX = std::max(highX, items[i].x);
            lowY = std::min(lowY, items[i].y);
            highY = std::max(highY, items[i].y);
        }
        const std::uint32_t middle = (firstNode + (endNode - firstNode) / 2) * capacity;
        if (highX - lowX > highY - lowY) {
            std::nth_element(items + first, items + middle, items + last,
                             [](const Item& a, const Item& b) { return a.x < b.x; });
        } else {
            std::nth_element(items + first, items + middle, items + last,
                             [](const Item& a, const Item& b) { return a.y < b.y; });
        }
        halve(items, first, middle, capacity);
        first = middle;
    }
}

}  // namespace

void WideTree::rebuild(std::span<std::uint32_t> places) {
    collectItems();
    layOut(places);
    buildLevels();
    misplaced_ = 0;
    decay_ = 0;
}

/// All proxies, sorted by size; each size class begins a new node, the gaps are items that come from nowhere.
void WideTree::collectItems() {
    std::array<std::uint32_t, 256> classes = {};
    oldBoxes_.swap(levels_[0]);
    oldKnown_.swap(known_);
    oldSlots_.swap(slots_);
    oldMoved_.swap(movedLanes_);
    const auto shapeOf = [this](std::uint32_t place) {
        const Aabb box = oldBoxes_[place >> kLaneBits].box(place & kLaneMask);
        const auto lowerX = toFloat(box.lower.x);
        const auto lowerY = toFloat(box.lower.y);
        const auto upperX = toFloat(box.upper.x);
        const auto upperY = toFloat(box.upper.y);
        return Item{lowerX * 0.5F + upperX * 0.5F, lowerY * 0.5F + upperY * 0.5F, place,
                    sizeClassOf(std::max(upperX - lowerX, upperY - lowerY))};
    };
    for (std::uint32_t place = 0; place < end_; ++place) {
        if (oldSlots_[place] != kNoSlot) { ++classes[shapeOf(place).sizeClass]; }
    }
    std::uint32_t next = 0;
    for (std::uint32_t& count : classes) {
        const std::uint32_t begin = next;
        next += (count + kLaneMask) & ~kLaneMask;
        count = begin;
    }
    items_.assign(next, Item{0, 0, kNoSlot, 0});
    std::array<std::uint32_t, 256> ends = classes;
    for (std::uint32_t place = 0; place < end_; ++place) {
        if (oldSlots_[place] == kNoSlot) { continue; }
        const Item item = shapeOf(place);
        items_[ends[item.sizeClass]++] = item;
    }
    std::uint32_t capacity = kWide;
    while (capacity < next) { capacity *= kWide; }
    for (std::size_t i = 0; i < classes.size(); ++i) {
        if (ends[i] > classes[i]) { halve(items_.data(), classes[i], ends[i], capacity); }
    }
    end_ = next;
}

/// Brings boxes, slots and marks into the order of the items.
void WideTree::layOut(std::span<std::uint32_t> places) {
    const std::size_t nodes = end_ >> kLaneBits;
    levels_[0].assign(nodes, WideBoxes::empty());
    known_.assign(nodes, WideBoxes::empty());
    slots_.assign(end_, kNoSlot);
    movedLanes_.assign(nodes, 0);
    jumpedLanes_.assign(nodes, 0);
    jumped_.clear();
    besides_.assign(end_, 0);
    nodeSpreads_.assign(nodes, 0);
    for (std::uint32_t place = 0; place < end_; ++place) {
        const std::uint32_t from = items_[place].from;
        if (from == kNoSlot) { continue; }
        const std::uint32_t node = place >> kLaneBits;
        levels_[0][node].set(place & kLaneMask, oldBoxes_[from >> kLaneBits].box(from & kLaneMask));
        known_[node].set(place & kLaneMask, oldKnown_[from >> kLaneBits].box(from & kLaneMask));
        slots_[place] = oldSlots_[from];
        places[oldSlots_[from]] = place;
        const std::uint32_t moved = (oldMoved_[from >> kLaneBits] >> (from & kLaneMask)) & 1U;
        movedLanes_[node] |= static_cast<std::uint8_t>(moved << (place & kLaneMask));
    }
    movedNodes_.clear();
    for (std::uint32_t node = 0; node < nodes; ++node) {
        if (movedLanes_[node] != 0) { movedNodes_.push_back(node); }
    }
}

void WideTree::buildLevels() {
    height_ = end_ > 0 ? 1 : 0;
    builtSpread_ = 0;
    for (std::size_t level = 1; level < kMaxLevels; ++level) {
        const std::vector<WideBoxes>& below = levels_[level - 1];
        levels_[level].assign(below.size() > 1 ? (below.size() + kLaneMask) >> kLaneBits : 0, WideBoxes::empty());
        if (below.size() <= 1) { continue; }
        height_ = level + 1;
        for (std::uint32_t i = 0; i < below.size(); ++i) {
            const Aabb hull = below[i].hull();
            levels_[level][i >> kLaneBits].set(i & kLaneMask, hull);
            if (level > 1) { continue; }
            builtSpread_ += spreadOf(hull);
            nodeSpreads_[i] = spreadOf(hull);
        }
    }
    spread_ = builtSpread_;
    builtSize_ = size_;
}

}  // namespace swept::inline SWEPT_PRECISION
