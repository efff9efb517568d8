#include "broadphase.h"

#include "all_pairs.h"
#include "bvh.h"
#include "wide_bvh.h"

namespace swept::inline SWEPT_PRECISION {

std::unique_ptr<Broadphase> makeBroadphase(BroadphaseKind kind) {
    switch (kind) {
        case BroadphaseKind::allPairs:
            return std::make_unique<AllPairs>();
        case BroadphaseKind::sortAndSweep:
        case BroadphaseKind::quadtree:
        case BroadphaseKind::grid:
        case BroadphaseKind::bvh:
            return std::make_unique<Bvh>();
        case BroadphaseKind::automatic:
        case BroadphaseKind::wideBvh:
            return std::make_unique<WideBvh>();
    }
    return nullptr;  // unreachable, but GCC cannot know
}

}  // namespace swept::inline SWEPT_PRECISION
