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
    switch (kind) {
        case PairKind::sharp:
            return sharpPairKernels();
        case PairKind::round:
            return roundPairKernels();
        case PairKind::chain:
            break;
    }
    return chainPairKernels();
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

bool collidesInBatches(const ChainSegment& segment) {
    for (const Vec2 v : {segment.before, segment.after}) {
        if (!isOrdinary(v.x) || !isOrdinary(v.y)) { return false; }
    }
    return collidesInBatches(polygonOf(segment));
}

bool canCollideInBatches() {
    return kernelsFor(PairKind::sharp).ofFew != nullptr && kernelsFor(PairKind::round).ofFew != nullptr;
}

void ManifoldBatch::collide() {
    for (std::size_t i = size_; i < kPairs; ++i) {  // what is left over does what the first does
        pairs_.a[i] = pairs_.a[0];
        pairs_.b[i] = pairs_.b[0];
        for (WidePairs::Lanes* const lanes :
             {&pairs_.c, &pairs_.s, &pairs_.x, &pairs_.y, &pairs_.points, &pairs_.nearest, &pairs_.radiusA,
              &pairs_.radiusB, &pairs_.verticesA, &pairs_.verticesB, &pairs_.closedStart, &pairs_.closedEnd}) {
            (*lanes)[i] = (*lanes)[0];
        }
    }
    const auto most = [](const WidePairs::Lanes& counts) { return *std::max_element(counts.begin(), counts.end()); };
    pairs_.vertices = static_cast<std::size_t>(std::max(most(pairs_.verticesA), most(pairs_.verticesB)));
    pairs_.nothing = 0;
    const PairKernels kernels = kernelsFor(kind_);
    if (pairs_.vertices > kFewVertices) {
        kernels.ofMany(pairs_);
    } else if (pairs_.vertices > kTwo || kind_ == PairKind::sharp) {
        kernels.ofFew(pairs_);
    } else {
        kernels.ofTwo(pairs_);
    }
}

/// What is not plain: apart, beside the face, or beyond what batches are for.
Manifold ManifoldBatch::otherManifold(std::size_t pair, ManifoldMemory& memory) const {
    const std::uint32_t bit = 1U << pair;
    const Polygon& a = *pairs_.a[pair];
    const Polygon& b = *pairs_.b[pair];
    const Transform bInA = poseOf(pair);
    const bool isApart = (pairs_.apart & bit) != 0;
    if (isLeft(pair) || !isOrdinary(bInA.translation.x) || !isOrdinary(bInA.translation.y)) {
        if (kind_ == PairKind::chain) {
            return swept::collide(*segments_[pair], a, b, bInA, pairs_.points[pair], memory);
        }
        return swept::collide(a, b, bInA, {pairs_.points[pair], pairs_.nearest[pair]}, memory);
    }
    if ((pairs_.nothing & bit) != 0) {
        memory.verdict = ManifoldMemory::Verdict::none;
        Manifold manifold;
        manifold.normal = {pairs_.normalX[pair], pairs_.normalY[pair]};
        return manifold;
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
    if (!isPlain(pair)) {
        manifold = otherManifold(pair, memory);
        return;
    }
    copyPoints(pair, manifold);
    memory.verdict = ManifoldMemory::Verdict::none;
}

}  // namespace swept::inline SWEPT_PRECISION
