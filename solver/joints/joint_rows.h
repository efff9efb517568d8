#pragma once

#include "../body_state.h"
#include "point_constraint.h"

/// The scalar rows that joints are made of, and rows that are held as one block.

namespace swept::inline SWEPT_PRECISION {

/// The two bodies of a joint in a solve.
struct JointPair {
    BodyState& a;
    BodyState& b;
    const BodyInertia& inertiaA;
    const BodyInertia& inertiaB;
};

/// One direction in which two bodies move relative to each other: speed = linear·(vB − vA) + spinB·ωB − spinA·ωA.
struct JointRow {
    Vec2 linear;
    Real spinA = 0;  ///< metres, or 1 for an angle
    Real spinB = 0;
};
inline constexpr JointRow kSpinRow{{}, 1, 1};

/// Relative motion of two points along a direction.
constexpr JointRow rowAlong(Vec2 direction, Vec2 armA, Vec2 armB) {
    return {direction, cross(armA, direction), cross(armB, direction)};
}

constexpr Real speedOf(const JointRow& row, const JointPair& pair) {
    return dot(row.linear, pair.b.velocity - pair.a.velocity) + row.spinB * pair.b.angularVelocity -
           row.spinA * pair.a.angularVelocity;
}

constexpr void apply(const JointRow& row, const JointPair& pair, Real impulse) {
    pair.a.velocity -= (pair.inertiaA.inverseMass * impulse) * row.linear;
    pair.b.velocity += (pair.inertiaB.inverseMass * impulse) * row.linear;
    pair.a.angularVelocity -= pair.inertiaA.inverseInertia * row.spinA * impulse;
    pair.b.angularVelocity += pair.inertiaB.inverseInertia * row.spinB * impulse;
}

/// Speed of the angle per impulse on it; 0 of bodies that cannot turn.
constexpr Real turnOf(const JointPair& pair) { return pair.inertiaA.inverseInertia + pair.inertiaB.inverseInertia; }

/// Two rows that are solved as one block.
struct HeldRows {
    JointRow first;
    JointRow second;
    PointMatrix matrix;
};

constexpr Vec2 speedsOf(const HeldRows& held, const JointPair& pair) {
    return {speedOf(held.first, pair), speedOf(held.second, pair)};
}
constexpr void apply(const HeldRows& held, const JointPair& pair, Vec2 impulse) {
    apply(held.first, pair, impulse.x);
    apply(held.second, pair, impulse.y);
}

/// Two points that are held together.
constexpr HeldRows heldPoint(const JointPair& pair, Vec2 armA, Vec2 armB) {
    return {rowAlong({1, 0}, armA, armB), rowAlong({0, 1}, armA, armB),
            pointMatrix(pair.inertiaA, armA, pair.inertiaB, armB)};
}

/// Softly towards zero errors; the change of the accumulated impulses.
/// @pre  not both `useBias` and held by a direct solve, see `JointConstraint::isHeld`
/// @param pace  of what it is held to, m/s
constexpr Vec2 heldChange(const HeldRows& held, const JointPair& pair, Vec2 error, Vec2 accumulated,
                          const Softness& softness, bool useBias, Vec2 pace = {}) {
    const Softness used = useBias ? softness : kRigid;
    const Vec2 bias = useBias ? used.biasRate * error : Vec2{};
    return -used.massScale * solve(held.matrix, (speedsOf(held, pair) - pace) + bias) - used.impulseScale * accumulated;
}

}  // namespace swept::inline SWEPT_PRECISION
