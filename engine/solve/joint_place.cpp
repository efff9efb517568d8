#include "joint_place.h"

#include <algorithm>
#include <optional>

namespace swept::inline SWEPT_PRECISION {
namespace {

bool hasAxis(const Joint& joint) { return joint.type() == JointType::prismatic || joint.type() == JointType::wheel; }

}  // namespace

double angleOf(const WorldState& world, const Joint& joint) {
    return world.motions[joint.bodyB].angle - world.motions[joint.bodyA].angle - joint.referenceAngle;
}

DVec2 anchorAOf(const WorldState& world, const Joint& joint) {
    if (const auto* part = std::get_if<JointPart<MouseJointDef, MouseConstraint>>(&joint.parts)) {
        return part->def.target;
    }
    return apply(world.motions[joint.bodyA].pose, joint.localAnchorA);
}

DVec2 anchorBOf(const WorldState& world, const Joint& joint) {
    return apply(world.motions[joint.bodyB].pose, joint.localAnchorB);
}

Real translationOf(const WorldState& world, const Joint& joint) {
    if (joint.type() == JointType::mouse) {
        return static_cast<Real>(length(anchorBOf(world, joint) - anchorAOf(world, joint)));
    }
    const Vec2 apart = centerOffset(world, joint) + armOf(world, joint.bodyB, joint.localAnchorB) -
                       armOf(world, joint.bodyA, joint.localAnchorA);
    return hasAxis(joint) ? dot(axisOf(world, joint), apart) : length(apart);
}

Vec2 directionOf(const WorldState& world, const Joint& joint) {
    if (hasAxis(joint)) { return axisOf(world, joint); }
    return normalized(toReal(anchorBOf(world, joint) - anchorAOf(world, joint))).unit;
}

double coordinateOf(const WorldState& world, const Joint& joint) {
    return joint.type() == JointType::prismatic ? static_cast<double>(translationOf(world, joint))
                                                : angleOf(world, joint);
}

JointErrors limitErrorsOf(const WorldState& world, const Joint& joint) {
    const auto beyond = [](double coordinate, const auto& limits) {
        if (!limits) { return Real(0); }
        const double below = static_cast<double>(limits->lower) - coordinate;
        const double above = coordinate - static_cast<double>(limits->upper);
        return static_cast<Real>(std::max({below, above, 0.0}));
    };
    if (const auto* hinge = std::get_if<HingePart>(&joint.parts)) {
        return {0, beyond(angleOf(world, joint), hinge->def.limits)};
    }
    const auto slid = static_cast<double>(translationOf(world, joint));
    if (const auto* slider = std::get_if<JointPart<PrismaticJointDef, PrismaticConstraint>>(&joint.parts)) {
        return {beyond(slid, slider->def.limits), 0};
    }
    if (const auto* wheel = std::get_if<JointPart<WheelJointDef, WheelConstraint>>(&joint.parts)) {
        return {beyond(slid, wheel->def.limits), 0};
    }
    return {};
}

}  // namespace swept::inline SWEPT_PRECISION
