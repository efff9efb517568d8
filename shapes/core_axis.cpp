#include "core_axis.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Smallest value of dot(direction, vertex) over a polygon. Where it is attained is asked for the best face only.
double lowestValue(const Polygon& p, DVec2 direction) {
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
    axis.largest = axis.separation;
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
    axis.largest = f.separation;
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

double shorterFace(const PairView& pair, int faceA, int faceB) {
    const double a = length(pair.edgeA(faceA));
    const double b = length(pair.edgeB(faceB));
    return a < b ? a : b;
}

/// One face measured with its own vertices: the axis, and where the foot of the support vertex falls.
struct MeasuredFace {
    FaceAxis axis;
    double along = 0;  ///< of the foot, times the length of the edge
    double end = 0;    ///< of the edge, in the same unit
};

MeasuredFace measureFaceOfA(const PairView& pair, int face) {
    const DVec2 edge = pair.edgeA(face);
    const DVec2 normal = edgeNormal(edge, pair.normalA(face));
    const int support = extremeVertex<-1>(pair.b, pair.toB(normal));
    const DVec2 toSupport = pair.vertexB(support) - pair.vertexA(face);
    return {{face, support, dot(normal, toSupport), normal}, dot(edge, toSupport), dot(edge, edge)};
}

MeasuredFace measureFaceOfB(const PairView& pair, int face) {
    const DVec2 edge = pair.edgeB(face);
    const DVec2 normal = edgeNormal(edge, pair.normalB(face));
    const int support = extremeVertex<-1>(pair.a, normal);
    const DVec2 toSupport = pair.vertexA(support) - pair.vertexB(face);
    return {{face, support, dot(normal, toSupport), normal}, dot(edge, toSupport), dot(edge, edge)};
}

/// The stored normals may choose a face beside the best one where several are almost parallel. Then the foot of the
/// support vertex falls beyond the end of the face, on the side of the better one.
FaceAxis settled(const PairView& pair, bool ofA, int face) {
    const Polygon& reference = ofA ? pair.a : pair.b;
    const auto measure = [&pair, ofA](int i) { return ofA ? measureFaceOfA(pair, i) : measureFaceOfB(pair, i); };
    MeasuredFace chosen = measure(face);
    for (int i = 1; i < reference.count; ++i) {
        if (chosen.along >= 0 && chosen.along <= chosen.end) { break; }
        const int beside = chosen.along < 0 ? reference.previous(chosen.axis.face) : reference.next(chosen.axis.face);
        const MeasuredFace other = measure(beside);
        if (!(other.axis.separation > chosen.axis.separation)) { break; }
        chosen = other;
    }
    return chosen.axis;
}

}  // namespace

FaceAxis bestFaceOfA(const PairView& pair) {
    int best = -1;
    double bestSeparation = 0;
    for (int i = 0; i < faceCount(pair.a); ++i) {
        const DVec2 n = pair.normalA(i);
        const double separation = lowestValue(pair.b, pair.toB(n)) + dot(n, pair.translation - pair.vertexA(i));
        if (best < 0 || separation > bestSeparation) {
            best = i;
            bestSeparation = separation;
        }
    }
    return best < 0 ? FaceAxis{} : settled(pair, true, best);
}

FaceAxis bestFaceOfB(const PairView& pair) {
    int best = -1;
    double bestSeparation = 0;
    for (int i = 0; i < faceCount(pair.b); ++i) {
        const DVec2 n = pair.normalB(i);
        const double separation = lowestValue(pair.a, n) - dot(n, pair.vertexB(i));
        if (best < 0 || separation > bestSeparation) {
            best = i;
            bestSeparation = separation;
        }
    }
    return best < 0 ? FaceAxis{} : settled(pair, false, best);
}

CoreAxis coreAxis(const PairView& pair, double preference, double enough) {
    if (pair.a.count == 1 && pair.b.count == 1) { return betweenPoints(pair); }
    const FaceAxis faceA = bestFaceOfA(pair);
    if (faceA.face >= 0 && faceA.separation > enough) { return asCoreAxis(faceA, true); }
    const FaceAxis faceB = bestFaceOfB(pair);
    bool takeA = faceB.face < 0 || (faceA.face >= 0 && faceA.separation >= faceB.separation);
    const double largest = takeA ? faceA.separation : faceB.separation;
    if (!takeA && faceA.face >= 0 && preference > 0) {
        takeA = faceB.separation - faceA.separation <= preference * shorterFace(pair, faceA.face, faceB.face);
    }
    CoreAxis best = takeA ? asCoreAxis(faceA, true) : asCoreAxis(faceB, false);
    best.largest = largest;
    if (pair.a.count <= 2 && pair.b.count <= 2) { tryEnds(pair, best); }
    return best;
}

}  // namespace swept::inline SWEPT_PRECISION
