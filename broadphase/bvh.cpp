#include "bvh.h"

#include <algorithm>
#include <cassert>

#include "box_sweep.h"
#include "tree_walks.h"

namespace swept::inline SWEPT_PRECISION {

namespace {

/// Walks all trees along a sweep. Returns the number of box tests.
std::uint64_t visitAlong(const BoxSweep& sweep, const std::array<AabbTree, kProxyKindCount>& trees, Real limit,
                         FunctionRef<Real(ProxyId, Real)> visit) {
    std::uint64_t tests = 0;
    bool goOn = true;
    const auto onLeaf = [&](std::uint32_t slot, Real current) {
        const Real shortened = std::min(current, visit(static_cast<ProxyId>(slot), current));
        goOn = shortened > 0;
        return shortened;
    };
    for (const AabbTree& tree : trees) {
        tests += walkSweep(tree, sweep, limit, onLeaf);
        if (!goOn) {
            break;
        }
    }
    return tests;
}

}  // namespace

Result<ProxyId> Bvh::insert(const Aabb& box, ProxyKind kind) {
    if (const Status status = checkBox(box); !status.ok()) {
        return status;
    }
    const Result<ProxyId> added = table_.add(kind);
    if (!added.ok()) {
        return added;
    }
    const NodeIndex leaf = treeOf(added.value()).insert(box, static_cast<std::uint32_t>(added.value()), true);
    const auto slot = static_cast<std::uint32_t>(added.value());
    if (slot == leaves_.size()) {
        leaves_.push_back(leaf);
    } else {
        leaves_[slot] = leaf;
    }
    return added;
}

Status Bvh::move(ProxyId id, const Aabb& box) {
    if (!table_.holds(id)) {
        return {StatusCode::staleId, "id"};
    }
    if (const Status status = checkBox(box); !status.ok()) {
        return status;
    }
    treeOf(id).move(leaves_[static_cast<std::uint32_t>(id)], box);
    table_.markMoved(id);
    ++counters_.reinserted;
    return Status::success();
}

Status Bvh::remove(ProxyId id) {
    if (!table_.holds(id)) {
        return {StatusCode::staleId, "id"};
    }
    treeOf(id).erase(leaves_[static_cast<std::uint32_t>(id)]);
    table_.release(id);
    return Status::success();
}

const Aabb& Bvh::box(ProxyId id) const {
    assert(table_.holds(id) && "the box of a stale id");
    return tree(table_.kindOf(id)).node(leaves_[static_cast<std::uint32_t>(id)]).box;
}

void Bvh::pairs(std::vector<ProxyPair>& out) {
    out.clear();
    std::uint64_t tests = 0;
    const auto report = [&out](std::uint32_t a, std::uint32_t b) {
        out.push_back({static_cast<ProxyId>(std::min(a, b)), static_cast<ProxyId>(std::max(a, b))});
    };
    for (int first = 0; first < kProxyKindCount; ++first) {
        for (int second = first; second < kProxyKindCount; ++second) {
            if (!canMeet(static_cast<ProxyKind>(first), static_cast<ProxyKind>(second))) {
                continue;
            }
            const AabbTree& a = trees_[static_cast<std::size_t>(first)];
            const AabbTree& b = trees_[static_cast<std::size_t>(second)];
            if (first == second) {
                tests += joinWithin(a, report);
            } else if (a.root() != kNoNode && b.root() != kNoNode) {
                tests += joinNodes(a, a.root(), b, b.root(), report);
            }
        }
    }
    order_.sort(out, table_.slotCount());
    for (const std::uint32_t slot : table_.listedMoved()) {
        const auto id = static_cast<ProxyId>(slot);
        if (table_.holds(id)) {
            treeOf(id).clearMoved(leaves_[slot]);
        }
    }
    table_.clearMoved();
    counters_.boxTests += tests;
    counters_.pairsReported += out.size();
}

void Bvh::query(const Aabb& box, FunctionRef<bool(ProxyId)> visit) const {
    std::uint64_t tests = 0;
    bool goOn = true;
    for (const AabbTree& tree : trees_) {
        tests += walkOverlaps(tree, box, goOn, [&](std::uint32_t slot) { return visit(static_cast<ProxyId>(slot)); });
        if (!goOn) {
            break;
        }
    }
    queryTests_.fetch_add(tests, std::memory_order_relaxed);
}

void Bvh::ray(DVec2 origin, DVec2 direction, Real maxFraction, FunctionRef<Real(ProxyId, Real)> visit) const {
    const std::uint64_t tests = visitAlong(BoxSweep::ofRay(origin, direction), trees_, maxFraction, visit);
    queryTests_.fetch_add(tests, std::memory_order_relaxed);
}

void Bvh::sweep(const Aabb& box, DVec2 translation, Real maxFraction, FunctionRef<Real(ProxyId, Real)> visit) const {
    const std::uint64_t tests = visitAlong(BoxSweep::ofBox(box, translation), trees_, maxFraction, visit);
    queryTests_.fetch_add(tests, std::memory_order_relaxed);
}

BroadphaseCounters Bvh::counters() const {
    BroadphaseCounters sum = counters_;
    sum.boxTests += queryTests_.load(std::memory_order_relaxed);
    return sum;
}

}  // namespace swept::inline SWEPT_PRECISION
