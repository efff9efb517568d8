#pragma once

#include "joint_constraint.h"
#include "joint_rows.h"

/// Rows that are moved while others are held: limits, motors and springs of a joint.

namespace swept::inline SWEPT_PRECISION {

/// Softness as a compliance: what soft rows give way per impulse is this part of what they give way anyhow.
/// Nothing in a relaxation, nor where a direct solve holds the joint.
inline Real complianceOf(const JointConstraint& joint, bool useBias) {
    return useBias && !joint.isHeld ? joint.softness.impulseScale / joint.softness.massScale : Real(0);
}

/// A row that is pushed while held rows stay as they are: each unit of impulse on it brings `answer` on the held ones.
/// Such a block is solved exactly, however long the arms; and a spring between hinged bodies has the inertia that it
/// really moves.
///
/// The block of held rows, matrix K, and this one, with `pull` p and own response k, may be soft in the held rows. By
/// how much is told by what is left of their response while this row is held, too: S = K − p·pᵀ/k, and K + γ·S is what
/// is solved. (By γ·K a body at a lever L, turned by a motor, hung on rows that were 1 + m·L²/I times as soft as its
/// mass asks for. And where the held rows were soft and their answer was rigid, the two passed on what softness took
/// back with that factor, without end.)
struct GuidedRow {
    JointRow row;
    Vec2 answer;
    Real mass = 0;           ///< impulse per speed, kg or kg·m²; 0 when nothing can move
    PointMatrix given;       ///< γ·S, without determinant
    PointMatrix heldMatrix;  ///< K + γ·S
};

/// γ·S, without determinant. @param own  k, greater than 0
constexpr PointMatrix givenBy(const PointMatrix& held, Vec2 pull, Real own, Real compliance) {
    return {compliance * (held.xx - pull.x * pull.x / own), compliance * (held.xy - pull.x * pull.y / own),
            compliance * (held.yy - pull.y * pull.y / own), 0};
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

/// @param inverse     speed per impulse with the answer of rigid rows
/// @param compliance  γ of the held rows
constexpr GuidedRow guidedBy(const HeldRows& held, const JointRow& row, const JointPair& pair, Real inverse,
                             Real compliance) {
    if (!(inverse > 0)) { return {row, {}, 0, {}, held.matrix}; }
    const Real own = coupling(row, row, pair);
    const Vec2 pull{coupling(row, held.first, pair), coupling(row, held.second, pair)};
    const PointMatrix given = givenBy(held.matrix, pull, own, compliance);
    const PointMatrix matrix = softened(held.matrix, given, compliance, inverse, own);
    return {row, -solve(matrix, pull), guidedMass(compliance, inverse, own), given, matrix};
}

/// Determinant of all three rows of two bodies: two points and the angle, or any turn of these axes.
constexpr Real fullDeterminant(const JointPair& pair, Vec2 armA, Vec2 armB) {
    const Real mass = pair.inertiaA.inverseMass + pair.inertiaB.inverseMass;
    const Real turn = turnOf(pair);
    return mass *
           (mass * turn + pair.inertiaA.inverseInertia * pair.inertiaB.inverseInertia * lengthSquared(armA - armB));
}

/// The angle of two bodies that share a point.
constexpr GuidedRow guidedSpin(const HeldRows& point, const JointPair& pair, Vec2 armA, Vec2 armB, Real compliance) {
    const Real all = fullDeterminant(pair, armA, armB);
    // Without mass to resist it the point is held by nothing: bodies that only turn.
    const bool heavy = point.matrix.determinant > 0;
    return guidedBy(point, kSpinRow, pair, heavy ? all / point.matrix.determinant : turnOf(pair), compliance);
}

constexpr void apply(const GuidedRow& guided, const HeldRows& held, const JointPair& pair, Real impulse,
                     Vec2& heldImpulse) {
    apply(guided.row, pair, impulse);
    apply(held, pair, impulse * guided.answer);
    heldImpulse += impulse * guided.answer;
}

/// Held rows that guide another, which is solved after them: both are one block.
/// @param bias  speed towards zero errors, with the opposite sign
constexpr void solveGuiding(const GuidedRow& guided, const HeldRows& held, const JointPair& pair, Vec2 bias,
                            Vec2& accumulated) {
    const Vec2 wanted = speedsOf(held, pair) + bias + product(guided.given, accumulated);
    const Vec2 change = -solve(guided.heldMatrix, wanted);
    accumulated += change;
    apply(held, pair, change);
}

}  // namespace swept::inline SWEPT_PRECISION
