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
/// Of a circle it has one.
constexpr std::size_t kOne = 1;

bool isOrdinary(Real coordinate) { return std::fabs(coordinate) <= kLargestShift; }

/// Which row, or column, of `RoundPairKernels`. @param most  vertices, few
[[maybe_unused]] std::size_t sideOf(std::size_t most) { return most <= kTwo ? most - kOne : kTwo; }

/// Null where there are none.
CollidePairs kernelFor([[maybe_unused]] PairKind kind, [[maybe_unused]] std::size_t mostA,
                       [[maybe_unused]] std::size_t mostB) {
#ifdef SWEPT_SIMD
    const std::size_t most = std::max(mostA, mostB);
    if (kind == PairKind::round) {
        const RoundPairKernels kernels = roundPairKernels();
        return most > kFewVertices ? kernels.ofMany : kernels.bySides[sideOf(mostA)][sideOf(mostB)];
    }
    const PairKernels kernels = kind == PairKind::sharp ? sharpPairKernels() : chainPairKernels();
    if (most > kFewVertices) { return kernels.ofMany; }
    return most > kTwo || kind == PairKind::sharp ? kernels.ofFew : kernels.ofTwo;
#else
    return nullptr;
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
    return kernelFor(PairKind::sharp, kFewVertices, kFewVertices) != nullptr &&
           kernelFor(PairKind::round, kFewVertices, kFewVertices) != nullptr;
}

void ManifoldBatch::takeOver(ManifoldBatch& other) {
    const WidePairs& from = other.pairs_;
    for (std::size_t i = 0; i < other.size_; ++i) {
        if (kind_ == PairKind::chain) {
            segments_[size_] = other.segments_[i];
            pairs_.closedStart[size_] = from.closedStart[i];
            pairs_.closedEnd[size_] = from.closedEnd[i];
        }
        const Sizes sizes{from.radiusA[i], from.radiusB[i], static_cast<std::uint8_t>(from.verticesA[i]),
                          static_cast<std::uint8_t>(from.verticesB[i])};
        add(*from.a[i], *from.b[i], sizes, other.poseOf(i), other.reachOf(i));
    }
    other.clear();
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
        if (kind_ == PairKind::chain) {  // nobody else has ends
            pairs_.closedStart[i] = pairs_.closedStart[0];
            pairs_.closedEnd[i] = pairs_.closedEnd[0];
        }
    }
    const auto most = [](const WidePairs::Lanes& counts) {
        return static_cast<std::size_t>(*std::max_element(counts.begin(), counts.end()));
    };
    pairs_.mostA = most(pairs_.verticesA);
    pairs_.mostB = most(pairs_.verticesB);
    pairs_.nothing = 0;
    pairs_.size = size_;
    kernelFor(kind_, pairs_.mostA, pairs_.mostB)(pairs_);
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
