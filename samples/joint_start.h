#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "scene_description.h"

/// Where joints of a scene begin, for those who do not ask the engine (engine/joint_def.h).

namespace swept {

/// Angle of B beyond that of A at which the angle of a joint is 0, rad. Whole turns by which it begins beyond what it
/// holds are none.
/// @param apart  the angle of B beyond that of A as it begins
template <class Members>
double referenceAngleOf(const Members& joint, double apart) {
    if (!joint.referenceAngle) { return apart; }
    const double now = apart - *joint.referenceAngle;
    double rest = 0;
    if constexpr (requires { joint.angularOffset; }) {
        if (!joint.maxTorque || joint.angularVelocity) { return *joint.referenceAngle; }
        rest = joint.angularOffset.value_or(0);
    } else if constexpr (requires { joint.maxMotorTorque; }) {  // a hinge
        constexpr double kInfinity = std::numeric_limits<double>::infinity();
        rest = std::clamp(now, joint.lower.value_or(-kInfinity), joint.upper.value_or(kInfinity));
    }
    constexpr double kTurn = 2 * std::numbers::pi;
    return *joint.referenceAngle + kTurn * std::round((now - rest) / kTurn);
}

/// B's anchor from A's as the joint begins, along its axis, m.
template <class Members>
double translationAtStart(const Members& joint) {
    const DVec2 apart = joint.anchorB.value_or(joint.anchor) - joint.anchor;
    return dot(joint.axis, apart) / length(joint.axis);
}

}  // namespace swept
