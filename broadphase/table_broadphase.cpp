#include "table_broadphase.h"

#include <cassert>

namespace swept::inline SWEPT_PRECISION {

Result<ProxyId> TableBroadphase::insert(const Aabb& box, ProxyKind kind) {
    if (const Status status = checkBox(box); !status.ok()) { return status; }
    const Result<ProxyId> added = table_.add(box, kind);
    if (added.ok()) { onInsert(static_cast<std::uint32_t>(added.value())); }
    return added;
}

Status TableBroadphase::move(ProxyId id, const Aabb& box) {
    if (!table_.holds(id)) { return {StatusCode::staleId, "id"}; }
    if (const Status status = checkBox(box); !status.ok()) { return status; }
    const auto slot = static_cast<std::uint32_t>(id);
    table_.move(id, box);
    onMove(slot);
    ++counters_.reinserted;
    return Status::success();
}

Status TableBroadphase::remove(ProxyId id) {
    if (!table_.holds(id)) { return {StatusCode::staleId, "id"}; }
    onRemove(static_cast<std::uint32_t>(id));
    table_.release(id);
    return Status::success();
}

Status TableBroadphase::renewPairs(ProxyId id) {
    if (!table_.holds(id)) { return {StatusCode::staleId, "id"}; }
    const auto slot = static_cast<std::uint32_t>(id);
    table_.renew(id);
    onRenew(slot);
    return Status::success();
}

const Aabb& TableBroadphase::box(ProxyId id) const {
    assert(table_.holds(id) && "the box of a stale id");
    return table_.boxAt(static_cast<std::uint32_t>(id));
}

void TableBroadphase::pairs(std::vector<ProxyPair>& out, TaskSystem& loops) {
    out.clear();
    if (table_.listedMoved().empty()) { return; }
    PairSink sink(table_, out);
    counters_.boxTests += join(sink, loops);
    order_.sort(out, table_.slotCount());
    onPairsDone();
    table_.finishPairs();
    counters_.pairsReported += out.size();
}

void TableBroadphase::query(const Aabb& box, FunctionRef<bool(ProxyId)> visit) const {
    queryTests_.add(visitOverlaps(box, visit));
}

void TableBroadphase::queryGround(const Aabb& box, FunctionRef<bool(ProxyId)> visit) const {
    queryTests_.add(visitGround(box, visit));
}

void TableBroadphase::ray(DVec2 origin, DVec2 direction, Real maxFraction,
                          FunctionRef<Real(ProxyId, Real)> visit) const {
    castAlong(BoxSweep::ofRay(origin, direction), maxFraction, visit);
}

void TableBroadphase::sweep(const Aabb& box, DVec2 translation, Real maxFraction,
                            FunctionRef<Real(ProxyId, Real)> visit) const {
    castAlong(BoxSweep::ofBox(box, translation), maxFraction, visit);
}

void TableBroadphase::castAlong(const BoxSweep& sweep, Real maxFraction, FunctionRef<Real(ProxyId, Real)> visit) const {
    SweepVisit along(sweep, maxFraction, visit);
    visitAlong(along);
    queryTests_.add(along.tests());
}

BroadphaseCounters TableBroadphase::counters() const {
    BroadphaseCounters sum = counters_;
    sum.boxTests += queryTests_.sum();
    return sum;
}

std::size_t TableBroadphase::memoryBytes() const {
    return table_.memoryBytes() + order_.memoryBytes() + structureBytes();
}

}  // namespace swept::inline SWEPT_PRECISION
