#pragma once

#include <vector>

#include "table_broadphase.h"
#include "wide_tree.h"

namespace swept::inline SWEPT_PRECISION {

/// Room for the walks, kept from call to call.
struct WideScratch {
    std::array<std::vector<std::uint32_t>, WideTree::kMaxLevels> candidates;  ///< by level: nodes still to be compared
};

/// What moved in one tree against everything in another, or in itself.
struct WideJoin {
    const WideTree* moving = nullptr;
    const WideTree* other = nullptr;
    bool skipMoved = false;  ///< leave out what moved in `other`: the join the other way round has it already
    WideScratch* scratch = nullptr;
    std::vector<ProxyPair>* out = nullptr;  ///< new pairs are added, each once
};

/// The walks through wide trees. Every set of kernels finds the same.
struct WideKernels {
    const char* name;
    /// Returns the number of box tests, as do the others.
    std::uint64_t (*join)(const WideJoin& join);
    /// @param goOn  false when the visitor ended the walk.
    std::uint64_t (*query)(const WideTree& tree, const Aabb& box, bool& goOn, FunctionRef<bool(ProxyId)> visit);
};

/// One lane after the other, in plain C++.
const WideKernels& scalarKernels();
/// The widest registers that this machine has; the scalar ones where built without `SWEPT_SIMD`.
const WideKernels& widestKernels();

}  // namespace swept::inline SWEPT_PRECISION
