#include "gjk.h"
#include "manifold.h"
#include "manifold_clip_inline.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Sine of the angle up to which a corner counts as flat and a direction as the segment's own normal. The separation
/// along the normal then differs from the distance by 2⁻²¹ of it.
constexpr double kSeamAngle = 0x1p-10;

/// As in manifold.cpp: the segment's own face wins against a face of B that is better by less.
constexpr double kFacePreference = 0x1p-10;

enum class CornerKind : std::uint8_t { open, convex, flatOrConcave };

/// One end of the segment, seen from its neighbour.
struct Corner {
    CornerKind kind = CornerKind::open;
    DVec2 neighbourNormal;  ///< unit; only when there is a neighbour
};

Corner cornerBetween(bool exists, DVec2 firstEdge, DVec2 secondEdge, DVec2 neighbourEdge) {
    if (!exists || !(dot(neighbourEdge, neighbourEdge) >= std::numeric_limits<double>::min())) { return {}; }
    const double turn = cross(firstEdge, secondEdge);
    const bool isConvex = turn > kSeamAngle * length(firstEdge) * length(secondEdge);
    return {isConvex ? CornerKind::convex : CornerKind::flatOrConcave, unitOf(rightPerp(neighbourEdge))};
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

    /// @param normal  unit, from the segment to B.
    NormalVerdict judge(DVec2 normal) const {
        const double along = dot(normal, face.tangent);
        if (std::fabs(along) <= kSeamAngle && dot(normal, face.normal) > 0) { return NormalVerdict::own; }
        const Corner& corner = along < 0 ? atStart : atEnd;
        switch (corner.kind) {
            case CornerKind::open:
                return dot(normal, face.normal) >= 0 ? NormalVerdict::admitted : NormalVerdict::refused;
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
    const double rounding = 4 * static_cast<double>(kEpsilon) * (chain.face.length + sumNorm(incident.start));
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

Manifold collideChain(const ChainSegment& segment, const PairView& pair, double margin, PairVerdict& verdict) {
    ChainFace chain;
    chain.face = faceOfA(pair, 0);
    if (dot(chain.face.normal, centerOfB(pair) - chain.face.start) < 0) { return {}; }
    const double radii = static_cast<double>(pair.a.radius) + static_cast<double>(pair.b.radius);
    const double reach = margin + radii;
    // Most that is not in contact lies above the segment, which a dot product for each vertex tells.
    const int lowest = extremeVertex<-1>(pair.b, pair.toB(chain.face.normal));
    const double above = dot(chain.face.normal, pair.vertexB(lowest) - chain.face.start);
    if (above > reach) {
        verdict.verdict = ManifoldMemory::Verdict::apart;
        verdict.room = above - radii;
        return {};
    }
    const GjkResult gjk = closestFeatures(pair, nullptr);
    if (gjk.outcome != GjkOutcome::touching && gjk.distance > reach) {
        verdict.verdict = ManifoldMemory::Verdict::apart;
        verdict.room = gjk.distance - radii;
        return {};
    }
    addCorners(pair, segment, chain);
    if (gjk.outcome == GjkOutcome::touching) { return collideCrossing(pair, chain, margin); }
    return collideBeside(pair, chain, gjk, margin);
}

}  // namespace

Manifold collide(const ChainSegment& a, const Polygon& b, const Transform& bInA, Real margin) {
    ManifoldMemory memory;
    return collide(a, b, bInA, margin, memory);
}

Manifold collide(const ChainSegment& a, const Polygon& b, const Transform& bInA, Real margin, ManifoldMemory& memory) {
    if (memory.isApart(bInA, margin)) { return {}; }
    PairVerdict verdict;
    const Polygon core = polygonOf(a);
    const RescaledPair scaled(core, b, bInA, {a.before, a.after});
    if (!scaled.isNeeded()) {
        const Manifold manifold = collideChain(a, PairView(core, b, bInA), static_cast<double>(margin), verdict);
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
    return restored(scaled, collideChain(segment, pair, static_cast<double>(scaled.scaled(margin)), verdict));
}

}  // namespace swept::inline SWEPT_PRECISION
