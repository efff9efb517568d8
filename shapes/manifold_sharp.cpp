#include <algorithm>
#include <cmath>

#include "face_search.h"
#include "manifold_clip_inline.h"
#include "manifold_parts.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Sine of the angle between two faces below which stored normals may choose the wrong one of them for what lies
/// beside both: then the faces are measured (core_axis.h).
constexpr Real kNearlyParallel = Real(1) / 64;

/// The best face of either shape.
struct FacePair {
    FaceChoice a;
    FaceChoice b;
};

/// @return whether they are nearer than the margin; else `verdict` says why not
bool findFaces(const PairView& pair, double margin, FacePair& faces, PairVerdict& verdict) {
    const Transform bInA{toReal(pair.translation), {static_cast<Real>(pair.c), static_cast<Real>(pair.s)}};
    FaceSearch::Placed placed;
    FaceSearch::place(pair.b, bInA, placed);
    faces.a = FaceSearch::best(pair.a, placed);
    double apart = static_cast<double>(faces.a.separation);
    if (!(apart > margin)) {
        FaceSearch::placeInverse(pair.a, bInA, placed);
        faces.b = FaceSearch::best(pair.b, placed);
        apart = static_cast<double>(faces.b.separation);
        if (!(apart > margin)) { return true; }
    }
    verdict.verdict = ManifoldMemory::Verdict::apart;
    verdict.room = apart;
    return false;
}

double squaredEdge(const Polygon& polygon, int edge) {
    const auto i = static_cast<std::size_t>(edge);
    const auto j = static_cast<std::size_t>(polygon.next(edge));
    const DVec2 span = toDouble(polygon.vertices[j]) - toDouble(polygon.vertices[i]);
    return dot(span, span);
}

/// Which of both faces is clipped against, and for how much motion that is certain.
struct Choice {
    bool takesA = false;
    double room = 0;
};

/// Of shapes that are apart, the face along which they are farther, and A's where both are flush and rounding would
/// choose. Of shapes that overlap, A's may be a little deeper.
Choice chooseFace(const PairView& pair, const FacePair& faces) {
    const auto separationA = static_cast<double>(faces.a.separation);
    const auto separationB = static_cast<double>(faces.b.separation);
    const double shorter = std::sqrt(std::min(squaredEdge(pair.a, faces.a.face), squaredEdge(pair.b, faces.b.face)));
    const double flush = kFlushRounding * (shorter + sumNorm(pair.translation));
    const double nearest = std::max(separationA, separationB);
    const double lead = separationB - separationA;
    const double ahead = lead - flush;
    const double beyond = lead - kFacePreference * shorter;
    const double decides = nearest > 0 ? ahead : beyond;
    // Separations change by the motion at most, their differences by twice as much. Until then they are apart, or
    // overlap, as they do now; or it makes no difference.
    const bool isEitherWay = (ahead <= 0) == (beyond <= 0);
    const double eitherWay = isEitherWay ? 0.5 * std::min(std::fabs(ahead), std::fabs(beyond)) : 0;
    const double asNow = std::min(0.5 * std::fabs(decides), std::fabs(nearest));
    const double ofFaces = 0.5 * static_cast<double>(std::min(faces.a.lead, faces.b.lead));
    return {decides <= 0, std::min(std::max(eitherWay, asNow), ofFaces)};
}

/// Vertices of a face and of an edge that faces it, and is apart from it: those that are closest.
struct NearestEnds {
    int onFace = 0;
    int onEdge = 0;
};

NearestEnds nearestEnds(const ReferenceFace& face, const IncidentEdge& edge) {
    struct Foot {
        double squared;  ///< distance to the face
        bool isAtEnd;    ///< of the face, not its start
    };
    const auto footOf = [&face](DVec2 vertex) {
        const double height = dot(face.normal, vertex - face.start);
        const double along = dot(face.tangent, vertex - face.start);
        const double beyond = std::max({-along, along - face.length, 0.0});
        return Foot{height * height + beyond * beyond, 2 * along > face.length};
    };
    const Foot start = footOf(edge.start);
    const Foot end = footOf(edge.end);
    const bool isStart = start.squared <= end.squared;
    return {(isStart ? start : end).isAtEnd ? face.endVertex : face.startVertex,
            isStart ? edge.startVertex : edge.endVertex};
}

/// Of shapes that are apart, the separation along a face is the distance where what is lowest lies over the face.
bool hasLowest(const ClippedEdge& clipped, double height) {
    const double limit = height * (1 + static_cast<double>(kEpsilon));
    for (std::size_t i = 0; i < static_cast<std::size_t>(clipped.count); ++i) {
        if (clipped.points[i].separation <= limit) { return true; }
    }
    return false;
}

/// No points where they do not belong to the face.
template <bool ofA>
Manifold clipOn(const PairView& pair, int edge, double margin) {
    const ReferenceFace face = ofA ? faceOfA(pair, edge) : faceOfB(pair, edge);
    const IncidentEdge incident = ofA ? incidentOfB(pair, face.normal) : incidentOfA(pair, face.normal);
    const ClippedEdge clipped = clip(face, incident, 0);
    const double lowest =
        std::min(dot(face.normal, incident.start - face.start), dot(face.normal, incident.end - face.start));
    if (lowest > 0 && !hasLowest(clipped, lowest)) { return {}; }
    return ManifoldBuilder{0, 0, margin, ofA, face.normal}.build(clipped);
}

SimplexCache nearestVertices(const PairView& pair, int edge, bool ofA) {
    const ReferenceFace face = ofA ? faceOfA(pair, edge) : faceOfB(pair, edge);
    const NearestEnds ends = nearestEnds(face, ofA ? incidentOfB(pair, face.normal) : incidentOfA(pair, face.normal));
    SimplexCache nearest;
    nearest.count = 1;
    nearest.indexA[0] = static_cast<std::uint8_t>(ofA ? ends.onFace : ends.onEdge);
    nearest.indexB[0] = static_cast<std::uint8_t>(ofA ? ends.onEdge : ends.onFace);
    return nearest;
}

}  // namespace

Manifold collideOnSharpFace(const PairView& pair, int face, bool isOfA, double margin) {
    return isOfA ? clipOn<true>(pair, face, margin) : clipOn<false>(pair, face, margin);
}

bool hasNearlyParallelNeighbour(const Polygon& polygon, int face) {
    const auto normal = [&polygon](int i) { return polygon.normals[static_cast<std::size_t>(i)]; };
    const Vec2 own = normal(face);
    for (const int beside : {polygon.previous(face), polygon.next(face)}) {
        if (dot(own, normal(beside)) > 0 && std::fabs(cross(own, normal(beside))) <= kNearlyParallel) { return true; }
    }
    return false;
}

Manifold collideBesideFace(const PairView& pair, int face, bool isOfA, Margins margins, PairVerdict& verdict) {
    const SimplexCache nearest = nearestVertices(pair, face, isOfA);
    PairVerdict ofGjk;
    const Manifold manifold = collideByGjk(pair, margins, &nearest, ofGjk);
    // Only that they are apart: which face it is without a question is for the faces alone to say.
    if (ofGjk.verdict == ManifoldMemory::Verdict::apart) { verdict = ofGjk; }
    return manifold;
}

/// In contact they overlap or nearly do: separating axes answer most of them without GJK, which is left with closest
/// vertices, and begins at those.
Manifold collideSharp(const PairView& pair, Margins margins, PairVerdict& verdict) {
    FacePair faces;
    if (!findFaces(pair, margins.nearest, faces, verdict)) { return {}; }
    Choice choice = chooseFace(pair, faces);
    int face = choice.takesA ? faces.a.face : faces.b.face;
    if (hasNearlyParallelNeighbour(choice.takesA ? pair.a : pair.b, face)) {
        face = choice.takesA ? settledFaceOfA(pair, face).face : settledFaceOfB(pair, face).face;
        choice.room = 0;
    }
    const Manifold manifold = collideOnSharpFace(pair, face, choice.takesA, margins.points);
    if (manifold.count == 0) { return collideBesideFace(pair, face, choice.takesA, margins, verdict); }
    if (choice.room > 0) {
        verdict.verdict = ManifoldMemory::Verdict::face;
        verdict.face = face;
        verdict.isOfA = choice.takesA;
        verdict.room = choice.room;
    }
    return manifold;
}

}  // namespace swept::inline SWEPT_PRECISION
