// No `#pragma once`: read once for each instruction set, in a namespace of that name.
#include <bit>

#include "wide_kernels.h"

#ifndef SWEPT_LANES
#define SWEPT_LANES scalar_lanes
#endif

namespace swept::inline SWEPT_PRECISION {
namespace SWEPT_LANES {

/// Joins the tree over what moved with another tree, both from the top at the same pace: every node that moved hands its
/// children the few nodes of the other tree that it overlaps, so that no search starts at the root.
///
/// `Query` is made from a box and tells which lanes of eight boxes overlap it, one bit per lane.
template <class Query>
class JoinWalk {
public:
    explicit JoinWalk(const WideJoin& join) : join_(join), moving_(*join.moving), other_(*join.other) {}

    std::uint64_t run() {
        const std::size_t top = moving_.height() - 1;
        std::size_t level = other_.height() - 1;
        room(level, 1)[0] = 0;
        std::uint32_t count = 1;
        const MovedNode& all = moving_.moved(top)[0];
        for (; level > top && count > 0; --level) { count = narrow(Query(all.hull), level, count); }
        descend(top, all, level, count);
        return kWide * nodeTests_;
    }

private:
    /// The candidates of a level, with room for so many.
    std::uint32_t* room(std::size_t level, std::uint32_t count) {
        std::vector<std::uint32_t>& list = join_.scratch->candidates[level];
        if (list.size() < count) { list.resize(2 * std::size_t{count}); }
        return list.data();
    }

    /// Children, one level below, of the candidates that overlap; returns their number.
    std::uint32_t narrow(const Query& query, std::size_t level, std::uint32_t count) {
        std::uint32_t* const below = room(level - 1, kWide * count);
        const std::uint32_t* const here = join_.scratch->candidates[level].data();
        const WideBoxes* const nodes = other_.level(level);
        std::uint32_t found = 0;
        for (std::uint32_t i = 0; i < count; ++i) {
            const std::uint32_t firstChild = kWide * here[i];
            for (std::uint32_t lanes = query.overlapping(nodes[here[i]]); lanes != 0; lanes &= lanes - 1) {
                below[found++] = firstChild + static_cast<std::uint32_t>(std::countr_zero(lanes));
            }
        }
        nodeTests_ += count;
        return found;
    }

    /// @param level, count  candidates of `node`, which stands at level `at` of its own tree; `level` ≤ `at`.
    void descend(std::size_t at, const MovedNode& node, std::size_t level, std::uint32_t count) {
        if (count == 0) { return; }
        if (at == 0) {
            compare(node, count);
            return;
        }
        const MovedNode* const nodes = moving_.moved(at - 1).data();
        const std::uint32_t end = (&node + 1)->firstChild;
        for (std::uint32_t i = node.firstChild; i < end; ++i) {
            if (level == at) {
                descend(at - 1, nodes[i], level - 1, narrow(Query(nodes[i].hull), level, count));
            } else {
                descend(at - 1, nodes[i], level, count);
            }
        }
    }

    /// Each moved box of a lowest node against the boxes of all candidates.
    void compare(const MovedNode& node, std::uint32_t count) {
        const WideBoxes& boxes = moving_.level(0)[node.node];
        const WideBoxes& known = moving_.known()[node.node];
        const std::uint32_t* const candidates = join_.scratch->candidates[0].data();
        const WideBoxes* const others = other_.level(0);
        for (std::uint32_t lanes = moving_.movedLanes()[node.node]; lanes != 0; lanes &= lanes - 1) {
            const auto lane = static_cast<std::uint32_t>(std::countr_zero(lanes));
            const Query now(boxes.box(lane));
            const Query before(known.box(lane));
            const std::uint32_t slot = moving_.slots()[kWide * node.node + lane];
            for (std::uint32_t i = 0; i < count; ++i) {
                // Whether some box overlaps is a coin toss, whether a pair is new hardly ever: one branch that is foreseen.
                const std::uint32_t fresh = now.overlapping(others[candidates[i]]) &
                                            ~before.overlapping(other_.known()[candidates[i]]);
                if (fresh != 0) { report(slot, candidates[i], fresh); }
            }
            nodeTests_ += count;
        }
    }

    void report(std::uint32_t slot, std::uint32_t candidate, std::uint32_t lanes) {
        const std::uint32_t moved = other_.movedLanes()[candidate];
        if (join_.skipMoved) { lanes &= ~moved; }
        for (; lanes != 0; lanes &= lanes - 1) {
            const auto lane = static_cast<std::uint32_t>(std::countr_zero(lanes));
            const std::uint32_t partner = other_.slots()[kWide * candidate + lane];
            // Within one tree, two that moved find each other twice, and each finds itself.
            const bool seenFromThere = &moving_ == &other_ && ((moved >> lane) & 1U) != 0 && partner <= slot;
            if (seenFromThere) { continue; }
            const bool lower = slot < partner;
            join_.out->push_back(
                {static_cast<ProxyId>(lower ? slot : partner), static_cast<ProxyId>(lower ? partner : slot)});
        }
    }

    const WideJoin& join_;
    const WideTree& moving_;
    const WideTree& other_;
    std::uint64_t nodeTests_ = 0;
};

/// Depth first; at most seven siblings wait at each level.
template <class Query>
std::uint64_t walkQuery(const WideTree& tree, const Aabb& box, bool& goOn, FunctionRef<bool(ProxyId)> visit) {
    struct Entry {
        std::uint32_t node;
        std::uint32_t level;
    };
    if (tree.height() == 0) { return 0; }
    Entry stack[WideTree::kMaxLevels * kWide];
    std::uint32_t size = 0;
    stack[size++] = {0, static_cast<std::uint32_t>(tree.height() - 1)};
    std::uint64_t tests = 0;
    const Query query(box);
    while (size > 0) {
        const Entry entry = stack[--size];
        tests += kWide;
        std::uint32_t lanes = query.overlapping(tree.level(entry.level)[entry.node]);
        for (; lanes != 0; lanes &= lanes - 1) {
            const std::uint32_t child = kWide * entry.node + static_cast<std::uint32_t>(std::countr_zero(lanes));
            if (entry.level > 0) {
                stack[size++] = {child, entry.level - 1};
                continue;
            }
            goOn = visit(static_cast<ProxyId>(tree.slots()[child]));
            if (!goOn) { return tests; }
        }
    }
    return tests;
}

template <class Query>
std::uint64_t scanIntervals(const IntervalScan& scan) {
    std::uint64_t tests = 0;
    for (const IntervalQuery& item : scan.queries) {
        const Query query(item.box);
        const Real end = scan.alongY ? item.box.upper.y : item.box.upper.x;
        std::uint32_t wanted = ~std::uint32_t{0} << (item.begin & kLaneMask);
        for (std::size_t node = item.begin >> kLaneBits; node < scan.boxes.size(); ++node) {
            const WideBoxes& boxes = scan.boxes[node];
            if (!((scan.alongY ? boxes.lowerY[0] : boxes.lowerX[0]) <= end)) { break; }
            tests += kWide;
            for (std::uint32_t lanes = query.overlapping(boxes) & wanted; lanes != 0; lanes &= lanes - 1) {
                const auto lane = static_cast<std::uint32_t>(std::countr_zero(lanes));
                scan.out->push_back({item.id, static_cast<std::uint32_t>(node * kWide) + lane});
            }
            wanted = ~std::uint32_t{0};
        }
    }
    return tests;
}

}  // namespace SWEPT_LANES
}  // namespace swept::inline SWEPT_PRECISION
