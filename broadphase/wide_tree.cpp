#include "wide_tree.h"

#include <algorithm>

#include "proxy_table.h"

namespace swept::inline SWEPT_PRECISION {

WideBoxes WideBoxes::empty() {
    WideBoxes boxes;
    for (std::uint32_t lane = 0; lane < kWide; ++lane) { boxes.set(lane, kNoBox); }
    return boxes;
}

Aabb WideBoxes::hull() const {
    Aabb sum = kNoBox;
    for (std::uint32_t lane = 0; lane < kWide; ++lane) { sum = hullOf(sum, box(lane)); }
    return sum;
}

void WideTree::insert(std::uint32_t slot, const Aabb& box, std::span<std::uint32_t> places) {
    places[slot] = append(slot, box, kNoBox);
    ++size_;
}

void WideTree::remove(std::uint32_t place) {
    const std::uint32_t node = place >> kLaneBits;
    levels_[0][node].set(place & kLaneMask, kNoBox);
    known_[node].set(place & kLaneMask, kNoBox);
    slots_[place] = kNoSlot;
    movedLanes_[node] &= static_cast<std::uint8_t>(~(1U << (place & kLaneMask)));
    --size_;
    ++misplaced_;
}

void WideTree::move(std::uint32_t slot, const Aabb& box, bool forget, std::span<std::uint32_t> places) {
    std::uint32_t place = places[slot];
    std::uint32_t node = place >> kLaneBits;
    if (forget) { known_[node].set(place & kLaneMask, kNoBox); }
    // Among the seven others that it left behind, what jumped away would blow up the node: it starts anew at the end.
    const bool jumped = height_ > 1 && !overlaps(box, levels_[1][node >> kLaneBits].box(node & kLaneMask));
    if (jumped) {
        const Aabb known = known_[node].box(place & kLaneMask);
        remove(place);
        ++size_;
        if (misplaced_ > 2 * size_ + kWide) { rebuild(places); }  // pairs are never asked for: room stays bounded
        places[slot] = append(slot, box, known);
        return;
    }
    levels_[0][node].set(place & kLaneMask, box);
    include(place, box);
    mark(place);
}

/// Puts a box behind all others and marks it as moved.
std::uint32_t WideTree::append(std::uint32_t slot, const Aabb& box, const Aabb& known) {
    const std::uint32_t place = end_++;
    if ((place & kLaneMask) == 0) { addNodes(); }
    const std::uint32_t node = place >> kLaneBits;
    levels_[0][node].set(place & kLaneMask, box);
    known_[node].set(place & kLaneMask, known);
    slots_[place] = slot;
    include(place, box);
    mark(place);
    ++misplaced_;
    return place;
}

/// One more node at the lowest level, and what is missing above it.
void WideTree::addNodes() {
    levels_[0].push_back(WideBoxes::empty());
    known_.push_back(WideBoxes::empty());
    slots_.resize(slots_.size() + kWide, kNoSlot);
    movedLanes_.push_back(0);
    height_ = std::max<std::size_t>(height_, 1);
    for (std::size_t level = 0; levels_[level].size() > 1; ++level) {
        std::vector<WideBoxes>& above = levels_[level + 1];
        if (above.empty()) {
            above.push_back(WideBoxes::empty());
            above[0].set(0, levels_[level][0].hull());
            height_ = level + 2;
        } else if (above.size() * kWide < levels_[level].size()) {
            above.push_back(WideBoxes::empty());
        }
    }
}

/// Lets everything above a place contain a box.
void WideTree::include(std::uint32_t place, const Aabb& box) {
    std::uint32_t index = place >> kLaneBits;
    for (std::size_t level = 1; level < height_; ++level) {
        WideBoxes& node = levels_[level][index >> kLaneBits];
        const std::uint32_t lane = index & kLaneMask;
        const Aabb before = node.box(lane);
        if (contains(before, box)) { return; }
        const Aabb after = hullOf(before, box);
        if (level == 1) { spread_ += spreadOf(after) - spreadOf(before); }
        node.set(lane, after);
        index >>= kLaneBits;
    }
}

void WideTree::mark(std::uint32_t place) {
    const auto bit = static_cast<std::uint8_t>(1U << (place & kLaneMask));
    std::uint8_t& lanes = movedLanes_[place >> kLaneBits];
    movedCount_ += (lanes & bit) == 0 ? 1 : 0;
    lanes |= bit;
}

bool WideTree::prepareJoin(std::span<std::uint32_t> places) {
    const bool due = isWorthRebuilding();
    if (due) { rebuild(places); }
    refit();
    if (builtSpread_ > 0) { decay_ += movedCount_ * (spread_ / builtSpread_ - 1); }
    return due;
}

bool WideTree::isWorthRebuilding() const {
    // A build costs about as much as joining half of the boxes, so it pays when the decay has cost that much already:
    // what is lost is never more than twice what the best moment would have cost ("ski rental").
    constexpr double kBuildInJoins = 0.5;
    return misplaced_ > kWide + size_ / 8 || decay_ > kBuildInJoins * size_;
}

/// From below: exact boxes above all that moved, and the list of it.
void WideTree::refit() {
    for (std::vector<MovedNode>& list : moved_) { list.clear(); }
    if (movedCount_ == 0) { return; }
    std::vector<MovedNode>& lowest = moved_[0];
    for (std::uint32_t node = 0; node < movedLanes_.size(); ++node) {
        std::uint32_t lanes = movedLanes_[node];
        if (lanes == 0) { continue; }
        Aabb hull = kNoBox;
        for (; lanes != 0; lanes &= lanes - 1) {
            hull = hullOf(hull, levels_[0][node].box(static_cast<std::uint32_t>(std::countr_zero(lanes))));
        }
        lowest.push_back({hull, node, 0});
    }
    for (std::size_t level = 1; level < height_; ++level) {
        std::vector<MovedNode>& below = moved_[level - 1];
        for (std::uint32_t i = 0; i < below.size(); ++i) {
            const std::uint32_t child = below[i].node;
            WideBoxes& parent = levels_[level][child >> kLaneBits];
            const Aabb tight = levels_[level - 1][child].hull();
            if (level == 1) { spread_ += spreadOf(tight) - spreadOf(parent.box(child & kLaneMask)); }
            parent.set(child & kLaneMask, tight);
            std::vector<MovedNode>& here = moved_[level];
            if (here.empty() || here.back().node != child >> kLaneBits) {
                here.push_back({below[i].hull, child >> kLaneBits, i});
            } else {
                here.back().hull = hullOf(here.back().hull, below[i].hull);
            }
        }
    }
    for (std::size_t level = 0; level < height_; ++level) {
        if (moved_[level].empty()) { continue; }
        const auto end = static_cast<std::uint32_t>(level > 0 ? moved_[level - 1].size() - 1 : 0);
        moved_[level].push_back({kNoBox, kNoSlot, end});
    }
}

void WideTree::finishJoin() {
    if (movedCount_ == 0) { return; }
    for (const MovedNode& moved : moved_[0]) {
        if (moved.node == kNoSlot) { continue; }  // the sentinel
        known_[moved.node] = levels_[0][moved.node];
        movedLanes_[moved.node] = 0;
    }
    movedCount_ = 0;
}

std::size_t WideTree::memoryBytes() const {
    std::size_t sum = bytesOf(known_) + bytesOf(slots_) + bytesOf(movedLanes_) + bytesOf(items_) + bytesOf(oldBoxes_) +
                      bytesOf(oldKnown_) + bytesOf(oldSlots_) + bytesOf(oldMoved_);
    for (const auto& level : levels_) { sum += bytesOf(level); }
    for (const auto& list : moved_) { sum += bytesOf(list); }
    return sum;
}

}  // namespace swept::inline SWEPT_PRECISION
