#pragma once

#include "manifold_clip.h"

/// The bodies of manifold_clip.h that every contact passes through at every step: inlined, a manifold takes an eighth
/// less, since their results need not go through memory.

namespace swept::inline SWEPT_PRECISION {

/// @param normal  unit, of that edge
inline ReferenceFace makeFace(DVec2 start, DVec2 edge, DVec2 normal) {
    ReferenceFace face;
    face.start = start;
    face.normal = normal;
    face.tangent = leftPerp(face.normal);
    face.length = dot(edge, face.tangent);
    return face;
}

inline ReferenceFace faceOfA(const PairView& pair, int edge, DVec2 normal) {
    ReferenceFace face = makeFace(pair.vertexA(edge), pair.edgeA(edge), normal);
    face.edge = edge;
    face.startVertex = edge;
    face.endVertex = pair.a.next(edge);
    return face;
}

inline ReferenceFace faceOfA(const PairView& pair, int edge) {
    return faceOfA(pair, edge, edgeNormal(pair.edgeA(edge), pair.normalA(edge)));
}

inline ReferenceFace faceOfB(const PairView& pair, int edge, DVec2 normal) {
    ReferenceFace face = makeFace(pair.vertexB(edge), pair.edgeB(edge), normal);
    face.edge = edge;
    face.startVertex = edge;
    face.endVertex = pair.b.next(edge);
    return face;
}

inline ReferenceFace faceOfB(const PairView& pair, int edge) {
    return faceOfB(pair, edge, edgeNormal(pair.edgeB(edge), pair.normalB(edge)));
}

inline int edgeFacing(const Polygon& polygon, DVec2 direction) {
    int best = 0;
    double bestDot = dot(direction, toDouble(polygon.normals[0]));
    for (int i = 1; i < polygon.count; ++i) {
        const double d = dot(direction, toDouble(polygon.normals[static_cast<std::size_t>(i)]));
        if (d > bestDot) {
            bestDot = d;
            best = i;
        }
    }
    return best;
}

inline IncidentEdge incidentOfA(const PairView& pair, DVec2 normal) {
    if (pair.a.count == 1) { return {pair.vertexA(0), pair.vertexA(0), 0, 0, 0, true}; }
    const int edge = edgeFacing(pair.a, -normal);
    const int next = pair.a.next(edge);
    return {pair.vertexA(edge), pair.vertexA(next), edge, edge, next, false};
}

inline IncidentEdge incidentOfB(const PairView& pair, DVec2 normal) {
    if (pair.b.count == 1) { return {pair.vertexB(0), pair.vertexB(0), 0, 0, 0, true}; }
    const int edge = edgeFacing(pair.b, pair.toB(-normal));
    const int next = pair.b.next(edge);
    return {pair.vertexB(edge), pair.vertexB(next), edge, edge, next, false};
}

inline ClippedEdge clip(const ReferenceFace& face, const IncidentEdge& edge, double slack) {
    const double startAlong = dot(face.tangent, edge.start - face.start);
    const double endAlong = dot(face.tangent, edge.end - face.start);
    ClippedEdge clipped;
    const auto add = [&](double along, double otherAlong, DVec2 vertex, DVec2 other, int vertexIndex) {
        ClippedPoint p;
        if (along >= -slack && along <= face.length + slack) {
            p.core = vertex;
            p.reference = {true, face.edge};
            p.incident = {false, vertexIndex};
        } else {
            const bool isBefore = along < 0;
            const double bound = isBefore ? 0 : face.length;
            if (isBefore ? otherAlong <= bound : otherAlong >= bound) { return; }  // nothing of the edge is left here
            p.core = vertex + ((bound - along) / (otherAlong - along)) * (other - vertex);
            p.reference = {false, isBefore ? face.startVertex : face.endVertex};
            p.incident = {true, edge.edge};
        }
        p.separation = dot(face.normal, p.core - face.start);
        clipped.points[static_cast<std::size_t>(clipped.count++)] = p;
    };
    add(startAlong, endAlong, edge.start, edge.end, edge.startVertex);
    if (!edge.isPoint) { add(endAlong, startAlong, edge.end, edge.start, edge.endVertex); }
    return clipped;
}

inline Manifold ManifoldBuilder::build(const ClippedEdge& clipped) const {
    Manifold manifold;
    manifold.normal = clampedReal(referenceIsA ? referenceNormal : -referenceNormal);
    manifold.isNormalOfB = !referenceIsA;
    const double referenceRadius = referenceIsA ? radiusA : radiusB;
    const double incidentRadius = referenceIsA ? radiusB : radiusA;
    for (std::size_t i = 0; i < static_cast<std::size_t>(clipped.count); ++i) {
        const ClippedPoint& p = clipped.points[i];
        const double separation = p.separation - referenceRadius - incidentRadius;
        if (separation > margin) { continue; }
        const double toMiddle = 0.5 * (referenceRadius - incidentRadius - p.separation);
        ManifoldPoint& out = manifold.points[static_cast<std::size_t>(manifold.count++)];
        out.point = clampedReal(p.core + toMiddle * referenceNormal);
        out.separation = clampedReal(separation);
        out.id = referenceIsA ? featureId(p.reference, p.incident) : featureId(p.incident, p.reference);
    }
    return manifold;
}

}  // namespace swept::inline SWEPT_PRECISION
