#include "all_pairs.h"

#include <algorithm>
#include <cassert>

#include "box_sweep.h"

namespace swept::inline SWEPT_PRECISION {

namespace {

/// Calls `visit` for each taken slot whose box the sweep meets. Returns the number of box tests.
std::uint64_t visitAlong(const BoxSweep& sweep, const ProxyTable& table, const std::vector<Aabb>& boxes, Real limit,
                         FunctionRef<Real(ProxyId, Real)> visit) {
    std::uint64_t tests = 0;
    for (std::uint32_t slot = 0; slot < table.slotCount(); ++slot) {
        if (table.bitAt(slot) == 0) {
            continue;
        }
        ++tests;
        if (sweep.firstTouch(boxes[slot], static_cast<double>(limit)) == BoxSweep::kNever) {
            continue;
        }
        limit = std::min(limit, visit(static_cast<ProxyId>(slot), limit));
        if (!(limit > 0)) {
            break;
        }
    }
    return tests;
}

}  // namespace

Result<ProxyId> AllPairs::insert(const Aabb& box, ProxyKind kind) {
    if (const Status status = checkBox(box); !status.ok()) {
        return status;
    }
    const Result<ProxyId> added = table_.add(kind);
    if (!added.ok()) {
        return added;
    }
    const auto slot = static_cast<std::uint32_t>(added.value());
    if (slot == boxes_.size()) {
        boxes_.push_back(box);
    } else {
        boxes_[slot] = box;
    }
    return added;
}

Status AllPairs::move(ProxyId id, const Aabb& box) {
    if (!table_.holds(id)) {
        return {StatusCode::staleId, "id"};
    }
    if (const Status status = checkBox(box); !status.ok()) {
        return status;
    }
    boxes_[static_cast<std::uint32_t>(id)] = box;
    table_.markMoved(id);
    ++counters_.reinserted;
    return Status::success();
}

Status AllPairs::remove(ProxyId id) {
    if (!table_.holds(id)) {
        return {StatusCode::staleId, "id"};
    }
    table_.release(id);
    return Status::success();
}

const Aabb& AllPairs::box(ProxyId id) const {
    assert(table_.holds(id) && "the box of a stale id");
    return boxes_[static_cast<std::uint32_t>(id)];
}

void AllPairs::pairs(std::vector<ProxyPair>& out) {
    out.clear();
    const std::span<const std::uint32_t> moved = table_.sortedMoved();
    std::uint64_t tests = 0;
    const auto consider = [&](std::uint32_t a, std::uint8_t meeting, std::uint32_t b) {
        if ((meeting & table_.bitAt(b)) == 0) {
            return;
        }
        ++tests;
        if (overlaps(boxes_[a], boxes_[b])) {
            out.push_back({static_cast<ProxyId>(a), static_cast<ProxyId>(b)});
        }
    };
    auto firstLater = moved.begin();  // the first moved slot above a
    for (std::uint32_t a = 0; a < table_.slotCount() && !moved.empty(); ++a) {
        while (firstLater != moved.end() && *firstLater <= a) {
            ++firstLater;
        }
        if (table_.bitAt(a) == 0) {
            continue;
        }
        const std::uint8_t meeting = meetingKinds(table_.kindOf(static_cast<ProxyId>(a)));
        if (table_.hasMoved(a)) {
            for (std::uint32_t b = a + 1; b < table_.slotCount(); ++b) {
                consider(a, meeting, b);
            }
        } else {
            for (auto later = firstLater; later != moved.end(); ++later) {
                consider(a, meeting, *later);
            }
        }
    }
    table_.clearMoved();
    counters_.boxTests += tests;
    counters_.pairsReported += out.size();
}

void AllPairs::query(const Aabb& box, FunctionRef<bool(ProxyId)> visit) const {
    std::uint64_t tests = 0;
    for (std::uint32_t slot = 0; slot < table_.slotCount(); ++slot) {
        if (table_.bitAt(slot) == 0) {
            continue;
        }
        ++tests;
        if (overlaps(box, boxes_[slot]) && !visit(static_cast<ProxyId>(slot))) {
            break;
        }
    }
    queryTests_.fetch_add(tests, std::memory_order_relaxed);
}

void AllPairs::ray(DVec2 origin, DVec2 direction, Real maxFraction, FunctionRef<Real(ProxyId, Real)> visit) const {
    const std::uint64_t tests = visitAlong(BoxSweep::ofRay(origin, direction), table_, boxes_, maxFraction, visit);
    queryTests_.fetch_add(tests, std::memory_order_relaxed);
}

void AllPairs::sweep(const Aabb& box, DVec2 translation, Real maxFraction,
                     FunctionRef<Real(ProxyId, Real)> visit) const {
    const std::uint64_t tests = visitAlong(BoxSweep::ofBox(box, translation), table_, boxes_, maxFraction, visit);
    queryTests_.fetch_add(tests, std::memory_order_relaxed);
}

BroadphaseCounters AllPairs::counters() const {
    BroadphaseCounters sum = counters_;
    sum.boxTests += queryTests_.load(std::memory_order_relaxed);
    return sum;
}

}  // namespace swept::inline SWEPT_PRECISION
