#include <algorithm>
#include <cmath>
#include <optional>

#include "../../shapes/room.h"
#include "../bodies/awake.h"
#include "../bodies/body_joints.h"
#include "../bodies/levers.h"
#include "../contacts/pairs_of_shapes.h"
#include "../solve/joint_builder.h"
#include "../solve/joint_tie.h"
#include "../state/number_range.h"
#include "../state/world_state.h"
#include "../world.h"
#include "joint_checks.h"
#include "joint_turns.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Where a joint takes hold of its bodies, in world coordinates.
struct Grip {
    DVec2 anchorA;
    DVec2 anchorB;
    DVec2 axis{};
    std::optional<double> referenceAngle{};
};

/// @pre its numbers are good
template <class Def>
Grip gripOf(const Def& def, DVec2 axis = {}) {
    return {def.anchor, def.anchorB.value_or(def.anchor), axis, def.referenceAngle};
}

Status checkReference(const std::optional<double>& angle) { return checkNumber(angle.value_or(0), "referenceAngle"); }

template <class Def>
Status checkGrip(const Def& def) {
    return firstFault({checkNumber(def.anchor, "anchor"), checkNumber(def.anchorB.value_or(DVec2{}), "anchorB"),
                       checkReference(def.referenceAngle)});
}

/// A joint whose angle is 0 elsewhere than where its bodies are now. Where it holds the angle it holds it there: so
/// does what its springs turn.
void refer(Joint& joint, double angle) {
    const double now = joint.referenceAngle - angle;
    joint.localAxisB = unrotate(rotationFromAngle(angle), joint.localAxis);
    joint.referenceAngle = angle + (mayTurnOn(joint) ? 0 : turnsOff(joint, now));
}

Joint jointOf(const WorldState& world, const JointDef& base, JointParts parts, const Grip& grip) {
    Joint joint;
    joint.base = base;
    joint.parts = std::move(parts);
    joint.bodyA = base.bodyA.index;
    joint.bodyB = base.bodyB.index;
    joint.bodies = {joint.bodyA, joint.bodyB, 0, 0};
    joint.bodyCount = 2;
    const WorldTransform& poseA = world.motions[joint.bodyA].pose;
    joint.localAnchorA = applyInverse(poseA, grip.anchorA);
    joint.localAnchorB = applyInverse(world.motions[joint.bodyB].pose, grip.anchorB);
    // A long axis is shortened before it is squared, by a power of two so that no digit is lost.
    const double size = std::max(std::fabs(grip.axis.x), std::fabs(grip.axis.y));
    const int digits = size > 0 ? std::ilogb(size) : 0;
    const DVec2 axis{std::ldexp(grip.axis.x, -digits), std::ldexp(grip.axis.y, -digits)};
    const Vec2 unit = size > 0 ? normalized(toReal(axis)).unit : Vec2{1, 0};
    joint.localAxis = unrotate(poseA.rotation, unit);
    joint.localAxisB = unrotate(world.motions[joint.bodyB].pose.rotation, unit);
    joint.referenceAngle = world.motions[joint.bodyB].angle - world.motions[joint.bodyA].angle;
    if (grip.referenceAngle) { refer(joint, *grip.referenceAngle); }
    return joint;
}

/// All that may fail when memory runs out, before a joint is made.
/// @param pairs  whose end it may report
void makeRoomForJoint(WorldState& world, const Joint& joint, std::size_t pairs) {
    world.joints.makeRoomForOne();
    makeRoom(world.jointTies, world.joints.slotsWithOneMore());
    for (const std::uint32_t body : joint.allBodies()) {
        std::vector<std::uint32_t>& joints = world.bodies[body].joints;
        makeRoom(joints, joints.size() + 1);
    }
    makeRoom(world.newJoints, world.newJoints.size() + 1);
    makeRoomToWake(world);
    makeRoom(world.eventsToCome, world.eventsToCome.size() + pairs);
}

Result<JointId> insert(WorldState& world, Joint joint) {
    std::span<const std::uint32_t> pairs;
    if (joint.keepsApart()) { pairs = pairsBetween(world, joint); }
    makeRoomForJoint(world, joint, pairs.size());
    joint.isOff = !canHold(world, joint);
    const std::optional<JointId> id = world.joints.insert(std::move(joint));
    if (!id) { return Status{StatusCode::noIdsLeft, "joint"}; }
    const Joint& placed = world.joints[id->index];
    world.jointTies.resize(world.joints.slotCount());
    world.jointTies[id->index] = tieOf(placed);
    world.jointChains.areCurrent = false;
    world.newJoints.push_back(*id);
    for (const std::uint32_t body : placed.allBodies()) {
        world.bodies[body].joints.push_back(id->index);
        world.bodies[body].holdingJoints += placed.holds() ? 1 : 0;
        resistTurns(world, body, placed);
        rouse(world, body);
    }
    removePairs(world, pairs);
    return *id;
}

/// Only a joint with one coordinate can be geared.
Status checkGeared(const WorldState& world, JointId id, const char* field) {
    const Joint* joint = world.joints.find(id);
    if (joint == nullptr) { return {StatusCode::staleId, field}; }
    const bool hasCoordinate = joint->type() == JointType::revolute || joint->type() == JointType::prismatic;
    return hasCoordinate ? Status::success() : Status{StatusCode::wrongJointType, field};
}

void addBody(Joint& gear, std::uint32_t body) {
    const auto all = gear.allBodies();
    if (std::find(all.begin(), all.end(), body) == all.end()) { gear.bodies[gear.bodyCount++] = body; }
}

}  // namespace

Result<JointId> World::createJoint(const RevoluteJointDef& def) {
    WorldState& world = *state_;
    const Status status = firstFault({checkBase(world, def.base), checkParts(def), checkGrip(def)});
    if (!status.ok()) { return status; }
    const HingePart part{def};
    return insert(world, jointOf(world, def.base, part, gripOf(def)));
}

Result<JointId> World::createJoint(const DistanceJointDef& def) {
    WorldState& world = *state_;
    const Status points = firstFault({checkNumber(def.anchorA, "anchorA"), checkNumber(def.anchorB, "anchorB")});
    if (!points.ok()) { return points; }
    const Real length = def.length.value_or(static_cast<Real>(swept::length(def.anchorB - def.anchorA)));
    const Status status = firstFault({checkBase(world, def.base), checkParts(def, length)});
    if (!status.ok()) { return status; }
    const JointPart<DistanceJointDef, DistanceConstraint> part{def, {}};
    Joint joint = jointOf(world, def.base, part, {def.anchorA, def.anchorB, def.anchorB - def.anchorA});
    joint.length = length;
    return insert(world, std::move(joint));
}

Result<JointId> World::createJoint(const PrismaticJointDef& def) {
    WorldState& world = *state_;
    const Status status =
        firstFault({checkBase(world, def.base), checkParts(def), checkGrip(def), checkAxis(def.axis)});
    if (!status.ok()) { return status; }
    const JointPart<PrismaticJointDef, PrismaticConstraint> part{def, {}};
    return insert(world, jointOf(world, def.base, part, gripOf(def, def.axis)));
}

Result<JointId> World::createJoint(const WheelJointDef& def) {
    WorldState& world = *state_;
    const Status status =
        firstFault({checkBase(world, def.base), checkParts(def), checkGrip(def), checkAxis(def.axis)});
    if (!status.ok()) { return status; }
    const JointPart<WheelJointDef, WheelConstraint> part{def, {}};
    return insert(world, jointOf(world, def.base, part, gripOf(def, def.axis)));
}

Result<JointId> World::createJoint(const WeldJointDef& def) {
    WorldState& world = *state_;
    const Status status = firstFault({checkBase(world, def.base), checkParts(def), checkGrip(def)});
    if (!status.ok()) { return status; }
    const JointPart<WeldJointDef, WeldConstraint> part{def, {}};
    return insert(world, jointOf(world, def.base, part, gripOf(def)));
}

Result<JointId> World::createJoint(const MotorJointDef& def) {
    WorldState& world = *state_;
    const Status status = firstFault({checkBase(world, def.base), checkParts(def), checkReference(def.referenceAngle)});
    if (!status.ok()) { return status; }
    const DVec2 origin = world.motions[def.base.bodyB.index].pose.position;
    const JointPart<MotorJointDef, MotorConstraint> part{def, {}};
    return insert(world, jointOf(world, def.base, part, {origin, origin, {}, def.referenceAngle}));
}

Result<JointId> World::createJoint(const MouseJointDef& def) {
    WorldState& world = *state_;
    const DVec2 anchor = def.anchor.value_or(def.target);
    const Status status = firstFault({checkBase(world, def.base), checkParts(def), checkNumber(anchor, "anchor")});
    if (!status.ok()) { return status; }
    if (!world.bodies[def.base.bodyB.index].isDynamic()) { return Status{StatusCode::wrongBodyType, "bodyB"}; }
    const JointPart<MouseJointDef, MouseConstraint> part{def, {}};
    JointDef base = def.base;
    base.collideConnected = true;  // A is only named: what is pulled must not fall through it
    return insert(world, jointOf(world, base, part, {def.target, anchor, {}}));
}

Result<JointId> World::createJoint(const GearJointDef& def) {
    WorldState& world = *state_;
    const Status joints = firstFault(
        {checkGeared(world, def.jointA, "jointA"), checkGeared(world, def.jointB, "jointB"), checkParts(def)});
    if (!joints.ok()) { return joints; }
    if (def.jointA == def.jointB) { return Status{StatusCode::notDistinct, "jointB"}; }
    const Joint& first = world.joints[def.jointA.index];
    const Joint& second = world.joints[def.jointB.index];
    GearJointDef filled = def;
    filled.base.bodyA = first.base.bodyB;
    filled.base.bodyB = second.base.bodyB;
    const Status base = checkBase(world, filled.base);
    if (!base.ok()) { return base; }
    const double constant = coordinateOf(world, first) + static_cast<double>(def.ratio) * coordinateOf(world, second);
    if (!isInRange(constant)) { return Status{StatusCode::outOfRange, "ratio"}; }
    const JointPart<GearJointDef, GearConstraint> part{filled, {}};
    Joint gear = jointOf(world, filled.base, part,
                         {apply(world.motions[first.bodyB].pose, first.localAnchorB),
                          apply(world.motions[second.bodyB].pose, second.localAnchorB),
                          {}});
    addBody(gear, first.bodyA);
    addBody(gear, second.bodyA);
    gear.gearConstant = constant;
    return insert(world, std::move(gear));
}

Result<JointId> World::createJoint(const PulleyJointDef& def) {
    WorldState& world = *state_;
    const Status status = firstFault({checkBase(world, def.base), checkNumber(def.groundA, "groundA"),
                                      checkNumber(def.groundB, "groundB"), checkNumber(def.anchorA, "anchorA"),
                                      checkNumber(def.anchorB, "anchorB"), checkParts(def)});
    if (!status.ok()) { return status; }
    const double rope =
        length(def.anchorA - def.groundA) + static_cast<double>(def.ratio) * length(def.anchorB - def.groundB);
    if (!isInRange(rope)) { return Status{StatusCode::outOfRange, "ratio"}; }
    const JointPart<PulleyJointDef, PulleyConstraint> part{def, {}};
    Joint joint = jointOf(world, def.base, part, {def.anchorA, def.anchorB, {}});
    joint.length = def.length.value_or(static_cast<Real>(rope));
    return insert(world, std::move(joint));
}

Result<JointId> World::createJoint(const FilterJointDef& def) {
    WorldState& world = *state_;
    const Status status = checkBase(world, def.base);
    if (!status.ok()) { return status; }
    return insert(world, jointOf(world, def.base, FilterPart{def}, {}));
}

Status World::destroyJoint(JointId id) {
    if (!state_->joints.isValid(id)) { return {StatusCode::staleId, "joint"}; }
    removeJoint(*state_, id);
    return Status::success();
}

bool World::isValid(JointId id) const { return state_->joints.isValid(id); }
std::uint32_t World::jointCount() const { return state_->joints.size(); }
JointType World::type(JointId id) const {
    const Joint* joint = state_->joints.find(id);
    return joint != nullptr ? joint->type() : JointType::revolute;
}
Real World::jointError(JointId id) const {
    const Joint* joint = state_->joints.find(id);
    return joint != nullptr ? errorsOf(*state_, *joint).length : Real(0);
}
Real World::jointAngleError(JointId id) const {
    const Joint* joint = state_->joints.find(id);
    return joint != nullptr ? errorsOf(*state_, *joint).angle : Real(0);
}
double World::jointAngle(JointId id) const {
    const Joint* joint = state_->joints.find(id);
    return joint != nullptr ? angleOf(*state_, *joint) : 0;
}
Real World::jointTranslation(JointId id) const {
    const Joint* joint = state_->joints.find(id);
    return joint != nullptr ? translationOf(*state_, *joint) : Real(0);
}
Real World::jointAngularVelocity(JointId id) const {
    const Joint* joint = state_->joints.find(id);
    if (joint == nullptr) { return 0; }
    return state_->motions[joint->bodyB].angularVelocity - state_->motions[joint->bodyA].angularVelocity;
}
Real World::jointSpeed(JointId id) const {
    const Joint* joint = state_->joints.find(id);
    if (joint == nullptr) { return 0; }
    const DVec2 place = anchorBOf(*state_, *joint);
    // Seen from A where B's anchor is now: its axis turns along, and what turns it about A's anchor brings it no
    // nearer.
    const Vec2 ofA = joint->type() == JointType::mouse ? Vec2{} : velocityAt(joint->base.bodyA, place);
    return dot(directionOf(*state_, *joint), velocityAt(joint->base.bodyB, place) - ofA);
}
Vec2 World::jointForce(JointId id) const {
    const Joint* joint = state_->joints.find(id);
    return joint != nullptr ? joint->reactionForce : Vec2{};
}
Real World::jointTorque(JointId id) const {
    const Joint* joint = state_->joints.find(id);
    return joint != nullptr ? joint->reactionTorque : Real(0);
}

}  // namespace swept::inline SWEPT_PRECISION
