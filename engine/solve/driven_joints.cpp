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

}  // namespace

void noteDriven(WorldState& world, JointId joint, Real moved) {
    if (!(moved > 0)) { return; }
    const bool yanks = isYank(world, *world.joints.find(joint), moved);
    const auto noted = std::find_if(world.drivenJoints.begin(), world.drivenJoints.end(),
                                    [joint](const DrivenJoint& driven) { return driven.joint == joint; });
    if (noted == world.drivenJoints.end()) {
        world.drivenJoints.push_back({joint, kDrivenSteps, yanks, moved});
    } else {
        *noted = {joint, kDrivenSteps, noted->isYank || yanks, noted->toGo + moved, noted->speed};
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
    std::erase_if(world.drivenJoints, [&world](DrivenJoint& driven) {
        Joint* const joint = world.joints.find(driven.joint);
        if (joint == nullptr) { return true; }
        if (MouseConstraint* const mouse = mouseOf(*joint)) { mouse->toGo = mouse->pace = {}; }
        return --driven.stepsLeft == 0;
    });
}

Real woundSpeed(const WorldState& world, std::uint32_t joint) {
    const auto noted =
        std::find_if(world.drivenJoints.begin(), world.drivenJoints.end(),
                     [joint](const DrivenJoint& driven) { return driven.joint.index == joint && !driven.isYank; });
    return noted == world.drivenJoints.end() ? Real(0) : noted->speed;
}

void noteDriven(WorldState& world, const TiedGroup& group) {
    for (const DrivenJoint& driven : world.drivenJoints) {
        const Joint* const joint = world.joints.find(driven.joint);
        if (joint == nullptr) { continue; }
        for (const std::uint32_t slot : joint->allBodies()) {
            if (!world.bodies[slot].isDynamic()) { continue; }
            EnergyAccount& account = accountOf(world, slot);
            if (account.solve != group.desk.energySolve) { continue; }
            if (driven.isYank) {
                account.isYanked = true;
            } else {
                account.isLed = true;
                account.leadSpeed = std::max(account.leadSpeed, static_cast<double>(driven.speed));
            }
        }
    }
}

}  // namespace swept::inline SWEPT_PRECISION
