#include "gjk.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Inlined by force: the pieces of the loop hand small structs to each other, which cost more through memory than their
/// arithmetic does.
#define SWEPT_HOT [[gnu::always_inline]] inline

/// A vertex or a segment of the Minkowski difference and its distance to the origin. Passed by value, so that it lives
/// in registers.
struct Candidate {
    bool isSegment = false;
    SupportPair p;
    SupportPair q;  ///< only of a segment, like the next three
    DVec2 edge;     ///< from p to q
    double edgeSquared = 0;
    double side = 0;  ///< cross(edge, p): twice the area of the triangle with the origin
    double distanceSquared = 0;
};

SWEPT_HOT Candidate vertexCandidate(SupportPair p) {
    Candidate c;
    c.p = p;
    c.distanceSquared = dot(p.w, p.w);
    return c;
}

/// The segment from p to q, or its end if that is the closest point.
SWEPT_HOT Candidate segmentCandidate(const PairView& pair, SupportPair p, SupportPair q) {
    const DVec2 edge = pair.spanB(p.b, q.b) - pair.spanA(p.a, q.a);
    if (dot(edge, p.w) >= 0) {
        return vertexCandidate(p);
    }
    if (dot(edge, q.w) <= 0) {
        return vertexCandidate(q);
    }
    const double edgeSquared = dot(edge, edge);
    if (!(edgeSquared >= std::numeric_limits<double>::min())) {
        return vertexCandidate(p);
    }  // underflow
    const double side = cross(edge, p.w);
    return {true, p, q, edge, edgeSquared, side, side * side / edgeSquared};
}

SWEPT_HOT Candidate closer(Candidate x, Candidate y) {
    if (y.distanceSquared < x.distanceSquared) {
        return y;
    }
    return x;
}

SWEPT_HOT SupportPair pairAt(const PairView& pair, int a, int b) {
    const DVec2 va = pair.vertexA(a);
    const DVec2 vb = pair.toA(pair.localB(b));
    return {a, b, (vb + pair.translation) - va, sumNorm(va) + sumNorm(vb) + sumNorm(pair.translation)};
}

/// The point of B − A farthest against `normal`.
SWEPT_HOT SupportPair supportPair(const PairView& pair, DVec2 normal) {
    return pairAt(pair, extremeVertex<1>(pair.a, normal), extremeVertex<-1>(pair.b, pair.toB(normal)));
}

Candidate startCandidate(const PairView& pair, const SimplexCache* warm) {
    std::array<SupportPair, 3> loaded;
    int count = 0;
    if (warm != nullptr && warm->count <= 3) {
        for (std::size_t i = 0; i < warm->count; ++i) {
            if (warm->indexA[i] >= pair.a.count || warm->indexB[i] >= pair.b.count) {
                continue;
            }
            loaded[static_cast<std::size_t>(count++)] = pairAt(pair, warm->indexA[i], warm->indexB[i]);
        }
    }
    if (count == 0) {
        return vertexCandidate(supportPair(pair, pair.translation));
    }
    if (count == 1) {
        return vertexCandidate(loaded[0]);
    }
    const Candidate first = segmentCandidate(pair, loaded[0], loaded[1]);
    if (count == 2) {
        return first;
    }
    return closer(closer(first, segmentCandidate(pair, loaded[1], loaded[2])),
                  segmentCandidate(pair, loaded[2], loaded[0]));
}

SWEPT_HOT bool isSame(SupportPair x, SupportPair y) { return x.a == y.a && x.b == y.b; }

/// Whether the origin lies inside the triangle of the segment and `p` beyond doubt: each cross product is compared with
/// the error that the coordinates' resolution may give it.
SWEPT_HOT bool enclosesOrigin(const Candidate& segment, SupportPair p, double resolution) {
    const DVec2 u = segment.p.w;
    const DVec2 v = segment.q.w;
    const double nu = sumNorm(u);
    const double nv = sumNorm(v);
    const double np = sumNorm(p.w);
    const double sign = segment.side > 0 ? -1 : 1;  // cross(u, v) = −cross(v − u, u)
    return sign * cross(u, v) > resolution * (nu + nv) && sign * cross(v, p.w) > resolution * (nv + np) &&
           sign * cross(p.w, u) > resolution * (np + nu);
}

SWEPT_HOT GjkResult asResult(const Candidate& c) {
    GjkResult r;
    r.count = c.isSegment ? 2 : 1;
    r.simplex[0] = c.p;
    r.simplex[1] = c.q;
    return r;
}

/// Unit normal of a segment, towards the side of the origin's other side: from A to B.
SWEPT_HOT DVec2 segmentNormal(const Candidate& c, double inverseLength) {
    return (c.side > 0 ? inverseLength : -inverseLength) * leftPerp(c.edge);
}

}  // namespace

GjkResult runGjk(const PairView& pair, const SimplexCache* warm) {
    Candidate current = startCandidate(pair, warm);
    double resolution = kResolution * current.p.size;
    double distance = 0;
    DVec2 normal;
    SupportPair next;
    GjkOutcome outcome = GjkOutcome::stalled;
    bool encloses = false;
    int iteration = 0;
    while (iteration < kMaxGjkIterations) {
        ++iteration;
        // The normal comes from the edge itself, not from the closest point, which is all rounding near a contact.
        const double scale = std::sqrt(current.isSegment ? current.edgeSquared : current.distanceSquared);
        const double inverse = scale > 0 ? 1 / scale : 0;
        distance = current.isSegment ? inverse * std::fabs(current.side) : scale;
        if (!(distance > resolution)) {
            outcome = GjkOutcome::touching;
            break;
        }
        normal = current.isSegment ? segmentNormal(current, inverse) : inverse * current.p.w;
        next = supportPair(pair, normal);
        const double seen = kResolution * next.size;
        resolution = seen > resolution ? seen : resolution;
        if (isSame(next, current.p) || (current.isSegment && isSame(next, current.q)) ||
            distance - dot(normal, next.w) <= resolution) {
            outcome = GjkOutcome::apart;
            break;
        }
        if (current.isSegment && enclosesOrigin(current, next, resolution)) {
            outcome = GjkOutcome::touching;
            encloses = true;
            break;
        }
        Candidate best = segmentCandidate(pair, current.p, next);
        if (current.isSegment) {
            best = closer(best, segmentCandidate(pair, next, current.q));
        }
        if (!(best.distanceSquared < current.distanceSquared)) {
            break;
        }
        current = best;
    }
    GjkResult r = asResult(current);
    r.outcome = outcome;
    r.normal = normal;
    r.distance = distance;
    r.resolution = resolution;
    r.iterations = iteration;
    r.encloses = encloses;
    if (encloses) {
        r.simplex[static_cast<std::size_t>(r.count++)] = next;
    }
    return r;
}

void remember(const GjkResult& r, SimplexCache& cache) {
    cache.count = static_cast<std::uint8_t>(r.count);
    for (std::size_t i = 0; i < static_cast<std::size_t>(r.count); ++i) {
        cache.indexA[i] = static_cast<std::uint8_t>(r.simplex[i].a);
        cache.indexB[i] = static_cast<std::uint8_t>(r.simplex[i].b);
    }
}

GjkResult closestByExhaustion(const PairView& pair) {
    GjkResult best;
    double bestGap = std::numeric_limits<double>::infinity();
    const auto consider = [&](const Candidate& c) {
        const double scale = std::sqrt(c.isSegment ? c.edgeSquared : c.distanceSquared);
        if (!(scale > 0)) {
            return;
        }
        const DVec2 normal = c.isSegment ? segmentNormal(c, 1 / scale) : (1 / scale) * c.p.w;
        const double distance = c.isSegment ? std::fabs(c.side) / scale : scale;
        const double gap = distance - dot(normal, supportPair(pair, normal).w);
        if (!(gap < bestGap) || !(distance > 0)) {
            return;
        }
        bestGap = gap;
        best = asResult(c);
        best.outcome = GjkOutcome::apart;
        best.normal = normal;
        best.distance = distance;
    };
    for (int i = 0; i < pair.a.count; ++i) {
        for (int j = 0; j < pair.b.count; ++j) {
            const SupportPair p = pairAt(pair, i, j);
            consider(segmentCandidate(pair, p, pairAt(pair, i, pair.b.next(j))));
            consider(segmentCandidate(pair, p, pairAt(pair, pair.a.next(i), j)));
        }
    }
    if (best.count == 0) {
        best = asResult(vertexCandidate(pairAt(pair, 0, 0)));
        best.outcome = GjkOutcome::touching;
    }
    return best;
}

GjkResult closestFeatures(const PairView& pair, const SimplexCache* warm) {
    GjkResult r = runGjk(pair, warm);
    if (r.outcome != GjkOutcome::stalled) {
        return r;
    }
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
    const double along = -dot(edge, p.w) / dot(edge, edge);
    const DVec2 a = pair.vertexA(p.a) + along * spanA;
    return {a, a + gap};
}

CoreSeparation coreSeparation(const PairView& pair, const GjkResult& gjk) {
    if (gjk.outcome == GjkOutcome::apart) {
        return {gjk.distance, gjk.normal, witnessOf(pair, gjk, gjk.distance * gjk.normal)};
    }
    const CoreAxis axis = coreAxis(pair);
    // In a mere touch the least penetration is all rounding, and its foot may lie beside a slender shape: the simplex
    // knows the place better.
    const bool isTouch = !gjk.encloses && axis.separation >= -gjk.resolution;
    return {axis.separation, axis.normal,
            isTouch ? witnessOf(pair, gjk, axis.separation * axis.normal) : corePoints(pair, axis)};
}

}  // namespace swept::inline SWEPT_PRECISION
