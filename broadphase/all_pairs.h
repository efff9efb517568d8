#pragma once

#include "table_broadphase.h"

namespace swept::inline SWEPT_PRECISION {

/// Every box against every box that moved: no upkeep at all, so good for a handful of proxies, and the reference that
/// the other implementations are tested against. n proxies of which m moved: m·n box tests; a query: n.
class AllPairs final : public TableBroadphase {
public:
    std::unique_ptr<Broadphase> clone() const override { return std::make_unique<AllPairs>(*this); }

    /// All of it (shapes/listed_members.h).
    template <class Self>
    static constexpr auto allMembers(Self& self) {
        return listed(baseOf<TableBroadphase>(self));
    }

private:
    void onInsert(std::uint32_t) override {}
    void onMove(std::uint32_t) override {}
    void onRemove(std::uint32_t) override {}
    std::uint64_t join(PairSink& sink, TaskSystem& loops) override;
    std::uint64_t visitOverlaps(const Aabb& box, FunctionRef<bool(ProxyId)> visit) const override;
    void visitAlong(SweepVisit& visit) const override;
    std::size_t structureBytes() const override { return 0; }
};

}  // namespace swept::inline SWEPT_PRECISION
