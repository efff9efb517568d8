#pragma once

#include "joint_constraint.h"
#include "joint_rows.h"

/// Rows that are moved while others are held: limits, motors and springs of a joint. Names are those of `Spin` (pin.h).

namespace swept::inline SWEPT_PRECISION {

/// Softness as a compliance: what soft rows give way per impulse is this part of what they give way anyhow.
/// Nothing in a relaxation, nor where a direct solve holds the joint.
inline Real complianceOf(const JointConstraint& joint, bool useBias) {
    return useBias && !joint.isHeld ? joint.softness.impulseScale / joint.softness.massScale : Real(0);
}

/// K + γ·S. Its determinant is (1 + γ)·|K|·(1 + γ·inverse/k), as k·|S| = inverse·|K|.
/// @param inverse  speed of the guided row per impulse with the answer of rigid rows
constexpr PointMatrix softened(const PointMatrix& held, const PointMatrix& given, Real compliance, Real inverse,
                               Real own) {
    return {held.xx + given.xx, held.xy + given.xy, held.yy + given.yy,
            (1 + compliance) * held.determinant * (1 + compliance * (inverse / own))};
}

/// Of the guided row, from k − pᵀ·(K + γ·S)⁻¹·p. @param inverse  greater than 0
constexpr Real guidedMass(Real compliance, Real inverse, Real own) {
    return (own + compliance * inverse) / ((1 + compliance) * own * inverse);
}

/// Determinant of all three rows of two bodies: two points and the angle, or any turn of these axes.
constexpr Real fullDeterminant(const JointPair& pair, Vec2 armA, Vec2 armB) {
    const Real mass = pair.inertiaA.inverseMass + pair.inertiaB.inverseMass;
    const Real turn = turnOf(pair);
    return mass *
           (mass * turn + pair.inertiaA.inverseInertia * pair.inertiaB.inverseInertia * lengthSquared(armA - armB));
}

}  // namespace swept::inline SWEPT_PRECISION
