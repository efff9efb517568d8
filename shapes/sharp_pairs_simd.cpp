// Compiled once per instruction set: foreach_target.h reads this file again for each.
#include "manifold_parts.h"
#include "wide_pairs.h"
#include "wide_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sharp_pairs_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#if HWY_TARGET == HWY_SCALAR || HWY_TARGET == HWY_EMU128 || !HWY_HAVE_FLOAT64
namespace swept::inline SWEPT_PRECISION {
namespace HWY_NAMESPACE {
PairKernels kernelsForSharpPairs() { return {}; }
}  // namespace HWY_NAMESPACE
}  // namespace swept::inline SWEPT_PRECISION
#else

HWY_BEFORE_NAMESPACE();
#include "wide_polygons.inc"

namespace swept::inline SWEPT_PRECISION {
namespace HWY_NAMESPACE {

/// Of one polygon of each pair: the best face, and its ends.
struct Faces {
    alignas(64) Real face[kPairs];
    Real separation[kPairs];
    Real startX[kPairs];
    Real startY[kPairs];
    Real endX[kPairs];
    Real endY[kPairs];
};

/// A polygon in the frame of the other one. (Constructors that the compiler makes are not of the instruction set that
/// vectors need on some machines: structures are made at once, or say that they are not filled.)
template <int kVertices>
struct Placed {
    HWY_INLINE Placed() {}

    RealLanes x[kVertices];
    RealLanes y[kVertices];
};

/// `FaceSearchOf::best`, and the ends of the face.
template <int kVertices>
HWY_INLINE void findFace(const Polygons<kVertices>& polygons, const Placed<kVertices>& others, std::size_t vertices,
                         std::size_t lane, Faces& faces) {
    const Reals tag;
    const auto x = [&polygons, lane](std::size_t i) HWY_ATTR { return hn::Load(Reals(), polygons.x[i] + lane); };
    const auto y = [&polygons, lane](std::size_t i) HWY_ATTR { return hn::Load(Reals(), polygons.y[i] + lane); };
    RealLanes face = hn::Zero(tag);
    RealLanes best = face;
    RealLanes startX = x(0);
    RealLanes startY = y(0);
    RealLanes endX = x(1);
    RealLanes endY = y(1);
    for (std::size_t i = 0; i < vertices; ++i) {
        const RealLanes normalX = hn::Load(tag, polygons.normalX[i] + lane);
        const RealLanes normalY = hn::Load(tag, polygons.normalY[i] + lane);
        RealLanes lowest = hn::Add(hn::Mul(others.x[0], normalX), hn::Mul(others.y[0], normalY));
        for (std::size_t j = 1; j < vertices; ++j) {
            lowest = hn::Min(hn::Add(hn::Mul(others.x[j], normalX), hn::Mul(others.y[j], normalY)), lowest);
        }
        const RealLanes separation = hn::Sub(lowest, hn::Add(hn::Mul(normalX, x(i)), hn::Mul(normalY, y(i))));
        if (i == 0) {
            best = separation;
            continue;
        }
        const std::size_t next = i + 1 < vertices ? i + 1 : 0;
        const auto isBetter = hn::Gt(separation, best);
        best = hn::IfThenElse(isBetter, separation, best);
        face = hn::IfThenElse(isBetter, hn::Set(tag, static_cast<Real>(i)), face);
        startX = hn::IfThenElse(isBetter, x(i), startX);
        startY = hn::IfThenElse(isBetter, y(i), startY);
        endX = hn::IfThenElse(isBetter, x(next), endX);
        endY = hn::IfThenElse(isBetter, y(next), endY);
    }
    hn::Store(face, tag, faces.face + lane);
    hn::Store(best, tag, faces.separation + lane);
    hn::Store(startX, tag, faces.startX + lane);
    hn::Store(startY, tag, faces.startY + lane);
    hn::Store(endX, tag, faces.endX + lane);
    hn::Store(endY, tag, faces.endY + lane);
}

template <int kVertices>
HWY_INLINE void findFaces(const Polygons<kVertices>& a, const Polygons<kVertices>& b, std::size_t vertices,
                          WidePairs& pairs, Faces& ofA, Faces& ofB) {
    const Reals tag;
    pairs.apart = pairs.ordinary = 0;
    const RealLanes largest = hn::Set(tag, kLargestShift);
    for (std::size_t lane = 0; lane < kPairs; lane += hn::MaxLanes(tag)) {
        const RealLanes c = hn::Load(tag, pairs.c.data() + lane);
        const RealLanes s = hn::Load(tag, pairs.s.data() + lane);
        const RealLanes shiftX = hn::Load(tag, pairs.x.data() + lane);
        const RealLanes shiftY = hn::Load(tag, pairs.y.data() + lane);
        const auto isOrdinary = hn::And(hn::Le(hn::Abs(shiftX), largest), hn::Le(hn::Abs(shiftY), largest));
        pairs.ordinary |= bitsOf(tag, isOrdinary, lane);
        Placed<kVertices> placed;
        for (std::size_t i = 0; i < vertices; ++i) {
            const RealLanes x = hn::Load(tag, b.x[i] + lane);
            const RealLanes y = hn::Load(tag, b.y[i] + lane);
            placed.x[i] = hn::Add(hn::Sub(hn::Mul(c, x), hn::Mul(s, y)), shiftX);
            placed.y[i] = hn::Add(hn::Add(hn::Mul(s, x), hn::Mul(c, y)), shiftY);
        }
        findFace(a, placed, vertices, lane, ofA);
        for (std::size_t i = 0; i < vertices; ++i) {
            const RealLanes x = hn::Sub(hn::Load(tag, a.x[i] + lane), shiftX);
            const RealLanes y = hn::Sub(hn::Load(tag, a.y[i] + lane), shiftY);
            placed.x[i] = hn::Add(hn::Mul(c, x), hn::Mul(s, y));
            placed.y[i] = hn::Sub(hn::Mul(c, y), hn::Mul(s, x));
        }
        findFace(b, placed, vertices, lane, ofB);
        const RealLanes alongA = hn::Load(tag, ofA.separation + lane);
        const RealLanes alongB = hn::Load(tag, ofB.separation + lane);
        const RealLanes farther = hn::Max(alongA, alongB);
        hn::Store(farther, tag, pairs.room.data() + lane);
        pairs.apart |= bitsOf(tag, hn::Gt(farther, hn::Load(tag, pairs.nearest.data() + lane)), lane);
    }
}

// --- in double, as manifold_clip_inline.h

HWY_INLINE Edges edgesOf(const Faces& faces, const Real* counts, std::size_t lane) {
    const DoubleLanes index = load(faces.face + lane);
    return {index,
            nextOf(index, load(counts + lane)),
            {load(faces.startX + lane), load(faces.startY + lane)},
            {load(faces.endX + lane), load(faces.endY + lane)}};
}

/// `chooseFace`: whether A's is taken.
HWY_INLINE DoubleMask takesA(const Faces& ofA, const Faces& ofB, const Edges& edgeA, const Edges& edgeB,
                             const Poses& poses, std::size_t lane) {
    const DoubleLanes alongA = load(ofA.separation + lane);
    const DoubleLanes alongB = load(ofB.separation + lane);
    const Points spanA = sub(edgeA.end, edgeA.start);
    const Points spanB = sub(edgeB.end, edgeB.start);
    const DoubleLanes shorter = hn::Sqrt(hn::Min(dot(spanA, spanA), dot(spanB, spanB)));
    const DoubleLanes away = hn::Add(hn::Abs(poses.translation.x), hn::Abs(poses.translation.y));
    const DoubleLanes flush = hn::Mul(constant(kFlushRounding), hn::Add(shorter, away));
    const DoubleLanes lead = hn::Sub(alongB, alongA);
    const DoubleLanes ahead = hn::Sub(lead, flush);
    const DoubleLanes beyond = hn::Sub(lead, hn::Mul(constant(kFacePreference), shorter));
    const DoubleMask areApart = hn::Gt(hn::Max(alongA, alongB), constant(0));
    return hn::Le(hn::IfThenElse(areApart, ahead, beyond), constant(0));
}

/// `ManifoldBuilder::build` for one point. @return whether it is there
HWY_INLINE DoubleMask build(const References& face, const Clipped& p, DoubleLanes margin, std::size_t lane,
                            WidePairs::Point& out) {
    const DoubleLanes toMiddle = hn::Mul(constant(0.5), hn::Sub(constant(0), p.separation));
    const Points middle = add(p.core, scale(toMiddle, face.normal));
    store(middle.x, out.x.data() + lane);
    store(middle.y, out.y.data() + lane);
    store(p.separation, out.separation.data() + lane);
    store(p.id, out.id.data() + lane);
    return hn::And(p.isThere, hn::Le(p.separation, margin));
}

template <int kVertices>
HWY_INLINE void clipPairs(const Polygons<kVertices>& a, const Polygons<kVertices>& b, const Faces& ofA,
                          const Faces& ofB, std::size_t vertices, std::size_t lane, WidePairs& pairs) {
    const Doubles tag;
    const Poses poses{load(pairs.c.data() + lane),
                      load(pairs.s.data() + lane),
                      {load(pairs.x.data() + lane), load(pairs.y.data() + lane)}};
    const Edges edgeA = edgesOf(ofA, a.count, lane);
    const Edges edgeB = edgesOf(ofB, b.count, lane);
    const DoubleMask isOfA = takesA(ofA, ofB, edgeA, edgeB, poses, lane);
    const References face = referencesOf(edgeA, edgeB, isOfA, poses);
    const Points inward{hn::Neg(face.normal.x), hn::Neg(face.normal.y)};
    Edges incident = facing(a, b, isOfA, select(isOfA, poses.toB(inward), inward), vertices, lane);
    const auto placed = [&](Points v) HWY_ATTR { return select(isOfA, add(poses.toA(v), poses.translation), v); };
    const Points start = placed(incident.start);
    const Points end = placed(incident.end);
    const Points toStart = sub(start, face.start);
    const Points toEnd = sub(end, face.start);
    const Ends first{start, dot(face.tangent, toStart), incident.index};
    const Ends second{end, dot(face.tangent, toEnd), incident.next};
    const Clipped p = clip(face, first, second, incident.index, isOutside(face, first));
    const Clipped q = clip(face, second, first, incident.index, isOutside(face, second));

    // `hasLowest`
    const DoubleLanes lowest = hn::Min(dot(face.normal, toStart), dot(face.normal, toEnd));
    const DoubleLanes limit = hn::Mul(lowest, constant(1 + static_cast<double>(kEpsilon)));
    const DoubleMask hasLowest =
        hn::Or(hn::And(p.isThere, hn::Le(p.separation, limit)), hn::And(q.isThere, hn::Le(q.separation, limit)));
    const DoubleMask isMeant = hn::Or(hn::Le(lowest, constant(0)), hasLowest);

    const DoubleLanes margin = load(pairs.points.data() + lane);
    const DoubleMask hasFirst = hn::And(isMeant, build(face, p, margin, lane, pairs.point[0]));
    const DoubleMask hasSecond = hn::And(isMeant, build(face, q, margin, lane, pairs.point[1]));
    const DoubleLanes nearest = load(pairs.nearest.data() + lane);
    const DoubleMask isNear =
        hn::Or(hn::And(hasFirst, hn::Le(p.separation, nearest)), hn::And(hasSecond, hn::Le(q.separation, nearest)));
    pairs.plain |= bitsOf(tag, isNear, lane);
    pairs.isThere[0] |= bitsOf(tag, hasFirst, lane);
    pairs.isThere[1] |= bitsOf(tag, hasSecond, lane);
    pairs.ofA |= bitsOf(tag, isOfA, lane);
    const Points normal = select(isOfA, face.normal, inward);
    store(normal.x, pairs.normalX.data() + lane);
    store(normal.y, pairs.normalY.data() + lane);
    store(face.edge, pairs.face.data() + lane);
}

/// @tparam kVertices  of none of them more; of the greatest number there is, loops end where they may, else with it
template <int kVertices>
void collideSharpPairs(WidePairs& pairs) {
    Polygons<kVertices> a;
    Polygons<kVertices> b;
    const std::size_t vertices = kVertices < kMaxPolygonVertices ? kVertices : pairs.most();
    gather<3>(pairs.a, pairs.verticesA, vertices, a);
    gather<3>(pairs.b, pairs.verticesB, vertices, b);
    Faces ofA;
    Faces ofB;
    findFaces(a, b, vertices, pairs, ofA, ofB);
    pairs.ofA = pairs.plain = pairs.isThere[0] = pairs.isThere[1] = 0;
    constexpr std::uint32_t kAll = (1U << kPairs) - 1;
    if (pairs.apart == kAll) { return; }
    for (std::size_t lane = 0; lane < kPairs; lane += hn::MaxLanes(Doubles())) {
        if (lane >= pairs.size) { break; }  // here, so that the loop is still unrolled
        clipPairs(a, b, ofA, ofB, vertices, lane, pairs);
    }
    pairs.plain &= pairs.ordinary & ~pairs.apart;
}

/// More than a few: what the most usual of these are made of is known to the compiler.
void collideManySharpPairs(WidePairs& pairs) {
    switch (pairs.most()) {
        case 5:
            return collideSharpPairs<5>(pairs);
        case 6:
            return collideSharpPairs<6>(pairs);
        default:
            return collideSharpPairs<kMaxPolygonVertices>(pairs);
    }
}

PairKernels kernelsForSharpPairs() { return {nullptr, collideSharpPairs<kFewVertices>, collideManySharpPairs}; }

}  // namespace HWY_NAMESPACE
}  // namespace swept::inline SWEPT_PRECISION
HWY_AFTER_NAMESPACE();
#endif

#if HWY_ONCE
namespace swept::inline SWEPT_PRECISION {

namespace {
HWY_EXPORT(kernelsForSharpPairs);
}

PairKernels sharpPairKernels() { return HWY_DYNAMIC_DISPATCH(kernelsForSharpPairs)(); }

}  // namespace swept::inline SWEPT_PRECISION
#endif
