// Compiled once per instruction set: foreach_target.h reads this file again for each.
#include <cmath>
#include <limits>

#include "manifold_parts.h"
#include "wide_pairs.h"
#include "wide_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "chain_pairs_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#if HWY_TARGET == HWY_SCALAR || HWY_TARGET == HWY_EMU128 || !HWY_HAVE_FLOAT64
namespace swept::inline SWEPT_PRECISION {
namespace HWY_NAMESPACE {
PairKernels kernelsForChainPairs() { return {}; }
}  // namespace HWY_NAMESPACE
}  // namespace swept::inline SWEPT_PRECISION
#else

HWY_BEFORE_NAMESPACE();
#include "round_cores.inc"

namespace swept::inline SWEPT_PRECISION {
namespace HWY_NAMESPACE {

// Of manifold_chain.cpp what needs no search, number for number: what lies behind the segment, or far from it, and what
// faces the segment itself. Corners, and cores that all but touch it, are left to that.

/// `faceOfA` of the segment.
HWY_INLINE References segmentFaces(const Polygons<2>& segments, std::size_t lane) {
    const Points start{load(segments.x[0] + lane), load(segments.y[0] + lane)};
    const Points end{load(segments.x[1] + lane), load(segments.y[1] + lane)};
    const Points edge = sub(end, start);
    const DoubleLanes inverse = hn::Div(constant(1), hn::Sqrt(dot(edge, edge)));
    const Points normal = scale(inverse, {edge.y, hn::Neg(edge.x)});
    const Points tangent{hn::Neg(normal.y), normal.x};
    return {start, tangent, normal, dot(edge, tangent), constant(0), constant(1), hn::Eq(constant(0), constant(0))};
}

/// The vertices of B, as `CoreOverSegment` sees them.
struct Overs {
    DoubleLanes center;  ///< height of the middle of the core
    DoubleLanes above;   ///< height of the lowest vertex
    DoubleLanes foot;    ///< along the segment, likewise
    DoubleLanes least;
    DoubleLanes first;
    DoubleLanes last;
    DoubleLanes size;
    DoubleLanes doubt;
};

template <int kVertices>
HWY_INLINE Overs oversOf(const Cores<kVertices>& b, const References& face, const Group& group) {
    const Points down = group.poses.toB(face.normal);
    const DoubleLanes infinity = constant(std::numeric_limits<double>::infinity());
    Points sum = b.local[0];
    DoubleLanes lowest = dot(down, b.local[0]);
    Overs over{constant(0), constant(0), constant(0), infinity, infinity, hn::Neg(infinity), constant(0), constant(0)};
    DoubleLanes farthest = constant(0);
    for (std::size_t i = 0; i < b.size(); ++i) {
        const Points v = sub(b.vertices[i], face.start);
        const DoubleLanes height = dot(face.normal, v);
        const DoubleLanes along = dot(face.tangent, v);
        over.least = hn::Min(over.least, height);
        over.first = hn::Min(over.first, along);
        over.last = hn::Max(over.last, along);
        farthest = hn::Max(farthest, hn::Add(hn::Abs(height), hn::Abs(along)));
        if (i == 0) {
            over.above = height;
            over.foot = along;
            continue;
        }
        const DoubleMask isThere = hn::Gt(b.count, constant(static_cast<double>(i)));
        sum = select(isThere, add(sum, b.local[i]), sum);
        const DoubleLanes low = dot(down, b.local[i]);
        const DoubleMask isLower = hn::Lt(low, lowest);
        lowest = hn::IfThenElse(isLower, low, lowest);
        over.above = hn::IfThenElse(isLower, height, over.above);
        over.foot = hn::IfThenElse(isLower, along, over.foot);
    }
    const Points middle = add(group.poses.toA(scale(hn::Div(constant(1), b.count), sum)), group.poses.translation);
    over.center = dot(face.normal, sub(middle, face.start));
    over.size = hn::Add(hn::Add(hn::Add(face.length, sumNorm(face.start)), sumNorm(group.poses.translation)), farthest);
    over.doubt = hn::Mul(constant(kChainRoundings * kResolution), over.size);
    return over;
}

/// `incidentOfB`.
struct Incidents {
    Points start;
    Points end;
    DoubleLanes index;
    DoubleLanes next;
};

template <int kVertices>
HWY_INLINE Incidents incidentsOf(const Cores<kVertices>& b, Points normal, const Poses& poses) {
    const Points direction = poses.toB(negative(normal));
    Incidents edge{b.vertices[0], b.vertices[1], constant(0), constant(0)};
    DoubleLanes best = dot(direction, b.normals[0]);
    for (std::size_t i = 1; i < b.size(); ++i) {
        const DoubleLanes along = dot(direction, b.normals[i]);
        const DoubleMask isBetter = hn::Gt(along, best);
        best = hn::IfThenElse(isBetter, along, best);
        edge.index = hn::IfThenElse(isBetter, constant(static_cast<double>(i)), edge.index);
        edge.start = select(isBetter, b.vertices[i], edge.start);
        edge.end = select(isBetter, b.vertices[b.wrapped(i + 1)], edge.end);
    }
    edge.next = nextOf(edge.index, b.count);
    return edge;
}

/// Which points there are, and whether they are surely within reach.
struct Clips {
    DoubleMask hasP;
    DoubleMask hasQ;
    DoubleMask isSure;
};

/// `clipOnSegment`, and `isSurelyWithin`.
HWY_INLINE Clips clipOnSegments(const Incidents& incident, const References& face, const Overs& over,
                                const Group& group) {
    const Points toStart = sub(incident.start, face.start);
    const Points toEnd = sub(incident.end, face.start);
    const DoubleLanes height = hn::Min(hn::Abs(dot(face.normal, toStart)), hn::Abs(dot(face.normal, toEnd)));
    const DoubleLanes rounding = hn::Mul(constant(kSeamRounding), hn::Add(face.length, sumNorm(incident.start)));
    const DoubleLanes slack = hn::Add(hn::Mul(constant(kSeamAngle), height), rounding);
    const auto isOutside = [&](DoubleLanes along) HWY_ATTR {
        return hn::Or(hn::Lt(along, hn::Neg(slack)), hn::Gt(along, hn::Add(face.length, slack)));
    };
    const Ends first{incident.start, dot(face.tangent, toStart), incident.index};
    const Ends second{incident.end, dot(face.tangent, toEnd), incident.next};
    const Clipped p = clip(face, first, second, incident.index, isOutside(first.along));
    const Clipped q = clip(face, second, first, incident.index, isOutside(second.along));
    const DoubleLanes separationP = build(face, p, group, group.pairs.point[0]);
    const DoubleLanes separationQ = build(face, q, group, group.pairs.point[1]);
    const DoubleMask isPoint = hn::Eq(incident.index, incident.next);  // a circle has but one
    const DoubleMask hasP = hn::And(p.isThere, hn::Le(separationP, group.points));
    const DoubleMask hasQ = hn::AndNot(isPoint, hn::And(q.isThere, hn::Le(separationQ, group.points)));
    // Where there is none, it is as deep as can be: sure.
    const DoubleLanes infinity = constant(std::numeric_limits<double>::infinity());
    const DoubleLanes deepest =
        rounded(hn::Min(hn::IfThenElse(hasP, separationP, infinity), hn::IfThenElse(hasQ, separationQ, infinity)));
    const DoubleLanes beyond = hn::Mul(constant(2 * kSeamRounding), over.size);
    const DoubleMask isNear = hn::Le(hn::Add(hn::Add(deepest, group.radii()), beyond),
                                     hn::Mul(constant(kSurePart), hn::Add(group.points, group.radii())));
    return {hasP, hasQ, hn::Or(isNear, hn::Not(hn::Or(hasP, hasQ)))};
}

/// `CoreOverSegment::crosses`, up to a rounding or two, of which there are many in the doubt.
template <int kVertices>
HWY_INLINE DoubleMask crosses(const Cores<kVertices>& b, const References& face, const Overs& over) {
    const DoubleLanes infinity = constant(std::numeric_limits<double>::infinity());
    const DoubleLanes below = hn::Neg(over.doubt);
    DoubleLanes first = infinity;
    DoubleLanes last = hn::Neg(infinity);
    const Points start = sub(b.vertices[0], face.start);
    Points v = start;
    DoubleLanes height = dot(face.normal, v);
    for (std::size_t i = 0; i < b.size(); ++i) {
        const Points w = i + 1 < b.size() ? sub(b.vertices[i + 1], face.start) : start;
        const DoubleLanes heightAfter = dot(face.normal, w);
        const DoubleLanes fall = hn::Sub(height, heightAfter);
        const DoubleMask falls = hn::And(hn::Gt(height, over.doubt), hn::Lt(heightAfter, below));
        const DoubleMask rises = hn::And(hn::Lt(height, below), hn::Gt(heightAfter, over.doubt));
        const DoubleMask isThrough = hn::Or(falls, rises);
        const DoubleLanes along = dot(face.tangent, v);
        const DoubleLanes way = hn::Sub(dot(face.tangent, w), along);
        const DoubleLanes part = hn::Div(constant(1), hn::IfThenElse(isThrough, fall, constant(1)));
        const DoubleLanes at = hn::Add(along, hn::Mul(hn::Mul(height, part), way));
        const DoubleLanes doubt = hn::Mul(over.doubt, hn::Add(constant(1), hn::Abs(hn::Mul(way, part))));
        first = hn::Min(first, hn::IfThenElse(isThrough, hn::Add(at, doubt), infinity));
        last = hn::Max(last, hn::IfThenElse(isThrough, hn::Sub(at, doubt), hn::Neg(infinity)));
        v = w;
        height = heightAfter;
    }
    return hn::And(hn::Gt(last, over.doubt), hn::Lt(first, hn::Sub(face.length, over.doubt)));
}

HWY_INLINE DoubleMask isClosed(const WidePairs::Lanes& lanes, const Group& group) {
    return hn::Gt(load(lanes.data() + group.lane), constant(0));
}

/// `CoreOverSegment::facesOwn`.
HWY_INLINE DoubleMask facesOwn(const Overs& over, const References& face, const Group& group) {
    const DoubleLanes end = hn::Sub(face.length, over.doubt);
    const DoubleMask isFootOver = hn::And(hn::Gt(over.foot, over.doubt), hn::Lt(over.foot, end));
    const DoubleMask isTurnedAtStart = hn::Or(hn::Gt(over.first, over.doubt), isClosed(group.pairs.closedStart, group));
    const DoubleMask isTurnedAtEnd = hn::Or(hn::Lt(over.last, end), isClosed(group.pairs.closedEnd, group));
    return hn::Or(isFootOver, hn::And(isTurnedAtStart, isTurnedAtEnd));
}

template <int kVertices>
HWY_INLINE void collideGroup(const Polygons<2>& segments, const Polygons<kVertices>& polygons, std::size_t vertices,
                             std::size_t lane, WidePairs& pairs) {
    const auto at = [lane](const WidePairs::Lanes& lanes) HWY_ATTR { return load(lanes.data() + lane); };
    const DoubleLanes radiusA = at(pairs.radiusA);
    const DoubleLanes radiusB = at(pairs.radiusB);
    const DoubleLanes points = at(pairs.points);
    const DoubleLanes reach = hn::Add(points, hn::Add(radiusA, radiusB));
    const Group group{pairs,  lane, {at(pairs.c), at(pairs.s), {at(pairs.x), at(pairs.y)}}, radiusA, radiusB, points,
                      points, reach};
    const References face = segmentFaces(segments, lane);
    Cores<kVertices> b(vertices);
    loadCores(polygons, lane, b);
    for (std::size_t i = 0; i < b.size(); ++i) {
        b.vertices[i] = add(group.poses.toA(b.local[i]), group.poses.translation);
    }
    const Overs over = oversOf(b, face, group);
    const Incidents incident = incidentsOf(b, face.normal, group.poses);
    const Clips clips = clipOnSegments(incident, face, over, group);

    const DoubleMask isBehind = hn::Lt(over.center, constant(0));
    const DoubleMask isAbove = hn::Gt(over.least, over.doubt);
    const DoubleLanes beside = hn::Max(hn::Max(hn::Sub(over.first, face.length), hn::Neg(over.last)), constant(0));
    const DoubleLanes distance =
        hn::Sub(hn::Sqrt(hn::Add(hn::Mul(over.least, over.least), hn::Mul(beside, beside))), over.doubt);  // at least
    const DoubleMask isHigh = hn::Gt(over.above, reach);
    const DoubleMask isFar = hn::Or(isHigh, hn::And(isAbove, hn::Gt(distance, reach)));
    // Where both ends are closed no face of B is admitted: what crosses the segment is pushed out along its normal.
    const DoubleMask areClosed = hn::And(isClosed(pairs.closedStart, group), isClosed(pairs.closedEnd, group));
    const DoubleMask facesIt = hn::Or(hn::And(hn::And(isAbove, clips.isSure), facesOwn(over, face, group)),
                                      hn::And(areClosed, crosses(b, face, over)));
    const DoubleMask isOwn = hn::AndNot(hn::Or(isBehind, isFar), facesIt);
    const DoubleMask hasPoint = hn::Or(clips.hasP, clips.hasQ);

    const DoubleLanes largest = constant(static_cast<double>(kLargestShift));
    const Points shift = group.poses.translation;
    const DoubleMask isOrdinary = hn::And(hn::Le(hn::Abs(shift.x), largest), hn::Le(hn::Abs(shift.y), largest));
    const DoubleMask isPlain = hn::And(isOrdinary, hn::And(isOwn, hasPoint));
    const Doubles tag;
    store(hn::IfThenElseZero(isOwn, face.normal.x), pairs.normalX.data() + lane);
    store(hn::IfThenElseZero(isOwn, face.normal.y), pairs.normalY.data() + lane);
    store(hn::Sub(hn::IfThenElse(isHigh, over.above, distance), group.radii()), pairs.room.data() + lane);
    pairs.isThere[0] |= bitsOf(tag, hn::And(isPlain, clips.hasP), lane);
    pairs.isThere[1] |= bitsOf(tag, hn::And(isPlain, clips.hasQ), lane);
    pairs.plain |= bitsOf(tag, isPlain, lane);
    pairs.apart |= bitsOf(tag, hn::And(isOrdinary, hn::AndNot(isBehind, isFar)), lane);
    pairs.nothing |= bitsOf(tag, hn::And(isOrdinary, hn::Or(isBehind, hn::AndNot(hasPoint, isOwn))), lane);
}

template <int kVertices>
void collideChainPairs(WidePairs& pairs) {
    Polygons<2> segments;
    Polygons<kVertices> polygons;
    const std::size_t vertices = kVertices <= kFewVertices ? kVertices : pairs.mostB;
    gather<2>(pairs.a, pairs.verticesA, 2, segments);
    gather<1>(pairs.b, pairs.verticesB, vertices, polygons);
    pairs.plain = pairs.apart = pairs.nothing = pairs.isThere[0] = pairs.isThere[1] = 0;
    for (std::size_t lane = 0; lane < pairs.size; lane += hn::MaxLanes(Doubles())) {
        collideGroup(segments, polygons, vertices, lane, pairs);
    }
    pairs.ofA = pairs.plain;
}

PairKernels kernelsForChainPairs() {
    return {collideChainPairs<2>, collideChainPairs<kFewVertices>, collideChainPairs<kMaxPolygonVertices>};
}

}  // namespace HWY_NAMESPACE
}  // namespace swept::inline SWEPT_PRECISION
HWY_AFTER_NAMESPACE();
#endif

#if HWY_ONCE
namespace swept::inline SWEPT_PRECISION {

namespace {
HWY_EXPORT(kernelsForChainPairs);
}

PairKernels chainPairKernels() { return HWY_DYNAMIC_DISPATCH(kernelsForChainPairs)(); }

}  // namespace swept::inline SWEPT_PRECISION
#endif
