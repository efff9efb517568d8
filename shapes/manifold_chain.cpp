#include <algorithm>
#include <cmath>

#include "manifold_clip_inline.h"
#include "manifold_parts.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

enum class CornerKind : std::uint8_t { open, convex, flatOrConcave };

/// One end of the segment, seen from its neighbour.
struct Corner {
    CornerKind kind = CornerKind::open;
    DVec2 neighbourNormal;  ///< unit; only of a convex one
};

Corner cornerBetween(bool exists, DVec2 firstEdge, DVec2 secondEdge, DVec2 neighbourEdge) {
    if (!exists || !(dot(neighbourEdge, neighbourEdge) >= std::numeric_limits<double>::min())) { return {}; }
    const double turn = cross(firstEdge, secondEdge);
    if (turn <= 0 || !(turn > kSeamAngle * length(firstEdge) * length(secondEdge))) {
        return {CornerKind::flatOrConcave, {}};
    }
    return {CornerKind::convex, unitOf(rightPerp(neighbourEdge))};
}

enum class NormalVerdict : std::uint8_t {
    own,       ///< the segment's own normal, or to be turned to it
    admitted,  ///< between the own normal and what the end leaves open
    refused,   ///< belongs to the neighbour, or comes from behind
};

/// A segment prepared for one query.
struct ChainFace {
    ReferenceFace face;
    Corner atStart;
    Corner atEnd;

    const Corner& cornerTowards(DVec2 normal) const { return dot(normal, face.tangent) < 0 ? atStart : atEnd; }

    /// @param normal  unit, from the segment to B.
    NormalVerdict judge(DVec2 normal) const {
        const double along = dot(normal, face.tangent);
        if (std::fabs(along) <= kSeamAngle && dot(normal, face.normal) > 0) { return NormalVerdict::own; }
        const Corner& corner = cornerTowards(normal);
        switch (corner.kind) {
            case CornerKind::open:  // solid all around: who leans over it touches it from behind
                return dot(normal, face.normal) >= 0 || std::fabs(along) > kSeamAngle ? NormalVerdict::admitted
                                                                                      : NormalVerdict::refused;
            case CornerKind::flatOrConcave:
                return NormalVerdict::own;
            case CornerKind::convex:
                break;
        }
        // The normals lie in the order: neighbour's at the start, own, neighbour's at the end, counter-clockwise.
        const double beyond = cross(normal, corner.neighbourNormal) * (along < 0 ? 1 : -1);
        return beyond <= kSeamAngle ? NormalVerdict::admitted : NormalVerdict::refused;
    }
};

/// What the neighbours are, of a segment whose face is there.
void addCorners(const PairView& pair, const ChainSegment& s, ChainFace& c) {
    const DVec2 edge = pair.edgeA(0);
    const DVec2 edgeBefore = toDouble(s.p) - toDouble(s.before);
    const DVec2 edgeAfter = toDouble(s.after) - toDouble(s.q);
    c.atStart = cornerBetween(s.hasBefore, edgeBefore, edge, edgeBefore);
    c.atEnd = cornerBetween(s.hasAfter, edge, edgeAfter, edgeAfter);
}

/// The vertex mean of B's core: inside it, and exactly the centre of boxes, segments and circles.
DVec2 centerOfB(const PairView& pair) {
    DVec2 sum;
    for (int i = 0; i < pair.b.count; ++i) { sum += pair.localB(i); }
    return pair.toA((1.0 / pair.b.count) * sum) + pair.translation;
}

Manifold clipOnSegment(const PairView& pair, const ChainFace& chain, double margin) {
    const IncidentEdge incident = incidentOfB(pair, chain.face.normal);
    // At a seam the neighbouring ranges overlap by the seam angle and rounding, so that nothing falls into a gap.
    const double startHeight = std::fabs(dot(chain.face.normal, incident.start - chain.face.start));
    const double endHeight = std::fabs(dot(chain.face.normal, incident.end - chain.face.start));
    const double rounding = kSeamRounding * (chain.face.length + sumNorm(incident.start));
    const double slack = kSeamAngle * (startHeight < endHeight ? startHeight : endHeight) + rounding;
    const ManifoldBuilder builder{static_cast<double>(pair.a.radius), static_cast<double>(pair.b.radius), margin, true,
                                  chain.face.normal};
    return builder.build(clip(chain.face, incident, slack));
}

Manifold clipOnFaceOfB(const PairView& pair, int edge, double margin) {
    const ReferenceFace face = faceOfB(pair, edge);
    IncidentEdge segment{pair.vertexA(0), pair.vertexA(1), 0, 0, 1, false};
    const ManifoldBuilder builder{static_cast<double>(pair.a.radius), static_cast<double>(pair.b.radius), margin, false,
                                  face.normal};
    return builder.build(clip(face, segment, 0));
}

/// The face of B along which it must be moved least, of those whose normal the corners admit; −1 when there is none
/// better than `toBeat`.
int bestAdmittedFace(const PairView& pair, const ChainFace& chain, double toBeat) {
    int best = -1;
    for (int i = 0; i < faceCount(pair.b); ++i) {
        const DVec2 normal = pair.normalB(i);
        if (chain.judge(-normal) != NormalVerdict::admitted) { continue; }
        const DVec2 start = pair.vertexB(i);
        const double p = dot(normal, pair.vertexA(0) - start);
        const double q = dot(normal, pair.vertexA(1) - start);
        const double separation = p < q ? p : q;
        if (separation > toBeat) {
            toBeat = separation;
            best = i;
        }
    }
    return best;
}

/// The core of B crosses the segment: pushed out along the segment's normal, or along an admitted face of B that is
/// shallower (B stands on a convex corner).
Manifold collideCrossing(const PairView& pair, const ChainFace& chain, double margin) {
    const int lowest = extremeVertex<-1>(pair.b, pair.toB(chain.face.normal));
    const double own = dot(chain.face.normal, pair.vertexB(lowest) - chain.face.start);
    const int faceB = bestAdmittedFace(pair, chain, own + kFacePreference * chain.face.length);
    if (faceB >= 0) {
        const Manifold manifold = clipOnFaceOfB(pair, faceB, margin);
        if (manifold.count > 0) { return manifold; }
    }
    return clipOnSegment(pair, chain, margin);
}

Manifold collideBeside(const PairView& pair, const ChainFace& chain, const GjkResult& gjk, double margin) {
    switch (chain.judge(gjk.normal)) {
        case NormalVerdict::own:
            return clipOnSegment(pair, chain, margin);
        case NormalVerdict::refused:
            return {};
        case NormalVerdict::admitted:
            break;
    }
    if (pair.b.count > 1) {
        const DVec2 direction = pair.toB(-gjk.normal);
        const int edge = edgeFacing(pair.b, direction);
        if (dot(pair.localNormalB(edge), direction) > 0 &&
            cross(pair.localNormalB(edge), direction) * cross(pair.localNormalB(edge), direction) <=
                static_cast<double>(kEpsilon)) {
            const Manifold manifold = clipOnFaceOfB(pair, edge, margin);
            if (manifold.count > 0) { return manifold; }
        }
    }
    return singlePoint(witnessOf(pair, gjk, gjk.distance * gjk.normal), gjk.distance, gjk.normal,
                       featureId({false, gjk.simplex[0].a}, {false, gjk.simplex[0].b}), pair.a, pair.b, margin);
}

/// Heights above a segment and ways along it, of the vertices of B's core: most of what is asked about a segment they
/// tell without a search, in a third of the instructions. What is not certain, up to all that rounding may have done,
/// they leave to the search; so every answer is the search's, bit for bit.
class CoreOverSegment {
public:
    /// @param lowest  vertex of B
    CoreOverSegment(const PairView& pair, const ReferenceFace& face, int lowest) : length_(face.length) {
        count_ = pair.b.count;
        double farthest = 0;
        for (int i = 0; i < count_; ++i) {
            const DVec2 v = pair.vertexB(i) - face.start;
            const double height = at(heights_, i) = dot(face.normal, v);
            const double along = at(alongs_, i) = dot(face.tangent, v);
            least_ = std::min(least_, height);
            first_ = std::min(first_, along);
            last_ = std::max(last_, along);
            farthest = std::max(farthest, std::fabs(height) + std::fabs(along));
        }
        foot_ = at(alongs_, lowest);
        size_ = length_ + sumNorm(face.start) + sumNorm(pair.translation) + farthest;
        doubt_ = kChainRoundings * kResolution * size_;
    }

    bool isAbove() const { return least_ > doubt_; }

    /// From the segment, at most. @pre above it
    double leastDistance() const {
        const double beside = std::max({first_ - length_, -last_, 0.0});
        return std::sqrt(least_ * least_ + beside * beside) - doubt_;
    }

    /// How far beyond an end a vertex may be at most, besides the seam angle, and still count as over the segment.
    double mostBeyond() const { return 2 * kSeamRounding * size_; }

    /// Whether the closest direction is that of the segment, or will be turned to it. @pre above it
    bool facesOwn(const ChainFace& chain) const {
        if (foot_ > doubt_ && foot_ < length_ - doubt_) { return true; }
        const bool isTurnedAtStart = first_ > doubt_ || chain.atStart.kind == CornerKind::flatOrConcave;
        return isTurnedAtStart && (last_ < length_ - doubt_ || chain.atEnd.kind == CornerKind::flatOrConcave);
    }

    /// Whether some of it lies on either side, and some on the segment.
    bool crosses() const {
        double first = std::numeric_limits<double>::infinity();
        double last = -first;
        for (int i = 0; i < count_; ++i) {
            const int next = i + 1 < count_ ? i + 1 : 0;
            const double height = at(heights_, i);
            const double fall = height - at(heights_, next);
            const bool fallsThrough = height > doubt_ && at(heights_, next) < -doubt_;
            const bool risesThrough = height < -doubt_ && at(heights_, next) > doubt_;
            if (!fallsThrough && !risesThrough) { continue; }
            const double way = at(alongs_, next) - at(alongs_, i);
            const double along = at(alongs_, i) + height / fall * way;
            const double doubt = doubt_ * (1 + std::fabs(way / fall));
            first = std::min(first, along + doubt);
            last = std::max(last, along - doubt);
        }
        return last > doubt_ && first < length_ - doubt_;
    }

private:
    using Numbers = std::array<double, kMaxPolygonVertices>;
    static double& at(Numbers& numbers, int i) { return numbers[static_cast<std::size_t>(i)]; }
    static double at(const Numbers& numbers, int i) { return numbers[static_cast<std::size_t>(i)]; }

    Numbers heights_;
    Numbers alongs_;
    int count_ = 0;
    double length_;
    double size_ = 0;  ///< sum of all coordinates' magnitudes; at least half that of a vertex in the frame of A
    double least_ = std::numeric_limits<double>::infinity();
    double first_ = std::numeric_limits<double>::infinity();
    double last_ = -std::numeric_limits<double>::infinity();
    double foot_ = 0;   ///< along the segment, of the lowest vertex
    double doubt_ = 0;  ///< what rounding may make of any of these, and of the search; metres
};

/// Whether the points are near enough for the search to have found the distance within reach: a vertex that counts as
/// over the segment, though it is beyond its end by the seam angle and rounding, is a little farther away.
bool isSurelyWithin(const Manifold& manifold, const CoreOverSegment& core, double radii, double reach) {
    if (manifold.count == 0) { return true; }
    return static_cast<double>(deepestSeparation(manifold)) + radii + core.mostBeyond() <= kSurePart * reach;
}

/// @tparam kSearches  always
template <bool kSearches>
Manifold collideChain(const ChainSegment& segment, const PairView& pair, double margin, PairVerdict& verdict) {
    ChainFace chain;
    chain.face = faceOfA(pair, 0);
    if (dot(chain.face.normal, centerOfB(pair) - chain.face.start) < 0) { return {}; }
    const double radii = static_cast<double>(pair.a.radius) + static_cast<double>(pair.b.radius);
    const double reach = margin + radii;
    // Most that is not in contact lies above the segment, which a dot product for each vertex tells.
    const int lowest = extremeVertex<-1>(pair.b, pair.toB(chain.face.normal));
    const double above = dot(chain.face.normal, pair.vertexB(lowest) - chain.face.start);
    const auto apart = [&verdict, radii](double distance) -> Manifold {
        verdict.verdict = ManifoldMemory::Verdict::apart;
        verdict.room = distance - radii;
        return {};
    };
    if (above > reach) { return apart(above); }
    if constexpr (kSearches) {
        addCorners(pair, segment, chain);
    } else {
        const CoreOverSegment core(pair, chain.face, lowest);
        if (core.isAbove() && core.leastDistance() > reach) { return apart(core.leastDistance()); }
        addCorners(pair, segment, chain);
        if (core.isAbove() && core.facesOwn(chain)) {
            const Manifold manifold = clipOnSegment(pair, chain, margin);
            if (isSurelyWithin(manifold, core, radii, reach)) { return manifold; }
        }
        if (core.crosses()) { return collideCrossing(pair, chain, margin); }
    }
    const GjkResult gjk = closestFeatures(pair, nullptr);
    if (gjk.outcome != GjkOutcome::touching && gjk.distance > reach) { return apart(gjk.distance); }
    if (gjk.outcome == GjkOutcome::touching) { return collideCrossing(pair, chain, margin); }
    return collideBeside(pair, chain, gjk, margin);
}

bool isClosed(const Corner& corner) { return corner.kind == CornerKind::flatOrConcave; }

}  // namespace

ClosedEnds closedEndsOf(const ChainSegment& segment) {
    const Polygon core = polygonOf(segment);
    ChainFace face;
    addCorners(PairView(core, core, {}), segment, face);
    return {isClosed(face.atStart), isClosed(face.atEnd)};
}

Vec2 outwardNormal(const ChainSegment& segment, Vec2 normal) {
    const Polygon core = polygonOf(segment);
    const PairView pair(core, core, {});
    ChainFace chain;
    chain.face = faceOfA(pair, 0);
    addCorners(pair, segment, chain);
    const DVec2 wanted = toDouble(normal);
    if (!(dot(wanted, chain.face.normal) >= 0)) { return normalOf(segment); }
    const NormalVerdict verdict = chain.judge(wanted);
    if (verdict == NormalVerdict::admitted) { return normal; }
    const Corner& corner = chain.cornerTowards(wanted);
    const bool isNeighbours = verdict == NormalVerdict::refused && corner.kind == CornerKind::convex;
    return isNeighbours ? toReal(corner.neighbourNormal) : normalOf(segment);
}

Manifold collideChainBySearch(const ChainSegment& a, const Polygon& b, const Transform& bInA, Real margin) {
    PairVerdict verdict;
    const Polygon core = polygonOf(a);
    return collideChain<true>(a, PairView(core, b, bInA), static_cast<double>(margin), verdict);
}

Manifold collide(const ChainSegment& a, const Polygon& b, const Transform& bInA, Real margin) {
    ManifoldMemory memory;
    return collide(a, b, bInA, margin, memory);
}

Manifold collide(const ChainSegment& a, const Polygon& b, const Transform& bInA, Real margin, ManifoldMemory& memory) {
    if (memory.isApart(bInA, margin)) { return {}; }
    return collide(a, polygonOf(a), b, bInA, margin, memory);
}

Manifold collide(const ChainSegment& a, const Polygon& core, const Polygon& b, const Transform& bInA, Real margin,
                 ManifoldMemory& memory) {
    if (memory.isApart(bInA, margin)) { return {}; }
    PairVerdict verdict;
    const RescaledPair scaled(core, b, bInA, {a.before, a.after});
    if (!scaled.isNeeded()) {
        const Manifold manifold = collideChain<false>(a, PairView(core, b, bInA), static_cast<double>(margin), verdict);
        remember(memory, verdict, core, b, bInA);
        return manifold;
    }
    memory.verdict = ManifoldMemory::Verdict::none;  // rare enough not to remember anything
    ChainSegment segment = a;
    for (Vec2* v : {&segment.before, &segment.p, &segment.q, &segment.after}) { *v = scaled.scaled(*v); }
    Polygon scaledA = scaled.a();
    Polygon scaledB = scaled.b();
    scaledA.radius = scaled.scaled(a.radius);
    scaledB.radius = scaled.scaled(b.radius);
    const PairView pair(scaledA, scaledB, scaled.bInA());
    return restored(scaled, collideChain<false>(segment, pair, static_cast<double>(scaled.scaled(margin)), verdict));
}

}  // namespace swept::inline SWEPT_PRECISION
