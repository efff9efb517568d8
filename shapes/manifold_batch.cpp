#include "manifold_batch.h"

#include <algorithm>
#include <cmath>

#include "manifold_parts.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Of the squares of edges, which are divided by.
constexpr double kLeastSquare = 0x1p-900;

/// Vertices of the core of a capsule.
constexpr std::size_t kTwo = 2;

bool isOrdinary(Real coordinate) { return std::fabs(coordinate) <= kLargestShift; }

PairKernels kernelsFor([[maybe_unused]] PairKind kind) {
#ifdef SWEPT_SIMD
    return kind == PairKind::sharp ? sharpPairKernels() : roundPairKernels();
#else
    return {};
#endif
}

}  // namespace

bool collidesInBatches(const Polygon& polygon) {
    if (!isOrdinary(polygon.radius)) { return false; }
    Real largest = polygon.radius;
    for (int i = 0; i < polygon.count; ++i) {
        const Vec2 p = polygon.vertices[static_cast<std::size_t>(i)];
        const Vec2 q = polygon.vertices[static_cast<std::size_t>(polygon.next(i))];
        const DVec2 edge = toDouble(q) - toDouble(p);
        if (!isOrdinary(p.x) || !isOrdinary(p.y)) { return false; }
        if (polygon.count > 1 && !(dot(edge, edge) >= kLeastSquare)) { return false; }
        if (polygon.count > 2 && hasNearlyParallelNeighbour(polygon, i)) { return false; }
        largest = std::max({largest, std::fabs(p.x), std::fabs(p.y)});
    }
    return largest >= 1 / kLargestShift;
}

bool canCollideInBatches() {
    return kernelsFor(PairKind::sharp).ofFew != nullptr && kernelsFor(PairKind::round).ofFew != nullptr;
}

void ManifoldBatch::add(const Polygon& a, const Polygon& b, const Sizes& sizes, const Transform& bInA,
                        ManifoldReach reach) {
    const std::size_t i = size_++;
    pairs_.a[i] = &a;
    pairs_.b[i] = &b;
    pairs_.c[i] = bInA.rotation.c;
    pairs_.s[i] = bInA.rotation.s;
    pairs_.x[i] = bInA.translation.x;
    pairs_.y[i] = bInA.translation.y;
    pairs_.points[i] = reach.points;
    pairs_.nearest[i] = std::min(reach.points, reach.nearest);
    pairs_.radiusA[i] = sizes.radiusA;
    pairs_.radiusB[i] = sizes.radiusB;
    pairs_.verticesA[i] = sizes.verticesA;
    pairs_.verticesB[i] = sizes.verticesB;
    pairs_.vertices =
        std::max(i > 0 ? pairs_.vertices : 0, static_cast<std::size_t>(std::max(sizes.verticesA, sizes.verticesB)));
}

void ManifoldBatch::collide() {
    for (std::size_t i = size_; i < kPairs; ++i) {  // what is left over does what the first does
        pairs_.a[i] = pairs_.a[0];
        pairs_.b[i] = pairs_.b[0];
        for (WidePairs::Lanes* const lanes :
             {&pairs_.c, &pairs_.s, &pairs_.x, &pairs_.y, &pairs_.points, &pairs_.nearest, &pairs_.radiusA,
              &pairs_.radiusB, &pairs_.verticesA, &pairs_.verticesB}) {
            (*lanes)[i] = (*lanes)[0];
        }
    }
    const PairKernels kernels = kernelsFor(kind_);
    if (pairs_.vertices > kFewVertices) {
        kernels.ofMany(pairs_);
    } else if (pairs_.vertices > kTwo || kind_ == PairKind::sharp) {
        kernels.ofFew(pairs_);
    } else {
        kernels.ofTwo(pairs_);
    }
}

/// Those of its two points that are there. @pre one of them is
void ManifoldBatch::copyPoints(std::size_t pair, Manifold& manifold) const {
    const std::uint32_t bit = 1U << pair;
    const auto pointOf = [this, pair](std::size_t k) {
        const WidePairs::Point& point = pairs_.point[k];
        return ManifoldPoint{{point.x[pair], point.y[pair]},
                             point.separation[pair],
                             static_cast<FeatureId>(static_cast<std::int32_t>(point.id[pair]))};
    };
    const bool hasFirst = (pairs_.isThere[0] & bit) != 0;
    const bool hasSecond = (pairs_.isThere[1] & bit) != 0;
    manifold.normal = {pairs_.normalX[pair], pairs_.normalY[pair]};
    manifold.isNormalOfB = (pairs_.ofA & bit) == 0;
    manifold.count = hasFirst && hasSecond ? 2 : 1;
    manifold.points[0] = pointOf(hasFirst ? 0 : 1);
    if (hasFirst && hasSecond) { manifold.points[1] = pointOf(1); }
}

/// What is not plain: apart, beside the face, or beyond what batches are for.
Manifold ManifoldBatch::otherManifold(std::size_t pair, ManifoldMemory& memory) const {
    const std::uint32_t bit = 1U << pair;
    const Polygon& a = *pairs_.a[pair];
    const Polygon& b = *pairs_.b[pair];
    const Transform bInA{{pairs_.x[pair], pairs_.y[pair]}, {pairs_.c[pair], pairs_.s[pair]}};
    const bool isApart = (pairs_.apart & bit) != 0;
    if (isLeft(pair) || !isOrdinary(bInA.translation.x) || !isOrdinary(bInA.translation.y)) {
        return swept::collide(a, b, bInA, {pairs_.points[pair], pairs_.nearest[pair]}, memory);
    }
    PairVerdict verdict;
    Manifold manifold;
    if (isApart) {
        verdict.verdict = ManifoldMemory::Verdict::apart;
        verdict.room = static_cast<double>(pairs_.room[pair]);
    } else if (((pairs_.isThere[0] | pairs_.isThere[1]) & bit) != 0) {
        copyPoints(pair, manifold);
    } else {
        const Margins margins{static_cast<double>(pairs_.points[pair]), static_cast<double>(pairs_.nearest[pair])};
        manifold = collideBesideFace(PairView(a, b, bInA), static_cast<int>(pairs_.face[pair]), (pairs_.ofA & bit) != 0,
                                     margins, verdict);
    }
    manifold = within(manifold, pairs_.nearest[pair], verdict);
    remember(memory, verdict, a, b, bInA);
    return manifold;
}

void ManifoldBatch::takeManifold(std::size_t pair, ManifoldMemory& memory, Manifold& manifold) const {
    if ((pairs_.plain >> pair & 1U) == 0) {
        manifold = otherManifold(pair, memory);
        return;
    }
    copyPoints(pair, manifold);
    memory.verdict = ManifoldMemory::Verdict::none;
}

}  // namespace swept::inline SWEPT_PRECISION
