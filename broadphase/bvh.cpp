#include "bvh.h"

#include "tree_walks.h"

namespace swept::inline SWEPT_PRECISION {

void Bvh::onInsert(std::uint32_t slot) {
    if (slot == leaves_.size()) { leaves_.push_back(kNoTreeNode); }
    leaves_[slot] = treeAt(slot).insert(table().boxAt(slot), slot, true);
}

void Bvh::onMove(std::uint32_t slot) { treeAt(slot).move(leaves_[slot], table().boxAt(slot)); }

void Bvh::onRemove(std::uint32_t slot) { treeAt(slot).erase(leaves_[slot]); }

void Bvh::onPairsDone(TaskSystem& /*loops*/) {
    for (const std::uint32_t slot : table().listedMoved()) {
        if (table().bitAt(slot) != 0) { treeAt(slot).clearMoved(leaves_[slot]); }
    }
}

std::uint64_t Bvh::join(PairSink& sink, TaskSystem& /*loops*/) {
    std::uint64_t tests = 0;
    const auto report = [&sink](std::uint32_t a, std::uint32_t b) { sink.add(a, b); };
    for (int first = 0; first < kProxyKindCount; ++first) {
        for (int second = first; second < kProxyKindCount; ++second) {
            if (!canMeet(static_cast<ProxyKind>(first), static_cast<ProxyKind>(second))) { continue; }
            const AabbTree& a = trees_[static_cast<std::size_t>(first)];
            const AabbTree& b = trees_[static_cast<std::size_t>(second)];
            if (first == second) {
                tests += joinWithin(a, report);
            } else if (a.root() != kNoTreeNode && b.root() != kNoTreeNode) {
                tests += joinNodes(a, a.root(), b, b.root(), report);
            }
        }
    }
    return tests;
}

std::uint64_t Bvh::visitOverlaps(const Aabb& box, FunctionRef<bool(ProxyId)> visit) const {
    std::uint64_t tests = 0;
    bool goOn = true;
    for (const AabbTree& tree : trees_) {
        tests += walkOverlaps(tree, box, goOn, [&](std::uint32_t slot) { return visit(static_cast<ProxyId>(slot)); });
        if (!goOn) { break; }
    }
    return tests;
}

void Bvh::visitAlong(SweepVisit& visit) const {
    for (const AabbTree& tree : trees_) {
        walkSweep(tree, visit);
        if (visit.isOver()) { return; }
    }
}

std::size_t Bvh::structureBytes() const {
    std::size_t sum = bytesOf(leaves_);
    for (const AabbTree& tree : trees_) { sum += tree.memoryBytes(); }
    return sum;
}

}  // namespace swept::inline SWEPT_PRECISION
