#include "broadphase_image.h"

#include "../../broadphase/all_pairs.h"
#include "../../broadphase/bvh.h"
#include "../../broadphase/grid.h"
#include "../../broadphase/quadtree.h"
#include "../../broadphase/sort_and_sweep.h"
#include "../../broadphase/wide_bvh.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Calls `visit` with the broadphase as what it is.
template <class AnyBroadphase, class Visit>
void visitAs(BroadphaseKind kind, AnyBroadphase& broadphase, const Visit& visit) {
    switch (kind) {
        case BroadphaseKind::allPairs:
            return visit(baseOf<AllPairs>(broadphase));
        case BroadphaseKind::sortAndSweep:
            return visit(baseOf<SortAndSweep>(broadphase));
        case BroadphaseKind::quadtree:
            return visit(baseOf<Quadtree>(broadphase));
        case BroadphaseKind::grid:
            return visit(baseOf<Grid>(broadphase));
        case BroadphaseKind::bvh:
            return visit(baseOf<Bvh>(broadphase));
        case BroadphaseKind::automatic:
        case BroadphaseKind::wideBvh:
            return visit(baseOf<WideBvh>(broadphase));
    }
}

consteval std::uint64_t layoutOfAll() {
    Layout layout;
    layout.add(kLayout<AllPairs>);
    layout.add(kLayout<SortAndSweep>);
    layout.add(kLayout<Quadtree>);
    layout.add(kLayout<Grid>);
    layout.add(kLayout<Bvh>);
    layout.add(kLayout<WideBvh>);
    return layout.hash;
}

}  // namespace

std::size_t encodedSize(BroadphaseKind kind, const Broadphase& broadphase) {
    std::size_t size = 0;
    visitAs(kind, broadphase, [&size](const auto& known) { size = encodedSize(known); });
    return size;
}
void encode(Encoder& to, BroadphaseKind kind, const Broadphase& broadphase) {
    visitAs(kind, broadphase, [&to](const auto& known) { to.put(known); });
}
void decode(Decoder& from, BroadphaseKind kind, Broadphase& broadphase) {
    visitAs(kind, broadphase, [&from](auto& known) { from.take(known); });
}
std::uint64_t layoutOfBroadphases() { return layoutOfAll(); }

}  // namespace swept::inline SWEPT_PRECISION
