#include <algorithm>
#include <cmath>

#include "constraint_builder.h"
#include "number_range.h"
#include "world_state.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

Status checkLimit(const std::optional<Real>& limit, const char* field) {
    if (!limit) { return Status::success(); }
    if (!isFinite(*limit)) { return {StatusCode::notFinite, field}; }
    if (*limit <= 0) { return {StatusCode::notPositive, field}; }
    return Status::success();
}

Status check(const WorldState& world, const JointDef& def) {
    if (!world.bodies.isValid(def.bodyA)) { return {StatusCode::staleId, "bodyA"}; }
    if (!world.bodies.isValid(def.bodyB)) { return {StatusCode::staleId, "bodyB"}; }
    if (def.bodyA == def.bodyB) { return {StatusCode::sameBody, "bodyB"}; }
    const bool anyDynamic =
        world.bodies[def.bodyA.index].isDynamic() || world.bodies[def.bodyB.index].isDynamic();
    if (!anyDynamic) { return {StatusCode::wrongBodyType, "bodyB"}; }
    const Status force = checkLimit(def.breakForce, "breakForce");
    return force.ok() ? checkLimit(def.breakTorque, "breakTorque") : force;
}

Status check(const std::optional<Spring>& spring) {
    if (!spring) { return Status::success(); }
    if (!isFinite(spring->hertz)) { return {StatusCode::notFinite, "hertz"}; }
    if (!isFinite(spring->dampingRatio)) { return {StatusCode::notFinite, "dampingRatio"}; }
    if (spring->hertz <= 0) { return {StatusCode::notPositive, "hertz"}; }
    if (spring->dampingRatio < 0) { return {StatusCode::negative, "dampingRatio"}; }
    return Status::success();
}

Status check(const std::optional<AngleLimits>& limits, const std::optional<AngularMotor>& motor) {
    if (limits && !isFinite(limits->lower)) { return {StatusCode::notFinite, "lower"}; }
    if (limits && !isFinite(limits->upper)) { return {StatusCode::notFinite, "upper"}; }
    if (limits && limits->lower > limits->upper) { return {StatusCode::outOfRange, "upper"}; }
    if (motor && !isFinite(motor->speed)) { return {StatusCode::notFinite, "motorSpeed"}; }
    if (motor && !isFinite(motor->maxTorque)) { return {StatusCode::notFinite, "maxMotorTorque"}; }
    if (motor && motor->maxTorque < 0) { return {StatusCode::negative, "maxMotorTorque"}; }
    return Status::success();
}

Status check(const std::optional<LengthLimits>& limits, Real length) {
    if (!isFinite(length)) { return {StatusCode::notFinite, "length"}; }
    if (length <= 0 && !limits) { return {StatusCode::notPositive, "length"}; }
    if (!limits) { return Status::success(); }
    if (!isFinite(limits->min)) { return {StatusCode::notFinite, "minLength"}; }
    if (limits->min < 0) { return {StatusCode::negative, "minLength"}; }
    if (!(limits->max >= limits->min)) { return {StatusCode::outOfRange, "maxLength"}; }
    return Status::success();
}

Joint jointOf(const WorldState& world, JointKind kind, const JointDef& base, DVec2 anchorA, DVec2 anchorB) {
    Joint joint;
    joint.kind = kind;
    joint.base = base;
    joint.bodyA = base.bodyA.index;
    joint.bodyB = base.bodyB.index;
    joint.localAnchorA = applyInverse(world.motions[joint.bodyA].pose, anchorA);
    joint.localAnchorB = applyInverse(world.motions[joint.bodyB].pose, anchorB);
    joint.referenceAngle = world.motions[joint.bodyB].angle - world.motions[joint.bodyA].angle;
    return joint;
}

Result<JointId> insert(WorldState& world, Joint joint) {
    const std::uint32_t a = joint.bodyA;
    const std::uint32_t b = joint.bodyB;
    const bool apart = !joint.base.collideConnected;
    const std::optional<JointId> id = world.joints.insert(std::move(joint));
    if (!id) { return Status{StatusCode::outOfMemory, "joint"}; }
    world.bodies[a].joints.push_back(id->index);
    world.bodies[b].joints.push_back(id->index);
    wake(world, a);
    wake(world, b);
    if (apart) {
        removeContacts(world, [a, b](const Contact& c) {
            return (c.bodyA == a && c.bodyB == b) || (c.bodyA == b && c.bodyB == a);
        });
    }
    return *id;
}

}  // namespace

Result<JointId> World::createJoint(const RevoluteJointDef& def) {
    WorldState& world = *state_;
    for (const Status& status : {check(world, def.base), check(def.limits, def.motor), check(def.spring)}) {
        if (!status.ok()) { return status; }
    }
    const Status anchor = checkNumber(def.anchor, "anchor");
    if (!anchor.ok()) { return anchor; }
    Joint joint = jointOf(world, JointKind::revolute, def.base, def.anchor, def.anchor);
    joint.revolute = def;
    return insert(world, std::move(joint));
}

Result<JointId> World::createJoint(const DistanceJointDef& def) {
    WorldState& world = *state_;
    for (const Status& status : {checkNumber(def.anchorA, "anchorA"), checkNumber(def.anchorB, "anchorB")}) {
        if (!status.ok()) { return status; }
    }
    const Real length = def.length.value_or(static_cast<Real>(swept::length(def.anchorB - def.anchorA)));
    for (const Status& status : {check(world, def.base), check(def.limits, length), check(def.spring)}) {
        if (!status.ok()) { return status; }
    }
    Joint joint = jointOf(world, JointKind::distance, def.base, def.anchorA, def.anchorB);
    joint.distance = def;
    joint.length = length;
    joint.distanceState.axis = {1, 0};  // until the anchors first differ
    return insert(world, std::move(joint));
}

Status World::destroyJoint(JointId id) {
    if (!state_->joints.isValid(id)) { return {StatusCode::staleId, "joint"}; }
    removeJoint(*state_, id);
    return Status::success();
}

bool World::isValid(JointId id) const { return state_->joints.isValid(id); }
std::uint32_t World::jointCount() const { return state_->joints.size(); }
Real World::jointError(JointId id) const {
    const Joint* joint = state_->joints.find(id);
    return joint != nullptr ? errorOf(*state_, *joint) : Real(0);
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
