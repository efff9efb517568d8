#pragma once

#include "pair_view.h"

namespace swept::inline SWEPT_PRECISION {

/// The face of one shape along whose normal the other shape's core is farthest away.
struct FaceAxis {
    int face = -1;            ///< −1: the reference shape has no faces
    int support = 0;          ///< vertex of the other shape that lies lowest over the face
    double separation = 0;    ///< of the cores along the normal, metres; negative when overlapping
    DVec2 normal;             ///< unit, outward from the reference shape, frame of A
    double lead = 0;          ///< by how much it was better than the next best face when chosen; 0: not known
    bool isOverFace = false;  ///< the support vertex projects onto the face; then a positive separation is the distance
};

/// Best face of A and of B. The axis is chosen with the stored normals; normal and separation are then taken from the
/// face's own vertices in double.
FaceAxis bestFaceOfA(const PairView& pair);
FaceAxis bestFaceOfB(const PairView& pair);

/// From a face that is the best but for the rounding of stored normals: itself, or one beside it that is better.
FaceAxis settledFaceOfA(const PairView& pair, int face);
FaceAxis settledFaceOfB(const PairView& pair, int face);

enum class AxisSource : std::uint8_t { faceOfA, faceOfB, direction };

/// The axis of largest core separation over all faces of the Minkowski difference (and, for cores without area, over
/// the directions of the segments too).
struct CoreAxis {
    AxisSource source = AxisSource::direction;
    double separation = 0;  ///< metres
    DVec2 normal;           ///< unit, from A to B
    int face = -1;
    int supportA = 0;  ///< extreme vertices along the normal; of the shape that owns the face: its first vertex
    int supportB = 0;
};
/// @param preference  a face of A is taken even if a face of B is better by up to this fraction of the shorter of the
///                    two faces; 0 gives the minimum translation, along the axis of the largest separation, whoever
///                    owns its face.
CoreAxis coreAxis(const PairView& pair, double preference = 0);

/// Of either shape; of a point, none.
struct BestFaces {
    FaceAxis ofA;
    FaceAxis ofB;
};
BestFaces bestFaces(const PairView& pair);
/// The same from what is known.
CoreAxis coreAxis(const PairView& pair, const BestFaces& faces, double preference);

/// Of the best faces of A and B: whether A's is taken, by the rule above. @pre one of them exists.
bool prefersA(const PairView& pair, const FaceAxis& faceA, const FaceAxis& faceB, double preference);

/// Core points that realise an axis: b − a = separation · normal. On both cores when these overlap or touch.
struct CorePoints {
    DVec2 a;
    DVec2 b;
};
CorePoints corePoints(const PairView& pair, const CoreAxis& axis);

}  // namespace swept::inline SWEPT_PRECISION
