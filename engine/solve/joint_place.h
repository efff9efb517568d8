#pragma once

#include "../state/world_state.h"

/// Where a joint stands at the present poses, and how far from where it should.

namespace swept::inline SWEPT_PRECISION {

/// Of a point of a body (its frame), from the centre of mass, world.
inline Vec2 armOf(const WorldState& world, std::uint32_t body, Vec2 localAnchor) {
    return rotate(world.motions[body].pose.rotation, localAnchor - world.bodies[body].localCenter);
}
/// From A's centre of mass to B's.
inline Vec2 centerOffset(const WorldState& world, const Joint& joint) {
    return toReal(world.motions[joint.bodyB].center - world.motions[joint.bodyA].center);
}
inline Vec2 axisOf(const WorldState& world, const Joint& joint) {
    return rotate(world.motions[joint.bodyA].pose.rotation, joint.localAxis);
}

/// How far a joint is from holding at the present poses: metres, radians. What it does not hold has no error.
struct JointErrors {
    Real length = 0;
    Real angle = 0;
};
/// How far a hinge, slider or wheel is beyond its limits. (A distance joint that is has an error.)
JointErrors limitErrorsOf(const WorldState& world, const Joint& joint);

/// Angle of B relative to A beyond that of reference, rad.
double angleOf(const WorldState& world, const Joint& joint);
/// Of B's anchor from A's: along the axis where there is one, else the distance. Metres.
Real translationOf(const WorldState& world, const Joint& joint);
/// In which that is measured, world, unit; (0, 0) where the anchors of a joint without an axis coincide.
Vec2 directionOf(const WorldState& world, const Joint& joint);
/// Where on A and B it holds now, world; of a mouse joint the target, for A.
DVec2 anchorAOf(const WorldState& world, const Joint& joint);
DVec2 anchorBOf(const WorldState& world, const Joint& joint);
/// What a gear sees of a revolute or prismatic joint, rad or metres.
double coordinateOf(const WorldState& world, const Joint& joint);

}  // namespace swept::inline SWEPT_PRECISION
