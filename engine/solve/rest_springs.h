#pragma once

#include "../state/world_state.h"

namespace swept::inline SWEPT_PRECISION {

/// Springs of fixed stiffness (`TurningSpring`): that with which they swing at their hertz as the joint was made, with
/// the masses that the bodies have now. @param h  length of a sub-step, s

/// What is moved along the rod as the joint was made, kg.
Real rodMassOf(const WorldState& world, const Joint& joint);
TurningSpring rodSpringOf(const WorldState& world, const Joint& joint, const Spring& spring, Real h);
TurningSpring wheelSpringOf(const WorldState& world, const Joint& joint, const Spring& spring, Real h);
/// Of a slider what moves along the axis is the same wherever it stands.
TurningSpring sliderSpringOf(const WorldState& world, const Joint& joint, const Spring& spring, Real h);
/// @param isAngleHeld  rigidly
/// @param turnOfA      how A stands
PointSpring pointSpringOf(const WorldState& world, const Joint& joint, const Spring& spring, Real h, bool isAngleHeld,
                          Rotation turnOfA);

/// Where the spring of a hinge, slider or wheel pulls to, rad or metres. Joints are solved in coordinates in which that
/// is 0.
template <class Def>
Real springTargetOf(const Def& def) {
    return def.spring ? def.springTarget : Real(0);
}

/// Of what has its hertz with whatever it moves.
SpringGains gainsOf(const Spring& spring, Real h);
/// What has its hertz with that mass, or moment of inertia.
TurningSpring turningSpring(const Spring& spring, Real h, Real mass);
/// As solves have it.
BodyInertia inertiaOf(const WorldState& world, std::uint32_t body);

}  // namespace swept::inline SWEPT_PRECISION
