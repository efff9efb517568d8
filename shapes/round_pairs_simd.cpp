// Compiled once per instruction set: foreach_target.h reads this file again for each.
#include <cmath>
#include <limits>

#include "manifold_parts.h"
#include "wide_pairs.h"
#include "wide_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "round_pairs_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#if HWY_TARGET == HWY_SCALAR || HWY_TARGET == HWY_EMU128 || !HWY_HAVE_FLOAT64
namespace swept::inline SWEPT_PRECISION {
namespace HWY_NAMESPACE {
RoundPairKernels kernelsForRoundPairs() { return {}; }
}  // namespace HWY_NAMESPACE
}  // namespace swept::inline SWEPT_PRECISION
#else

HWY_BEFORE_NAMESPACE();
#include "round_cores.inc"

namespace swept::inline SWEPT_PRECISION {
namespace HWY_NAMESPACE {

// What a search would find is guessed here, proved, and written as `collideApart` would. Proofs keep a distance from
// every decision that the search makes: where it is smaller, a pair is left to the search, as are cores that overlap.

/// Part of `kFaceAngle` that is doubtful: more than stored normals are off.
constexpr double kDoubtfulPart = 0x1p-10;
/// Shorter edges, as a part of the coordinates, turn by more than that when their ends are rounded (four times): the
/// search, which places them first, may find others parallel.
constexpr double kShortestEdge = 4 * kResolution / (kFaceAngle * kDoubtfulPart);
/// Closest vertices lie so far beyond the other vertices of their shapes, as a sine, that no face is nearly across.
constexpr double kVertexAngle = 2 * kFaceAngle;
/// Of edges that may lie across the line between two closest vertices, which then have a second point.
constexpr double kMaybeFlatCosine = kFlatCosine - 0x1p-20;
/// Roundings of coordinates that a length may be off, at most.
constexpr double kRoundings = 64;
/// Part of the distance that is doubtful where it was measured along one of two nearly parallel faces.
constexpr double kDoubtfulDistance = 2 * static_cast<double>(kEpsilon);
/// Below it squares of lengths are lost: the search brings them to another scale.
constexpr double kLeastLength = 0x1p-180;

/// What becomes of a pair.
struct Outcome {
    DoubleMask isKnown;
    DoubleMask isApart;
    DoubleLanes room;
};

/// A face and an edge that faces it, of which one is the other shape's.
struct FacePairs {
    References face;
    Edges incident;
    Points incidentStart;  ///< in the frame of A
    Points incidentEnd;
    DoubleMask isThere;     ///< one of both shapes has faces, and neither edge is too short to tell its direction
    DoubleMask isParallel;  ///< beyond doubt
    DoubleMask isSkew;      ///< beyond doubt
};

/// The best face of both shapes, and what faces it; of two nearly parallel faces that of A is the reference.
template <int kA, int kB>
HWY_INLINE FacePairs findFaces(const Cores<kA>& a, const Cores<kB>& b, const Polygons<kB>& polygonsB,
                               const Group& group) {
    const Poses& poses = group.poses;
    const BestFaces ofA = bestFaceOf(a, b);
    const BestFaces ofB = bestFaceOf(b, a);
    const DoubleMask isOfA = hn::Ge(ofA.separation, ofB.separation);
    const References best = referencesOf(ofA.edge, ofB.edge, isOfA, poses);
    const Points inward = negative(best.normal);
    const Edges other = facing(a, b, polygonsB, isOfA, select(isOfA, poses.toB(inward), inward), group.lane);
    const Points span = sub(other.end, other.start);
    const Points otherSpan = select(isOfA, poses.toA(span), span);
    const DoubleLanes sine = cross(best.tangent, otherSpan);
    const DoubleLanes squaredSine = hn::Mul(sine, sine);
    const DoubleLanes squared = dot(otherSpan, otherSpan);
    const DoubleLanes size = hn::Add(sumNorm(poses.translation), hn::Add(sumNorm(best.start), sumNorm(other.start)));
    const DoubleLanes shortest = hn::Mul(constant(kShortestEdge), size);
    const DoubleMask isPoint = hn::Eq(other.index, other.next);  // a circle has no direction
    const DoubleMask areLong =
        hn::And(hn::Ge(best.length, shortest), hn::Or(isPoint, hn::Ge(squared, hn::Mul(shortest, shortest))));
    const auto isWithin = [&](double angle) HWY_ATTR {
        return hn::And(hn::Lt(dot(best.tangent, otherSpan), constant(0)),
                       hn::Le(squaredSine, hn::Mul(constant(angle * angle), squared)));
    };
    const DoubleMask mayBeParallel = isWithin(kFaceAngle * (1 + kDoubtfulPart));
    const DoubleMask takesA = hn::Or(isOfA, mayBeParallel);
    const Edges edgeA = select(isOfA, ofA.edge, other);
    const Edges edgeB = select(isOfA, other, ofB.edge);
    const Edges incident = select(takesA, edgeB, edgeA);
    const auto placed = [&](Points v) HWY_ATTR { return select(takesA, add(poses.toA(v), poses.translation), v); };
    return {referencesOf(edgeA, edgeB, takesA, poses),
            incident,
            placed(incident.start),
            placed(incident.end),
            hn::And(areLong, hn::Gt(hn::Max(a.count, b.count), constant(1))),
            isWithin(kFaceAngle * (1 - kDoubtfulPart)),
            hn::Not(mayBeParallel)};
}

/// How the edge lies over the face.
struct Heights {
    DoubleLanes start;
    DoubleLanes end;
    Ends first;
    Ends second;
    DoubleLanes lowest;
    DoubleLanes distance;  ///< of the shapes, where they are closest here
    DoubleLanes doubt;     ///< what rounding may make of a length, and more
    DoubleMask isClosest;  ///< the shapes are closest here, beyond doubt
};

HWY_INLINE Heights heightsOf(const FacePairs& faces, const Poses& poses) {
    const References& face = faces.face;
    const Points toStart = sub(faces.incidentStart, face.start);
    const Points toEnd = sub(faces.incidentEnd, face.start);
    const Ends first{faces.incidentStart, dot(face.tangent, toStart), faces.incident.index};
    const Ends second{faces.incidentEnd, dot(face.tangent, toEnd), faces.incident.next};
    const DoubleLanes start = dot(face.normal, toStart);
    const DoubleLanes end = dot(face.normal, toEnd);
    const DoubleLanes lowest = hn::Min(start, end);
    const DoubleLanes size = hn::Add(hn::Add(sumNorm(poses.translation), sumNorm(face.start)),
                                     hn::Add(hn::Add(sumNorm(toStart), sumNorm(toEnd)), face.length));
    const DoubleLanes doubt = hn::Mul(constant(kRoundings * kResolution), size);

    // Skew: where the lowest end is over the face, it is closest.
    const auto isOver = [&](const Ends& p) HWY_ATTR {
        return hn::And(hn::Gt(p.along, doubt), hn::Lt(p.along, hn::Sub(face.length, doubt)));
    };
    const DoubleMask isLowestOver =
        hn::Or(hn::And(hn::Le(start, end), isOver(first)), hn::And(hn::Le(end, start), isOver(second)));
    // Parallel: where both have a part above each other, one end of that is closest.
    const auto over = [&](DoubleLanes along) HWY_ATTR { return hn::Min(hn::Max(along, constant(0)), face.length); };
    const DoubleLanes overFirst = over(first.along);
    const DoubleLanes overSecond = over(second.along);
    const DoubleMask areOver = hn::Gt(hn::Abs(hn::Sub(overSecond, overFirst)), doubt);
    const DoubleLanes slope = hn::Div(hn::Sub(end, start), hn::Sub(second.along, first.along));
    const auto heightAt = [&](DoubleLanes along)
                              HWY_ATTR { return hn::Add(start, hn::Mul(slope, hn::Sub(along, first.along))); };
    const DoubleLanes lowestOver = hn::Min(heightAt(overFirst), heightAt(overSecond));
    return {start,  end,
            first,  second,
            lowest, hn::IfThenElse(faces.isParallel, lowestOver, lowest),
            doubt,  hn::Or(hn::And(faces.isParallel, areOver), hn::And(faces.isSkew, isLowestOver))};
}

/// Manifolds of a face, written where they are known.
HWY_INLINE Outcome collideOnFaces(const FacePairs& faces, const Group& group) {
    const References& face = faces.face;
    const Heights heights = heightsOf(faces, group.poses);
    const DoubleLanes slack = hn::Mul(constant(2 * kFaceAngle), heights.distance);
    const DoubleLanes slackDoubt = hn::Add(hn::Mul(constant(kDoubtfulPart), slack), heights.doubt);
    const auto isOutside = [&](const Ends& p) HWY_ATTR {
        return hn::Or(hn::Lt(p.along, hn::Neg(slack)), hn::Gt(p.along, hn::Add(face.length, slack)));
    };
    const auto isCertain = [&](const Ends& p) HWY_ATTR {
        const DoubleLanes beyondStart = hn::Abs(hn::Add(p.along, slack));
        const DoubleLanes beyondEnd = hn::Abs(hn::Sub(p.along, hn::Add(face.length, slack)));
        return hn::Gt(hn::Min(beyondStart, beyondEnd), slackDoubt);
    };
    const Clipped p = clip(face, heights.first, heights.second, faces.incident.index, isOutside(heights.first));
    const Clipped q = clip(face, heights.second, heights.first, faces.incident.index, isOutside(heights.second));
    const DoubleLanes separationP = build(face, p, group, group.pairs.point[0]);
    const DoubleLanes separationQ = build(face, q, group, group.pairs.point[1]);
    const DoubleMask hasP = hn::And(p.isThere, hn::Le(separationP, group.points));
    const DoubleMask isPoint =  // a circle has but one point
        hn::Eq(faces.incident.index, faces.incident.next);
    const DoubleMask hasQ = hn::AndNot(isPoint, hn::And(q.isThere, hn::Le(separationQ, group.points)));
    const DoubleLanes infinity = constant(std::numeric_limits<double>::infinity());
    const DoubleLanes deepest =
        rounded(hn::Min(hn::IfThenElse(hasP, separationP, infinity), hn::IfThenElse(hasQ, separationQ, infinity)));

    // `isAsDeepAs`: the search allows for four roundings of the coordinates.
    const DoubleLanes size = hn::Add(heights.distance, sumNorm(group.poses.translation));
    const DoubleLanes core = hn::Sub(hn::Sub(heights.distance, group.radiusA), group.radiusB);
    const DoubleLanes epsilon = constant(static_cast<double>(kEpsilon));
    const DoubleMask isAsDeep = hn::And(hn::Le(deepest, hn::Add(core, hn::Mul(epsilon, size))),
                                        hn::Le(group.radii(), size));  // or their rounding is more than it allows for
    const DoubleLanes distanceDoubt =
        hn::Add(hn::Mul(constant(kDoubtfulDistance), hn::Abs(heights.distance)), heights.doubt);
    const DoubleMask isNear =
        hn::And(hn::Le(heights.distance, hn::Sub(group.limit, distanceDoubt)), hn::Le(deepest, group.nearest));
    const DoubleMask isClosest = hn::And(hn::And(faces.isThere, heights.isClosest),
                                         hn::Gt(heights.distance, hn::Max(heights.doubt, constant(kLeastLength))));
    const DoubleMask isKnown = hn::And(hn::And(isClosest, isAsDeep),
                                       hn::And(isNear, hn::And(isCertain(heights.first), isCertain(heights.second))));
    const Doubles tag;
    group.pairs.isThere[0] |= bitsOf(tag, hn::And(isKnown, hasP), group.lane);
    group.pairs.isThere[1] |= bitsOf(tag, hn::And(isKnown, hasQ), group.lane);
    group.pairs.ofA |= bitsOf(tag, hn::And(isKnown, face.isOfA), group.lane);
    const Points normal = select(face.isOfA, face.normal, negative(face.normal));
    store(normal.x, group.pairs.normalX.data() + group.lane);
    store(normal.y, group.pairs.normalY.data() + group.lane);
    return {isKnown, hn::And(faces.isThere, hn::Gt(heights.lowest, hn::Add(group.limit, distanceDoubt))),
            hn::Sub(heights.lowest, group.radii())};
}

/// Of each pair, the two vertices that are closest to each other.
struct VertexPairs {
    Points a;
    Points b;
    DoubleLanes squared;
    DoubleLanes id;
};

template <int kA, int kB>
HWY_INLINE VertexPairs closestVertices(const Cores<kA>& a, const Cores<kB>& b) {
    constexpr double kShift = 0x100;  // `featureId`
    const Points first = sub(b.vertices[0], a.vertices[0]);
    VertexPairs closest{a.vertices[0], b.vertices[0], dot(first, first), constant(0)};
    for (std::size_t i = 0; i < a.size(); ++i) {
        for (std::size_t j = i == 0 ? 1 : 0; j < b.size(); ++j) {
            const Points w = sub(b.vertices[j], a.vertices[i]);
            const DoubleLanes squared = dot(w, w);
            const DoubleMask isCloser = hn::Lt(squared, closest.squared);
            closest.squared = hn::IfThenElse(isCloser, squared, closest.squared);
            closest.a = select(isCloser, a.vertices[i], closest.a);
            closest.b = select(isCloser, b.vertices[j], closest.b);
            const double id = static_cast<double>(i) * kShift + static_cast<double>(j);
            closest.id = hn::IfThenElse(isCloser, constant(id), closest.id);
        }
    }
    return closest;
}

/// Whether a vertex is the farthest of its shape along a unit direction, beyond doubt, and no edge is so flat that
/// there may be a second point.
struct Farthest {
    DoubleMask isSure;
    DoubleMask mayBeFlat;
};

template <int kVertices>
HWY_INLINE Farthest farthest(const Cores<kVertices>& cores, Points vertex, Points direction, DoubleLanes doubt) {
    const DoubleLanes angle = constant(kVertexAngle);
    DoubleLanes highest = constant(0);
    DoubleLanes flattest = constant(0);
    for (std::size_t i = 0; i < cores.size(); ++i) {
        const Points to = sub(cores.vertices[i], vertex);
        const DoubleLanes away = sumNorm(to);
        const DoubleLanes least = hn::Add(hn::Mul(angle, away), hn::IfThenElseZero(hn::Gt(away, constant(0)), doubt));
        highest = hn::Max(highest, hn::Add(dot(direction, to), least));
        flattest = hn::Max(flattest, dot(direction, cores.normals[i]));
    }
    return {hn::Le(highest, constant(0)), hn::Ge(flattest, constant(kMaybeFlatCosine))};
}

/// Manifolds of two vertices, written where they are known, and nothing is yet.
template <int kA, int kB>
HWY_INLINE Outcome collideVertices(const Cores<kA>& a, const Cores<kB>& b, DoubleMask isKnown, const Group& group) {
    const VertexPairs closest = closestVertices(a, b);
    const Points w = sub(closest.b, closest.a);
    const DoubleLanes distance = hn::Sqrt(closest.squared);
    const Points normal = scale(hn::Div(constant(1), distance), w);
    const DoubleLanes size = hn::Add(hn::Add(sumNorm(closest.a), sumNorm(closest.b)), sumNorm(group.poses.translation));
    const DoubleLanes doubt = hn::Mul(constant(kRoundings * kResolution), size);
    const Farthest ofA = farthest(a, closest.a, normal, doubt);
    const Farthest ofB = farthest(b, closest.b, negative(normal), doubt);
    // So far apart that rounding turns the line between them by less than the angle: nearer, a search may take an edge
    // that begins there, and its normal.
    const DoubleMask isFarEnough =
        hn::And(hn::Gt(hn::Mul(constant(kVertexAngle), distance), doubt), hn::Gt(distance, constant(kLeastLength)));
    const DoubleMask isClosest = hn::And(hn::And(ofA.isSure, ofB.isSure), isFarEnough);
    const DoubleMask isBeyond = hn::Gt(distance, group.limit);

    // `singlePoint`
    const DoubleLanes separation = hn::Sub(hn::Sub(distance, group.radiusA), group.radiusB);
    const DoubleLanes toMiddle = hn::Mul(constant(0.5), hn::Sub(hn::Add(distance, group.radiusA), group.radiusB));
    const Points middle = add(closest.a, scale(toMiddle, normal));
    const DoubleMask isNear = hn::And(hn::Le(separation, group.points), hn::Le(rounded(separation), group.nearest));
    const DoubleMask isSingle =
        hn::And(hn::AndNot(isBeyond, isClosest), hn::AndNot(hn::And(ofA.mayBeFlat, ofB.mayBeFlat), isNear));
    const DoubleMask isWritten = hn::AndNot(isKnown, isSingle);
    const auto put = [&](DoubleLanes value, WidePairs::Lanes& lanes) HWY_ATTR {
        Real* const to = lanes.data() + group.lane;
        store(hn::IfThenElse(isWritten, value, load(to)), to);
    };
    WidePairs::Point& point = group.pairs.point[0];
    put(middle.x, point.x);
    put(middle.y, point.y);
    put(separation, point.separation);
    put(closest.id, point.id);
    put(normal.x, group.pairs.normalX);
    put(normal.y, group.pairs.normalY);
    const std::uint32_t written = bitsOf(Doubles(), isWritten, group.lane);
    group.pairs.isThere[0] |= written;
    group.pairs.ofA |= written;
    return {isSingle, hn::And(isClosest, isBeyond), hn::Sub(distance, group.radii())};
}

template <int kA, int kB>
HWY_INLINE void collideGroup(const Polygons<kA>& polygonsA, const Polygons<kB>& polygonsB, std::size_t lane,
                             WidePairs& pairs) {
    const Doubles tag;
    const auto at = [lane](const WidePairs::Lanes& lanes) HWY_ATTR { return load(lanes.data() + lane); };
    const DoubleLanes radiusA = at(pairs.radiusA);
    const DoubleLanes radiusB = at(pairs.radiusB);
    const DoubleLanes nearest = at(pairs.nearest);
    const Group group{pairs,
                      lane,
                      {at(pairs.c), at(pairs.s), {at(pairs.x), at(pairs.y)}},
                      radiusA,
                      radiusB,
                      at(pairs.points),
                      nearest,
                      hn::Add(nearest, hn::Add(radiusA, radiusB))};
    Cores<kA> a(pairs.mostA);
    Cores<kB> b(pairs.mostB);
    loadCores(polygonsA, lane, a);
    loadCores(polygonsB, lane, b);
    place(group.poses, b);
    const DoubleMask none = hn::Lt(constant(0), constant(0));
    Outcome ofFaces{none, none, constant(0)};
    if constexpr (kA > 1 || kB > 1) {
        ofFaces = collideOnFaces(findFaces(a, b, polygonsB, group), group);
    } else {  // asked for, though there is no second point
        store(constant(0), pairs.point[1].id.data() + lane);
    }
    const Outcome ofVertices = collideVertices(a, b, ofFaces.isKnown, group);
    const DoubleMask isKnown = hn::Or(ofFaces.isKnown, ofVertices.isKnown);
    const DoubleMask isApart = hn::AndNot(isKnown, hn::Or(ofFaces.isApart, ofVertices.isApart));
    store(hn::IfThenElse(ofVertices.isApart, ofVertices.room, ofFaces.room), pairs.room.data() + lane);
    const DoubleLanes largest = constant(static_cast<double>(kLargestShift));
    const Points shift = group.poses.translation;
    const DoubleMask isOrdinary = hn::And(hn::Le(hn::Abs(shift.x), largest), hn::Le(hn::Abs(shift.y), largest));
    pairs.plain |= bitsOf(tag, hn::And(isKnown, isOrdinary), lane);
    pairs.apart |= bitsOf(tag, hn::And(isApart, isOrdinary), lane);
}

template <int kA, int kB>
void collideRoundPairs(WidePairs& pairs) {
    Polygons<kA> a;
    Polygons<kB> b;
    gather<1>(pairs.a, pairs.verticesA, kA <= kFewVertices ? std::size_t{kA} : pairs.mostA, a);
    gather<1>(pairs.b, pairs.verticesB, kB <= kFewVertices ? std::size_t{kB} : pairs.mostB, b);
    pairs.ofA = pairs.plain = pairs.apart = pairs.isThere[0] = pairs.isThere[1] = 0;
    for (std::size_t lane = 0; lane < pairs.size; lane += hn::MaxLanes(Doubles())) { collideGroup(a, b, lane, pairs); }
}

RoundPairKernels kernelsForRoundPairs() {
    constexpr int kFew = kFewVertices;
    return {{{{collideRoundPairs<1, 1>, collideRoundPairs<2, 2>, collideRoundPairs<1, kFew>},
              {collideRoundPairs<2, 2>, collideRoundPairs<2, 2>, collideRoundPairs<2, kFew>},
              {collideRoundPairs<kFew, 1>, collideRoundPairs<kFew, 2>, collideRoundPairs<kFew, kFew>}}},
            collideRoundPairs<kMaxPolygonVertices, kMaxPolygonVertices>};
}

}  // namespace HWY_NAMESPACE
}  // namespace swept::inline SWEPT_PRECISION
HWY_AFTER_NAMESPACE();
#endif

#if HWY_ONCE
namespace swept::inline SWEPT_PRECISION {

namespace {
HWY_EXPORT(kernelsForRoundPairs);
}

RoundPairKernels roundPairKernels() { return HWY_DYNAMIC_DISPATCH(kernelsForRoundPairs)(); }

}  // namespace swept::inline SWEPT_PRECISION
#endif
