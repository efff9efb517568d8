#pragma once

#include "table_broadphase.h"

namespace swept::inline SWEPT_PRECISION {

/// A grid without edges: each box is filed once, in the cell of its lower corner, and cells are found by hashing, so
/// that memory depends on the number of boxes alone (Teschner et al., "Optimized spatial hashing", 2003). No filed box
/// is longer than a cell, so all that overlap something begin in its cells or one before. What is longer than a cell, a
/// few giants, is kept in a list of its own that everything is compared with. The length of a cell follows the sizes:
/// so long that one box of 64 is a giant.
///
/// n proxies of which m moved, g giants: insert, move and remove O(1); the join O(m·(k + g) + pairs) for k boxes in the
/// cells around one; a query O(cells, no more than n, + g); refiling all, O(n), when number or sizes have changed much.
/// Good where sizes are alike.
class Grid final : public TableBroadphase {
public:
    std::unique_ptr<Broadphase> clone() const override { return std::make_unique<Grid>(*this); }
    Grid();

    /// All of it (shapes/listed_members.h).
    template <class Self>
    static constexpr auto allMembers(Self& self) {
        return listed(baseOf<TableBroadphase>(self), self.buckets_, self.next_, self.previous_, self.cells_,
                      self.isGiant_, leftOut(self.sizes_), self.firstGiant_, self.giants_, self.filed_,
                      self.giantsAtRefiling_, self.used_, self.cell_);
    }

private:
    struct Cell {
        std::int32_t x = 0;
        std::int32_t y = 0;
        constexpr bool operator==(const Cell&) const = default;
    };
    struct CellRange {
        Cell first;
        Cell last;
    };

    void onInsert(std::uint32_t slot) override;
    void onMove(std::uint32_t slot) override;
    void onRemove(std::uint32_t slot) override { takeOut(slot); }
    std::uint64_t join(PairSink& sink, TaskSystem& loops) override;
    std::uint64_t visitOverlaps(const Aabb& box, FunctionRef<bool(ProxyId)> visit) const override;
    void visitAlong(SweepVisit& visit) const override;
    std::size_t structureBytes() const override;

    std::uint32_t& listOf(std::uint32_t slot);
    std::uint32_t bucketOf(Cell cell) const;
    Cell cellAt(Vec2 point) const;
    void file(std::uint32_t slot);
    void takeOut(std::uint32_t slot);
    bool isRefilingDue() const;
    void refileAll();
    void chooseCell();
    void walkCells(const CellRange& cells, SweepVisit& visit) const;
    /// Calls `offer(slot)` for all that may overlap a box, each once, until it returns false.
    template <class Offer>
    void offerAround(const Aabb& box, const Offer& offer) const;
    /// Calls `offer(slot)` for all of a list that are filed in a cell, until it returns false. Returns what it returned
    /// last.
    template <class Offer>
    bool offerCell(Cell cell, const Offer& offer) const;

    std::vector<std::uint32_t> buckets_;   // first slot of each bucket's list; a power of two of them
    std::vector<std::uint32_t> next_;      // one per slot: in the list of its bucket, or of the giants
    std::vector<std::uint32_t> previous_;  // likewise
    std::vector<Cell> cells_;              // one per slot
    std::vector<std::uint8_t> isGiant_;    // one per slot
    std::vector<double> sizes_;            // scratch
    std::uint32_t firstGiant_;
    std::uint32_t giants_ = 0;
    std::uint32_t filed_ = 0;  // giants included
    std::uint32_t giantsAtRefiling_ = 0;
    CellRange used_;   // all cells with something in them, and maybe more; if nothing is filed maybe none
    double cell_ = 1;  // length of a cell, metres
};

}  // namespace swept::inline SWEPT_PRECISION
