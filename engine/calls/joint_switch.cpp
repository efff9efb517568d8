#include "joint_switch.h"

#include <variant>

#include "../bodies/awake.h"
#include "../bodies/body_joints.h"
#include "../bodies/levers.h"
#include "../solve/joint_place.h"
#include "../solve/joint_results.h"
#include "../solve/joint_tie.h"
#include "../state/number_range.h"
#include "joint_turns.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

using GearPart = JointPart<GearJointDef, GearConstraint>;

void setConstant(Joint& gear, double constant) {
    if (isInRange(constant)) { gear.gearConstant = constant; }
}

/// The same place of a hinge counts as another angle from now on: gears on it that hold meanwhile have their error as
/// before. (Those that do not begin anew when they do.) @param less  by so much, rad
void recountGears(WorldState& world, JointId hinge, double less) {
    const Joint& joint = world.joints[hinge.index];
    for (const std::uint32_t slot : fewerJoints(world, joint.bodyA, joint.bodyB)) {
        Joint& gear = world.joints[slot];
        const auto* const part = std::get_if<GearPart>(&gear.parts);
        if (part == nullptr) { continue; }
        if (part->def.jointA == hinge) { setConstant(gear, gear.gearConstant - less); }
        if (part->def.jointB == hinge) {
            setConstant(gear, gear.gearConstant - static_cast<double>(part->def.ratio) * less);
        }
    }
}

/// A joint takes hold of its bodies as they are by then: nothing is turned back by whole turns, and a gear goes on from
/// where its wheels are.
void takeHold(WorldState& world, std::uint32_t slot) {
    Joint& joint = world.joints[slot];
    const double turns = turnsOff(joint, angleOf(world, joint));
    joint.referenceAngle += turns;
    if (turns != 0 && joint.type() == JointType::revolute) { recountGears(world, world.joints.idOf(slot), turns); }
    const auto* const gear = std::get_if<GearPart>(&joint.parts);
    if (gear == nullptr) { return; }
    setConstant(joint,
                coordinateOf(world, world.joints[gear->def.jointA.index]) +
                    static_cast<double>(gear->def.ratio) * coordinateOf(world, world.joints[gear->def.jointB.index]));
}

void switchJoint(WorldState& world, std::uint32_t slot) {
    Joint& joint = world.joints[slot];
    const bool isOff = !canHold(world, joint);
    if (isOff == joint.isOff) { return; }
    const bool held = joint.holds();
    joint.isOff = isOff;
    forgetImpulses(joint);
    if (!isOff) { takeHold(world, slot); }
    world.jointTies[slot] = tieOf(joint);
    world.jointChains.areCurrent = false;
    for (const std::uint32_t body : joint.allBodies()) {
        world.bodies[body].holdingJoints += joint.holds() ? 1 : 0;
        world.bodies[body].holdingJoints -= held ? 1 : 0;
        rouse(world, body);
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
