#pragma once

#include "../../shapes/status.h"
#include "../state/world_state.h"

/// What the members of joint definitions must be. Each check names the first member that is wrong.

namespace swept::inline SWEPT_PRECISION {

Status checkBase(const WorldState& world, const JointDef& def);
Status checkBreakLimits(const std::optional<Real>& force, const std::optional<Real>& torque);
Status checkSpring(const std::optional<Spring>& spring);
Status checkLimits(const std::optional<AngleLimits>& limits);
Status checkLimits(const std::optional<TranslationLimits>& limits);
Status checkMotor(const std::optional<AngularMotor>& motor);
Status checkMotor(const std::optional<LinearMotor>& motor);
/// A length of 0 is for ropes alone: rods and springs of length 0 have no direction. Within limits
/// neither: going through the anchor it would stop there, undamped too, and around it circle for ever, however damped.
/// A mouse joint does neither.
Status checkLength(Real length, const std::optional<LengthLimits>& limits, const std::optional<Spring>& spring);
/// A direction has a length.
Status checkAxis(DVec2 axis);
Status checkStrength(const std::optional<Real>& strength, const char* field);
Status checkDrive(const MotorDrive& drive);
Status checkRatio(Real ratio);

// Of what a definition says of more than where the joint is: limits, motors, springs, strengths, ratios.
Status checkParts(const RevoluteJointDef& def);
/// @param length  where `def` has none
Status checkParts(const DistanceJointDef& def, Real length);
Status checkParts(const PrismaticJointDef& def);
Status checkParts(const WheelJointDef& def);
Status checkParts(const WeldJointDef& def);
Status checkParts(const MotorJointDef& def);
Status checkParts(const MouseJointDef& def);
Status checkParts(const GearJointDef& def);
Status checkParts(const PulleyJointDef& def);

}  // namespace swept::inline SWEPT_PRECISION
