#include "gjk.h"

#include "gjk_run.h"

namespace swept::inline SWEPT_PRECISION {

GjkResult runGjk(const PairView& pair, const SimplexCache* warm) {
    GjkResult r;
    gjk::run(pair, warm, r);
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
    const auto consider = [&](const SupportPair& p, const SupportPair& q) {
        gjk::Simplex simplex;
        gjk::setSegment(pair, simplex, p, q);
        GjkResult candidate;
        gjk::store(simplex, candidate);
        const double gap = candidate.distance - dot(candidate.normal, gjk::supportPair(pair, candidate.normal).w());
        if (!(gap < bestGap) || !(candidate.distance > 0)) { return; }
        bestGap = gap;
        best = candidate;
        best.outcome = GjkOutcome::apart;
    };
    for (int i = 0; i < pair.a.count; ++i) {
        for (int j = 0; j < pair.b.count; ++j) {
            const SupportPair p = gjk::pairAt(pair, i, j);
            consider(p, gjk::pairAt(pair, i, pair.b.next(j)));
            consider(p, gjk::pairAt(pair, pair.a.next(i), j));
        }
    }
    if (best.count == 0) {
        best.count = 1;
        best.simplex[0] = gjk::pairAt(pair, 0, 0);
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
    const double along = -dot(edge, p.w()) / dot(edge, edge);
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
