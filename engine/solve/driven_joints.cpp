#include "driven_joints.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>

#include "../state/tolerances.h"
#include "energy_gain.h"
#include "joint_builder.h"
#include "joint_place.h"
#include "torn_joints.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// A rod closes a quarter of its gap in a step: then a hundredth is left.
constexpr int kDrivenSteps = 16;

/// Of the dynamic bodies of a joint; infinite without any.
Real smallestOf(const WorldState& world, const Joint& joint, Real Body::*size) {
    Real smallest = std::numeric_limits<Real>::infinity();
    for (const std::uint32_t slot : joint.allBodies()) {
        const Body& body = world.bodies[slot];
        if (body.isDynamic() && body.*size > 0) { smallest = std::min(smallest, body.*size); }
    }
    return smallest;
}

/// Farther than a slow body moves in a step: nobody is pulled like that, but put elsewhere.
bool isYank(const WorldState& world, const Joint& joint, Real moved) {
    return moved > kFastRatio * smallestOf(world, joint, &Body::extent);
}

/// Metres that a joint has to close, of angles those at the rim of the larger body.
Real gapOfPut(const WorldState& world, const Joint& joint) {
    const JointErrors errors = errorsOf(world, joint);
    const JointErrors limits = limitErrorsOf(world, joint);
    const auto radiusOf = [&world](std::uint32_t slot) {
        return world.bodies[slot].isDynamic() ? world.bodies[slot].radius : Real(0);
    };
    const Real radius = std::max(radiusOf(joint.bodyA), radiusOf(joint.bodyB));
    return std::max(errors.length, limits.length) + radius * std::max(errors.angle, limits.angle);
}

/// Of a mouse joint; null of others.
MouseConstraint* mouseOf(Joint& joint) {
    auto* const part = std::get_if<JointPart<MouseJointDef, MouseConstraint>>(&joint.parts);
    return part == nullptr ? nullptr : &part->memory;
}

/// Of two speeds the one that both reach.
Real lesserOf(Real a, Real b) {
    if (!(a * b > 0)) { return 0; }
    return std::fabs(a) < std::fabs(b) ? a : b;
}

/// What goes on as it did in the step before has a pace. What is set elsewhere once draws its bodies after it, and
/// leaves them no speed; and so does what goes farther in a step than its bodies are wide. What jumps does not glide,
/// either.
void findMotion(DrivenJoint& driven, const WorldState& world, const Joint& joint, Real dt) {
    const std::array<Real, 2> before = driven.speedBefore;
    for (std::size_t i = 0; i < before.size(); ++i) {
        driven.speedBefore[i] = std::exchange(driven.way[i], Real(0)) / dt;
    }
    const auto& now = driven.speedBefore;
    LimitPace pace{lesserOf(now[0], before[0]), lesserOf(now[1], before[1])};
    const auto speedOf = [&](const LimitPace& of) {
        return driven.lever * std::max(std::fabs(of.lower), std::fabs(of.upper));
    };
    if (pace.any() && dt * speedOf(pace) > 2 * smallestOf(world, joint, &Body::radius)) { pace = {}; }
    driven.paceSpeed = speedOf(pace);
    // What the limits carry along is where its spring pulls to without being pulled.
    const Real carried = dt * driven.paceSpeed;
    const bool yanks = isYank(world, joint, std::exchange(driven.jump, Real(0)) - carried);
    const bool springYanks = isYank(world, joint, std::exchange(driven.springJump, Real(0)) - carried);
    driven.motion = {yanks ? pace : LimitPace{now[0], now[1]}, pace};
    if (yanks || springYanks) {
        driven.isYank = true;
        driven.isStuck = false;
    }
}

/// Whether a yank left a gap so wide that it tears: it should have been closed by now. (A mouse has its own rule.)
bool isTornApart(const WorldState& world, const Joint& joint) {
    if (joint.type() == JointType::mouse) { return false; }
    const JointErrors errors = errorsOf(world, joint);
    const JointErrors limits = limitErrorsOf(world, joint);
    return errorRatio(world, joint, {std::max(errors.length, limits.length), 0}) > kTornPull ||
           std::max(errors.angle, limits.angle) > kMostTwist;
}

/// Of what follows a target it is known what it did (motor_work.h).
bool isAccounted(const Joint& joint) { return joint.type() == JointType::mouse || joint.type() == JointType::motor; }

/// The accounts of what the joint ties, as far as they are of the present solve.
void tell(WorldState& world, const DrivenJoint& driven, const SolveDesk& desk) {
    const Joint* const joint = world.joints.find(driven.joint);
    if (joint == nullptr) { return; }
    for (const std::uint32_t slot : joint->allBodies()) {
        if (!world.bodies[slot].isDynamic()) { continue; }
        EnergyAccount& account = accountOf(world, slot);
        if (account.solve != desk.energySolve) { continue; }
        account.isYanked = account.isYanked || driven.isYank;
        const Real speed = woundSpeed(driven);
        if (isAccounted(*joint) || !(speed > 0)) { continue; }
        account.isLed = true;
        account.leadSpeed = std::max(account.leadSpeed, static_cast<double>(speed));
    }
}

DrivenJoint& entryOf(WorldState& world, JointId joint) {
    Joint& held = *world.joints.find(joint);
    if (held.driven == kNotDriven) {
        held.driven = static_cast<std::uint32_t>(world.drivenJoints.size());
        world.drivenJoints.push_back({.joint = joint});
    }
    return world.drivenJoints[held.driven];
}

DrivenJoint& noted(WorldState& world, JointId joint) {
    DrivenJoint& driven = entryOf(world, joint);
    driven.stepsLeft = kDrivenSteps;
    return driven;
}

/// What was put without a gap is no move: without another one the joint is as if it had not been noted. What is off
/// waits until it is on.
void findYank(DrivenJoint& driven, const WorldState& world, Joint& joint) {
    if (joint.isOff) {
        driven.stepsLeft = std::max(driven.stepsLeft, 2);
        return;
    }
    driven.isPut = false;
    if (isYank(world, joint, gapOfPut(world, joint))) {
        driven.isYank = true;
        driven.isStuck = false;
        driven.stepsLeft = kDrivenSteps;
    } else if (driven.stepsLeft <= 1 && !driven.isStuck) {
        driven.stepsLeft = 1;  // it ends with this step
        joint.driven = kNotDriven;
    }
}

}  // namespace

void noteDriven(WorldState& world, JointId joint, const DrivenMove& move) {
    if (!(move.farthest > 0)) { return; }
    DrivenJoint& driven = noted(world, joint);
    if (!std::isfinite(move.farthest)) { driven.way = driven.speedBefore = {}; }  // these may be other limits
    driven.toGo += move.farthest;
    driven.jump = std::max(driven.jump, move.farthest);
    driven.lever = move.lever;
    for (std::size_t i = 0; i < driven.way.size(); ++i) { driven.way[i] += move.way[i]; }
}

void noteSpringDriven(WorldState& world, JointId joint, Real farthest) {
    if (!(farthest > 0)) { return; }
    DrivenJoint& driven = noted(world, joint);
    driven.springToGo += farthest;
    driven.springJump = std::max(driven.springJump, farthest);
}

void notePut(WorldState& world, JointId joint) { entryOf(world, joint).isPut = true; }

void beginDriven(WorldState& world, double dt) {
    const auto step = static_cast<Real>(dt);
    for (DrivenJoint& driven : world.drivenJoints) {
        // The limits and the spring draw at the same bodies: these get there with the faster one, not with both.
        const Real farthest = std::max(std::exchange(driven.toGo, Real(0)), std::exchange(driven.springToGo, Real(0)));
        driven.speed = std::max(driven.speed, farthest / step);
        Joint* const joint = world.joints.find(driven.joint);
        if (joint == nullptr) { continue; }
        if (MouseConstraint* const mouse = mouseOf(*joint)) { mouse->pace = (1 / step) * mouse->toGo; }
        findMotion(driven, world, *joint, step);
        if (driven.isPut) { findYank(driven, world, *joint); }
        if (driven.motion.glide.any()) { world.jointTies[driven.joint.index].hingeParts.isGliding = true; }
    }
}

void endDriven(WorldState& world) {
    world.anyStuck = false;
    std::uint32_t kept = 0;
    for (DrivenJoint& driven : world.drivenJoints) {
        Joint* const joint = world.joints.find(driven.joint);
        if (joint == nullptr) { continue; }
        if (MouseConstraint* const mouse = mouseOf(*joint)) { mouse->toGo = mouse->pace = {}; }
        world.jointTies[driven.joint.index].hingeParts.isGliding = false;
        driven.motion = {};
        driven.paceSpeed = 0;
        joint->driven = kNotDriven;
        if (--driven.stepsLeft == 0) {
            const bool mayBeStuck = driven.isYank || driven.isStuck;
            if (!mayBeStuck || !isTornApart(world, *joint)) { continue; }
            if (driven.isStuck || isTouching(world, *joint)) {
                driven = {.joint = driven.joint, .stepsLeft = 1, .isStuck = true};
            } else {
                driven.stepsLeft = 1;  // nothing is in the way: it is drawn on
            }
        }
        world.anyStuck = world.anyStuck || driven.isStuck;
        joint->driven = kept;
        world.drivenJoints[kept++] = driven;
    }
    world.drivenJoints.resize(kept);
}

const DrivenJoint* drivenOf(const WorldState& world, const Joint& joint) {
    return joint.driven == kNotDriven ? nullptr : &world.drivenJoints[joint.driven];
}

Real woundSpeed(const DrivenJoint& driven) { return driven.isYank ? driven.paceSpeed : driven.speed; }

void markDrivenAccounts(WorldState& world, const TiedGroup& group) {
    const std::vector<DrivenJoint>& all = world.drivenJoints;
    if (group.role == BodyRole::solved) {
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
