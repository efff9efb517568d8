#include "wide_bvh.h"

#include <algorithm>

namespace swept::inline SWEPT_PRECISION {
namespace {

/// A search among fewer nodes than these is over before another worker has begun: some 10 µs.
constexpr std::size_t kFewestToCut = 128;
constexpr std::size_t kFewestPieces = 32;

/// Level of the nodes below which the pieces of a search are.
std::size_t levelToCut(const WideTree& moving) {
    std::size_t level = moving.height() - 1;
    if (moving.moved(0).size() <= kFewestToCut) { return level; }
    while (level > 0 && moving.moved(level).size() <= kFewestPieces) { --level; }
    return level;
}

}  // namespace

void WideBvh::onInsert(std::uint32_t slot) {
    if (slot == places_.size()) { places_.push_back(0); }
    treeAt(slot).insert(slot, table().boxAt(slot), places_);
}

void WideBvh::onMove(std::uint32_t slot) { treeAt(slot).move(places_[slot], table().boxAt(slot)); }

void WideBvh::onBeginMoves() {
    for (CopiedAtomic<bool>& any : kindsInParallel_) { any.store(false, std::memory_order_relaxed); }
}

void WideBvh::onMoveInParallel(std::uint32_t slot, const Aabb& box) {
    table().moveUnmarked(slot, box);
    treeAt(slot).moveInParallel(places_[slot], box);
    CopiedAtomic<bool>& any = kindsInParallel_[static_cast<std::size_t>(table().kindOf(static_cast<ProxyId>(slot)))];
    if (!any.load(std::memory_order_relaxed)) { any.store(true, std::memory_order_relaxed); }  // mostly it is
}

/// All that the next search would do first is done here, where much has moved: what asks for boxes before that finds
/// them tight.
std::size_t WideBvh::onEndMoves(TaskSystem& loops) {
    std::size_t count = 0;
    for (std::size_t kind = 0; kind < trees_.size(); ++kind) {
        // The others need not be gone through for marks: most of a large world is ground.
        if (kindsInParallel_[kind].load(std::memory_order_relaxed)) { count += trees_[kind].endMoves(loops); }
    }
    if (count > 0) { prepareJoins(loops); }
    return count;
}

void WideBvh::prepareJoins(TaskSystem& loops) {
    for (WideTree& tree : trees_) {
        if (tree.prepareJoin(places_, loops)) { countRebuild(); }
    }
}

void WideBvh::onRemove(std::uint32_t slot) { treeAt(slot).remove(places_[slot]); }

/// Each kind with each: in one piece where little has moved, else cut where so many nodes are that several workers find
/// work, whether there are several or not. (Each piece goes down from the top of the other tree by itself: that costs
/// some tests more.)
void WideBvh::listJoins() {
    joins_.clear();
    for (int first = 0; first < kProxyKindCount; ++first) {
        for (int second = 0; second < kProxyKindCount; ++second) {
            const WideTree& moving = trees_[static_cast<std::size_t>(first)];
            const WideTree& other = trees_[static_cast<std::size_t>(second)];
            const bool canMeetAny = canMeet(static_cast<ProxyKind>(first), static_cast<ProxyKind>(second));
            if (!canMeetAny || !moving.anyMoved() || other.height() == 0) { continue; }
            const std::size_t level = levelToCut(moving);
            const std::size_t nodes = moving.moved(level).size() - 1;  // a sentinel ends them
            for (std::size_t place = 0; place < nodes; ++place) {
                joins_.push_back(
                    {.moving = &moving, .other = &other, .skipMoved = first > second, .level = level, .place = place});
            }
        }
    }
}

std::uint64_t WideBvh::join(PairSink& sink, TaskSystem& loops) {
    prepareJoins(loops);
    listJoins();
    scratch_.resize(std::max(scratch_.size(), static_cast<std::size_t>(loops.workerCount())));
    for (WideScratch& scratch : scratch_) {
        scratch.found.clear();
        scratch.tests = 0;
    }
    loops.run(joins_.size(), 1, [&](std::size_t begin, std::size_t end, int worker) {
        WideScratch& scratch = scratch_[static_cast<std::size_t>(worker)];
        for (std::size_t i = begin; i < end; ++i) {
            WideJoin piece = joins_[i];
            piece.scratch = &scratch;
            piece.out = worker == 0 ? &sink.newPairs() : &scratch.found;
            scratch.tests += kernels_.join(piece);
        }
    });
    std::uint64_t tests = 0;
    for (const WideScratch& scratch : scratch_) {  // in any order: pairs are sorted
        sink.newPairs().insert(sink.newPairs().end(), scratch.found.begin(), scratch.found.end());
        tests += scratch.tests;
    }
    return tests;
}

void WideBvh::onPairsDone(TaskSystem& loops) {
    for (WideTree& tree : trees_) { tree.finishJoin(loops); }
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

std::uint64_t WideBvh::visitDynamic(std::span<const Aabb> boxes, FunctionRef<void(std::size_t, ProxyId)> visit) const {
    std::uint64_t tests = 0;
    for (std::size_t first = 0; first < boxes.size(); first += kWide) {
        tests += kernels_.queries(tree(ProxyKind::dynamic), WideBoxes::of(boxes.subspan(first)),
                                  [&](std::uint32_t lane, ProxyId id) { visit(first + lane, id); });
    }
    return tests;
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
    for (const WideScratch& scratch : scratch_) {
        sum += bytesOf(scratch.found);
        for (const auto& list : scratch.candidates) { sum += bytesOf(list); }
    }
    sum += bytesOf(scratch_) + bytesOf(joins_);
    return sum;
}

}  // namespace swept::inline SWEPT_PRECISION
