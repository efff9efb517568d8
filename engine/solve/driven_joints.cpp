#include "driven_joints.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "../state/tolerances.h"
#include "energy_gain.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// A rod closes a quarter of its gap in a step: then a hundredth is left.
constexpr int kDrivenSteps = 16;

/// Farther than a slow body moves in a step: nobody is pulled like that, but put elsewhere.
bool isYank(const WorldState& world, const Joint& joint, Real moved) {
    Real smallest = std::numeric_limits<Real>::infinity();
    for (const std::uint32_t slot : joint.allBodies()) {
        const Body& body = world.bodies[slot];
        if (body.isDynamic() && body.extent > 0) { smallest = std::min(smallest, body.extent); }
    }
    return moved > kFastRatio * smallest;
}

/// Of a mouse joint; null of others.
MouseConstraint* mouseOf(Joint& joint) {
    auto* const part = std::get_if<JointPart<MouseJointDef, MouseConstraint>>(&joint.parts);
    return part == nullptr ? nullptr : &part->memory;
}

/// The accounts of what the joint ties, as far as they are of the present solve.
void tell(WorldState& world, const DrivenJoint& driven, const SolveDesk& desk) {
    const Joint* const joint = world.joints.find(driven.joint);
    if (joint == nullptr) { return; }
    for (const std::uint32_t slot : joint->allBodies()) {
        if (!world.bodies[slot].isDynamic()) { continue; }
        EnergyAccount& account = accountOf(world, slot);
        if (account.solve != desk.energySolve) { continue; }
        if (driven.isYank) {
            account.isYanked = true;
        } else {
            account.isLed = true;
            account.leadSpeed = std::max(account.leadSpeed, static_cast<double>(driven.speed));
        }
    }
}

}  // namespace

void noteDriven(WorldState& world, JointId joint, Real moved) {
    if (!(moved > 0)) { return; }
    Joint& held = *world.joints.find(joint);
    const bool yanks = isYank(world, held, moved);
    if (held.driven == kNotDriven) {
        world.drivenJoints.push_back({joint, kDrivenSteps, yanks, moved});
        held.driven = static_cast<std::uint32_t>(world.drivenJoints.size() - 1);
    } else {
        DrivenJoint& noted = world.drivenJoints[held.driven];
        noted = {joint, kDrivenSteps, noted.isYank || yanks, noted.toGo + moved, noted.speed};
    }
}

void beginDriven(WorldState& world, double dt) {
    for (DrivenJoint& driven : world.drivenJoints) {
        driven.speed = std::max(driven.speed, std::exchange(driven.toGo, Real(0)) / static_cast<Real>(dt));
        Joint* const joint = world.joints.find(driven.joint);
        MouseConstraint* const mouse = joint == nullptr ? nullptr : mouseOf(*joint);
        if (mouse != nullptr) { mouse->pace = (1 / static_cast<Real>(dt)) * mouse->toGo; }
    }
}

void endDriven(WorldState& world) {
    std::uint32_t kept = 0;
    for (DrivenJoint& driven : world.drivenJoints) {
        Joint* const joint = world.joints.find(driven.joint);
        if (joint == nullptr) { continue; }
        if (MouseConstraint* const mouse = mouseOf(*joint)) { mouse->toGo = mouse->pace = {}; }
        joint->driven = kNotDriven;
        if (--driven.stepsLeft == 0) { continue; }
        joint->driven = kept;
        world.drivenJoints[kept++] = driven;
    }
    world.drivenJoints.resize(kept);
}

Real woundSpeed(const WorldState& world, std::uint32_t joint) {
    const std::uint32_t place = world.joints[joint].driven;
    if (place == kNotDriven || world.drivenJoints[place].isYank) { return 0; }
    return world.drivenJoints[place].speed;
}

void noteDriven(WorldState& world, const TiedGroup& group) {
    const std::vector<DrivenJoint>& all = world.drivenJoints;
    if (group.role == BodyRole::solved || all.size() <= group.bodies.size()) {
        for (const DrivenJoint& driven : all) { tell(world, driven, group.desk); }
        return;
    }
    // Of an island that advances by itself, all of whose bodies are in the group: there may be thousands of these.
    for (const std::uint32_t slot : group.bodies) {
        for (const std::uint32_t index : world.bodies[slot].joints) {
            const std::uint32_t place = world.joints[index].driven;
            if (place != kNotDriven) { tell(world, all[place], group.desk); }
        }
    }
}

}  // namespace swept::inline SWEPT_PRECISION
