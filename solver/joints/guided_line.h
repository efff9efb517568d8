#pragma once

#include "freedom_parts.h"
#include "guided_row.h"
#include "joint_constraint.h"

/// The rows of joints along whose axis a body slides, as numbers that are found once per motion: one row along the
/// axis, and one across it that guides whatever else the joint does. Scalar twin of wide_lines.inc.

namespace swept::inline SWEPT_PRECISION {

/// Speed of a row per turn of each body.
struct Spins {
    Real a = 0;
    Real b = 0;
};

inline Real massOf(const JointPair& pair) { return pair.inertiaA.inverseMass + pair.inertiaB.inverseMass; }

/// As a joint stands in this sub-step.
struct GuidedLine {
    Vec2 axis;
    Spins along;
    Spins across;
    Real place = 0;        ///< of the anchor, along the axis, metres
    Real gap = 0;          ///< from the axis, metres
    Real response = 0;     ///< speed across the axis per impulse, 1/kg
    Real own = 0;          ///< likewise along it
    Real coupled = 0;      ///< of the one on the other
    Real inverseMass = 0;  ///< along the axis while nothing moves across it; 0 when nothing can move
    Real lonely = 0;       ///< what is left of `response` while all that it guides is held, too: a Schur complement
};

/// Where both rows act, what they answer, and what of errors the offset of the anchors alone makes; the rest of the
/// line is for who calls this.
inline GuidedLine lineAlong(Vec2 axis, Vec2 offset, Vec2 armA, Vec2 armB, const JointPair& pair) {
    GuidedLine line{.axis = axis,
                    .along = {cross(armA, axis), cross(armB, axis)},
                    .across = {dot(armA, axis), dot(armB, axis)},
                    .place = dot(axis, offset),
                    .gap = cross(axis, offset)};
    const auto response = [&pair](const Spins& p, const Spins& q) {
        return pair.inertiaA.inverseInertia * p.a * q.a + pair.inertiaB.inverseInertia * p.b * q.b;
    };
    const Real straight = massOf(pair) * lengthSquared(axis);
    line.response = straight + response(line.across, line.across);
    line.own = straight + response(line.along, line.along);
    line.coupled = response(line.along, line.across);
    return line;
}

inline Real speedAcross(const GuidedLine& line, const JointPair& pair) {
    return cross(line.axis, pair.b.velocity - pair.a.velocity) + line.across.b * pair.b.angularVelocity -
           line.across.a * pair.a.angularVelocity;
}
inline Real speedAlong(const GuidedLine& line, const JointPair& pair) {
    return dot(line.axis, pair.b.velocity - pair.a.velocity) + line.along.b * pair.b.angularVelocity -
           line.along.a * pair.a.angularVelocity;
}

inline void push(const JointPair& pair, Vec2 direction, const Spins& row, Real impulse) {
    pair.a.velocity -= (pair.inertiaA.inverseMass * impulse) * direction;
    pair.b.velocity += (pair.inertiaB.inverseMass * impulse) * direction;
    pair.a.angularVelocity -= pair.inertiaA.inverseInertia * row.a * impulse;
    pair.b.angularVelocity += pair.inertiaB.inverseInertia * row.b * impulse;
}
/// @param held  accumulated
inline void pushAcross(Real& held, const GuidedLine& line, const JointPair& pair, Real impulse) {
    held += impulse;
    push(pair, leftPerp(line.axis), line.across, impulse);
}

/// A row that the one across guides: each unit of impulse on it brings `answer` across.
struct GuidedPart {
    Real mass = 0;  ///< impulse per speed; 0 when nothing can move
    Real answer = 0;
};

/// See `Spin` (pin.h), of two held rows. @param inverse  speed per impulse while nothing moves across
/// @param own      speed per impulse, alone
/// @param coupled  of the row on the one across
/// @param given    γ·S of what is across, 1/kg
inline GuidedPart guidedPart(const GuidedLine& line, Real inverse, Real own, Real coupled, Real given) {
    if (!(inverse > 0)) { return {}; }
    if (!(line.response > 0)) { return {1 / inverse, 0}; }
    const Real across = line.response + given;
    return {across / (inverse * line.response + own * given), -coupled / across};
}
inline GuidedPart guidedAlong(const GuidedLine& line, Real given) {
    return guidedPart(line, line.inverseMass, line.own, line.coupled, given);
}

/// Not when a direct solve holds the joint.
inline void solveAcross(const JointConstraint& joint, Real& held, const GuidedLine& line, const JointPair& pair,
                        Real given, bool useBias) {
    const Real across = line.response + given;
    if ((joint.isHeld && useBias) || !(across > 0)) { return; }
    Real wanted = speedAcross(line, pair);
    if (useBias) { wanted += joint.softness.biasRate * line.gap + given * held; }
    pushAcross(held, line, pair, -wanted / across);
}

/// Limits, motor and spring along the axis.
inline void solveAlong(const JointConstraint& joint, FreedomParts& parts, Real& held, const GuidedLine& line,
                       const JointPair& pair, Real given, Real h, bool useBias) {
    const GuidedPart along = guidedAlong(line, given);
    solveFreedom(
        parts, {along.mass, line.place}, passOf(joint, h, useBias), [&] { return speedAlong(line, pair); },
        [&](Real impulse) {
            push(pair, line.axis, line.along, impulse);
            pushAcross(held, line, pair, impulse * along.answer);
        });
}

/// The new push of the spring takes the place of its old impulse. @return what is across answers to the change
inline Real warmStartSpring(FreedomParts& parts, const GuidedLine& line) {
    const Real before = parts.springImpulse;
    const GuidedPart along = guidedAlong(line, 0);
    pushSpring(parts, along.mass, line.place);
    return (parts.springImpulse - before) * along.answer;
}

}  // namespace swept::inline SWEPT_PRECISION
