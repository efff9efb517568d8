#include "gjk.h"

#include "compiler.h"
#include "gjk_run.h"

namespace swept::inline SWEPT_PRECISION {
namespace gjk {
namespace {

// The pieces of the loop are inlined by force: they hand small structs to each other, which cost more through memory
// than their arithmetic does.

/// A point of the Minkowski difference: vertex `b` of B minus vertex `a` of A, frame of A.
/// Without initial values: clearing what is written at once would cost a query a tenth of its time.
struct SupportPoint {
    int a;
    int b;
    double x;
    double y;
    double size;  ///< sum of the magnitudes of the coordinates that went into it, metres

    DVec2 w() const { return {x, y}; }
};

SWEPT_FORCE_INLINE SupportPoint pointAt(const PairView& pair, int a, int b) {
    const DVec2 va = pair.vertexA(a);
    const DVec2 vb = pair.toA(pair.localB(b));
    const DVec2 w = (vb + pair.translation) - va;
    return {a, b, w.x, w.y, sumNorm(va) + sumNorm(vb) + sumNorm(pair.translation)};
}

/// The point of B − A farthest against `normal`.
SWEPT_FORCE_INLINE SupportPoint supportPoint(const PairView& pair, DVec2 normal) {
    return pointAt(pair, extremeVertex<1>(pair.a, normal), extremeVertex<-1>(pair.b, pair.toB(normal)));
}

SWEPT_FORCE_INLINE bool isSame(const SupportPoint& x, const SupportPoint& y) { return x.a == y.a && x.b == y.b; }

/// A vertex (`p` alone) or a segment of the Minkowski difference, with what its distance to the origin is made of.
struct Simplex {
    SupportPoint p;
    SupportPoint q;
    bool isSegment;
    double edgeX;  ///< from p to q; only of a segment, like the next three
    double edgeY;
    double edgeSquared;
    double side;  ///< cross(edge, p): twice the area of the triangle with the origin
    double distanceSquared;
};

SWEPT_FORCE_INLINE void setVertex(Simplex& simplex, const SupportPoint& p) {
    simplex.p = p;
    simplex.isSegment = false;
    simplex.distanceSquared = dot(p.w(), p.w());
}

/// Makes `simplex` the segment from p to q, or its end if that is the closest point.
SWEPT_FORCE_INLINE void setSegment(const PairView& pair, Simplex& simplex, const SupportPoint& p,
                                   const SupportPoint& q) {
    const DVec2 edge = pair.spanB(p.b, q.b) - pair.spanA(p.a, q.a);
    const double edgeSquared = dot(edge, edge);
    const bool atP = dot(edge, p.w()) >= 0 || !(edgeSquared >= std::numeric_limits<double>::min());  // or underflow
    if (atP || dot(edge, q.w()) <= 0) { return setVertex(simplex, atP ? p : q); }
    simplex.p = p;
    simplex.q = q;
    simplex.isSegment = true;
    simplex.edgeX = edge.x;
    simplex.edgeY = edge.y;
    simplex.edgeSquared = edgeSquared;
    simplex.side = cross(edge, p.w());
    simplex.distanceSquared = simplex.side * simplex.side / edgeSquared;
}

/// The closer of the segments from `next` to the ends of `simplex`, in `closer`.
SWEPT_FORCE_INLINE void extend(const PairView& pair, const Simplex& simplex, const SupportPoint& next,
                               Simplex& closer) {
    setSegment(pair, closer, simplex.p, next);
    if (!simplex.isSegment) { return; }
    Simplex other;
    setSegment(pair, other, next, simplex.q);
    if (other.distanceSquared < closer.distanceSquared) { closer = other; }
}

/// The pair of a cached simplex; false when its indices do not fit.
SWEPT_FORCE_INLINE bool load(const PairView& pair, const SimplexCache& warm, std::size_t i, SupportPoint& loaded) {
    const int a = warm.indexA[i];
    const int b = warm.indexB[i];
    if (a >= pair.a.count || b >= pair.b.count) { return false; }
    loaded = pointAt(pair, a, b);
    return true;
}

/// Where a run begins: the closest part of what the last one ended with, or the vertices that face each other. Of a
/// triangle (the cores touched) the first edge is taken: the run finds the rest.
SWEPT_FORCE_INLINE void start(const PairView& pair, const SimplexCache* warm, Simplex& simplex) {
    SupportPoint first;
    SupportPoint second;
    if (warm == nullptr || warm->count == 0 || !load(pair, *warm, 0, first)) {
        setVertex(simplex, supportPoint(pair, pair.translation));
    } else if (warm->count > 1 && load(pair, *warm, 1, second)) {
        setSegment(pair, simplex, first, second);
    } else {
        setVertex(simplex, first);
    }
}

/// Whether the origin lies inside the triangle of the segment and `p` beyond doubt: each cross product is compared with
/// the error that the coordinates' resolution may give it.
SWEPT_FORCE_INLINE bool enclosesOrigin(const Simplex& segment, const SupportPoint& p, double resolution) {
    const DVec2 u = segment.p.w();
    const DVec2 v = segment.q.w();
    const double nu = sumNorm(u);
    const double nv = sumNorm(v);
    const double np = sumNorm(p.w());
    const double sign = segment.side > 0 ? -1 : 1;  // cross(u, v) = −cross(v − u, u)
    return sign * cross(u, v) > resolution * (nu + nv) && sign * cross(v, p.w()) > resolution * (nv + np) &&
           sign * cross(p.w(), u) > resolution * (np + nu);
}

/// From the closest point of the origin towards it, not normalised: the closest direction from A to B. Of a segment it
/// comes from the edge itself, not from the closest point, which is all rounding near a contact.
SWEPT_FORCE_INLINE DVec2 directionOf(const Simplex& simplex) {
    if (!simplex.isSegment) { return simplex.p.w(); }
    const DVec2 across = leftPerp(DVec2{simplex.edgeX, simplex.edgeY});
    return simplex.side > 0 ? across : -across;
}

/// Never longer than the Euclidean length.
SWEPT_FORCE_INLINE double maxNorm(DVec2 v) {
    const double x = std::fabs(v.x);
    const double y = std::fabs(v.y);
    return x > y ? x : y;
}

/// Writes features, distance and normal of a simplex.
SWEPT_FORCE_INLINE void store(const Simplex& simplex, GjkResult& r) {
    const double scale = std::sqrt(simplex.isSegment ? simplex.edgeSquared : simplex.distanceSquared);
    const double inverse = scale > 0 ? 1 / scale : 0;
    r.distance = simplex.isSegment ? inverse * std::fabs(simplex.side) : scale;
    r.normal = inverse * directionOf(simplex);
    r.count = simplex.isSegment ? 2 : 1;
    r.simplex[0] = {simplex.p.a, simplex.p.b};
    if (simplex.isSegment) { r.simplex[1] = {simplex.q.a, simplex.q.b}; }
}

}  // namespace

void runLoop(const PairView& pair, const SimplexCache* warm, GjkResult& r) {
    r.outcome = GjkOutcome::stalled;
    // Two places that take turns: the simplex and what it grows into.
    std::array<Simplex, 2> places;
    Simplex* current = &places[0];
    Simplex* grown = &places[1];
    start(pair, warm, *current);
    r.resolution = kResolution * current->p.size;
    while (r.iterations < kMaxGjkIterations) {
        ++r.iterations;
        // Lengths are compared times the length of the direction: the root and the division wait until the end.
        if (!(current->distanceSquared > r.resolution * r.resolution)) {
            r.outcome = GjkOutcome::touching;
            break;
        }
        const DVec2 direction = directionOf(*current);
        const SupportPoint next = supportPoint(pair, direction);
        const double seen = kResolution * next.size;
        r.resolution = seen > r.resolution ? seen : r.resolution;
        const double upper = current->isSegment ? std::fabs(current->side) : current->distanceSquared;
        if (isSame(next, current->p) || (current->isSegment && isSame(next, current->q)) ||
            upper - dot(direction, next.w()) <= r.resolution * maxNorm(direction)) {
            r.outcome = GjkOutcome::apart;
            break;
        }
        if (current->isSegment && enclosesOrigin(*current, next, r.resolution)) {
            r.outcome = GjkOutcome::touching;
            r.encloses = true;
            r.simplex[2] = {next.a, next.b};
            break;
        }
        extend(pair, *current, next, *grown);
        if (!(grown->distanceSquared < current->distanceSquared)) { break; }
        std::swap(current, grown);
    }
    store(*current, r);
    if (r.encloses) { r.count = 3; }
    if (r.outcome == GjkOutcome::apart) { r.points = witnessOf(pair, r, r.distance * r.normal); }
}

}  // namespace gjk

GjkResult runGjk(const PairView& pair, const SimplexCache* warm) {
    GjkResult r;
    gjk::run(pair, warm, r);
    return r;
}

GjkResult closestByExhaustion(const PairView& pair) {
    GjkResult best;
    double bestGap = std::numeric_limits<double>::infinity();
    const auto consider = [&](const gjk::SupportPoint& p, const gjk::SupportPoint& q) {
        gjk::Simplex simplex;
        gjk::setSegment(pair, simplex, p, q);
        GjkResult candidate;
        gjk::store(simplex, candidate);
        const double gap = candidate.distance - dot(candidate.normal, gjk::supportPoint(pair, candidate.normal).w());
        if (!(gap < bestGap) || !(candidate.distance > 0)) { return; }
        bestGap = gap;
        best = candidate;
        best.outcome = GjkOutcome::apart;
    };
    for (int i = 0; i < pair.a.count; ++i) {
        for (int j = 0; j < pair.b.count; ++j) {
            const gjk::SupportPoint p = gjk::pointAt(pair, i, j);
            consider(p, gjk::pointAt(pair, i, pair.b.next(j)));
            consider(p, gjk::pointAt(pair, pair.a.next(i), j));
        }
    }
    if (best.count == 0) {
        best.count = 1;
        best.simplex[0] = {0, 0};
        best.outcome = GjkOutcome::touching;
        return best;
    }
    best.points = witnessOf(pair, best, best.distance * best.normal);
    return best;
}

GjkResult closestFeatures(const PairView& pair, const SimplexCache* warm) {
    GjkResult r = runGjk(pair, warm);
    if (r.outcome != GjkOutcome::stalled) { return r; }
    if (coreAxis(pair).separation <= 0) {
        r.outcome = GjkOutcome::touching;
        return r;
    }
    GjkResult resolved = closestByExhaustion(pair);
    resolved.resolution = r.resolution;
    resolved.iterations = r.iterations;
    return resolved;
}

CorePoints witnessOf(const PairView& pair, const GjkResult& r, DVec2 gap) {
    const SupportPair& p = r.simplex[0];
    if (r.count == 1) {
        const DVec2 a = pair.vertexA(p.a);
        return {a, a + gap};
    }
    const SupportPair& q = r.simplex[1];
    if (p.b == q.b) {  // a vertex of B over an edge of A
        const DVec2 b = pair.vertexB(p.b);
        return {b - gap, b};
    }
    const DVec2 spanA = pair.spanA(p.a, q.a);
    const DVec2 edge = pair.spanB(p.b, q.b) - spanA;
    const DVec2 first = pair.vertexA(p.a);
    const double along = -dot(edge, pair.vertexB(p.b) - first) / dot(edge, edge);
    const DVec2 a = first + along * spanA;
    return {a, a + gap};
}

CoreSeparation coreSeparation(const PairView& pair, const GjkResult& gjk) {
    if (gjk.outcome == GjkOutcome::apart) { return {gjk.distance, gjk.normal, gjk.points}; }
    const CoreAxis axis = coreAxis(pair);
    // In a mere touch the least penetration is all rounding, and its foot may lie beside a slender shape: the simplex
    // knows the place better.
    const bool isTouch = !gjk.encloses && axis.separation >= -gjk.resolution;
    return {axis.separation, axis.normal,
            isTouch ? witnessOf(pair, gjk, axis.separation * axis.normal) : corePoints(pair, axis)};
}

}  // namespace swept::inline SWEPT_PRECISION
