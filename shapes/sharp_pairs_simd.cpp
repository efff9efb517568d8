// Compiled once per instruction set: foreach_target.h reads this file again for each.
#include "manifold_parts.h"
#include "sharp_pairs.h"
#include "wide_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "sharp_pairs_simd.cpp"
#include <hwy/foreach_target.h>
#include <hwy/highway.h>

#if HWY_TARGET == HWY_SCALAR || HWY_TARGET == HWY_EMU128
namespace swept::inline SWEPT_PRECISION {
namespace HWY_NAMESPACE {
SharpPairKernels kernelsForSharpPairs() { return {}; }
}  // namespace HWY_NAMESPACE
}  // namespace swept::inline SWEPT_PRECISION
#else

HWY_BEFORE_NAMESPACE();
namespace swept::inline SWEPT_PRECISION {
namespace HWY_NAMESPACE {

namespace hn = hwy::HWY_NAMESPACE;

constexpr std::size_t kPairs = SharpPairs::kPairs;

// --- in `Real`, as face_search.h

using Reals = hn::CappedTag<Real, kPairs>;
using RealLanes = hn::Vec<Reals>;

/// Polygons side by side, coordinates apart. Beyond the last vertex the first one is repeated: it changes no choice.
template <int kVertices>
struct alignas(64) Polygons {
    Real x[kVertices][kPairs];
    Real y[kVertices][kPairs];
    Real normalX[kVertices][kPairs];
    Real normalY[kVertices][kPairs];
    Real count[kPairs];
};

/// As many pairs, and half as many points of each, as 16 bytes hold numbers.
constexpr std::size_t kSquare = 16 / sizeof(Real);

/// Vertices, or normals, of as many pairs as a square has rows.
using Rows = std::array<const Real*, kSquare>;

/// The points of a square from row to row, to coordinates from lane to lane.
/// @param first  of the points
HWY_INLINE void transpose(const Rows& rows, std::size_t first, Real (*x)[kPairs], Real (*y)[kPairs], std::size_t lane) {
    const hn::FixedTag<Real, kSquare> tag;
    const auto row = [&rows, first](std::size_t k)
                         HWY_ATTR { return hn::LoadU(hn::FixedTag<Real, kSquare>(), rows[k] + 2 * first); };
    const auto low = hn::InterleaveLower(tag, row(0), row(1));
    const auto high = hn::InterleaveUpper(tag, row(0), row(1));
    if constexpr (kSquare == 2) {
        hn::Store(low, tag, x[first] + lane);
        hn::Store(high, tag, y[first] + lane);
    } else {
        const auto otherLow = hn::InterleaveLower(tag, row(2), row(3));
        const auto otherHigh = hn::InterleaveUpper(tag, row(2), row(3));
        hn::Store(hn::ConcatLowerLower(tag, otherLow, low), tag, x[first] + lane);
        hn::Store(hn::ConcatUpperUpper(tag, otherLow, low), tag, y[first] + lane);
        hn::Store(hn::ConcatLowerLower(tag, otherHigh, high), tag, x[first + 1] + lane);
        hn::Store(hn::ConcatUpperUpper(tag, otherHigh, high), tag, y[first + 1] + lane);
    }
}

HWY_INLINE void repeatFirst(Real (*rows)[kPairs], std::size_t row, std::size_t lane, hn::Mask<Reals> isThere) {
    const Reals tag;
    const RealLanes own = hn::Load(tag, rows[row] + lane);
    hn::Store(hn::IfThenElse(isThere, own, hn::Load(tag, rows[0] + lane)), tag, rows[row] + lane);
}

template <int kVertices>
HWY_INLINE void gather(const std::array<const Polygon*, kPairs>& from, std::size_t vertices, Polygons<kVertices>& to) {
    const Reals tag;
    constexpr std::size_t kPoints = kSquare / 2;
    for (std::size_t lane = 0; lane < kPairs; lane += kSquare) {
        Rows corners;
        Rows normals;
        for (std::size_t k = 0; k < kSquare; ++k) {
            corners[k] = &from[lane + k]->vertices[0].x;
            normals[k] = &from[lane + k]->normals[0].x;
        }
        for (std::size_t i = 0; i < vertices; i += kPoints) {
            transpose(corners, i, to.x, to.y, lane);
            transpose(normals, i, to.normalX, to.normalY, lane);
        }
    }
    for (std::size_t lane = 0; lane < kPairs; ++lane) { to.count[lane] = static_cast<Real>(from[lane]->count); }
    for (std::size_t lane = 0; lane < kPairs; lane += hn::MaxLanes(tag)) {
        const RealLanes count = hn::Load(tag, to.count + lane);
        for (std::size_t i = 3; i < vertices; ++i) {
            const auto isThere = hn::Gt(count, hn::Set(tag, static_cast<Real>(i)));
            repeatFirst(to.x, i, lane, isThere);
            repeatFirst(to.y, i, lane, isThere);
            repeatFirst(to.normalX, i, lane, isThere);
            repeatFirst(to.normalY, i, lane, isThere);
        }
    }
}

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

template <class Tag>
HWY_INLINE std::uint32_t bitsOf(Tag tag, hn::Mask<Tag> mask, std::size_t lane) {
    std::uint8_t bytes[8];  // as many as are written at once
    hn::StoreMaskBits(tag, mask, bytes);
    return std::uint32_t{bytes[0]} << lane;
}

template <int kVertices>
HWY_INLINE void findFaces(const Polygons<kVertices>& a, const Polygons<kVertices>& b, std::size_t vertices,
                          SharpPairs& pairs, Faces& ofA, Faces& ofB) {
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

using Doubles = hn::CappedTag<double, kPairs>;
using DoubleLanes = hn::Vec<Doubles>;
using DoubleMask = hn::Mask<Doubles>;

struct Points {
    DoubleLanes x;
    DoubleLanes y;
};

HWY_INLINE DoubleLanes load(const double* from) { return hn::Load(Doubles(), from); }
HWY_INLINE DoubleLanes load(const float* from) {
    return hn::PromoteTo(Doubles(), hn::Load(hn::Rebind<float, Doubles>(), from));
}
HWY_INLINE void store(DoubleLanes v, double* to) { hn::Store(v, Doubles(), to); }
HWY_INLINE void store(DoubleLanes v, float* to) {
    const hn::Rebind<float, Doubles> tag;
    hn::Store(hn::DemoteTo(tag, v), tag, to);
}
HWY_INLINE DoubleLanes constant(double x) { return hn::Set(Doubles(), x); }

HWY_INLINE Points add(Points p, Points q) { return {hn::Add(p.x, q.x), hn::Add(p.y, q.y)}; }
HWY_INLINE Points sub(Points p, Points q) { return {hn::Sub(p.x, q.x), hn::Sub(p.y, q.y)}; }
HWY_INLINE Points scale(DoubleLanes s, Points p) { return {hn::Mul(s, p.x), hn::Mul(s, p.y)}; }
HWY_INLINE DoubleLanes dot(Points p, Points q) { return hn::Add(hn::Mul(p.x, q.x), hn::Mul(p.y, q.y)); }
HWY_INLINE Points select(DoubleMask mask, Points p, Points q) {
    return {hn::IfThenElse(mask, p.x, q.x), hn::IfThenElse(mask, p.y, q.y)};
}

/// `PairView` without the shapes.
struct Poses {
    DoubleLanes c;
    DoubleLanes s;
    Points translation;

    HWY_INLINE Points toA(Points v) const {
        return {hn::Sub(hn::Mul(c, v.x), hn::Mul(s, v.y)), hn::Add(hn::Mul(s, v.x), hn::Mul(c, v.y))};
    }
    HWY_INLINE Points toB(Points v) const {
        return {hn::Add(hn::Mul(c, v.x), hn::Mul(s, v.y)), hn::Sub(hn::Mul(c, v.y), hn::Mul(s, v.x))};
    }
};

/// An edge of one polygon of each pair, in the frame of that polygon.
struct Edges {
    DoubleLanes index;
    DoubleLanes next;  ///< index of the vertex at the end; that at the start has the index of the edge
    Points start;
    Points end;
};

HWY_INLINE DoubleLanes nextOf(DoubleLanes index, DoubleLanes count) {
    const DoubleLanes next = hn::Add(index, constant(1));
    return hn::IfThenElseZero(hn::Lt(next, count), next);
}

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

/// `edgeFacing` of that polygon which has not the reference face.
template <int kVertices>
HWY_INLINE Edges facing(const Polygons<kVertices>& a, const Polygons<kVertices>& b, DoubleMask isOfB, Points direction,
                        std::size_t vertices, std::size_t lane) {
    const auto vertex = [&](std::size_t i) HWY_ATTR {
        return select(isOfB, {load(b.x[i] + lane), load(b.y[i] + lane)}, {load(a.x[i] + lane), load(a.y[i] + lane)});
    };
    const auto normal = [&](std::size_t i) HWY_ATTR {
        return select(isOfB, {load(b.normalX[i] + lane), load(b.normalY[i] + lane)},
                      {load(a.normalX[i] + lane), load(a.normalY[i] + lane)});
    };
    const Points first = vertex(0);
    Points next = vertex(1);
    Edges edges{constant(0), constant(0), first, next};
    DoubleLanes best = dot(direction, normal(0));
    for (std::size_t i = 1; i < vertices; ++i) {
        const Points own = next;
        next = i + 1 < vertices ? vertex(i + 1) : first;
        const DoubleLanes along = dot(direction, normal(i));
        const DoubleMask isBetter = hn::Gt(along, best);
        best = hn::IfThenElse(isBetter, along, best);
        edges.index = hn::IfThenElse(isBetter, constant(static_cast<double>(i)), edges.index);
        edges.start = select(isBetter, own, edges.start);
        edges.end = select(isBetter, next, edges.end);
    }
    edges.next = nextOf(edges.index, hn::IfThenElse(isOfB, load(b.count + lane), load(a.count + lane)));
    return edges;
}

/// `ReferenceFace`.
struct References {
    Points start;
    Points tangent;
    Points normal;
    DoubleLanes length;
    DoubleLanes edge;
    DoubleLanes next;
    DoubleMask isOfA;
};

HWY_INLINE References referencesOf(const Edges& a, const Edges& b, DoubleMask isOfA, const Poses& poses) {
    const Points edge = select(isOfA, sub(a.end, a.start), poses.toA(sub(b.end, b.start)));
    const Points start = select(isOfA, a.start, add(poses.toA(b.start), poses.translation));
    const DoubleLanes inverse = hn::Div(constant(1), hn::Sqrt(dot(edge, edge)));
    const Points normal = scale(inverse, {edge.y, hn::Neg(edge.x)});
    const Points tangent{hn::Neg(normal.y), normal.x};
    return {start,
            tangent,
            normal,
            dot(edge, tangent),
            hn::IfThenElse(isOfA, a.index, b.index),
            hn::IfThenElse(isOfA, a.next, b.next),
            isOfA};
}

/// An end of the incident edge: a vertex, how far along the reference face, and its index.
struct Ends {
    Points vertex;
    DoubleLanes along;
    DoubleLanes index;
};

/// `ClippedPoint`.
struct Clipped {
    Points core;
    DoubleLanes separation;
    DoubleLanes id;
    DoubleMask isThere;
};

/// One call of `clip`'s `add`, without slack.
HWY_INLINE Clipped clip(const References& face, const Ends& own, const Ends& other, DoubleLanes incidentEdge) {
    constexpr double kEdge = 0x80;  // `featureId`
    constexpr double kShift = 0x100;
    const DoubleLanes zero = constant(0);
    const DoubleMask isBefore = hn::Lt(own.along, zero);
    const DoubleMask isBeyond = hn::Gt(own.along, face.length);
    const DoubleMask isOutside = hn::Or(isBefore, isBeyond);
    const DoubleLanes bound = hn::IfThenElse(isBefore, zero, face.length);
    const DoubleMask isNothingLeft =
        hn::Or(hn::And(isBefore, hn::Le(other.along, bound)), hn::AndNot(isBefore, hn::Ge(other.along, bound)));
    const DoubleLanes part = hn::Div(hn::Sub(bound, own.along), hn::Sub(other.along, own.along));
    const Points core = select(isOutside, add(own.vertex, scale(part, sub(other.vertex, own.vertex))), own.vertex);
    const DoubleLanes reference =
        hn::IfThenElse(isOutside, hn::IfThenElse(isBefore, face.edge, face.next), hn::Add(face.edge, constant(kEdge)));
    const DoubleLanes incident = hn::IfThenElse(isOutside, hn::Add(incidentEdge, constant(kEdge)), own.index);
    const DoubleLanes ofA = hn::IfThenElse(face.isOfA, reference, incident);
    const DoubleLanes ofB = hn::IfThenElse(face.isOfA, incident, reference);
    return {core, dot(face.normal, sub(core, face.start)), hn::Add(hn::Mul(ofA, constant(kShift)), ofB),
            hn::Not(hn::And(isOutside, isNothingLeft))};
}

/// `ManifoldBuilder::build` for one point. @return whether it is there
HWY_INLINE DoubleMask build(const References& face, const Clipped& p, DoubleLanes margin, std::size_t lane,
                            SharpPairs::Point& out) {
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
                          const Faces& ofB, std::size_t vertices, std::size_t lane, SharpPairs& pairs) {
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
    const Clipped p = clip(face, first, second, incident.index);
    const Clipped q = clip(face, second, first, incident.index);

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

template <int kVertices>
void collideSharpPairs(SharpPairs& pairs) {
    Polygons<kVertices> a;
    Polygons<kVertices> b;
    const std::size_t vertices = kVertices == kFewVertices ? kVertices : pairs.vertices;
    gather(pairs.a, vertices, a);
    gather(pairs.b, vertices, b);
    Faces ofA;
    Faces ofB;
    findFaces(a, b, vertices, pairs, ofA, ofB);
    pairs.ofA = pairs.plain = pairs.isThere[0] = pairs.isThere[1] = 0;
    constexpr std::uint32_t kAll = (1U << kPairs) - 1;
    if (pairs.apart == kAll) { return; }
    for (std::size_t lane = 0; lane < kPairs; lane += hn::MaxLanes(Doubles())) {
        clipPairs(a, b, ofA, ofB, vertices, lane, pairs);
    }
    pairs.plain &= pairs.ordinary & ~pairs.apart;
}

SharpPairKernels kernelsForSharpPairs() {
    return {collideSharpPairs<kFewVertices>, collideSharpPairs<kMaxPolygonVertices>};
}

}  // namespace HWY_NAMESPACE
}  // namespace swept::inline SWEPT_PRECISION
HWY_AFTER_NAMESPACE();
#endif

#if HWY_ONCE
namespace swept::inline SWEPT_PRECISION {

namespace {
HWY_EXPORT(kernelsForSharpPairs);
}

SharpPairKernels sharpPairKernels() { return HWY_DYNAMIC_DISPATCH(kernelsForSharpPairs)(); }

}  // namespace swept::inline SWEPT_PRECISION
#endif
