#include "gjk.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// What double resolves of a difference of coordinates, per unit of their sum: a rotated and translated vertex carries
/// about three half-units of rounding, the difference one more.
constexpr double kResolution = 2 * std::numeric_limits<double>::epsilon();

/// Closest point of a segment of the Minkowski difference (or of a vertex) to the origin.
struct Candidate {
    int count = 0;
    std::array<SupportPair, 2> pairs{};
    DVec2 edge;                 ///< from pairs[0] to pairs[1]; only when count is 2
    double edgeSquared = 0;     ///< dot(edge, edge)
    double side = 0;            ///< cross(edge, w0): twice the area of the triangle with the origin
    double distanceSquared = 0;
};

Candidate vertexCandidate(const SupportPair& p) {
    Candidate c;
    c.count = 1;
    c.pairs[0] = p;
    c.distanceSquared = dot(p.w, p.w);
    return c;
}

Candidate segmentCandidate(const PairView& pair, const SupportPair& p, const SupportPair& q) {
    const DVec2 edge = pair.spanB(p.b, q.b) - pair.spanA(p.a, q.a);
    if (dot(edge, p.w) >= 0) { return vertexCandidate(p); }
    if (dot(edge, q.w) <= 0) { return vertexCandidate(q); }
    const double edgeSquared = dot(edge, edge);
    if (!(edgeSquared >= std::numeric_limits<double>::min())) { return vertexCandidate(p); }  // underflow
    Candidate c;
    c.count = 2;
    c.pairs = {p, q};
    c.edge = edge;
    c.edgeSquared = edgeSquared;
    c.side = cross(edge, p.w);
    c.distanceSquared = c.side * c.side / edgeSquared;
    return c;
}

const Candidate& closer(const Candidate& x, const Candidate& y) {
    return y.distanceSquared < x.distanceSquared ? y : x;
}

/// The state of one run.
class Gjk {
public:
    explicit Gjk(const PairView& pair) : pair_(pair), translationNorm_(sumNorm(pair.translation)) {}

    GjkResult run(const SimplexCache* warm);

private:
    SupportPair makePair(int a, int b);
    SupportPair support(DVec2 normal);
    void start(const SimplexCache* warm);
    bool isKnown(const SupportPair& p) const;
    bool enclosesOrigin(const SupportPair& p) const;
    GjkResult finish(GjkOutcome outcome, int iterations) const;

    const PairView& pair_;
    double translationNorm_;
    double resolution_ = 0;  ///< metres; grows with the coordinates seen
    Candidate current_;
    DVec2 normal_;
    double distance_ = 0;
    SupportPair third_;
    bool hasThird_ = false;
};

SupportPair Gjk::makePair(int a, int b) {
    const DVec2 va = pair_.vertexA(a);
    const DVec2 vb = pair_.toA(pair_.localB(b));
    const double resolution = kResolution * (sumNorm(va) + sumNorm(vb) + translationNorm_);
    if (resolution > resolution_) { resolution_ = resolution; }
    return {a, b, (vb + pair_.translation) - va};
}

/// The point of B − A farthest against `normal`.
SupportPair Gjk::support(DVec2 normal) {
    return makePair(extremeVertex<1>(pair_.a, normal), extremeVertex<-1>(pair_.b, pair_.toB(normal)));
}

void Gjk::start(const SimplexCache* warm) {
    std::array<SupportPair, 3> loaded;
    int count = 0;
    if (warm != nullptr && warm->count <= 3) {
        for (std::size_t i = 0; i < warm->count; ++i) {
            if (warm->indexA[i] >= pair_.a.count || warm->indexB[i] >= pair_.b.count) { continue; }
            loaded[static_cast<std::size_t>(count++)] = makePair(warm->indexA[i], warm->indexB[i]);
        }
    }
    switch (count) {
        case 0: current_ = vertexCandidate(support(pair_.translation)); break;
        case 1: current_ = vertexCandidate(loaded[0]); break;
        case 2: current_ = segmentCandidate(pair_, loaded[0], loaded[1]); break;
        default:
            current_ = closer(closer(segmentCandidate(pair_, loaded[0], loaded[1]),
                                     segmentCandidate(pair_, loaded[1], loaded[2])),
                              segmentCandidate(pair_, loaded[2], loaded[0]));
    }
}

bool Gjk::isKnown(const SupportPair& p) const {
    for (std::size_t i = 0; i < static_cast<std::size_t>(current_.count); ++i) {
        if (current_.pairs[i].a == p.a && current_.pairs[i].b == p.b) { return true; }
    }
    return false;
}

/// Whether the origin lies inside the triangle of the current segment and `p` beyond doubt: each cross product is
/// compared with the error that the coordinates' resolution may give it.
bool Gjk::enclosesOrigin(const SupportPair& p) const {
    const DVec2 u = current_.pairs[0].w;
    const DVec2 v = current_.pairs[1].w;
    const double nu = sumNorm(u);
    const double nv = sumNorm(v);
    const double np = sumNorm(p.w);
    const double sign = current_.side > 0 ? -1 : 1;  // cross(u, v) = −cross(v − u, u)
    return sign * cross(u, v) > resolution_ * (nu + nv) && sign * cross(v, p.w) > resolution_ * (nv + np) &&
           sign * cross(p.w, u) > resolution_ * (np + nu);
}

GjkResult Gjk::finish(GjkOutcome outcome, int iterations) const {
    GjkResult r;
    r.outcome = outcome;
    r.count = current_.count;
    r.simplex[0] = current_.pairs[0];
    r.simplex[1] = current_.pairs[1];
    if (hasThird_) { r.simplex[static_cast<std::size_t>(r.count++)] = third_; }
    r.normal = normal_;
    r.distance = distance_;
    r.iterations = iterations;
    return r;
}

GjkResult Gjk::run(const SimplexCache* warm) {
    start(warm);
    for (int i = 1; i <= kMaxGjkIterations; ++i) {
        // The normal comes from the edge itself, not from the closest point, which is all rounding near a contact.
        const bool isSegment = current_.count == 2;
        const double scale = std::sqrt(isSegment ? current_.edgeSquared : current_.distanceSquared);
        distance_ = isSegment ? std::fabs(current_.side) / scale : scale;
        if (!(distance_ > resolution_)) { return finish(GjkOutcome::touching, i); }
        normal_ = (1 / scale) * (isSegment ? (current_.side > 0 ? leftPerp(current_.edge) : rightPerp(current_.edge))
                                           : current_.pairs[0].w);
        const SupportPair next = support(normal_);
        if (isKnown(next) || distance_ - dot(normal_, next.w) <= resolution_) { return finish(GjkOutcome::apart, i); }
        if (isSegment && enclosesOrigin(next)) {
            third_ = next;
            hasThird_ = true;
            return finish(GjkOutcome::touching, i);
        }
        Candidate best = segmentCandidate(pair_, current_.pairs[0], next);
        if (isSegment) { best = closer(best, segmentCandidate(pair_, next, current_.pairs[1])); }
        if (!(best.distanceSquared < current_.distanceSquared)) { return finish(GjkOutcome::stalled, i); }
        current_ = best;
    }
    return finish(GjkOutcome::stalled, kMaxGjkIterations);
}

/// Turns a candidate that is known to be the closest into a result.
GjkResult resultOf(const Candidate& c) {
    GjkResult r;
    r.outcome = GjkOutcome::apart;
    r.count = c.count;
    r.simplex[0] = c.pairs[0];
    r.simplex[1] = c.pairs[1];
    r.distance = std::sqrt(c.distanceSquared);
    const double scale = c.count == 2 ? std::sqrt(c.edgeSquared) : r.distance;
    if (!(r.distance > 0)) {
        r.outcome = GjkOutcome::touching;
        return r;
    }
    r.normal = (1 / scale) *
               (c.count == 2 ? (c.side > 0 ? leftPerp(c.edge) : rightPerp(c.edge)) : c.pairs[0].w);
    return r;
}

}  // namespace

GjkResult runGjk(const PairView& pair, const SimplexCache* warm) { return Gjk(pair).run(warm); }

GjkResult closestByExhaustion(const PairView& pair) {
    const auto at = [&pair](int i, int j) { return SupportPair{i, j, pair.vertexB(j) - pair.vertexA(i)}; };
    Candidate best = vertexCandidate(at(0, 0));
    for (int i = 0; i < pair.a.count; ++i) {
        for (int j = 0; j < pair.b.count; ++j) {
            best = closer(best, segmentCandidate(pair, at(i, j), at(i, pair.b.next(j))));
            best = closer(best, segmentCandidate(pair, at(i, j), at(pair.a.next(i), j)));
        }
    }
    return resultOf(best);
}

GjkResult closestFeatures(const PairView& pair, const SimplexCache* warm) {
    GjkResult r = runGjk(pair, warm);
    if (r.outcome != GjkOutcome::stalled) { return r; }
    const int iterations = r.iterations;
    if (coreAxis(pair).separation <= 0) {
        r.outcome = GjkOutcome::touching;
    } else {
        r = closestByExhaustion(pair);
    }
    r.iterations = iterations;
    return r;
}

CorePoints witnessOf(const PairView& pair, const GjkResult& r) {
    const SupportPair& p = r.simplex[0];
    const DVec2 gap = r.distance * r.normal;
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

}  // namespace swept::inline SWEPT_PRECISION
