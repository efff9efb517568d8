#include "joint_turns.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <variant>

namespace swept::inline SWEPT_PRECISION {
namespace {

using MotorPart = JointPart<MotorJointDef, MotorConstraint>;

/// Of the angles at which a joint lets its bodies rest the one nearest to theirs, rad. Where it has none, 0.
double restAngleOf(const Joint& joint, double angle) {
    if (const auto* const hinge = std::get_if<HingePart>(&joint.parts); hinge != nullptr && hinge->def.limits) {
        const AngleLimits& limits = *hinge->def.limits;
        return std::clamp(angle, static_cast<double>(limits.lower), static_cast<double>(limits.upper));
    }
    if (const auto* const motor = std::get_if<MotorPart>(&joint.parts)) {
        return static_cast<double>(motor->def.drive.angularOffset.value_or(0));
    }
    return 0;
}

}  // namespace

bool mayTurnOn(const Joint& joint) {
    if (const auto* const hinge = std::get_if<HingePart>(&joint.parts)) { return !hinge->def.limits; }
    if (const auto* const motor = std::get_if<MotorPart>(&joint.parts)) {
        return !motor->def.drive.maxTorque || motor->def.drive.angularVelocity;
    }
    return joint.type() == JointType::wheel;
}

double turnsOff(const Joint& joint, double angle) {
    constexpr double kTurn = 2 * std::numbers::pi;
    return kTurn * std::round((angle - restAngleOf(joint, angle)) / kTurn);
}

}  // namespace swept::inline SWEPT_PRECISION
