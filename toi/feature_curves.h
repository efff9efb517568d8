#pragma once

#include "method_pair.h"
#include "root_search.h"

namespace swept::inline SWEPT_PRECISION {

/// A pair with the roles of its bodies fixed: `owner` has the feature that the other body's vertex may meet. Vectors in
/// world axes, from the owner's centre.
struct FeatureFrame {
    const MethodBody& owner;
    const MethodBody& other;
    const RelativeMotion& motion;
    double direction = 1;   ///< 1: A is the owner; −1: B is
    double level = 0;       ///< distance of the cores at which they touch: target and radii, metres
    double resolution = 0;  ///< metres
    double farthest = 0;    ///< bound on the distance of the centres over the search, metres
    double fastest = 0;     ///< bound on the relative speed of the centres, metres per unit of fraction

    double ownerSpin() const { return direction > 0 ? motion.spinA : motion.spinB; }
    double otherSpin() const { return direction > 0 ? motion.spinB : motion.spinA; }
    Rotation ownerRotation(double t) const { return direction > 0 ? motion.rotationA(t) : motion.rotationB(t); }
    Rotation otherRotation(double t) const { return direction > 0 ? motion.rotationB(t) : motion.rotationA(t); }
    Vec2 offsetAt(double t) const { return toReal(direction * motion.offsetAt(t)); }
    Vec2 velocityAt(double t) const { return toReal(direction * motion.velocityAt(t)); }
};

/// The same search with the roles of the bodies exchanged.
inline FeatureFrame swapped(const FeatureFrame& f) {
    return {f.other, f.owner, f.motion, -f.direction, f.level, f.resolution, f.farthest, f.fastest};
}

/// Height of a vertex of the other body above an edge of the owner, minus the level. With d the difference of the
/// centres, n the edge's normal and r the vertex,
///     n(t)·d(t) + n(t)·r(t) − const
///         = Σ (αᵢ + βᵢ·t + γᵢ·t²)·cos(ω_owner·t + φᵢ) + |r|·cos((ω_other − ω_owner)·t + ψ) + δ,   i = x, y,
/// whose second derivative is within ω_owner²·|d| + 2·|ω_owner|·|v| + 2·|k| + (ω_other − ω_owner)²·|r|.
class VertexEdgeCurve {
public:
    VertexEdgeCurve(const FeatureFrame& frame, int edge, int vertex);
    CurveSample at(double fraction) const;
    double bend() const { return bend_; }
    double resolution() const { return frame_.resolution; }
    /// Whether the foot of the vertex lies on the edge, or beyond its end by no more than the resolution.
    bool accepts(double fraction) const;

private:
    Vec2 vertexAt(double fraction) const;

    const FeatureFrame& frame_;
    Vec2 normal_;  ///< of the edge, frame of the owner
    Vec2 start_;   ///< first vertex of the edge
    double length_ = 0;
    Vec2 vertex_;
    double bend_ = 0;
};

/// Squared distance of two vertices minus the squared level: smooth even where the distance is 0. Second derivative
/// 2·|w′|² + 2·w·w″, w the difference of the vertices. Square metres.
class VertexVertexCurve {
public:
    VertexVertexCurve(const FeatureFrame& frame, int ownVertex, int otherVertex);
    CurveSample at(double fraction) const;
    double bend() const { return bend_; }
    double resolution() const { return frame_.resolution * (2 * frame_.level + frame_.resolution); }
    bool accepts(double) const { return true; }

private:
    const FeatureFrame& frame_;
    Vec2 own_;
    Vec2 other_;
    double bend_ = 0;
};

}  // namespace swept::inline SWEPT_PRECISION
