#pragma once

#include <cmath>
#include <cstdint>

#include "branchless.h"
#include "manifold.h"
#include "wide_pairs.h"

namespace swept::inline SWEPT_PRECISION {

/// Whether pairs of such polygons may be collided in batches: no two neighbouring faces nearly parallel, coordinates
/// neither so small nor so large that products of them are lost.
bool collidesInBatches(const Polygon& polygon);

bool collidesInBatches(const ChainSegment& segment);

/// What may be in a batch together.
enum class PairKind : std::uint8_t {
    sharp,  ///< two polygons without radius, of three vertices at least
    round,  ///< any others
    chain,  ///< a chain segment and a polygon
};
inline bool isSharp(const Polygon& polygon) { return polygon.count > 2 && !(polygon.radius > 0); }
inline PairKind pairKindOf(const Polygon& a, const Polygon& b) {
    return isSharp(a) && isSharp(b) ? PairKind::sharp : PairKind::round;
}

/// Whether this machine, and this build, have registers for batches. Without them `collide` does as well.
bool canCollideInBatches();

/// Manifolds of as many pairs at once as there are lanes: bit for bit those of `collide` without a memory, at less than
/// half the cost.
class ManifoldBatch {
public:
    static constexpr std::size_t kPairs = WidePairs::kPairs;

    explicit ManifoldBatch(PairKind kind) : kind_(kind) {}

    std::size_t size() const { return size_; }
    bool isFull() const { return size_ == kPairs; }
    /// What a batch asks of two polygons beside vertices and normals, of who has it at hand.
    struct Sizes {
        Real radiusA = 0;
        Real radiusB = 0;
        std::uint8_t verticesA = 0;
        std::uint8_t verticesB = 0;
    };

    /// @pre not full; of the kind; `collidesInBatches` both, which stay where they are until the batch is cleared
    void add(const Polygon& a, const Polygon& b, const Sizes& sizes, const Transform& bInA, ManifoldReach reach) {
        const std::size_t i = size_++;
        pairs_.a[i] = &a;
        pairs_.b[i] = &b;
        pairs_.c[i] = bInA.rotation.c;
        pairs_.s[i] = bInA.rotation.s;
        pairs_.x[i] = bInA.translation.x;
        pairs_.y[i] = bInA.translation.y;
        pairs_.points[i] = reach.points;
        pairs_.nearest[i] = reach.nearest < reach.points ? reach.nearest : reach.points;
        pairs_.radiusA[i] = sizes.radiusA;
        pairs_.radiusB[i] = sizes.radiusB;
        pairs_.verticesA[i] = sizes.verticesA;
        pairs_.verticesB[i] = sizes.verticesB;
    }
    void add(const Polygon& a, const Polygon& b, const Transform& bInA, ManifoldReach reach) {
        const auto vertices = [](const Polygon& polygon) { return static_cast<std::uint8_t>(polygon.count); };
        add(a, b, {a.radius, b.radius, vertices(a), vertices(b)}, bInA, reach);
    }
    /// Of a batch of chain segments. @param a  `polygonOf(segment)`, of which, and of what its neighbours are at, the
    /// same is asked; `nearest` counts for nothing
    void add(const ChainSegment& segment, ClosedEnds closed, const Polygon& a, const Polygon& b, const Sizes& sizes,
             const Transform& bInA, ManifoldReach reach) {
        segments_[size_] = &segment;
        pairs_.closedStart[size_] = closed.atStart ? Real(1) : Real(0);
        pairs_.closedEnd[size_] = closed.atEnd ? Real(1) : Real(0);
        add(a, b, sizes, bInA, reach);
    }
    /// What was added to another batch, after what is in this one; then the other is empty.
    /// @pre of one kind; there is room for all
    void takeOver(ManifoldBatch& other);
    PairKind kind() const { return kind_; }
    /// As they were added.
    Transform poseOf(std::size_t pair) const {
        return {{pairs_.x[pair], pairs_.y[pair]}, {pairs_.c[pair], pairs_.s[pair]}};
    }
    ManifoldReach reachOf(std::size_t pair) const { return {pairs_.points[pair], pairs_.nearest[pair]}; }
    const Polygon& polygonA(std::size_t pair) const { return *pairs_.a[pair]; }
    /// Of a plain pair. @pre collided
    Vec2 normalOf(std::size_t pair) const { return {pairs_.normalX[pair], pairs_.normalY[pair]}; }
    /// Whether nothing but `copyPoints` is to be done for the manifold, and the memory is to hold no verdict.
    /// @pre collided
    bool isPlain(std::size_t pair) const { return (pairs_.plain >> pair & 1U) != 0; }
    /// Whether a manifold has the points of a plain pair already, in this order, if not at the same places.
    bool hasPoints(std::size_t pair, const Manifold& manifold) const {
        const std::uint32_t first = pairs_.isThere[0] >> pair & 1U;
        const int count = static_cast<int>(first + (pairs_.isThere[1] >> pair & 1U));
        const FeatureId second = idOf(1, pair);
        // At once: one point or two, no branch would foretell which.
        const bool hasFirst = idOf(1 - first, pair) == manifold.points[0].id;
        const int hasSecond = int{second == manifold.points[1].id} & int{second != manifold.points[0].id};
        return (int{manifold.count == count} & int{hasFirst} & (int{count < 2} | hasSecond)) != 0;
    }
    /// Whether nothing but `rememberApart` is to be done, and there is no point. @pre collided
    bool isApart(std::size_t pair) const {
        const bool isOrdinary =
            std::fabs(pairs_.x[pair]) <= kLargestShift && std::fabs(pairs_.y[pair]) <= kLargestShift;
        return (pairs_.apart >> pair & 1U) != 0 && isOrdinary;
    }
    /// Of such a pair.
    void rememberApart(std::size_t pair, ManifoldMemory& memory) const {
        const PairVerdict verdict{.verdict = ManifoldMemory::Verdict::apart,
                                  .room = static_cast<double>(pairs_.room[pair])};
        remember(memory, verdict, *pairs_.a[pair], *pairs_.b[pair], poseOf(pair));
    }
    /// Of a plain pair.
    void copyPoints(std::size_t pair, Manifold& manifold) const {
        const std::uint32_t bit = 1U << pair;
        const bool hasFirst = (pairs_.isThere[0] & bit) != 0;
        const bool hasSecond = (pairs_.isThere[1] & bit) != 0;
        manifold.normal = {pairs_.normalX[pair], pairs_.normalY[pair]};
        manifold.isNormalOfB = (pairs_.ofA & bit) == 0;
        manifold.count = 1 + static_cast<int>(hasFirst && hasSecond);
        // Likewise: where there is one point, the second one is zero.
        copyPoint<false>(pairs_.point[hasFirst ? 0 : 1], pair, true, manifold.points[0]);
        copyPoint<true>(pairs_.point[1], pair, hasFirst && hasSecond, manifold.points[1]);
    }
    /// Whether a pair was too doubtful for the batch, and is collided by itself. @pre collided
    bool isLeft(std::size_t pair) const {
        return kind_ != PairKind::sharp && ((pairs_.plain | pairs_.apart | pairs_.nothing) >> pair & 1U) == 0;
    }
    /// All that were added. @pre there is one; `canCollideInBatches`
    void collide();
    /// @param memory    of the two shapes; keeps how far apart they are, where they are
    /// @param manifold  as made; what becomes of it. (Not returned: a copy of what was just written has to wait for
    /// it.)
    /// @pre collided
    void takeManifold(std::size_t pair, ManifoldMemory& memory, Manifold& manifold) const;
    void clear() { size_ = 0; }

private:
    FeatureId idOf(std::size_t point, std::size_t pair) const {
        return static_cast<FeatureId>(static_cast<std::int32_t>(pairs_.point[point].id[pair]));
    }
    /// @param isThere  else all of it is zero, without a branch
    template <bool kMayLack>
    static void copyPoint(const WidePairs::Point& from, std::size_t pair, bool isThere, ManifoldPoint& to) {
        const auto value = [isThere](Real number) { return kMayLack ? orZero(isThere, number) : number; };
        to.point.x = value(from.x[pair]);
        to.point.y = value(from.y[pair]);
        to.separation = value(from.separation[pair]);
        to.id = static_cast<FeatureId>(static_cast<std::int32_t>(value(from.id[pair])));
    }
    Manifold otherManifold(std::size_t pair, ManifoldMemory& memory) const;

    WidePairs pairs_;
    std::array<const ChainSegment*, kPairs> segments_;
    std::size_t size_ = 0;
    PairKind kind_;
};

}  // namespace swept::inline SWEPT_PRECISION
