#pragma once

#include <algorithm>

#include "body_state.h"
#include "point_constraint.h"

/// The scalar rows that joints are made of, and rows that are moved while others are held.

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

/// Speed of one row per impulse on the other.
constexpr Real coupling(const JointRow& p, const JointRow& q, const JointPair& pair) {
    return (pair.inertiaA.inverseMass + pair.inertiaB.inverseMass) * dot(p.linear, q.linear) +
           pair.inertiaA.inverseInertia * p.spinA * q.spinA + pair.inertiaB.inverseInertia * p.spinB * q.spinB;
}

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

/// A direction alone. The second row is empty.
constexpr HeldRows heldLine(const JointPair& pair, const JointRow& side) {
    const Real across = coupling(side, side, pair);
    return {side, {}, {across, 0, across, across * across}};
}

/// A direction and the angle are held: what a slider leaves free is the direction across.
constexpr HeldRows heldSlide(const JointPair& pair, const JointRow& side) {
    const Real mass = pair.inertiaA.inverseMass + pair.inertiaB.inverseMass;
    const Real turn = pair.inertiaA.inverseInertia + pair.inertiaB.inverseInertia;
    const Real across = coupling(side, side, pair);
    if (!(turn > 0)) { return heldLine(pair, side); }  // bodies that cannot turn need no holding
    // Expanded into terms that are all ≥ 0: see `pointMatrix`.
    const Real determinant =
        mass * turn + pair.inertiaA.inverseInertia * pair.inertiaB.inverseInertia * square(side.spinA - side.spinB);
    return {side, kSpinRow, {across, coupling(side, kSpinRow, pair), turn, determinant}};
}

/// Softly towards zero errors; the change of the accumulated impulses.
/// @pre  not both `useBias` and held by a direct solve, see `JointConstraint::isHeld`
constexpr Vec2 heldChange(const HeldRows& held, const JointPair& pair, Vec2 error, Vec2 accumulated,
                          const Softness& softness, bool useBias) {
    const Softness used = useBias ? softness : kRigid;
    const Vec2 bias = useBias ? used.biasRate * error : Vec2{};
    return -used.massScale * solve(held.matrix, speedsOf(held, pair) + bias) - used.impulseScale * accumulated;
}

/// A row that is pushed while held rows stay as they are: each unit of impulse on it brings `answer` on the held ones.
/// Such a block is solved exactly, however long the arms; and a spring between hinged bodies has the inertia that it
/// really moves.
struct GuidedRow {
    JointRow row;
    Vec2 answer;
    Real mass = 0;  ///< impulse per speed, kg or kg·m²; 0 when nothing can move
};

/// @param inverseMass  speed per impulse with the answer included
constexpr GuidedRow guidedBy(const HeldRows& held, const JointRow& row, const JointPair& pair, Real inverseMass) {
    const Vec2 pull{coupling(row, held.first, pair), coupling(row, held.second, pair)};
    return {row, -solve(held.matrix, pull), inverseMass > 0 ? 1 / inverseMass : Real(0)};
}

/// Determinant of all three rows of two bodies: two points and the angle, or any turn of these axes.
constexpr Real fullDeterminant(const JointPair& pair, Vec2 armA, Vec2 armB) {
    const Real mass = pair.inertiaA.inverseMass + pair.inertiaB.inverseMass;
    const Real turn = pair.inertiaA.inverseInertia + pair.inertiaB.inverseInertia;
    return mass *
           (mass * turn + pair.inertiaA.inverseInertia * pair.inertiaB.inverseInertia * lengthSquared(armA - armB));
}

/// The angle of two bodies that share a point.
constexpr GuidedRow guidedSpin(const HeldRows& point, const JointPair& pair, Vec2 armA, Vec2 armB) {
    const Real all = fullDeterminant(pair, armA, armB);
    // Without mass to resist it the point is held by nothing: bodies that only turn.
    const bool heavy = point.matrix.determinant > 0;
    const Real turn = pair.inertiaA.inverseInertia + pair.inertiaB.inverseInertia;
    return guidedBy(point, kSpinRow, pair, heavy ? all / point.matrix.determinant : turn);
}

constexpr void apply(const GuidedRow& guided, const HeldRows& held, const JointPair& pair, Real impulse,
                     Vec2& heldImpulse) {
    apply(guided.row, pair, impulse);
    apply(held, pair, impulse * guided.answer);
    heldImpulse += impulse * guided.answer;
}

/// One side of a pair of limits, whose impulse only pushes. @param room  what is left before the limit, negative beyond
/// it
/// @param speed  at which the room grows; @return change of the accumulated impulse
inline Real limitChange(Real mass, Real speed, Real room, Real accumulated, const Softness& softness, Real h,
                        bool useBias) {
    Real change = 0;
    if (room > 0) {
        change = -mass * (speed + room / h);  // may reach the limit within this sub-step, no more
    } else {
        change = scalarChange(mass, speed, useBias ? room : Real(0), accumulated, useBias ? softness : kRigid);
    }
    return std::max(accumulated + change, Real(0)) - accumulated;
}

/// Towards a speed, with limited impulse; the change of the accumulated one.
inline Real motorChange(Real mass, Real speed, Real wantedSpeed, Real accumulated, Real maxImpulse) {
    return std::clamp(accumulated - mass * (speed - wantedSpeed), -maxImpulse, maxImpulse) - accumulated;
}

/// Limits, motor and spring of one free direction of a joint: an angle or a translation.
struct FreedomParts {
    Real lower = 0;  ///< rad or metres
    Real upper = 0;
    Real motorSpeed = 0;       ///< rad/s or m/s
    Real maxMotorImpulse = 0;  ///< maximum torque or force times sub-step
    SpringGains spring;        ///< towards 0
    bool hasLimits = false;
    bool hasMotor = false;
    bool hasSpring = false;
    /// Accumulated; warm start in (but for the spring), result out. N·s or N·m·s per sub-step.
    Real lowerImpulse = 0;
    Real upperImpulse = 0;
    Real motorImpulse = 0;
    Real springImpulse = 0;

    constexpr Real impulse() const { return springImpulse + motorImpulse + lowerImpulse - upperImpulse; }
};

constexpr void dropUnused(FreedomParts& parts) {
    if (!parts.hasMotor) { parts.motorImpulse = 0; }
    if (!parts.hasLimits) { parts.lowerImpulse = parts.upperImpulse = 0; }
}

/// The spring's push, at the start of a sub-step: part of warm starting, where it takes the place of an old impulse.
constexpr void pushSpring(FreedomParts& parts, Real mass, Real place) {
    parts.springImpulse = parts.hasSpring ? -mass * (parts.spring.push * place) : Real(0);
}

/// Drag of the spring, motor and limits in this order: limits have the last word. @param speed  the present one, called
/// anew for each
/// @param push  applies an impulse
template <class SpeedNow, class Push>
void solveFreedom(FreedomParts& parts, Real mass, Real place, const Softness& softness, Real h, bool useBias,
                  SpeedNow&& speed, Push&& push) {
    if (!(mass > 0)) { return; }       // nothing to move; and 0 times the room of a limit at infinity is no number
    if (parts.hasSpring && useBias) {  // once per sub-step
        const Real change = parts.spring.drag * (parts.springImpulse - mass * speed());
        parts.springImpulse += change;
        push(change);
    }
    if (parts.hasMotor) {
        const Real change = motorChange(mass, speed(), parts.motorSpeed, parts.motorImpulse, parts.maxMotorImpulse);
        parts.motorImpulse += change;
        push(change);
    }
    if (!parts.hasLimits) { return; }
    const Real lower = limitChange(mass, speed(), place - parts.lower, parts.lowerImpulse, softness, h, useBias);
    parts.lowerImpulse += lower;
    push(lower);
    const Real upper = limitChange(mass, -speed(), parts.upper - place, parts.upperImpulse, softness, h, useBias);
    parts.upperImpulse += upper;
    push(-upper);
}

}  // namespace swept::inline SWEPT_PRECISION
