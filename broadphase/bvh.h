#pragma once

#include <array>

#include "aabb_tree.h"
#include "table_broadphase.h"

namespace swept::inline SWEPT_PRECISION {

/// One dynamic tree of boxes per kind. Pairs are found by joining the trees of kinds that can meet, subtree against
/// subtree, leaving out all in which nothing moved.
///
/// n proxies of which m moved: an insertion or a move out of the neighbourhood O(log n), a move within it O(1) mostly;
/// the join O(m log n + pairs) in worlds whose boxes do not all overlap; a query O(log n + found).
class Bvh final : public TableBroadphase {
public:
    std::unique_ptr<Broadphase> clone() const override { return std::make_unique<Bvh>(*this); }
    /// For tests and for measuring its quality.
    const AabbTree& tree(ProxyKind kind) const { return trees_[static_cast<std::size_t>(kind)]; }

    /// All of it (shapes/listed_members.h).
    template <class Self>
    static constexpr auto allMembers(Self& self) {
        return listed(baseOf<TableBroadphase>(self), self.leaves_, self.trees_);
    }

private:
    void onInsert(std::uint32_t slot) override;
    void onMove(std::uint32_t slot) override;
    void onRenew(std::uint32_t slot) override { onMove(slot); }
    void onRemove(std::uint32_t slot) override;
    void onPairsDone(TaskSystem& loops) override;
    std::uint64_t join(PairSink& sink, TaskSystem& loops) override;
    std::uint64_t visitOverlaps(const Aabb& box, FunctionRef<bool(ProxyId)> visit) const override;
    void visitAlong(SweepVisit& visit) const override;
    std::size_t structureBytes() const override;

    AabbTree& treeAt(std::uint32_t slot) {
        return trees_[static_cast<std::size_t>(table().kindOf(static_cast<ProxyId>(slot)))];
    }

    std::vector<NodeIndex> leaves_;  // one per slot: the leaf in the tree of the slot's kind
    std::array<AabbTree, kProxyKindCount> trees_;
};

}  // namespace swept::inline SWEPT_PRECISION
