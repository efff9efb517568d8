#include "wide_bvh.h"

namespace swept::inline SWEPT_PRECISION {
void WideBvh::onInsert(std::uint32_t slot) {
    if (slot == places_.size()) { places_.push_back(0); }
    treeAt(slot).insert(slot, table().boxAt(slot), places_);
}

void WideBvh::onMove(std::uint32_t slot) { treeAt(slot).move(places_[slot], table().boxAt(slot)); }

void WideBvh::onRemove(std::uint32_t slot) { treeAt(slot).remove(places_[slot]); }

std::uint64_t WideBvh::join(PairSink& sink) {
    for (WideTree& tree : trees_) {
        if (tree.prepareJoin(places_)) { countRebuild(); }
    }
    std::uint64_t tests = 0;
    for (int first = 0; first < kProxyKindCount; ++first) {
        for (int second = 0; second < kProxyKindCount; ++second) {
            const WideTree& moving = trees_[static_cast<std::size_t>(first)];
            const WideTree& other = trees_[static_cast<std::size_t>(second)];
            const bool canMeetAny = canMeet(static_cast<ProxyKind>(first), static_cast<ProxyKind>(second));
            if (!canMeetAny || !moving.anyMoved() || other.height() == 0) { continue; }
            tests += kernels_.join({.moving = &moving,
                                    .other = &other,
                                    .skipMoved = first > second,
                                    .scratch = &scratch_,
                                    .out = &sink.newPairs()});
        }
    }
    return tests;
}

void WideBvh::onPairsDone() {
    for (WideTree& tree : trees_) { tree.finishJoin(); }
}

std::uint64_t WideBvh::visitOverlaps(const Aabb& box, FunctionRef<bool(ProxyId)> visit) const {
    std::uint64_t tests = 0;
    bool goOn = true;
    for (const WideTree& tree : trees_) {
        tests += kernels_.query(tree, box, goOn, visit);
        if (!goOn) { break; }
    }
    return tests;
}

std::uint64_t WideBvh::visitGround(const Aabb& box, FunctionRef<bool(ProxyId)> visit) const {
    bool goOn = true;
    const std::uint64_t tests = kernels_.query(tree(ProxyKind::fixed), box, goOn, visit);
    const WideTree& kinematic = tree(ProxyKind::kinematic);
    return goOn && kinematic.height() > 0 ? tests + kernels_.query(kinematic, box, goOn, visit) : tests;
}

void WideBvh::visitAlong(SweepVisit& visit) const {
    for (const WideTree& tree : trees_) {
        kernels_.sweep(tree, visit);
        if (visit.isOver()) { return; }
    }
}

std::size_t WideBvh::structureBytes() const {
    std::size_t sum = bytesOf(places_);
    for (const WideTree& tree : trees_) { sum += tree.memoryBytes(); }
    for (const auto& list : scratch_.candidates) { sum += bytesOf(list); }
    return sum;
}

}  // namespace swept::inline SWEPT_PRECISION
