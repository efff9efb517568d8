#include "core_axis.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Smallest value of dot(direction, vertex) over a polygon, and where.
struct Lowest {
    int vertex = 0;
    double value = 0;
};
Lowest lowestVertex(const Polygon& p, DVec2 direction) {
    Lowest lowest{0, dot(direction, toDouble(p.vertices[0]))};
    for (int i = 1; i < p.count; ++i) {
        const double d = dot(direction, toDouble(p.vertices[static_cast<std::size_t>(i)]));
        if (d < lowest.value) { lowest = {i, d}; }
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
            if (end.separation > best.separation) { best = end; }
        }
    }
}

double shorterFace(const PairView& pair, int faceA, int faceB) {
    const double a = length(pair.edgeA(faceA));
    const double b = length(pair.edgeB(faceB));
    return a < b ? a : b;
}

}  // namespace

FaceAxis bestFaceOfA(const PairView& pair) {
    FaceAxis best;
    for (int i = 0; i < faceCount(pair.a); ++i) {
        const DVec2 n = pair.normalA(i);
        const Lowest lowest = lowestVertex(pair.b, pair.toB(n));
        const double separation = lowest.value + dot(n, pair.translation - pair.vertexA(i));
        if (best.face < 0 || separation > best.separation) { best = {i, lowest.vertex, separation, n}; }
    }
    if (best.face >= 0) {
        best.normal = edgeNormal(pair.edgeA(best.face), best.normal);
        best.separation = dot(best.normal, pair.vertexB(best.support) - pair.vertexA(best.face));
    }
    return best;
}

FaceAxis bestFaceOfB(const PairView& pair) {
    FaceAxis best;
    for (int i = 0; i < faceCount(pair.b); ++i) {
        const DVec2 n = pair.normalB(i);
        const Lowest lowest = lowestVertex(pair.a, n);
        const double separation = lowest.value - dot(n, pair.vertexB(i));
        if (best.face < 0 || separation > best.separation) { best = {i, lowest.vertex, separation, n}; }
    }
    if (best.face >= 0) {
        best.normal = edgeNormal(pair.edgeB(best.face), best.normal);
        best.separation = dot(best.normal, pair.vertexA(best.support) - pair.vertexB(best.face));
    }
    return best;
}

CoreAxis coreAxis(const PairView& pair, double preference) {
    if (pair.a.count == 1 && pair.b.count == 1) { return betweenPoints(pair); }
    const FaceAxis faceA = bestFaceOfA(pair);
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
