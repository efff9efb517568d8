#pragma once

#include <array>
#include <atomic>

#include "aabb_tree.h"
#include "pair_order.h"
#include "proxy_table.h"

namespace swept::inline SWEPT_PRECISION {

/// One dynamic tree of boxes per kind. Pairs are found by joining the trees of kinds that can meet, subtree against
/// subtree, leaving out all in which nothing moved.
class Bvh final : public Broadphase {
public:
    Result<ProxyId> insert(const Aabb& box, ProxyKind kind) override;
    Status move(ProxyId id, const Aabb& box) override;
    Status remove(ProxyId id) override;
    const Aabb& box(ProxyId id) const override;
    void pairs(std::vector<ProxyPair>& out) override;
    void query(const Aabb& box, FunctionRef<bool(ProxyId)> visit) const override;
    void ray(DVec2 origin, DVec2 direction, Real maxFraction, FunctionRef<Real(ProxyId, Real)> visit) const override;
    void sweep(const Aabb& box, DVec2 translation, Real maxFraction,
               FunctionRef<Real(ProxyId, Real)> visit) const override;
    BroadphaseCounters counters() const override;

    /// For tests and for measuring its quality.
    const AabbTree& tree(ProxyKind kind) const { return trees_[static_cast<std::size_t>(kind)]; }

private:
    AabbTree& treeOf(ProxyId id) { return trees_[static_cast<std::size_t>(table_.kindOf(id))]; }

    ProxyTable table_;
    std::vector<NodeIndex> leaves_;  // one per slot: the leaf in the tree of the slot's kind
    std::array<AabbTree, kProxyKindCount> trees_;
    PairOrder order_;
    BroadphaseCounters counters_;
    mutable std::atomic<std::uint64_t> queryTests_ = 0;  // queries may run at the same time as each other
};

}  // namespace swept::inline SWEPT_PRECISION
