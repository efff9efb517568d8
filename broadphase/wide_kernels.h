#pragma once

#include <vector>

#include "../shapes/cache_line.h"
#include "table_broadphase.h"
#include "wide_tree.h"

namespace swept::inline SWEPT_PRECISION {

/// What one worker needs for the walks, and what it found. Kept for its capacity; nothing of it shares a cache line
/// with another worker's.
struct alignas(kCacheLine) WideScratch {
    std::array<std::vector<std::uint32_t>, WideTree::kMaxLevels> candidates;  ///< by level: nodes still to be compared
    std::vector<ProxyPair> found;
    std::uint64_t tests = 0;
};

/// What moved below one node of a tree against everything in another tree, or in the same one.
struct WideJoin {
    const WideTree* moving = nullptr;  ///< something in it has moved
    const WideTree* other = nullptr;   ///< not empty
    bool skipMoved = false;            ///< leave out what moved in `other`: the join the other way round has it already
    std::size_t level = 0;             ///< of the node, in `moving`
    std::size_t place = 0;             ///< among what has moved there
    WideScratch* scratch = nullptr;
    std::vector<ProxyPair>* out = nullptr;  ///< new pairs are added, each once
};

/// A box and the place from which on others begin later.
struct IntervalQuery {
    Aabb box;
    std::uint32_t begin;
    std::uint32_t id;
};
struct IntervalHit {
    std::uint32_t id;
    std::uint32_t place;
};

/// Boxes in ascending order of their lower bounds along one axis; each query is compared with all from its place on
/// until one begins beyond its end.
struct IntervalScan {
    std::span<const WideBoxes> boxes;  ///< empty lanes only at the end
    std::span<const IntervalQuery> queries;
    bool alongY = false;
    std::vector<IntervalHit>* out = nullptr;  ///< overlapping boxes are added
};

/// The walks through wide trees, and the scan of sorted boxes. Every set of kernels finds the same.
struct WideKernels {
    const char* name;
    /// Returns the number of box tests, as do the others.
    std::uint64_t (*join)(const WideJoin& join);
    /// @param goOn  false when the visitor ended the walk.
    std::uint64_t (*query)(const WideTree& tree, const Aabb& box, bool& goOn, FunctionRef<bool(ProxyId)> visit);
    /// Eight queries at once, of boxes that lie near each other. @param visit  of a box, by its lane, and what it meets
    std::uint64_t (*queries)(const WideTree& tree, const WideBoxes& boxes,
                             FunctionRef<void(std::uint32_t, ProxyId)> visit);
    std::uint64_t (*intervals)(const IntervalScan& scan);
    /// Near boxes first. `visit` counts the tests itself.
    void (*sweep)(const WideTree& tree, SweepVisit& visit);
};

/// One lane after the other, in plain C++.
const WideKernels& scalarKernels();
/// The widest registers that this machine has; the scalar ones where built without `SWEPT_SIMD`.
const WideKernels& widestKernels();

}  // namespace swept::inline SWEPT_PRECISION
