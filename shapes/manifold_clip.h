#pragma once

#include "core_axis.h"
#include "manifold.h"
#include "rescaled_pair.h"

namespace swept::inline SWEPT_PRECISION {

/// A vertex or an edge of one shape.
struct Feature {
    bool isEdge = false;
    int index = 0;
};

/// Eight bits for each shape: the high bit of each half tells an edge from a vertex.
constexpr FeatureId featureId(Feature ofA, Feature ofB) {
    const int a = (ofA.isEdge ? 0x80 : 0) | ofA.index;
    const int b = (ofB.isEdge ? 0x80 : 0) | ofB.index;
    return static_cast<FeatureId>((a << 8) | b);
}

/// An edge whose normal is the contact normal, frame of A.
struct ReferenceFace {
    DVec2 start;
    DVec2 tangent;      ///< unit, towards the other end
    DVec2 normal;       ///< unit, outward
    double length = 0;  ///< metres
    int edge = 0;
    int startVertex = 0;
    int endVertex = 0;
};
ReferenceFace faceOfA(const PairView& pair, int edge);
ReferenceFace faceOfB(const PairView& pair, int edge);
/// The same where the normal is known: unit, outward, frame of A.
ReferenceFace faceOfA(const PairView& pair, int edge, DVec2 normal);
ReferenceFace faceOfB(const PairView& pair, int edge, DVec2 normal);

/// The edge of the other shape that faces the reference face; of a circle, its centre (`isPoint`).
struct IncidentEdge {
    DVec2 start;
    DVec2 end;
    int edge = 0;
    int startVertex = 0;
    int endVertex = 0;
    bool isPoint = false;
};
/// @param normal  unit, frame of A, outward from the reference shape.
IncidentEdge incidentOfA(const PairView& pair, DVec2 normal);
IncidentEdge incidentOfB(const PairView& pair, DVec2 normal);

/// Edge of the polygon whose outward normal is closest to `direction` (frame of the polygon). @pre count ≥ 2.
int edgeFacing(const Polygon& polygon, DVec2 direction);

/// A point of the incident edge over the reference face.
struct ClippedPoint {
    DVec2 core;             ///< on the incident core, frame of A
    double separation = 0;  ///< of the cores along the reference normal, metres
    Feature reference;
    Feature incident;
};
struct ClippedEdge {
    std::array<ClippedPoint, 2> points;
    int count = 0;
};

/// The part of the incident edge that lies over the reference face. A vertex that sticks out by at most `slack` ≥ 0
/// metres still counts as over it.
ClippedEdge clip(const ReferenceFace& face, const IncidentEdge& edge, double slack);

/// Adds the points whose separation, radii included, is at most `margin`.
struct ManifoldBuilder {
    double radiusA;
    double radiusB;
    double margin;
    bool referenceIsA;
    DVec2 referenceNormal;  ///< unit, outward from the reference shape

    Manifold build(const ClippedEdge& clipped) const;
};

/// One point between core points a and b, b − a = separation · normal.
Manifold singlePoint(const CorePoints& core, double coreSeparation, DVec2 normal, FeatureId id, const Polygon& a,
                     const Polygon& b, double margin);

/// A manifold of a scaled pair at the scale of the input.
Manifold restored(const RescaledPair& scaled, Manifold manifold);

}  // namespace swept::inline SWEPT_PRECISION
