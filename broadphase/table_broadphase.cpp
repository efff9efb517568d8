#include "table_broadphase.h"

#include <cassert>

namespace swept::inline SWEPT_PRECISION {

namespace {

/// Gives the slot back when the structure has no memory for it, and so throws.
struct AddedProxy {
    AddedProxy(ProxyTable& itsTable, ProxyId itsId) : table(itsTable), id(itsId) {}
    AddedProxy(const AddedProxy&) = delete;
    AddedProxy& operator=(const AddedProxy&) = delete;
    ~AddedProxy() {
        if (!isWhole) { table.release(id); }
    }

    ProxyTable& table;
    ProxyId id;
    bool isWhole = false;
};

/// Whether a query may be asked as it is: no copy of its box is made.
constexpr bool isUsual(const Aabb& box) { return isAskable(box) && askedAs(box).upper.x == box.upper.x; }

}  // namespace

Result<ProxyId> TableBroadphase::insert(const Aabb& box, ProxyKind kind) {
    if (const Status status = checkBox(box); !status.ok()) { return status; }
    const Result<ProxyId> added = table_.add(box, kind);
    if (!added.ok()) { return added; }
    AddedProxy kept(table_, added.value());
    onInsert(static_cast<std::uint32_t>(added.value()));
    kept.isWhole = true;
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

void TableBroadphase::beginMoves() { onBeginMoves(); }

Status TableBroadphase::moveInParallel(ProxyId id, const Aabb& box) {
    if (!table_.holds(id)) { return {StatusCode::staleId, "id"}; }
    if (const Status status = checkBox(box); !status.ok()) { return status; }
    onMoveInParallel(static_cast<std::uint32_t>(id), box);
    return Status::success();
}

std::size_t TableBroadphase::endMoves(TaskSystem& loops) {
    const std::size_t count = onEndMoves(loops);
    anyInParallel_ = anyInParallel_ || count > 0;
    counters_.reinserted += count;
    return count;
}

void TableBroadphase::onBeginMoves() {
    pendingBox_.resize(table_.slotCount());
    isPending_.assign(table_.slotCount(), 0);
}

void TableBroadphase::onMoveInParallel(std::uint32_t slot, const Aabb& box) {
    pendingBox_[slot] = box;
    isPending_[slot] = 1;
}

std::size_t TableBroadphase::onEndMoves(TaskSystem& /*loops*/) {
    std::size_t count = 0;
    for (std::uint32_t slot = 0; slot < isPending_.size(); ++slot) {
        if (isPending_[slot] == 0) { continue; }
        table_.move(static_cast<ProxyId>(slot), pendingBox_[slot]);
        onMove(slot);
        ++count;
    }
    return count;
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
    if (table_.listedMoved().empty() && !anyInParallel_) { return; }
    PairSink sink(table_, out);
    counters_.boxTests += join(sink, loops);
    order_.sort(out, table_.slotCount(), loops);
    onPairsDone(loops);
    table_.finishPairs();
    anyInParallel_ = false;
    counters_.pairsReported += out.size();
}

void TableBroadphase::query(const Aabb& box, FunctionRef<bool(ProxyId)> visit) const {
    if (isUsual(box)) {
        queryTests_.add(visitOverlaps(box, visit));
    } else if (isAskable(box)) {
        queryTests_.add(visitOverlaps(askedAs(box), visit));
    }
}

void TableBroadphase::queryGround(const Aabb& box, FunctionRef<bool(ProxyId)> visit) const {
    if (isUsual(box)) {
        queryTests_.add(visitGround(box, visit));
    } else if (isAskable(box)) {
        queryTests_.add(visitGround(askedAs(box), visit));
    }
}

void TableBroadphase::queryDynamic(std::span<const Aabb> boxes, FunctionRef<void(std::size_t, ProxyId)> visit) const {
    queryTests_.add(visitDynamic(boxes, visit));
}

std::uint64_t TableBroadphase::visitDynamic(std::span<const Aabb> boxes,
                                            FunctionRef<void(std::size_t, ProxyId)> visit) const {
    std::uint64_t tests = 0;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        if (!isAskable(boxes[i])) { continue; }
        tests += visitOverlaps(askedAs(boxes[i]), [&](ProxyId id) {
            visit(i, id);
            return true;
        });
    }
    return tests;
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
    return table_.memoryBytes() + order_.memoryBytes() + structureBytes() + bytesOf(pendingBox_) + bytesOf(isPending_);
}

}  // namespace swept::inline SWEPT_PRECISION
