#pragma once

#include <array>

#include "../shapes/copied_atomic.h"
#include "table_broadphase.h"
#include "wide_kernels.h"
#include "wide_tree.h"

namespace swept::inline SWEPT_PRECISION {

/// One wide tree per kind. Pairs are found by joining what moved in one tree with all of another, eight boxes at a
/// time; a box that did not move, asleep or fixed, costs nothing unless something comes near.
///
/// n proxies of which m moved: move O(1) mostly; the join O(m log n + pairs) in worlds whose boxes do not all overlap,
/// and a rebuild, O(n log n), no more often than what it saves; a query O(log n + found).
class WideBvh final : public TableBroadphase {
public:
    std::unique_ptr<Broadphase> clone() const override { return std::make_unique<WideBvh>(*this); }
    explicit WideBvh(const WideKernels& kernels = widestKernels()) : TableBroadphase(false), kernels_(kernels) {}

    /// For tests and for measuring its quality.
    const WideTree& tree(ProxyKind kind) const { return trees_[static_cast<std::size_t>(kind)]; }

    /// All of it (shapes/listed_members.h).
    template <class Self>
    static constexpr auto allMembers(Self& self) {
        return listed(baseOf<TableBroadphase>(self), leftOut(self.kernels_), self.trees_,
                      leftOut(self.kindsInParallel_), self.places_, leftOut(self.joins_), leftOut(self.scratch_));
    }

private:
    void onInsert(std::uint32_t slot) override;
    void onMove(std::uint32_t slot) override;
    void onRenew(std::uint32_t slot) override { treeAt(slot).forget(places_[slot]); }
    void onRemove(std::uint32_t slot) override;
    void onBeginMoves() override;
    void onMoveInParallel(std::uint32_t slot, const Aabb& box) override;
    std::size_t onEndMoves(TaskSystem& loops) override;
    void onPairsDone(TaskSystem& loops) override;
    std::uint64_t join(PairSink& sink, TaskSystem& loops) override;
    std::uint64_t visitOverlaps(const Aabb& box, FunctionRef<bool(ProxyId)> visit) const override;
    std::uint64_t visitGround(const Aabb& box, FunctionRef<bool(ProxyId)> visit) const override;
    std::uint64_t visitDynamic(std::span<const Aabb> boxes,
                               FunctionRef<void(std::size_t, ProxyId)> visit) const override;
    void visitAlong(SweepVisit& visit) const override;
    std::size_t structureBytes() const override;

    WideTree& treeAt(std::uint32_t slot) {
        return trees_[static_cast<std::size_t>(table().kindOf(static_cast<ProxyId>(slot)))];
    }

    void prepareJoins(TaskSystem& loops);
    void listJoins();

    const WideKernels& kernels_;
    std::array<WideTree, kProxyKindCount> trees_;
    std::array<CopiedAtomic<bool>, kProxyKindCount> kindsInParallel_{};  // some of it were moved in parallel
    std::vector<std::uint32_t> places_;  // one per slot: the place in the tree of the slot's kind
    std::vector<WideJoin> joins_;        // the pieces of a search, none of which needs another
    std::vector<WideScratch> scratch_;   // one per worker
};

}  // namespace swept::inline SWEPT_PRECISION
