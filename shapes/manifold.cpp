#include "manifold.h"

#include <algorithm>
#include <cmath>

#include "manifold_clip_inline.h"
#include "manifold_parts.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

ManifoldBuilder builderFor(const PairView& pair, double margin, bool referenceIsA, DVec2 normal) {
    return {static_cast<double>(pair.a.radius), static_cast<double>(pair.b.radius), margin, referenceIsA, normal};
}

/// The least that a vertex may stick out by: an edge that stands upright on the end of the face lies over it or not by
/// rounding alone, and where such an edge is cut is anywhere on it.
double roundingOf(const ReferenceFace& face, const IncidentEdge& edge) {
    return 4 * kResolution * (face.length + sumNorm(face.start) + sumNorm(edge.start) + sumNorm(edge.end));
}

Manifold clipAgainst(const PairView& pair, const ReferenceFace& face, const IncidentEdge& edge, double margin,
                     bool isOfA, double slack) {
    const double least = slack > 0 ? slack : roundingOf(face, edge);
    return builderFor(pair, margin, isOfA, face.normal).build(clip(face, edge, least));
}

}  // namespace

Manifold clipAgainstA(const PairView& pair, int edge, double margin, double slack) {
    const ReferenceFace face = faceOfA(pair, edge);
    return clipAgainst(pair, face, incidentOfB(pair, face.normal), margin, true, slack);
}

Manifold clipAgainstB(const PairView& pair, int edge, double margin, double slack) {
    const ReferenceFace face = faceOfB(pair, edge);
    return clipAgainst(pair, face, incidentOfA(pair, face.normal), margin, false, slack);
}

namespace {

FeatureId vertexPair(const GjkResult& gjk) { return featureId({false, gjk.simplex[0].a}, {false, gjk.simplex[0].b}); }

/// Cores that overlap or touch, without a face to clip against: points, ends of segments, or a preferred face that is
/// not under the other shape.
Manifold collideWithoutFace(const PairView& pair, const GjkResult& gjk, double margin) {
    const CoreSeparation core = coreSeparation(pair, gjk);
    return singlePoint(core.points, core.separation, core.normal, vertexPair(gjk), pair.a, pair.b, margin);
}

/// How long the choice of a face lasts, once cores overlap: until the preference changes, or until the cores come
/// apart. Separations along faces change by the motion at most, their differences by twice as much.
double choiceRoomOf(const PairView& pair, const FaceAxis& faceA, const FaceAxis& faceB) {
    const DVec2 edgeA = pair.edgeA(faceA.face);
    const DVec2 edgeB = pair.edgeB(faceB.face);
    const double shorter = std::sqrt(std::min(dot(edgeA, edgeA), dot(edgeB, edgeB)));
    const double beyond = std::fabs(faceB.separation - faceA.separation - kFacePreference * shorter);
    return std::min(0.5 * beyond, -std::max(faceA.separation, faceB.separation));
}

/// Cores that overlap or touch: clip against the face of least penetration.
Manifold collideTouching(const PairView& pair, const GjkResult& gjk, double margin, PairVerdict& verdict) {
    const BestFaces faces = bestFaces(pair);
    const CoreAxis axis = coreAxis(pair, faces, kFacePreference);
    Manifold manifold;
    switch (axis.source) {
        case AxisSource::faceOfA:
            manifold = clipAgainstA(pair, axis.face, margin, 0);
            break;
        case AxisSource::faceOfB:
            manifold = clipAgainstB(pair, axis.face, margin, 0);
            break;
        case AxisSource::direction:
            break;
    }
    if (manifold.count == 0) { return collideWithoutFace(pair, gjk, margin); }
    const bool haveArea = pair.a.count > 2 || pair.b.count > 2;  // of the Minkowski difference: faces alone decide
    if (haveArea && faces.ofA.face >= 0 && faces.ofB.face >= 0) {
        verdict.verdict = ManifoldMemory::Verdict::face;
        verdict.face = axis.face;
        verdict.isOfA = axis.source == AxisSource::faceOfA;
        verdict.room =
            std::min(choiceRoomOf(pair, faces.ofA, faces.ofB), 0.5 * std::min(faces.ofA.lead, faces.ofB.lead));
    }
    return manifold;
}

bool isFaceNormal(DVec2 faceNormal, DVec2 direction) {
    const double sine = cross(faceNormal, direction);
    return std::fabs(sine) <= kFaceAngle && dot(faceNormal, direction) > 0;
}

/// The edge on which the simplex lies, else the one that faces the direction most.
int closestEdge(const Polygon& polygon, int first, int second, DVec2 direction) {
    if (polygon.count > 2 && first != second) {
        if (polygon.next(first) == second) { return first; }
        if (polygon.next(second) == first) { return second; }
    }
    return edgeFacing(polygon, direction);
}

bool isAsDeepAs(const Manifold& manifold, double separation) {
    for (std::size_t i = 0; i < static_cast<std::size_t>(manifold.count); ++i) {
        if (static_cast<double>(manifold.points[i].separation) <= separation) { return true; }
    }
    return false;
}

/// The end of an edge that is not `vertex`; the edge is that of the polygon whose normal is closest to `direction`.
struct EdgeEnd {
    bool isFlat = false;  ///< the edge lies across the direction within `kFlatCosine`, and begins or ends at the vertex
    int vertex = 0;
};

/// @param edge  that which faces the direction
EdgeEnd otherEnd(const Polygon& polygon, DVec2 direction, int vertex, int edge) {
    const int next = polygon.next(edge);
    const bool isFlat = dot(toDouble(polygon.normals[static_cast<std::size_t>(edge)]), direction) >= kFlatCosine;
    return {isFlat && (edge == vertex || next == vertex), edge == vertex ? next : edge};
}

/// Of each shape, that whose normal is closest to the direction of the other.
struct FacingEdges {
    int ofA = 0;
    int ofB = 0;
};

/// Two vertices are closest, but edges that lie nearly across the normal begin there and run side by side: where the
/// shorter one ends is a second point. Without it a rounded box that hangs over another by a hair would rest on one
/// point.
void addSecondPoint(const PairView& pair, const GjkResult& gjk, FacingEdges facing, double margin, Manifold& manifold) {
    const int vertexA = gjk.simplex[0].a;
    const int vertexB = gjk.simplex[0].b;
    const EdgeEnd endA = otherEnd(pair.a, gjk.normal, vertexA, facing.ofA);
    const EdgeEnd endB = otherEnd(pair.b, pair.toB(-gjk.normal), vertexB, facing.ofB);
    if (!endA.isFlat || !endB.isFlat) { return; }
    const DVec2 edgeA = pair.spanA(vertexA, endA.vertex);
    const DVec2 edgeB = pair.spanB(vertexB, endB.vertex);
    const DVec2 tangent = leftPerp(gjk.normal);
    const double alongA = dot(tangent, edgeA);
    const double alongB = dot(tangent, edgeB);
    if (!(alongA * alongB > 0)) { return; }
    const bool endsA = std::fabs(alongA) <= std::fabs(alongB);
    const DVec2 onA = pair.vertexA(vertexA) + (endsA ? 1 : alongB / alongA) * edgeA;
    const DVec2 onB = pair.vertexB(vertexB) + (endsA ? alongA / alongB : 1) * edgeB;
    const double gap = dot(gjk.normal, onB - onA);
    const double radiusA = static_cast<double>(pair.a.radius);
    const double radiusB = static_cast<double>(pair.b.radius);
    if (gap - radiusA - radiusB > margin) { return; }
    ManifoldPoint& point = manifold.points[static_cast<std::size_t>(manifold.count++)];
    point.point = clampedReal(onA + (0.5 * (gap + radiusA - radiusB)) * gjk.normal);
    point.separation = clampedReal(gap - radiusA - radiusB);
    point.id = featureId({false, endsA ? endA.vertex : vertexA}, {false, endsA ? vertexB : endB.vertex});
}

/// Cores that are apart: clip where the closest direction is a face's normal, else one point between the vertices.
Manifold collideApart(const PairView& pair, const GjkResult& gjk, double margin) {
    const double slack = 2 * kFaceAngle * gjk.distance;
    const SupportPair& p = gjk.simplex[0];
    const SupportPair& q = gjk.simplex[static_cast<std::size_t>(gjk.count - 1)];
    // Of several nearly parallel faces only the one under the closest point will do: one as deep as the distance, up to
    // the rounding of `Real`, and of heights above a face that begins far away.
    const double rounding = gjk.resolution * (2 * static_cast<double>(kEpsilon) / kResolution);
    const auto limit = [&](DVec2 edge) {
        constexpr double kRoundings = 4;
        return gjk.distance - static_cast<double>(pair.a.radius) - static_cast<double>(pair.b.radius) + 2 * rounding +
               kRoundings * kResolution * sumNorm(edge);
    };
    int edgeA = 0;
    int edgeB = 0;
    if (pair.a.count > 1) {
        edgeA = closestEdge(pair.a, p.a, q.a, gjk.normal);
        if (isFaceNormal(pair.normalA(edgeA), gjk.normal)) {
            const Manifold manifold = clipAgainstA(pair, edgeA, margin, slack);
            if (isAsDeepAs(manifold, limit(pair.edgeA(edgeA)))) { return manifold; }
        }
    }
    if (pair.b.count > 1) {
        const DVec2 direction = pair.toB(-gjk.normal);
        edgeB = closestEdge(pair.b, p.b, q.b, direction);
        if (isFaceNormal(pair.localNormalB(edgeB), direction)) {
            const Manifold manifold = clipAgainstB(pair, edgeB, margin, slack);
            if (isAsDeepAs(manifold, limit(pair.edgeB(edgeB)))) { return manifold; }
        }
    }
    Manifold manifold = singlePoint(witnessOf(pair, gjk, gjk.distance * gjk.normal), gjk.distance, gjk.normal,
                                    vertexPair(gjk), pair.a, pair.b, margin);
    const bool areVertices = gjk.count == 1 && pair.a.count > 1 && pair.b.count > 1;
    if (areVertices && manifold.count == 1) { addSecondPoint(pair, gjk, {edgeA, edgeB}, margin, manifold); }
    return manifold;
}

}  // namespace

Manifold collideByGjk(const PairView& pair, Margins margins, const SimplexCache* warm, PairVerdict& verdict) {
    const GjkResult gjk = closestFeatures(pair, warm);
    if (gjk.outcome == GjkOutcome::touching) { return collideTouching(pair, gjk, margins.points, verdict); }
    const double radii = static_cast<double>(pair.a.radius) + static_cast<double>(pair.b.radius);
    if (gjk.distance > margins.nearest + radii) {
        verdict.verdict = ManifoldMemory::Verdict::apart;
        verdict.room = gjk.distance - radii;
        return {};
    }
    return collideApart(pair, gjk, margins.points);
}

namespace {

bool areSharp(const PairView& pair) {
    return pair.a.count > 2 && pair.b.count > 2 && !(pair.a.radius > 0) && !(pair.b.radius > 0);
}

Manifold collideCores(const PairView& pair, Margins margins, PairVerdict& verdict) {
    return areSharp(pair) ? collideSharp(pair, margins, verdict) : collideByGjk(pair, margins, nullptr, verdict);
}

Manifold clipAgainstKnown(const PairView& pair, const ManifoldMemory& memory, double margin) {
    if (areSharp(pair)) { return collideOnSharpFace(pair, memory.face, memory.isOfA, margin); }
    return memory.isOfA ? clipAgainstA(pair, memory.face, margin, 0) : clipAgainstB(pair, memory.face, margin, 0);
}

/// `query(pair, margin)` on the pair at a scale at which its numbers neither overflow nor underflow.
template <class Query>
Manifold atSafeScale(const Polygon& a, const Polygon& b, const Transform& bInA, Real margin, const Query& query) {
    const RescaledPair scaled(a, b, bInA);
    if (!scaled.isNeeded()) { return query(PairView(a, b, bInA), static_cast<double>(margin)); }
    Polygon scaledA = scaled.a();
    Polygon scaledB = scaled.b();
    scaledA.radius = scaled.scaled(a.radius);
    scaledB.radius = scaled.scaled(b.radius);
    const PairView pair(scaledA, scaledB, scaled.bInA());
    return restored(scaled, query(pair, static_cast<double>(scaled.scaled(margin))));
}

}  // namespace

Manifold collide(const Polygon& a, const Polygon& b, const Transform& bInA, Real margin) {
    PairVerdict verdict;
    return atSafeScale(a, b, bInA, margin, [&verdict](const PairView& pair, double reach) {
        return collideCores(pair, {reach, reach}, verdict);
    });
}

Manifold collide(const Polygon& a, const Polygon& b, const Transform& bInA, Real margin, ManifoldMemory& memory) {
    return collide(a, b, bInA, {margin, margin}, memory);
}

Manifold collide(const Polygon& a, const Polygon& b, const Transform& bInA, ManifoldReach reach,
                 ManifoldMemory& memory) {
    using Verdict = ManifoldMemory::Verdict;
    const Margins margins{static_cast<double>(reach.points),
                          static_cast<double>(std::min(reach.points, reach.nearest))};
    const PairView pair(a, b, bInA);
    if (memory.isApart(bInA, std::min(reach.points, reach.nearest))) { return {}; }
    PairVerdict verdict;
    if (memory.verdict == Verdict::face && memory.motionTo(bInA) < memory.room) {
        const Manifold manifold = clipAgainstKnown(pair, memory, margins.points);
        // As near as `nearest` to rounding, a search may say that they are apart.
        const Real certain = static_cast<Real>(margins.nearest) - kVerdictRounding * memory.lever;
        if (manifold.count > 0 && deepestSeparation(manifold) <= certain) { return manifold; }
    }
    if (RescaledPair(a, b, bInA).isNeeded()) {  // rare enough not to remember anything
        memory.verdict = Verdict::none;
        return within(collide(a, b, bInA, reach.points), reach.nearest, verdict);
    }
    const Manifold manifold = within(collideCores(pair, margins, verdict), reach.nearest, verdict);
    remember(memory, verdict, a, b, bInA);
    return manifold;
}

Manifold collideOnFace(const Polygon& a, int face, const Polygon& b, const Transform& bInA, Real margin, Real sine) {
    return atSafeScale(a, b, bInA, margin, [face, sine](const PairView& pair, double reach) {
        const ReferenceFace reference = faceOfA(pair, face);
        const IncidentEdge incident = incidentOfB(pair, reference.normal);
        const double height = std::min(std::fabs(dot(reference.normal, incident.start - reference.start)),
                                       std::fabs(dot(reference.normal, incident.end - reference.start)));
        const double slack = static_cast<double>(sine) * height;
        return builderFor(pair, reach, true, reference.normal).build(clip(reference, incident, slack));
    });
}

}  // namespace swept::inline SWEPT_PRECISION
