#pragma once

#include "table_broadphase.h"
#include "wide_kernels.h"

namespace swept::inline SWEPT_PRECISION {

/// Boxes sorted by their lower bound along one axis: whoever meets a box begins before it ends ("sweep and prune",
/// Cohen et al., "I-COLLIDE", 1995). The axis is the one along which the centres vary more; it changes only when the
/// other is clearly better. The order is kept and repaired by insertion sort, which is linear where things move little.
///
/// n proxies of which m moved: a move is free; repairing the order O(n + inversions); the join O(n + m·k) for k boxes
/// that overlap along the axis, about √n in a square world; a query O(n/64 + m + blocks met). Good for long, flat
/// worlds.
class SortAndSweep final : public TableBroadphase {
public:
    std::unique_ptr<Broadphase> clone() const override { return std::make_unique<SortAndSweep>(*this); }

    /// All of it (shapes/listed_members.h).
    template <class Self>
    static constexpr auto allMembers(Self& self) {
        return listed(baseOf<TableBroadphase>(self), self.all_, leftOut(self.moved_), self.isListed_, self.blocks_,
                      leftOut(self.movedQueries_), leftOut(self.restedQueries_), leftOut(self.hits_), self.alongY_,
                      self.isSorted_);
    }

private:
    struct Entry {
        Real key;  ///< lower bound along the axis
        std::uint32_t slot;
    };

    /// Boxes in the order of a list of entries, eight to a node; the last node is filled up with `kNoBox`.
    struct Sorted {
        std::vector<Entry> entries;
        std::vector<WideBoxes> boxes;

        void pack(const ProxyTable& table);
    };

    // The order is brought up to date in one go, before pairs are found; what has moved since is looked at one by one.
    void onInsert(std::uint32_t) override {}
    void onMove(std::uint32_t) override {}
    void onRemove(std::uint32_t) override {}
    std::uint64_t join(PairSink& sink, TaskSystem& loops) override;
    std::uint64_t visitOverlaps(const Aabb& box, FunctionRef<bool(ProxyId)> visit) const override;
    void visitAlong(SweepVisit& visit) const override;
    std::size_t structureBytes() const override;

    Real keyOf(std::uint32_t slot) const;
    void renewEntries();
    void chooseAxis();
    void repairOrder();
    void prepareScans();
    std::uint64_t scan(const std::vector<IntervalQuery>& queries, const Sorted& others, PairSink& sink);
    bool isCurrent(std::uint32_t slot) const { return table().bitAt(slot) != 0 && !table().hasMoved(slot); }

    Sorted all_;
    Sorted moved_;                        // those of all_ that moved
    std::vector<std::uint8_t> isListed_;  // one per slot: stands in all_
    std::vector<Aabb> blocks_;            // hulls of so many entries, for queries
    std::vector<IntervalQuery> movedQueries_;
    std::vector<IntervalQuery> restedQueries_;
    std::vector<IntervalHit> hits_;
    bool alongY_ = false;
    bool isSorted_ = false;
};

}  // namespace swept::inline SWEPT_PRECISION
