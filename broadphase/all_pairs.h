#pragma once

#include <atomic>

#include "proxy_table.h"

namespace swept::inline SWEPT_PRECISION {

/// Every box against every box that moved: no upkeep at all, so the best choice for a handful of proxies, and the
/// reference the other implementations are tested against.
class AllPairs final : public Broadphase {
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

private:
    ProxyTable table_;
    std::vector<Aabb> boxes_;  // one per slot
    BroadphaseCounters counters_;
    mutable std::atomic<std::uint64_t> queryTests_ = 0;  // queries may run at the same time as each other
};

}  // namespace swept::inline SWEPT_PRECISION
