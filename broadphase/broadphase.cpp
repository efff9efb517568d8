#include "broadphase.h"

#include "all_pairs.h"
#include "bvh.h"
#include "grid.h"
#include "quadtree.h"
#include "sort_and_sweep.h"
#include "wide_bvh.h"

namespace swept::inline SWEPT_PRECISION {

std::unique_ptr<Broadphase> makeBroadphase(BroadphaseKind kind) {
    switch (kind) {
        case BroadphaseKind::allPairs:
            return std::make_unique<AllPairs>();
        case BroadphaseKind::sortAndSweep:
            return std::make_unique<SortAndSweep>();
        case BroadphaseKind::quadtree:
            return std::make_unique<Quadtree>();
        case BroadphaseKind::grid:
            return std::make_unique<Grid>();
        case BroadphaseKind::bvh:
            return std::make_unique<Bvh>();
        case BroadphaseKind::automatic:
        case BroadphaseKind::wideBvh:
            return std::make_unique<WideBvh>();
    }
    return nullptr;  // unreachable, but GCC cannot know
}

}  // namespace swept::inline SWEPT_PRECISION
