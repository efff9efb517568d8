#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "../shapes/aabb.h"
#include "../shapes/listed_members.h"
#include "../shapes/task_system.h"

namespace swept::inline SWEPT_PRECISION {

/// Boxes, or nodes, under one node. Eight floats fill the widest registers in common use, and a lane is three bits of
/// an index.
inline constexpr std::uint32_t kWide = 8;
inline constexpr std::uint32_t kLaneBits = 3;
inline constexpr std::uint32_t kLaneMask = kWide - 1;
inline constexpr std::uint8_t kAllLanes = (1U << kWide) - 1;
inline constexpr std::uint32_t kNoSlot = (std::numeric_limits<std::uint32_t>::max)();

/// Eight boxes, coordinate by coordinate, as lanes of one comparison. Empty lanes hold `kNoBox`.
struct alignas(64) WideBoxes {
    std::array<Real, kWide> lowerX;
    std::array<Real, kWide> lowerY;
    std::array<Real, kWide> upperX;
    std::array<Real, kWide> upperY;

    static WideBoxes empty();
    /// Of up to eight; one with a bound that is no number becomes an empty lane.
    static WideBoxes of(std::span<const Aabb> some);
    Aabb box(std::uint32_t lane) const { return {{lowerX[lane], lowerY[lane]}, {upperX[lane], upperY[lane]}}; }
    void set(std::uint32_t lane, const Aabb& box) {
        lowerX[lane] = box.lower.x;
        lowerY[lane] = box.lower.y;
        upperX[lane] = box.upper.x;
        upperY[lane] = box.upper.y;
    }
    Aabb hull() const;
};

/// Half the perimeter; 0 for `kNoBox`. May be infinite for boxes near the range of `Real`, and then decides nothing.
inline double spreadOf(const Aabb& box) {
    if (!(box.lower.x <= box.upper.x)) { return 0; }
    return (static_cast<double>(box.upper.x) - static_cast<double>(box.lower.x)) +
           (static_cast<double>(box.upper.y) - static_cast<double>(box.lower.y));
}

/// One node of the tree over what has moved (`WideTree::moved`), parallel to a node of the tree itself.
struct MovedNode {
    Aabb hull;                     ///< of the moved boxes below
    std::uint32_t node = 0;        ///< its index in the level
    std::uint32_t firstChild = 0;  ///< in the moved nodes one level below; the children end where the next node's begin
};

/// A tree of boxes with eight children per node and no pointers: node i of a level has nodes 8i … 8i + 7 of the level
/// below as children, and the boxes of those children as its own lanes. The lowest level holds the proxies' boxes
/// themselves (a packed R-tree: Roussopoulos and Leifker, "Direct spatial search on pictorial databases using packed
/// R-trees", 1985).
///
/// A moved box stays in its place and the boxes above it grow; `refit` makes them tight again, of all moved boxes at
/// once. What jumps away from its neighbours, and what is inserted, goes to the end. When that has made walks dear
/// enough, the whole order is built anew (`rebuild`): by size first, since a large box among small ones would spoil
/// every node above it, then by halving the wider axis at the median.
///
/// n boxes, m of them moved: insertion and move O(1) mostly, O(log n) at worst; refit O(n/64 + m); rebuild O(n log n).
class WideTree {
public:
    /// 8¹¹ > 2³² proxies.
    static constexpr std::size_t kMaxLevels = 11;

    /// Everything anew: boxes in an order in which what is near follows each other; slot i at place i. All are known,
    /// and none has moved.
    void pack(std::span<const Aabb> boxes);

    /// Places are indices of lanes at the lowest level. The tree keeps `places[slot]` of its proxies up to date.
    void insert(std::uint32_t slot, const Aabb& box, std::span<std::uint32_t> places);
    void remove(std::uint32_t place);
    void move(std::uint32_t place, const Aabb& box);
    /// Likewise, of different places at the same time; the boxes above follow with `endMoves`.
    void moveInParallel(std::uint32_t place, const Aabb& box);
    /// Marks what was moved that way. What asks for boxes needs `prepareJoin` first. @return how many were
    std::uint32_t endMoves(TaskSystem& loops);
    /// Takes a box back from the known ones, and marks it as moved.
    void forget(std::uint32_t place);

    /// Rebuilds when that is due, makes all boxes above moved ones tight, and lists what has moved. Nothing to do when
    /// nothing changed since the last call.
    /// @return whether it was rebuilt.
    bool prepareJoin(std::span<std::uint32_t> places, TaskSystem& loops);
    /// From here on all boxes are known, and nothing has moved.
    void finishJoin(TaskSystem& loops);

    /// Number of levels; 0 when nothing was ever put into it. The highest has one node.
    std::size_t height() const { return height_; }
    const WideBoxes* level(std::size_t index) const { return levels_[index].data(); }
    /// Boxes as they were when pairs were found last, parallel to level 0.
    const WideBoxes* known() const { return known_.data(); }
    /// One per lane of level 0; `kNoSlot` where nothing is.
    const std::uint32_t* slots() const { return slots_.data(); }
    /// One bit per lane, one byte per node of level 0.
    const std::uint8_t* movedLanes() const { return movedLanes_.data(); }
    /// What has moved, as of `prepareJoin`: one list per level, with a sentinel at its end; empty when nothing has.
    std::span<const MovedNode> moved(std::size_t level) const { return moved_[level]; }
    bool anyMoved() const { return !moved_[0].empty(); }
    std::uint32_t size() const { return size_; }
    std::size_t memoryBytes() const;

    /// All of it (shapes/listed_members.h).
    template <class Self>
    static constexpr auto allMembers(Self& self) {
        return listed(self.levels_, self.known_, self.slots_, self.movedLanes_, self.movedNodes_, self.jumpedLanes_,
                      self.jumped_, self.parallelMarks_, self.nodeSpreads_, self.moved_, self.height_, self.size_,
                      self.end_, self.movedCount_, self.misplaced_, self.builtSpread_, self.builtSize_, self.spread_,
                      self.isPrepared_, self.decay_, leftOut(self.spreadGains_), leftOut(self.items_),
                      leftOut(self.oldBoxes_), leftOut(self.oldKnown_), leftOut(self.oldSlots_),
                      leftOut(self.oldMoved_));
    }

private:
    struct Item {
        float x;  // of the centre: enough to find a good order
        float y;
        std::uint32_t from;
        std::uint32_t sizeClass;
    };

    std::uint32_t append(std::uint32_t slot, const Aabb& box, const Aabb& known);
    void makeRoomForNodes();
    void addNodes();
    void include(std::uint32_t place, const Aabb& box);
    void mark(std::uint32_t place);
    bool jumpsFrom(std::uint32_t place, const Aabb& box) const;
    std::uint32_t takeParallelMarks(std::size_t begin, std::size_t end);
    void settleJumps(std::span<std::uint32_t> places);
    void sortMovedNodes();
    void refit(TaskSystem& loops);
    void refitNodes(std::size_t begin, std::size_t end);
    void listMovedAbove(std::size_t level);
    bool isWorthRebuilding() const;
    void makeRoomForItems(std::size_t count);
    void rebuild(std::span<std::uint32_t> places, TaskSystem& loops);
    void collectItems(TaskSystem& loops);
    void layOut(std::span<std::uint32_t> places, TaskSystem& loops);
    void clearJumps();
    void layOutNode(std::uint32_t node, std::span<std::uint32_t> places);
    void buildLevels(TaskSystem& loops);

    std::array<std::vector<WideBoxes>, kMaxLevels> levels_;
    std::vector<WideBoxes> known_;
    std::vector<std::uint32_t> slots_;
    std::vector<std::uint8_t> movedLanes_;
    std::vector<std::uint32_t> movedNodes_;    // those with marks, and maybe others, and maybe twice
    std::vector<std::uint8_t> jumpedLanes_;    // those that left the box of their node in one move
    std::vector<std::uint32_t> jumped_;        // their places
    std::vector<std::uint8_t> parallelMarks_;  // one per place: kMovedInParallel, kJumpedInParallel
    std::vector<double> nodeSpreads_;          // of the lowest nodes when they were built; 0: not known yet
    std::array<std::vector<MovedNode>, kMaxLevels> moved_;
    std::size_t height_ = 0;
    std::uint32_t size_ = 0;        // proxies in the tree
    std::uint32_t end_ = 0;         // lanes in use, empty ones between them included
    std::uint32_t movedCount_ = 0;  // at most: marks of what was removed since are counted too
    std::uint32_t misplaced_ = 0;   // appended or removed since the last build
    double builtSpread_ = 0;        // sum of perimeters of the lowest nodes after the last build
    double builtSize_ = 0;          // proxies then
    double spread_ = 0;             // the same now
    bool isPrepared_ = false;       // nothing changed since `prepareJoin`
    double decay_ = 0;              // what the growth of the spread has cost since, in moved boxes

    std::vector<double> spreadGains_;  // scratch of refit: by which its moved nodes grew
    std::vector<Item> items_;          // scratch of rebuild
    std::vector<WideBoxes> oldBoxes_;
    std::vector<WideBoxes> oldKnown_;
    std::vector<std::uint32_t> oldSlots_;
    std::vector<std::uint8_t> oldMoved_;
};

}  // namespace swept::inline SWEPT_PRECISION
