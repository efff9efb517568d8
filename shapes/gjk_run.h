#pragma once

#include "compiler.h"
#include "gjk.h"
#include "gjk_facing.h"

/// GJK as inline code, for the places that must not pay for calls: `distance` and the time of impact.
///
/// The fast path is a walk over features. The support points of a new direction are mostly those of the last one or
/// their neighbours, and a vertex of a convex polygon that lies beyond both its neighbours is the support point. So
/// each step looks at neighbours only, and the last one proves the answer by them: what verifies a warm start is the
/// same step. What the walk cannot prove it leaves to the loop over simplices.
///
/// Measured by swept_bench_kernels on mixed pairs, in double: the loop alone takes 132 ns cold and 82 warm, the walk 66
/// cold and 30 warm. What made the difference: proofs by neighbours instead of whole support searches; the large locals
/// of the loop out of the way, in functions of their own (an eighth of a warm query); a start without branches (a
/// quarter of a cold one); choices by arithmetic (a fifth of a warm one). Two circles skip the search for a start: it
/// took them longer than the rest. Inlined by force: the pieces hand small structs to each other, which cost more
/// through memory than their arithmetic does.

namespace swept::inline SWEPT_PRECISION::gjk {

/// The loop over simplices, for what the walk does not prove: cores that overlap or touch, coordinates beyond range.
void runLoop(const PairView& pair, const SimplexCache* warm, GjkResult& r);

/// The closest features as far as the walk knows: vertices `a` and `b`, or the edge that begins at one of them and the
/// other vertex. Never two edges: where these are parallel, an end of one is as close.
struct Features {
    enum class Kind : std::uint8_t { vertices, edgeOfA, edgeOfB };
    Kind kind;
    int a;
    int b;
    int from = -1;  ///< the vertex that was held against the same edge in the last step, if any
};

enum class WalkStep : std::uint8_t { proved, moved, lost };

// Choices that depend on the data alone are made by arithmetic: as branches, one in two was mispredicted.
SWEPT_FORCE_INLINE int choose(bool first, int a, int b) { return b ^ ((a ^ b) & -static_cast<int>(first)); }
SWEPT_FORCE_INLINE int nextOf(const Polygon& p, int i) { return (i + 1) & -static_cast<int>(i + 1 < p.count); }
SWEPT_FORCE_INLINE int previousOf(const Polygon& p, int i) { return i - 1 + (p.count & -static_cast<int>(i == 0)); }
SWEPT_FORCE_INLINE double larger(double a, double b) { return a > b ? a : b; }

/// The two neighbours of a vertex along a direction (in its polygon's frame), relative to it and times the length of
/// the direction.
struct Neighbours {
    double next;
    double previous;

    double highest() const { return larger(next, previous); }
    bool isNextHigher() const { return next > previous; }
};

SWEPT_FORCE_INLINE Neighbours neighboursAlong(const Polygon& p, int i, DVec2 vertex, DVec2 direction) {
    const DVec2 next = toDouble(p.vertices[static_cast<std::size_t>(nextOf(p, i))]) - vertex;
    const DVec2 previous = toDouble(p.vertices[static_cast<std::size_t>(previousOf(p, i))]) - vertex;
    return {dot(direction, next), dot(direction, previous)};
}

/// Not above 0 where a vertex is the farthest of its polygon: both neighbours lie below. A convex corner leaves no room
/// beyond them, unless it is so flat that rounding could turn the polygon over: then both seem level with it.
/// @param level  what rounding may make of a level neighbour.
SWEPT_FORCE_INLINE double doubtOf(const Polygon& p, const Neighbours& n, double level) {
    constexpr std::array<double, 2> kFlat = {0, 1};  // points and segments have no inside to turn over
    const double flat = level * kFlat[static_cast<std::size_t>(p.count > 2)];
    return larger(n.highest(), n.next + n.previous + flat);
}

/// Twice the rounding of a neighbour's height, or more: two rotated vertices, their difference and its product.
SWEPT_FORCE_INLINE double levelAlong(DVec2 direction, double resolution) { return 4 * resolution * sumNorm(direction); }

/// What the coordinates of two vertices resolve of their difference.
SWEPT_FORCE_INLINE double resolutionOf(const PairView& pair, DVec2 a, DVec2 turnedB) {
    return kResolution * (sumNorm(a) + sumNorm(turnedB) + sumNorm(pair.translation));
}

/// Two circles: nothing to search.
SWEPT_FORCE_INLINE bool arePoints(const PairView& pair) { return pair.a.count + pair.b.count == 2; }

/// Proves that the vertices are closest, or moves to the edge that promises most.
SWEPT_FORCE_INLINE WalkStep tryVertices(const PairView& pair, Features& f, GjkResult& r) {
    const DVec2 a = pair.vertexA(f.a);
    const DVec2 localB = pair.localB(f.b);
    const DVec2 turnedB = pair.toA(localB);
    const DVec2 w = (turnedB + pair.translation) - a;
    const double resolution = resolutionOf(pair, a, turnedB);
    const auto prove = [&] {
        const double squared = dot(w, w);
        if (!(squared > resolution * resolution)) { return WalkStep::lost; }
        r.count = 1;
        r.simplex[0] = {f.a, f.b};
        r.distance = std::sqrt(squared);
        r.normal = (1 / r.distance) * w;
        r.resolution = resolution;
        r.points = {a, a + w};
        return WalkStep::proved;
    };
    if (arePoints(pair)) { return prove(); }
    const Neighbours ofA = neighboursAlong(pair.a, f.a, a, w);
    const Neighbours ofB = neighboursAlong(pair.b, f.b, localB, -pair.toB(w));
    const double level = levelAlong(w, resolution);
    const double doubt = larger(doubtOf(pair.a, ofA, level), doubtOf(pair.b, ofB, level));
    const double sum = ofA.next + ofA.previous + ofB.next + ofB.previous;  // not a number, where any is not
    if (doubt <= 0 && sum <= 0) { return prove(); }
    if (ofA.highest() > ofB.highest()) {
        f.kind = Features::Kind::edgeOfA;
        f.a = choose(ofA.isNextHigher(), f.a, previousOf(pair.a, f.a));
        return ofA.highest() > 0 ? WalkStep::moved : WalkStep::lost;
    }
    f.kind = Features::Kind::edgeOfB;
    f.b = choose(ofB.isNextHigher(), f.b, previousOf(pair.b, f.b));
    return ofB.highest() > 0 ? WalkStep::moved : WalkStep::lost;
}

/// Where a walk goes from beyond the end of an edge: to the other shape's edge that led there, or to the two vertices.
SWEPT_FORCE_INLINE void leaveEdge(const Polygon& other, Features& f, int& vertex, Features::Kind edgeOfOther) {
    f.kind = f.from < 0 ? Features::Kind::vertices : edgeOfOther;
    vertex = f.from >= 0 && other.next(f.from) == vertex ? f.from : vertex;
    f.from = -1;
}

/// Proves that an edge and a vertex are closest, or moves on. Everything in the frame of A.
template <bool ofA>
SWEPT_FORCE_INLINE WalkStep tryEdge(const PairView& pair, Features& f, GjkResult& r) {
    const int begin = ofA ? f.a : f.b;
    const int end = ofA ? nextOf(pair.a, begin) : nextOf(pair.b, begin);
    const DVec2 a = pair.vertexA(f.a);
    const DVec2 localB = pair.localB(f.b);
    const DVec2 turnedB = pair.toA(localB);
    const DVec2 b = turnedB + pair.translation;
    const DVec2 toVertex = ofA ? b - a : a - b;
    const DVec2 edge = ofA ? pair.spanA(begin, end) : pair.spanB(begin, end);
    const double edgeSquared = dot(edge, edge);
    const double along = dot(edge, toVertex);
    const Polygon& other = ofA ? pair.b : pair.a;
    if (!(along >= 0 && along <= edgeSquared)) {
        (ofA ? f.a : f.b) = along < 0 ? begin : end;
        leaveEdge(other, f, ofA ? f.b : f.a, ofA ? Features::Kind::edgeOfB : Features::Kind::edgeOfA);
        return WalkStep::moved;
    }
    // A segment faces both ways: its second edge is the first one backwards.
    const double sideOfEdge = cross(toVertex, edge);
    const bool isSegment = (ofA ? pair.a.count : pair.b.count) == 2;
    const bool isBackwards = (static_cast<int>(isSegment) & static_cast<int>(sideOfEdge < 0)) != 0;
    constexpr std::array<double, 2> kSign = {1, -1};
    const double sign = kSign[static_cast<std::size_t>(isBackwards)];
    const double side = sign * sideOfEdge;
    const DVec2 outward = sign * rightPerp(edge);
    const double resolution = resolutionOf(pair, a, turnedB);
    if (!(side > 0 && side * side > resolution * resolution * edgeSquared)) { return WalkStep::lost; }
    const Neighbours n =
        ofA ? neighboursAlong(other, f.b, localB, -pair.toB(outward)) : neighboursAlong(other, f.a, a, -outward);
    if (!(doubtOf(other, n, levelAlong(outward, resolution)) <= 0 && n.next + n.previous <= 0)) {
        int& vertex = ofA ? f.b : f.a;
        f.from = vertex;
        vertex = choose(n.isNextHigher(), nextOf(other, vertex), previousOf(other, vertex));
        return n.highest() > 0 ? WalkStep::moved : WalkStep::lost;
    }
    const double inverse = 1 / std::sqrt(edgeSquared);
    r.count = 2;
    const int first = choose(isBackwards, end, begin);
    const int second = begin ^ end ^ first;
    r.simplex[0] = {ofA ? first : f.a, ofA ? f.b : first};
    r.simplex[1] = {ofA ? second : f.a, ofA ? f.b : second};
    r.distance = inverse * side;
    r.normal = (ofA ? inverse : -inverse) * outward;
    r.resolution = resolution;
    const DVec2 gap = r.distance * r.normal;
    r.points.a = ofA ? b - gap : a;
    r.points.b = ofA ? b : a + gap;
    return WalkStep::proved;
}

/// Where a walk begins: at the features of the last one, or at the vertices that face each other. Edges are cached as a
/// walk leaves them, in the order of the polygon; others it finds again from their first ends.
SWEPT_FORCE_INLINE Features start(const PairView& pair, const SimplexCache* warm) {
    if (warm == nullptr || warm->count == 0 || warm->indexA[0] >= pair.a.count || warm->indexB[0] >= pair.b.count) {
        if (arePoints(pair)) { return {Features::Kind::vertices, 0, 0}; }
        const DVec2 towardsA = -pair.toB(pair.translation);
        return {Features::Kind::vertices, FacingVertex::along(pair.a, toReal(pair.translation)),
                FacingVertex::along(pair.b, toReal(towardsA))};
    }
    Features f{Features::Kind::vertices, warm->indexA[0], warm->indexB[0]};
    if (warm->count != 2) { return f; }
    const int a = warm->indexA[1];
    const int b = warm->indexB[1];
    if (b == f.b && a == pair.a.next(f.a) && a != f.a) { f.kind = Features::Kind::edgeOfA; }
    if (a == f.a && b == pair.b.next(f.b) && b != f.b) { f.kind = Features::Kind::edgeOfB; }
    return f;
}

/// Steps after which the walk gives up; most take one or two.
inline constexpr int kMaxWalk = 8;

SWEPT_FORCE_INLINE bool walk(const PairView& pair, Features f, GjkResult& r) {
    for (int i = 1; i <= kMaxWalk; ++i) {
        WalkStep step = WalkStep::lost;
        switch (f.kind) {
            case Features::Kind::vertices:
                step = tryVertices(pair, f, r);
                break;
            case Features::Kind::edgeOfA:
                step = tryEdge<true>(pair, f, r);
                break;
            case Features::Kind::edgeOfB:
                step = tryEdge<false>(pair, f, r);
                break;
        }
        r.iterations = i;
        if (step != WalkStep::moved) { return step == WalkStep::proved; }
    }
    return false;
}

/// One run; see `runGjk`. Sets all of `r` that its outcome promises.
/// @param begin  from `start`, with the same cache.
SWEPT_FORCE_INLINE void runFrom(const PairView& pair, const Features& begin, const SimplexCache* warm, GjkResult& r) {
    if (walk(pair, begin, r)) {
        r.encloses = false;
        r.outcome = GjkOutcome::apart;
    } else {
        runLoop(pair, warm, r);
    }
}
SWEPT_FORCE_INLINE void run(const PairView& pair, const SimplexCache* warm, GjkResult& r) {
    runFrom(pair, start(pair, warm), warm, r);
}

}  // namespace swept::inline SWEPT_PRECISION::gjk
