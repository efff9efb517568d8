#include <algorithm>
#include <numeric>

#include "../shapes/bit_cast.h"
#include "../shapes/room.h"
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

/// Items between two places, in nodes of so many places.
struct BuildPart {
    std::uint32_t first = 0;
    std::uint32_t last = 0;
    std::uint32_t capacity = 0;

    /// Also where there is nothing.
    bool isOneNode() const { return last <= first || first >> kLaneBits == (last - 1) >> kLaneBits; }
};

/// Orders items of a part that is more than one node, so that those of its two halves lie together: at the median of
/// the wider axis, at the border between two nodes of `capacity` places. Leaves the second half. @return the first one
template <class Item>
BuildPart halveOnce(Item* items, BuildPart& part) {
    std::uint32_t firstNode = part.first / part.capacity;
    std::uint32_t endNode = (part.last - 1) / part.capacity + 1;
    while (endNode - firstNode == 1) {
        part.capacity /= kWide;
        firstNode = part.first / part.capacity;
        endNode = (part.last - 1) / part.capacity + 1;
    }
    float lowX = items[part.first].x;
    float highX = lowX;
    float lowY = items[part.first].y;
    float highY = lowY;
    for (std::uint32_t i = part.first + 1; i < part.last; ++i) {
        lowX = std::min(lowX, items[i].x);
        highX = std::max(highX, items[i].x);
        lowY = std::min(lowY, items[i].y);
        highY = std::max(highY, items[i].y);
    }
    const std::uint32_t middle = (firstNode + (endNode - firstNode) / 2) * part.capacity;
    if (highX - lowX > highY - lowY) {
        std::nth_element(items + part.first, items + middle, items + part.last,
                         [](const Item& a, const Item& b) { return a.x < b.x; });
    } else {
        std::nth_element(items + part.first, items + middle, items + part.last,
                         [](const Item& a, const Item& b) { return a.y < b.y; });
    }
    const BuildPart before{part.first, middle, part.capacity};
    part.first = middle;
    return before;
}

/// Orders items so that each node of the implicit tree gets what lies together.
template <class Item>
void halve(Item* items, BuildPart part) {
    while (!part.isOneNode()) { halve(items, halveOnce(items, part)); }
}

/// Fewer items than this are ordered before another worker has begun: some 100 us.
constexpr std::uint32_t kFewestToOrder = 2048;
constexpr std::size_t kOrderedParts = 16;
/// Nodes per block of a parallel loop; and of one in which each node asks for all that are below it.
constexpr std::size_t kBuildGrain = 64;
constexpr std::size_t kHullGrain = kBuildGrain / kWide;

/// The same, by all workers: first each halves one part, then each has parts of its own.
template <class Item>
void halve(Item* items, const BuildPart& whole, TaskSystem& loops) {
    const bool hasMany = loops.startSeconds() < TaskSystem::kAtOnce || whole.last - whole.first >= kFewestToOrder;
    if (loops.workerCount() <= 1 || !hasMany) { return halve(items, whole); }
    std::array<BuildPart, kOrderedParts> parts{whole};
    for (std::size_t count = 1; count < kOrderedParts; count *= 2) {
        loops.run(count, 1, [&](std::size_t begin, std::size_t end, int) {
            for (std::size_t i = begin; i < end; ++i) {
                if (!parts[i].isOneNode()) { parts[count + i] = halveOnce(items, parts[i]); }
            }
        });
    }
    loops.run(kOrderedParts, 1, [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i) { halve(items, parts[i]); }
    });
}

}  // namespace

void WideTree::pack(std::span<const Aabb> boxes) {
    const std::size_t nodes = (boxes.size() + kLaneMask) >> kLaneBits;
    levels_[0].resize(nodes);
    for (std::size_t node = 0; node < nodes; ++node) {
        levels_[0][node] = WideBoxes::of(boxes.subspan(node << kLaneBits));
    }
    known_ = levels_[0];
    slots_.assign(nodes << kLaneBits, kNoSlot);
    std::iota(slots_.begin(), slots_.begin() + static_cast<std::ptrdiff_t>(boxes.size()), 0U);
    movedLanes_.assign(nodes, 0);
    movedNodes_.clear();
    for (std::vector<MovedNode>& list : moved_) { list.clear(); }
    movedCount_ = 0;
    clearJumps();
    end_ = size_ = static_cast<std::uint32_t>(boxes.size());
    SerialTaskSystem alone;
    buildLevels(alone);
    misplaced_ = 0;
    decay_ = 0;
    isPrepared_ = false;
}

/// As many marks as there are places.
void WideTree::clearJumps() {
    jumpedLanes_.assign(levels_[0].size(), 0);
    jumped_.clear();
    parallelMarks_.assign(slots_.size(), 0);
    nodeSpreads_.assign(levels_[0].size(), 0);
}

void WideTree::rebuild(std::span<std::uint32_t> places, TaskSystem& loops) {
    collectItems(loops);
    layOut(places, loops);
    buildLevels(loops);
    misplaced_ = 0;
    decay_ = 0;
}

/// Whatever a rebuild asks for, before it moves anything: when memory runs out the tree stays as it is.
void WideTree::makeRoomForItems(std::size_t count) {
    std::size_t nodes = count >> kLaneBits;
    makeRoom(items_, count);
    makeRoom(oldBoxes_, nodes);  // these four change places with the present ones
    makeRoom(oldKnown_, nodes);
    makeRoom(oldSlots_, count);
    makeRoom(oldMoved_, nodes);
    makeRoom(jumpedLanes_, nodes);
    makeRoom(parallelMarks_, count);
    makeRoom(nodeSpreads_, nodes);
    makeRoom(movedNodes_, nodes);
    for (std::size_t level = 1; level < kMaxLevels && nodes > 1; ++level) {
        nodes = (nodes + kLaneMask) >> kLaneBits;
        makeRoom(levels_[level], nodes);
    }
}

/// All proxies, sorted by size; each size class begins a new node, the gaps are items that come from nowhere.
void WideTree::collectItems(TaskSystem& loops) {
    std::array<std::uint32_t, 256> classes = {};
    const auto shapeOf = [](const std::vector<WideBoxes>& boxes, std::uint32_t place) {
        const Aabb box = boxes[place >> kLaneBits].box(place & kLaneMask);
        const auto lowerX = toFloat(box.lower.x);
        const auto lowerY = toFloat(box.lower.y);
        const auto upperX = toFloat(box.upper.x);
        const auto upperY = toFloat(box.upper.y);
        return Item{lowerX * 0.5F + upperX * 0.5F, lowerY * 0.5F + upperY * 0.5F, place,
                    sizeClassOf(std::max(upperX - lowerX, upperY - lowerY))};
    };
    for (std::uint32_t place = 0; place < end_; ++place) {
        if (slots_[place] != kNoSlot) { ++classes[shapeOf(levels_[0], place).sizeClass]; }
    }
    std::uint32_t next = 0;
    for (std::uint32_t& count : classes) {
        const std::uint32_t begin = next;
        next += (count + kLaneMask) & ~kLaneMask;
        count = begin;
    }
    makeRoomForItems(next);
    oldBoxes_.swap(levels_[0]);
    oldKnown_.swap(known_);
    oldSlots_.swap(slots_);
    oldMoved_.swap(movedLanes_);
    items_.assign(next, Item{0, 0, kNoSlot, 0});
    std::array<std::uint32_t, 256> ends = classes;
    for (std::uint32_t place = 0; place < end_; ++place) {
        if (oldSlots_[place] == kNoSlot) { continue; }
        const Item item = shapeOf(oldBoxes_, place);
        items_[ends[item.sizeClass]++] = item;
    }
    std::uint32_t capacity = kWide;
    while (capacity < next) { capacity *= kWide; }
    for (std::size_t i = 0; i < classes.size(); ++i) {
        if (ends[i] > classes[i]) { halve(items_.data(), {classes[i], ends[i], capacity}, loops); }
    }
    end_ = next;
}

/// Boxes, slots and marks of a node from where its items come from.
void WideTree::layOutNode(std::uint32_t node, std::span<std::uint32_t> places) {
    WideBoxes boxes = WideBoxes::empty();
    WideBoxes known = WideBoxes::empty();
    std::uint32_t moved = 0;
    for (std::uint32_t lane = 0; lane < kWide; ++lane) {
        const std::uint32_t place = (node << kLaneBits) + lane;
        const std::uint32_t from = items_[place].from;
        slots_[place] = from != kNoSlot ? oldSlots_[from] : kNoSlot;
        if (from == kNoSlot) { continue; }
        boxes.set(lane, oldBoxes_[from >> kLaneBits].box(from & kLaneMask));
        known.set(lane, oldKnown_[from >> kLaneBits].box(from & kLaneMask));
        places[oldSlots_[from]] = place;
        moved |= ((oldMoved_[from >> kLaneBits] >> (from & kLaneMask)) & 1U) << lane;
    }
    levels_[0][node] = boxes;
    known_[node] = known;
    movedLanes_[node] = static_cast<std::uint8_t>(moved);
}

/// Brings boxes, slots and marks into the order of the items.
void WideTree::layOut(std::span<std::uint32_t> places, TaskSystem& loops) {
    const std::size_t nodes = end_ >> kLaneBits;
    levels_[0].resize(nodes);
    known_.resize(nodes);
    slots_.resize(end_);
    movedLanes_.resize(nodes);
    clearJumps();
    loops.run(nodes, kBuildGrain, [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t node = begin; node < end; ++node) { layOutNode(static_cast<std::uint32_t>(node), places); }
    });
    movedNodes_.clear();
    for (std::uint32_t node = 0; node < nodes; ++node) {
        if (movedLanes_[node] != 0) { movedNodes_.push_back(node); }
    }
}

void WideTree::buildLevels(TaskSystem& loops) {
    height_ = end_ > 0 ? 1 : 0;
    builtSpread_ = 0;
    for (std::size_t level = 1; level < kMaxLevels; ++level) {
        const std::vector<WideBoxes>& below = levels_[level - 1];
        std::vector<WideBoxes>& here = levels_[level];
        here.assign(below.size() > 1 ? (below.size() + kLaneMask) >> kLaneBits : 0, WideBoxes::empty());
        if (below.size() <= 1) { continue; }
        height_ = level + 1;
        loops.run(here.size(), kHullGrain, [&](std::size_t begin, std::size_t end, int) {
            for (std::size_t i = begin * kWide; i < std::min(end * kWide, below.size()); ++i) {
                const Aabb hull = below[i].hull();
                here[i >> kLaneBits].set(static_cast<std::uint32_t>(i) & kLaneMask, hull);
                if (level == 1) { nodeSpreads_[i] = spreadOf(hull); }
            }
        });
        if (level > 1) { continue; }
        for (const double spread : nodeSpreads_) { builtSpread_ += spread; }  // in order, for any number of workers
    }
    spread_ = builtSpread_;
    builtSize_ = size_;
}

}  // namespace swept::inline SWEPT_PRECISION
