#include "joint_switch.h"

#include <cmath>
#include <numbers>
#include <variant>

#include "../islands/levers.h"
#include "../solve/joint_builder.h"
#include "../state/number_range.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// A joint takes hold of its bodies as they are by then: nothing is turned back by whole turns, and a gear goes on from
/// where its wheels are.
void takeHold(const WorldState& world, Joint& joint) {
    constexpr double kTurn = 2 * std::numbers::pi;
    joint.referenceAngle += kTurn * std::round(angleOf(world, joint) / kTurn);
    const auto* const gear = std::get_if<JointPart<GearJointDef, GearConstraint>>(&joint.parts);
    if (gear == nullptr) { return; }
    const double constant =
        coordinateOf(world, world.joints[gear->def.jointA.index]) +
        static_cast<double>(gear->def.ratio) * coordinateOf(world, world.joints[gear->def.jointB.index]);
    if (isInRange(constant)) { joint.gearConstant = constant; }
}

void switchJoint(WorldState& world, std::uint32_t slot) {
    Joint& joint = world.joints[slot];
    const bool isOff = !canHold(world, joint);
    if (isOff == joint.isOff) { return; }
    const bool held = joint.holds();
    joint.isOff = isOff;
    forgetImpulses(joint);
    if (!isOff) { takeHold(world, joint); }
    world.jointTies[slot] = tieOf(joint);
    world.jointChains.areCurrent = false;
    for (const std::uint32_t body : joint.allBodies()) {
        world.bodies[body].holdingJoints += joint.holds() ? 1 : 0;
        world.bodies[body].holdingJoints -= held ? 1 : 0;
        wake(world, body);
    }
}

}  // namespace

/// A hub may have thousands.
void switchJoints(WorldState& world, std::uint32_t body) {
    for (const std::uint32_t slot : world.bodies[body].joints) {
        switchJoint(world, slot);
        for (const std::uint32_t other : world.joints[slot].allBodies()) {
            if (other != body) { resistTurns(world, other); }
        }
    }
    resistTurns(world, body);
}

}  // namespace swept::inline SWEPT_PRECISION
