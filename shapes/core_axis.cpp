#include "core_axis.h"

#include "compiler.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Smallest value of dot(direction, vertex) over a polygon. Where it is attained is asked for the best face only.
/// (Converting the vertices once, ahead of all faces, was slower: they went through memory.)
SWEPT_FORCE_INLINE double lowestAlong(const Polygon& p, DVec2 direction) {
    double lowest = dot(direction, toDouble(p.vertices[0]));
    for (int i = 1; i < p.count; ++i) {
        const double d = dot(direction, toDouble(p.vertices[static_cast<std::size_t>(i)]));
        lowest = d < lowest ? d : lowest;
    }
    return lowest;
}

/// Separation along a unit direction (frame of A) from the farthest vertex of A to the nearest of B.
CoreAxis alongDirection(const PairView& pair, DVec2 direction) {
    CoreAxis axis;
    axis.normal = direction;
    axis.supportA = extremeVertex<1>(pair.a, direction);
    axis.supportB = extremeVertex<-1>(pair.b, pair.toB(direction));
    axis.separation = dot(direction, pair.vertexB(axis.supportB) - pair.vertexA(axis.supportA));
    return axis;
}

/// Two points: along their difference; for equal points any direction does, and up is as good as another.
CoreAxis betweenPoints(const PairView& pair) {
    const DVec2 w = pair.vertexB(0) - pair.vertexA(0);
    return alongDirection(pair, dot(w, w) >= std::numeric_limits<double>::min() ? unitOf(w) : DVec2{0, 1});
}

CoreAxis asCoreAxis(const FaceAxis& f, bool ofA) {
    CoreAxis axis;
    axis.source = ofA ? AxisSource::faceOfA : AxisSource::faceOfB;
    axis.separation = f.separation;
    axis.normal = ofA ? f.normal : -f.normal;
    axis.face = f.face;
    axis.supportA = ofA ? f.face : f.support;
    axis.supportB = ofA ? f.support : f.face;
    return axis;
}

/// Points and segments: where both lie on one line their Minkowski difference has no area, and its ends face along it.
void tryEnds(const PairView& pair, CoreAxis& best) {
    for (const bool ofA : {true, false}) {
        if ((ofA ? pair.a.count : pair.b.count) != 2) { continue; }
        const DVec2 along = ofA ? leftPerp(edgeNormal(pair.edgeA(0), pair.normalA(0)))
                                : leftPerp(edgeNormal(pair.edgeB(0), pair.normalB(0)));
        for (const DVec2 direction : {along, -along}) {
            const CoreAxis end = alongDirection(pair, direction);
            // Not by rounding alone: a perpendicular segment has this direction as a face, whose points are right.
            const double size = sumNorm(pair.vertexA(end.supportA)) + sumNorm(pair.vertexB(end.supportB)) +
                                2 * sumNorm(pair.translation);
            if (end.separation > best.separation + kResolution * size) { best = end; }
        }
    }
}

/// The first of the best faces, and how good the next best is.
struct BestFace {
    int face = -1;
    double separation = -std::numeric_limits<double>::infinity();
    double second = -std::numeric_limits<double>::infinity();

    SWEPT_FORCE_INLINE void offer(int candidate, double candidateSeparation) {
        const bool isBetter = face < 0 || candidateSeparation > separation;
        const double behind = isBetter ? separation : candidateSeparation;
        second = behind > second ? behind : second;
        face = isBetter ? candidate : face;
        separation = isBetter ? candidateSeparation : separation;
    }
};

/// One face measured with its own vertices: the axis, and where the foot of the support vertex falls.
struct MeasuredFace {
    FaceAxis axis;
    double along = 0;  ///< of the foot, times the length of the edge
    double end = 0;    ///< of the edge, in the same unit
};

template <bool ofA>
MeasuredFace measureFace(const PairView& pair, int face) {
    const DVec2 edge = ofA ? pair.edgeA(face) : pair.edgeB(face);
    const DVec2 normal = edgeNormal(edge, ofA ? pair.normalA(face) : pair.normalB(face));
    const int support = ofA ? extremeVertex<-1>(pair.b, pair.toB(normal)) : extremeVertex<-1>(pair.a, normal);
    const DVec2 toSupport =
        ofA ? pair.vertexB(support) - pair.vertexA(face) : pair.vertexA(support) - pair.vertexB(face);
    MeasuredFace measured{
        {face, support, dot(normal, toSupport), normal, 0, false}, dot(edge, toSupport), dot(edge, edge)};
    measured.axis.isOverFace = measured.along >= 0 && measured.along <= measured.end;
    return measured;
}

/// The stored normals may choose a face beside the best one where several are almost parallel. Then the foot of the
/// support vertex falls beyond the end of the face, on the side of the better one.
template <bool ofA>
FaceAxis settled(const PairView& pair, const BestFace& best) {
    if (best.face < 0) { return {}; }
    const Polygon& reference = ofA ? pair.a : pair.b;
    MeasuredFace chosen = measureFace<ofA>(pair, best.face);
    chosen.axis.lead = best.separation - best.second;
    for (int i = 1; i < reference.count && !chosen.axis.isOverFace; ++i) {
        const int beside = chosen.along < 0 ? reference.previous(chosen.axis.face) : reference.next(chosen.axis.face);
        const MeasuredFace other = measureFace<ofA>(pair, beside);
        if (!(other.axis.separation > chosen.axis.separation)) { break; }
        chosen = other;
    }
    return chosen.axis;
}

}  // namespace

FaceAxis bestFaceOfA(const PairView& pair) {
    BestFace best;
    for (int i = 0; i < faceCount(pair.a); ++i) {
        const DVec2 n = pair.normalA(i);
        best.offer(i, lowestAlong(pair.b, pair.toB(n)) + dot(n, pair.translation - pair.vertexA(i)));
    }
    return settled<true>(pair, best);
}

FaceAxis bestFaceOfB(const PairView& pair) {
    BestFace best;
    for (int i = 0; i < faceCount(pair.b); ++i) {
        const DVec2 n = pair.normalB(i);
        best.offer(i, lowestAlong(pair.a, n) - dot(n, pair.vertexB(i)));
    }
    return settled<false>(pair, best);
}

FaceAxis settledFaceOfA(const PairView& pair, int face) { return settled<true>(pair, {face, 0, 0}); }
FaceAxis settledFaceOfB(const PairView& pair, int face) { return settled<false>(pair, {face, 0, 0}); }

bool prefersA(const PairView& pair, const FaceAxis& faceA, const FaceAxis& faceB, double preference) {
    if (faceA.face < 0 || faceB.face < 0) { return faceB.face < 0; }
    const double lead = faceB.separation - faceA.separation;
    if (lead <= 0 || !(preference > 0)) { return lead <= 0; }
    const DVec2 edgeA = pair.edgeA(faceA.face);
    const DVec2 edgeB = pair.edgeB(faceB.face);
    const double squaredA = dot(edgeA, edgeA);
    const double squaredB = dot(edgeB, edgeB);
    return lead * lead <= preference * preference * (squaredA < squaredB ? squaredA : squaredB);
}

BestFaces bestFaces(const PairView& pair) { return {bestFaceOfA(pair), bestFaceOfB(pair)}; }

CoreAxis coreAxis(const PairView& pair, double preference) { return coreAxis(pair, bestFaces(pair), preference); }

CoreAxis coreAxis(const PairView& pair, const BestFaces& faces, double preference) {
    if (pair.a.count == 1 && pair.b.count == 1) { return betweenPoints(pair); }
    const auto& [faceA, faceB] = faces;
    CoreAxis best = prefersA(pair, faceA, faceB, preference) ? asCoreAxis(faceA, true) : asCoreAxis(faceB, false);
    if (pair.a.count <= 2 && pair.b.count <= 2) { tryEnds(pair, best); }
    return best;
}

}  // namespace swept::inline SWEPT_PRECISION
