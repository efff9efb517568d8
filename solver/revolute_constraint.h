#pragma once

#include <cstdint>
#include <span>

#include "contact_constraint.h"

namespace swept::inline SWEPT_PRECISION {

/// Two bodies share a point, and may turn about it within limits, against a spring, driven by a motor.
/// Anchors relative to the centres of mass, world orientation, at the start of the step.
struct RevoluteConstraint {
    BodySlot slotA = kFixedSlot;
    BodySlot slotB = kFixedSlot;
    Vec2 anchorA;
    Vec2 anchorB;
    Vec2 centerOffset;    ///< centre of B minus centre of A at the start of the step, metres
    Real baseAngle = 0;   ///< joint angle at the start of the step, rad
    Real lower = 0;       ///< limits of the joint angle, rad
    Real upper = 0;
    Real motorSpeed = 0;  ///< rad/s
    Real maxMotorImpulse = 0;  ///< maximum torque times sub-step, N·m·s
    Softness softness;         ///< of the shared point and the limits
    Softness spring;           ///< towards angle 0
    bool hasLimits = false;
    bool hasMotor = false;
    bool hasSpring = false;
    std::uint32_t source = 0;  ///< the engine's name for the joint
    Real angularMass = 0;      ///< kg·m²
    /// Accumulated; warm start in, result out. N·s and N·m·s per sub-step.
    Vec2 linearImpulse;
    Real lowerImpulse = 0;
    Real upperImpulse = 0;
    Real motorImpulse = 0;
    Real springImpulse = 0;
};

void prepareRevolute(RevoluteConstraint& joint, std::span<const BodyInertia> inertias);
void warmStartRevolutes(std::span<RevoluteConstraint> joints, const SolverBodies& bodies);
/// @param useBias  false: relaxation, only velocities.
void solveRevolutes(std::span<RevoluteConstraint> joints, const SolverBodies& bodies, Real h, bool useBias);

/// Distance between the two anchors now, metres.
Real anchorGap(const RevoluteConstraint& joint, const BodyState& a, const BodyState& b);

}  // namespace swept::inline SWEPT_PRECISION
