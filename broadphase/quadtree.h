#pragma once

#include <array>

#include "table_broadphase.h"

namespace swept::inline SWEPT_PRECISION {

/// A loose quadtree: every square has four quarters, and a box is put into the smallest square that is no shorter than
/// the box and holds its lower corner, where it stays as long as it fits. All that stands in a square lies within a
/// square of twice its size, so one place per box is enough, and it follows from size and corner alone (Ulrich, "Loose
/// octrees", Game Programming Gems, 2000).
/// The root grows as boxes come that it does not hold; squares that nothing stands in or below are given back.
///
/// n proxies of which m moved, a tree of h levels (log₂ of the world over the smallest box: what comes is put
/// 32 levels down at most, but the root grows over what is there; in f32 some 250, in f64 some 2000 at the very most,
/// as deep as walks call themselves): insert, remove and a move to another square O(h), a move within the square O(1);
/// the join O(m·(h + k) + pairs) for k boxes in the squares around one; a query O(h + squares met). Good where sizes
/// differ much.
class Quadtree final : public TableBroadphase {
public:
    std::unique_ptr<Broadphase> clone() const override { return std::make_unique<Quadtree>(*this); }
    Quadtree();

    /// All of it (shapes/listed_members.h).
    template <class Self>
    static constexpr auto allMembers(Self& self) {
        return listed(baseOf<TableBroadphase>(self), self.squares_, self.free_, self.root_, self.standsIn_, self.next_,
                      self.previous_);
    }

private:
    using SquareIndex = std::uint32_t;
    struct Square {
        double x = 0;  ///< centre, metres
        double y = 0;
        double half = 0;  ///< of its side, metres
        Aabb loose{};     ///< contains all that may stand here
        SquareIndex parent = 0;
        std::array<SquareIndex, 4> quarters = {};  ///< 0: none; by (x is above) + 2·(y is above)
        std::uint32_t first = 0;                   ///< slot; what stands here is a list
        std::uint32_t count = 0;                   ///< boxes here and in all quarters

        bool holds(const Aabb& box) const;
    };

    void onInsert(std::uint32_t slot) override;
    void onMove(std::uint32_t slot) override;
    void onRemove(std::uint32_t slot) override { takeOut(slot); }
    std::uint64_t join(PairSink& sink, TaskSystem& loops) override;
    std::uint64_t visitOverlaps(const Aabb& box, FunctionRef<bool(ProxyId)> visit) const override;
    void visitAlong(SweepVisit& visit) const override;
    std::size_t structureBytes() const override;

    SquareIndex addSquare(double x, double y, double half, SquareIndex parent);
    void growRootOver(const Aabb& box);
    SquareIndex squareFor(const Aabb& box);
    void put(std::uint32_t slot);
    void takeOut(std::uint32_t slot);
    /// Calls `offer(slot)` for all in a square that may overlap a box, until it returns false. Returns what it returned
    /// last.
    template <class Offer>
    bool offerBelow(SquareIndex index, const Aabb& box, const Offer& offer) const;
    void walkBelow(SquareIndex index, SweepVisit& visit) const;

    std::vector<Square> squares_;  // the first is no part of the tree: it holds what is too large or far for any square
    std::vector<SquareIndex> free_;
    SquareIndex root_ = 0;                 // 0: none yet
    std::vector<SquareIndex> standsIn_;    // one per slot
    std::vector<std::uint32_t> next_;      // one per slot: in the list of its square
    std::vector<std::uint32_t> previous_;  // likewise
};

}  // namespace swept::inline SWEPT_PRECISION
