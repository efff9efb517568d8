#include "wide_tree.h"

#include <algorithm>
#include <atomic>
#include <cstring>

#include "../shapes/room.h"
#include "proxy_table.h"

namespace swept::inline SWEPT_PRECISION {

namespace {

/// Nodes per block of a parallel loop: of those whose boxes are read, and of those whose marks are.
constexpr std::size_t kNodeGrain = 64;
constexpr std::size_t kMarkGrain = 256;
/// Marks of places, until they are the nodes': a byte each, so that several threads may set them.
constexpr std::uint8_t kMovedInParallel = 1;
constexpr std::uint8_t kJumpedInParallel = 2;
static_assert(kWide == sizeof(std::uint64_t), "the marks of a node are read at once");

/// Halves against each other: three steps instead of a chain of eight, and the first is one for a register of four
/// lanes.
template <class Pick>
Real reduced(const std::array<Real, kWide>& lanes, const Pick& pick) {
    std::array<Real, kWide / 2> four;
    for (std::uint32_t i = 0; i < kWide / 2; ++i) { four[i] = pick(lanes[i], lanes[i + kWide / 2]); }
    return pick(pick(four[0], four[2]), pick(four[1], four[3]));
}

}  // namespace

WideBoxes WideBoxes::empty() {
    WideBoxes boxes;
    for (std::uint32_t lane = 0; lane < kWide; ++lane) { boxes.set(lane, kNoBox); }
    return boxes;
}

WideBoxes WideBoxes::of(std::span<const Aabb> some) {
    WideBoxes boxes;
    for (std::uint32_t lane = 0; lane < kWide; ++lane) {
        const bool isOne = lane < some.size() && isAskable(some[lane]);
        boxes.set(lane, isOne ? askedAs(some[lane]) : kNoBox);
    }
    return boxes;
}

Aabb WideBoxes::hull() const {
    const auto least = [](Real a, Real b) { return b < a ? b : a; };
    const auto most = [](Real a, Real b) { return a < b ? b : a; };
    return {{reduced(lowerX, least), reduced(lowerY, least)}, {reduced(upperX, most), reduced(upperY, most)}};
}

void WideTree::insert(std::uint32_t slot, const Aabb& box, std::span<std::uint32_t> places) {
    if (misplaced_ > 2 * size_ + kWide) {  // pairs are never asked for: room stays bounded
        SerialTaskSystem alone;
        rebuild(places, alone);
    }
    places[slot] = append(slot, box, kNoBox);
    ++size_;
}

void WideTree::remove(std::uint32_t place) {
    const std::uint32_t node = place >> kLaneBits;
    isPrepared_ = false;
    levels_[0][node].set(place & kLaneMask, kNoBox);
    known_[node].set(place & kLaneMask, kNoBox);
    slots_[place] = kNoSlot;
    movedLanes_[node] &= static_cast<std::uint8_t>(~(1U << (place & kLaneMask)));
    --size_;
    ++misplaced_;
}

void WideTree::forget(std::uint32_t place) {
    known_[place >> kLaneBits].set(place & kLaneMask, kNoBox);
    mark(place);
}

void WideTree::move(std::uint32_t place, const Aabb& box) {
    const std::uint32_t node = place >> kLaneBits;
    const auto bit = static_cast<std::uint8_t>(1U << (place & kLaneMask));
    if (jumpsFrom(place, box) && (jumpedLanes_[node] & bit) == 0) {
        jumpedLanes_[node] |= bit;
        jumped_.push_back(place);
    }
    levels_[0][node].set(place & kLaneMask, box);
    include(place, box);
    mark(place);
}

/// Whether a box lies apart from the box of the node that its place is in.
bool WideTree::jumpsFrom(std::uint32_t place, const Aabb& box) const {
    const std::uint32_t node = place >> kLaneBits;
    return height_ > 1 && !overlaps(box, levels_[1][node >> kLaneBits].box(node & kLaneMask));
}

void WideTree::moveInParallel(std::uint32_t place, const Aabb& box) {
    parallelMarks_[place] = jumpsFrom(place, box) ? kMovedInParallel | kJumpedInParallel : kMovedInParallel;
    levels_[0][place >> kLaneBits].set(place & kLaneMask, box);
}

/// Of a range of the lowest nodes. @return how many were moved
std::uint32_t WideTree::takeParallelMarks(std::size_t begin, std::size_t end) {
    std::uint32_t count = 0;
    for (std::size_t node = begin; node < end; ++node) {
        std::uint8_t* const marksOfNode = parallelMarks_.data() + node * kWide;
        std::uint64_t all = 0;
        std::memcpy(&all, marksOfNode, sizeof(all));
        if (all == 0) { continue; }
        unsigned moved = 0;
        unsigned jumped = 0;
        for (std::uint32_t lane = 0; lane < kWide; ++lane) {
            const unsigned marks = marksOfNode[lane];
            moved |= (marks & kMovedInParallel) << lane;
            jumped |= ((marks & kJumpedInParallel) >> 1U) << lane;
        }
        std::memset(marksOfNode, 0, sizeof(all));
        count += static_cast<std::uint32_t>(std::popcount(moved));
        movedLanes_[node] |= static_cast<std::uint8_t>(moved);
        jumpedLanes_[node] |= static_cast<std::uint8_t>(jumped);
    }
    return count;
}

std::uint32_t WideTree::endMoves(TaskSystem& loops) {
    std::atomic<std::uint32_t> count = 0;
    loops.run(movedLanes_.size(), kMarkGrain, [&](std::size_t begin, std::size_t end, int) {
        const std::uint32_t some = takeParallelMarks(begin, end);
        if (some > 0) { count.fetch_add(some, std::memory_order_relaxed); }
    });
    if (count == 0) { return 0; }
    isPrepared_ = false;
    movedCount_ = 0;
    movedNodes_.clear();
    jumped_.clear();
    for (std::uint32_t node = 0; node < movedLanes_.size(); ++node) {
        if (movedLanes_[node] != 0) { movedNodes_.push_back(node); }
        movedCount_ += static_cast<std::uint32_t>(std::popcount(movedLanes_[node]));
        for (std::uint32_t lanes = jumpedLanes_[node]; lanes != 0; lanes &= lanes - 1) {
            jumped_.push_back((node << kLaneBits) + static_cast<std::uint32_t>(std::countr_zero(lanes)));
        }
    }
    return count;
}

/// Puts a box behind all others and marks it as moved.
std::uint32_t WideTree::append(std::uint32_t slot, const Aabb& box, const Aabb& known) {
    const std::uint32_t place = end_;
    makeRoom(movedNodes_, movedNodes_.size() + 1);
    if ((place & kLaneMask) == 0) { addNodes(); }
    ++end_;
    const std::uint32_t node = place >> kLaneBits;
    levels_[0][node].set(place & kLaneMask, box);
    known_[node].set(place & kLaneMask, known);
    slots_[place] = slot;
    include(place, box);
    mark(place);
    ++misplaced_;
    return place;
}

/// For one more node at each level: so `addNodes` adds all of them, or none when memory runs out.
void WideTree::makeRoomForNodes() {
    for (std::size_t level = 0; level <= height_ && level < kMaxLevels; ++level) {
        makeRoom(levels_[level], levels_[level].size() + 1);
    }
    makeRoom(known_, known_.size() + 1);
    makeRoom(slots_, slots_.size() + kWide);
    makeRoom(parallelMarks_, slots_.size() + kWide);
    makeRoom(movedLanes_, movedLanes_.size() + 1);
    makeRoom(jumpedLanes_, jumpedLanes_.size() + 1);
    makeRoom(nodeSpreads_, nodeSpreads_.size() + 1);
    makeRoom(jumped_, slots_.capacity());
    makeRoom(movedNodes_, movedLanes_.capacity());
    makeRoom(spreadGains_, movedLanes_.capacity());
}

/// One more node at the lowest level, and what is missing above it.
void WideTree::addNodes() {
    makeRoomForNodes();
    levels_[0].push_back(WideBoxes::empty());
    known_.push_back(WideBoxes::empty());
    slots_.resize(slots_.size() + kWide, kNoSlot);
    movedLanes_.push_back(0);
    jumpedLanes_.push_back(0);
    parallelMarks_.resize(slots_.size(), 0);
    nodeSpreads_.push_back(0);
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
    isPrepared_ = false;
    const auto bit = static_cast<std::uint8_t>(1U << (place & kLaneMask));
    std::uint8_t& lanes = movedLanes_[place >> kLaneBits];
    if (lanes == 0) { movedNodes_.push_back(place >> kLaneBits); }
    movedCount_ += (lanes & bit) == 0 ? 1 : 0;
    lanes |= bit;
}

bool WideTree::prepareJoin(std::span<std::uint32_t> places, TaskSystem& loops) {
    if (isPrepared_) { return false; }
    const bool due = isWorthRebuilding();
    if (due) { rebuild(places, loops); }
    settleJumps(places);
    refit(loops);
    isPrepared_ = true;
    return due;
}

bool WideTree::isWorthRebuilding() const {
    // A build takes about as long as joining every box between once (a thousand) and twice (ten thousand), so it pays
    // when the decay has cost that much already: what is lost is never more than twice what the best moment would have
    // cost ("ski rental"). Decay counts what moves here; the other limit is for trees at rest that others move through.
    constexpr double kBuildInJoins = 1.5;
    return misplaced_ > kWide + size_ / 2 || decay_ > kBuildInJoins * size_;
}

/// What jumped away from the seven others of its node blows the node up, and starts anew at the end. What jumped with
/// them, as in free flight, stays.
void WideTree::settleJumps(std::span<std::uint32_t> places) {
    constexpr double kBlownUp = 2;
    for (std::size_t i = 0; i < jumped_.size(); ++i) {  // by index: appending may reserve more room for it
        const std::uint32_t place = jumped_[i];
        const std::uint32_t node = place >> kLaneBits;
        const std::uint32_t slot = slots_[place];
        jumpedLanes_[node] = 0;
        if (slot == kNoSlot || !(spreadOf(levels_[0][node].hull()) > kBlownUp * nodeSpreads_[node])) { continue; }
        const Aabb box = levels_[0][node].box(place & kLaneMask);
        const Aabb known = known_[node].box(place & kLaneMask);
        remove(place);
        ++size_;
        places[slot] = append(slot, box, known);
    }
    jumped_.clear();
}

/// Ascending, each once, without those whose marks are gone.
void WideTree::sortMovedNodes() {
    // A pass over all nodes costs as much as sorting one of so many.
    constexpr std::size_t kNodesPerSorted = 16;
    if (movedNodes_.size() * kNodesPerSorted < movedLanes_.size()) {
        std::sort(movedNodes_.begin(), movedNodes_.end());
        movedNodes_.erase(std::unique(movedNodes_.begin(), movedNodes_.end()), movedNodes_.end());
        std::erase_if(movedNodes_, [this](std::uint32_t node) { return movedLanes_[node] == 0; });
        return;
    }
    movedNodes_.clear();
    for (std::uint32_t node = 0; node < movedLanes_.size(); ++node) {
        if (movedLanes_[node] != 0) { movedNodes_.push_back(node); }
    }
}

/// From below: exact boxes above all that moved, and the list of it.
void WideTree::refit(TaskSystem& loops) {
    if (movedCount_ == 0 && !anyMoved()) { return; }
    for (std::vector<MovedNode>& list : moved_) { list.clear(); }
    if (movedCount_ == 0) { return; }
    sortMovedNodes();
    moved_[0].resize(movedNodes_.size());
    spreadGains_.assign(movedNodes_.size(), 0);
    loops.run(movedNodes_.size(), kNodeGrain,
              [this](std::size_t begin, std::size_t end, int) { refitNodes(begin, end); });
    for (const double gain : spreadGains_) { spread_ += gain; }  // in order: the same for any number of workers
    for (std::size_t level = 1; level < height_; ++level) { listMovedAbove(level); }
    for (std::size_t level = 0; level < height_; ++level) {
        if (moved_[level].empty()) { continue; }
        const auto end = static_cast<std::uint32_t>(level > 0 ? moved_[level - 1].size() - 1 : 0);
        moved_[level].push_back({kNoBox, kNoSlot, end});
    }
}

/// Of some of the lowest nodes that moved: each writes its own lane one level above.
void WideTree::refitNodes(std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
        const std::uint32_t node = movedNodes_[i];
        const WideBoxes& boxes = levels_[0][node];
        const Aabb tight = boxes.hull();
        Aabb hull = tight;
        if (std::uint32_t lanes = movedLanes_[node]; lanes != kAllLanes) {
            hull = kNoBox;
            for (; lanes != 0; lanes &= lanes - 1) {
                hull = hullOf(hull, boxes.box(static_cast<std::uint32_t>(std::countr_zero(lanes))));
            }
        }
        moved_[0][i] = {hull, node, 0};
        if (height_ == 1) { continue; }
        WideBoxes& parent = levels_[1][node >> kLaneBits];
        const std::uint32_t lane = node & kLaneMask;
        const double spread = spreadOf(tight);
        spreadGains_[i] = spread - spreadOf(parent.box(lane));
        if (nodeSpreads_[node] == 0) { nodeSpreads_[node] = spread; }
        parent.set(lane, tight);
    }
}

/// Of a level above the lowest: what moved below it, and from two levels above that on the exact boxes.
void WideTree::listMovedAbove(std::size_t level) {
    const std::vector<MovedNode>& below = moved_[level - 1];
    std::vector<MovedNode>& here = moved_[level];
    for (std::uint32_t i = 0; i < below.size(); ++i) {
        const std::uint32_t child = below[i].node;
        const std::uint32_t parent = child >> kLaneBits;
        if (level > 1) { levels_[level][parent].set(child & kLaneMask, levels_[level - 1][child].hull()); }
        if (here.empty() || here.back().node != parent) {
            here.push_back({below[i].hull, parent, i});
        } else {
            here.back().hull = hullOf(here.back().hull, below[i].hull);
        }
    }
}

void WideTree::finishJoin(TaskSystem& loops) {
    isPrepared_ = false;
    if (movedCount_ == 0) { return; }
    // Per box, since more boxes have more nodes. What a box is compared with goes with the area of the nodes.
    const double spread = spread_ * builtSize_;
    const double built = builtSpread_ * size_;
    const double ratio = built > 0 ? spread / built : 0;
    if (ratio > 1) { decay_ += movedCount_ * (ratio * ratio - 1); }
    const std::size_t count = moved_[0].empty() ? 0 : moved_[0].size() - 1;  // without the sentinel
    loops.run(count, kNodeGrain, [this](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i) {
            const std::uint32_t node = moved_[0][i].node;
            known_[node] = levels_[0][node];
            movedLanes_[node] = 0;
        }
    });
    movedNodes_.clear();
    movedCount_ = 0;
}

std::size_t WideTree::memoryBytes() const {
    std::size_t sum = bytesOf(known_) + bytesOf(slots_) + bytesOf(movedLanes_) + bytesOf(jumpedLanes_) +
                      bytesOf(jumped_) + bytesOf(movedNodes_) + bytesOf(parallelMarks_) + bytesOf(nodeSpreads_) +
                      bytesOf(spreadGains_) + bytesOf(items_) + bytesOf(oldBoxes_) + bytesOf(oldKnown_) +
                      bytesOf(oldSlots_) + bytesOf(oldMoved_);
    for (const auto& level : levels_) { sum += bytesOf(level); }
    for (const auto& list : moved_) { sum += bytesOf(list); }
    return sum;
}

}  // namespace swept::inline SWEPT_PRECISION
