#include <algorithm>
#include <cmath>

#include "../../shapes/room.h"
#include "../bodies/awake.h"
#include "../bodies/body_joints.h"
#include "../bodies/body_mass.h"
#include "../bodies/proxies.h"
#include "../bodies/travel.h"
#include "../bodies/world_boxes.h"
#include "../contacts/pairs_of_shapes.h"
#include "../modes/modes.h"
#include "../solve/driven_joints.h"
#include "../solve/joint_results.h"
#include "../state/number_range.h"
#include "../world.h"
#include "body_type.h"
#include "joint_switch.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

Status checkNumbers(const BodyDef& def) {
    const auto number = [](Real x, const char* field) { return checkNumber(static_cast<double>(x), field); };
    return firstFault({checkNumber(def.position, "position"), checkNumber(def.angle, "angle"),
                       checkNumber(def.velocity, "velocity"), number(def.angularVelocity, "angularVelocity"),
                       number(def.linearDamping, "linearDamping"), number(def.angularDamping, "angularDamping"),
                       number(def.gravityScale, "gravityScale"), number(def.mass, "mass"),
                       number(def.inertia, "inertia")});
}

Status check(const BodyDef& def) {
    // Enumerators that were made from numbers may be none.
    if (def.type > BodyType::dynamic) { return {StatusCode::outOfRange, "type"}; }
    if (def.continuous.value_or(ContinuousMode::off) > ContinuousMode::subStep) {
        return {StatusCode::outOfRange, "continuous"};
    }
    const Status numbers = checkNumbers(def);
    if (!numbers.ok()) { return numbers; }
    if (def.linearDamping < 0) { return {StatusCode::negative, "linearDamping"}; }
    if (def.angularDamping < 0) { return {StatusCode::negative, "angularDamping"}; }
    if (def.mass < 0) { return {StatusCode::negative, "mass"}; }
    if (def.inertia < 0) { return {StatusCode::negative, "inertia"}; }
    const bool moves = def.velocity != Vec2{} || def.angularVelocity != 0;
    if (def.type == BodyType::fixed && moves) { return {StatusCode::wrongBodyType, "velocity"}; }
    if (def.fixedRotation && def.angularVelocity != 0) { return {StatusCode::outOfRange, "angularVelocity"}; }
    return Status::success();
}

/// Of what forces and impulses are for.
Status checkDynamic(const Body* body) {
    if (body == nullptr) { return {StatusCode::staleId, "body"}; }
    return body->isDynamic() ? Status::success() : Status{StatusCode::wrongBodyType, "body"};
}

/// Likewise, where the next step has to be one of its own.
Status checkTakesPart(const Body* body) {
    const Status dynamic = checkDynamic(body);
    if (!dynamic.ok()) { return dynamic; }
    return body->def.enabled ? Status::success() : Status{StatusCode::disabled, "body"};
}

/// Its joints hold something else now, or nothing: they begin anew, and what is on them, too.
void renewJoints(WorldState& world, std::uint32_t slot) {
    for (const std::uint32_t joint : world.bodies[slot].joints) { forgetImpulses(world.joints[joint]); }
    switchJoints(world, slot);
    wakeJoined(world, slot);
    world.jointChains.areCurrent = false;
}

/// All that may fail when memory runs out, before a body is made.
void makeRoomForBody(WorldState& world) {
    world.bodies.makeRoomForOne();
    const std::size_t count = world.bodies.slotsWithOneMore();
    makeRoom(world.motions, count);
    makeRoom(world.solverSlots, count);
    makeRoom(world.travels, count);
    makeRoom(world.glances, count);
    makeRoom(world.departures, count);
    makeRoomToWake(world);
}

/// What of a definition is about the present alone stays as it is now.
BodyDef atPresent(const WorldState& world, std::uint32_t slot, BodyDef def) {
    const Body& body = world.bodies[slot];
    const BodyMotion& motion = world.motions[slot];
    def.position = motion.pose.position;
    def.angle = motion.angle;
    def.velocity = motion.velocity;
    def.angularVelocity = motion.angularVelocity;
    def.awake = body.awake || body.heldIn != kNoIndex;
    def.enabled = body.def.enabled;
    return def;
}

/// For a force. What is held is in balance without it, and is asked again; what sleeps on has it if it wakes by the
/// next step.
void makeReady(WorldState& world, std::uint32_t slot, Wake wakes) {
    world.forcesGiven = true;
    const Body& body = world.bodies[slot];
    if (wakes == Wake::yes) {
        rouse(world, slot);
    } else if (body.heldIn != kNoIndex) {
        wake(world, slot);
    } else if (!body.awake) {
        world.pushedAsleep.push_back(slot);
    }
}

}  // namespace

Result<BodyId> World::createBody(const BodyDef& def) {
    const Status status = check(def);
    if (!status.ok()) { return status; }
    WorldState& world = *state_;
    makeRoomForBody(world);
    Body body;
    body.def = def;
    body.startCenter = def.position;  // it did not move so far
    body.startAngle = def.angle;
    const std::optional<BodyId> id = world.bodies.insert(std::move(body));
    if (!id) { return Status{StatusCode::noIdsLeft, "body"}; }
    world.motions.resize(world.bodies.slotCount());
    world.solverSlots.resize(world.bodies.slotCount());
    BodyMotion& motion = world.motions[id->index];
    motion = {
        .center = def.position, .angle = def.angle, .velocity = def.velocity, .angularVelocity = def.angularVelocity};
    world.bodies[id->index].nextAsleep = id->index;
    world.travels.resize(world.bodies.slotCount());
    world.travels[id->index] = {.angle = def.angle};
    world.departures.resize(world.bodies.slotCount());
    world.glances.resize(world.bodies.slotCount());
    world.glances[id->index] = {.center = def.position};
    updatePose(world, id->index);
    countBody(world, world.bodies[id->index], 1);
    if (def.type == BodyType::dynamic) { updateMass(world, id->index); }  // it may have one of its own
    if (def.awake || def.type == BodyType::kinematic) {                   // unless it is disabled
        const std::uint64_t woken = world.counters.wokeUp;
        wake(world, id->index);
        world.counters.wokeUp = woken;  // born awake
    }
    return *id;
}

Status World::destroyBody(BodyId id) {
    WorldState& world = *state_;
    if (!world.bodies.isValid(id)) { return {StatusCode::staleId, "body"}; }
    dropContacts(world, id.index);
    while (!world.bodies[id.index].joints.empty()) {
        removeJoint(world, world.joints.idOf(world.bodies[id.index].joints.back()), id.index);
    }
    Body& body = world.bodies[id.index];
    for (const std::uint32_t slot : body.shapes) { removeShapeSlot(world, slot); }
    countBody(world, body, -1);
    removeFromAwake(world, id.index);
    world.bodies.erase(id);
    return Status::success();
}

BodyDef World::definition(BodyId id) const {
    const WorldState& world = *state_;
    return isValid(id) ? atPresent(world, id.index, world.bodies[id.index].def) : BodyDef{};
}

Status World::redefine(BodyId id, const BodyDef& given) {
    WorldState& world = *state_;
    if (!world.bodies.isValid(id)) { return {StatusCode::staleId, "body"}; }
    const std::uint32_t slot = id.index;
    BodyDef def = atPresent(world, slot, given);
    if (def.type == BodyType::fixed) { def.velocity = {}; }
    if (def.type == BodyType::fixed || def.fixedRotation) { def.angularVelocity = 0; }
    const Status status = check(def);
    if (!status.ok()) { return status; }
    Body& body = world.bodies[slot];
    const bool isOtherType = def.type != body.def.type;
    const auto isChain = [&world](std::uint32_t shape) { return world.shapes[shape].isChainSegment; };
    if (def.type == BodyType::dynamic && std::any_of(body.shapes.begin(), body.shapes.end(), isChain)) {
        return {StatusCode::wrongBodyType, "type"};
    }
    const bool isToldApart = world.contactFilter != nullptr && def.userData != body.def.userData;
    BodyDef before = atPresent(world, slot, body.def);
    before.userData = def.userData;
    if (def == before && !isToldApart) {
        body.def.userData = def.userData;
        return Status::success();
    }
    wake(world, slot);
    countBody(world, body, -1);
    if (isOtherType) {
        changeType(world, slot, def.type);
    } else if (isToldApart) {
        dropContacts(world, slot);
    }
    body.def = def;
    world.motions[slot].velocity = def.velocity;
    world.motions[slot].angularVelocity = def.angularVelocity;
    countBody(world, body, 1);
    updateMass(world, slot);
    rouse(world, slot);
    if (isOtherType) {
        renewJoints(world, slot);
        renewKinds(world, body.shapes);
    }
    if (isToldApart) {
        renewProxies(world, slot);
    } else {
        updateProxies(world, slot);
    }
    return Status::success();
}

bool World::isValid(BodyId id) const { return state_->bodies.isValid(id); }
std::uint32_t World::bodyCount() const { return state_->bodies.size(); }

BodyType World::type(BodyId id) const {
    const Body* body = state_->bodies.find(id);
    return body != nullptr ? body->def.type : BodyType::fixed;
}
DVec2 World::position(BodyId id) const { return isValid(id) ? state_->motions[id.index].pose.position : DVec2{}; }
double World::angle(BodyId id) const { return isValid(id) ? state_->motions[id.index].angle : 0; }
DVec2 World::centerOfMass(BodyId id) const { return isValid(id) ? state_->motions[id.index].center : DVec2{}; }
Vec2 World::velocity(BodyId id) const { return isValid(id) ? state_->motions[id.index].velocity : Vec2{}; }
WorldTransform World::transform(BodyId id) const {
    return isValid(id) ? state_->motions[id.index].pose : WorldTransform{};
}
Vec2 World::velocityAt(BodyId id, DVec2 point) const {
    if (!isValid(id)) { return {}; }
    const BodyMotion& motion = state_->motions[id.index];
    const auto spin = static_cast<double>(motion.angularVelocity);
    const DVec2 turning = spin * (point - motion.center);  // far away, the arm is beyond `float`
    return nearestReal(toDouble(motion.velocity) + DVec2{-turning.y, turning.x});
}
Real World::angularVelocity(BodyId id) const {
    return isValid(id) ? state_->motions[id.index].angularVelocity : Real(0);
}
bool World::isAwake(BodyId id) const {
    const Body* body = state_->bodies.find(id);
    return body != nullptr && (body->awake || body->heldIn != kNoIndex);
}
double World::mass(BodyId id) const { return isValid(id) ? state_->bodies[id.index].mass : 0; }
double World::inertia(BodyId id) const { return isValid(id) ? state_->bodies[id.index].inertia : 0; }
std::uint64_t World::userData(BodyId id) const { return isValid(id) ? state_->bodies[id.index].def.userData : 0; }

Status World::setPose(BodyId id, DVec2 position, double angle) {
    WorldState& world = *state_;
    if (!world.bodies.isValid(id)) { return {StatusCode::staleId, "body"}; }
    const Status numbers = firstFault({checkNumber(position, "position"), checkNumber(angle, "angle")});
    if (!numbers.ok()) { return numbers; }
    dropContacts(world, id.index);
    rouse(world, id.index);
    BodyMotion& motion = world.motions[id.index];
    motion.angle = angle;
    motion.pose = {position, rotationFromAngle(angle)};
    motion.center = apply(motion.pose, world.bodies[id.index].localCenter);
    notePut(world.bodies[id.index]);
    for (const std::uint32_t joint : world.bodies[id.index].joints) { notePut(world, world.joints.idOf(joint)); }
    if (!world.bodies[id.index].awake) { noteRest(world, id.index); }  // no step does it for what is fixed
    renewProxies(world, id.index);
    return Status::success();
}

Status World::setVelocity(BodyId id, Vec2 velocity, Real angularVelocity) {
    WorldState& world = *state_;
    const Body* body = world.bodies.find(id);
    if (body == nullptr) { return {StatusCode::staleId, "body"}; }
    if (body->def.type == BodyType::fixed) { return {StatusCode::wrongBodyType, "body"}; }
    const Status numbers = firstFault(
        {checkNumber(velocity, "velocity"), checkNumber(static_cast<double>(angularVelocity), "angularVelocity")});
    if (!numbers.ok()) { return numbers; }
    if (body->def.fixedRotation && angularVelocity != 0) { return {StatusCode::outOfRange, "angularVelocity"}; }
    setInMotion(world, id.index, velocity, angularVelocity);
    return Status::success();
}

Status World::driveTo(BodyId id, DVec2 position, double angle, double dt) {
    const WorldState& world = *state_;
    const Body* body = world.bodies.find(id);
    if (body == nullptr) { return {StatusCode::staleId, "body"}; }
    if (body->def.type != BodyType::kinematic) { return {StatusCode::wrongBodyType, "body"}; }
    const Status numbers =
        firstFault({checkNumber(position, "position"), checkNumber(angle, "angle"), checkNumber(dt, "dt")});
    if (!numbers.ok()) { return numbers; }
    if (!(dt > 0)) { return {StatusCode::notPositive, "dt"}; }
    const BodyMotion& motion = world.motions[id.index];
    const DVec2 velocity = (1 / dt) * (position - motion.pose.position);  // which is its centre, too
    const double spin = (angle - motion.angle) / dt;
    if (!isInRange(velocity)) { return {StatusCode::outOfRange, "position"}; }
    if (!isInRange(spin)) { return {StatusCode::outOfRange, "angle"}; }
    return setVelocity(id, toReal(velocity), static_cast<Real>(spin));
}

Status World::applyForce(BodyId id, Vec2 force) { return applyForce(id, force, centerOfMass(id)); }
Status World::applyImpulse(BodyId id, Vec2 impulse) { return applyImpulse(id, impulse, centerOfMass(id)); }

Status World::applyForce(BodyId id, Vec2 force, DVec2 point, Wake wake) {
    WorldState& world = *state_;
    Body* body = world.bodies.find(id);
    const Status pushed = checkTakesPart(body);
    if (!pushed.ok()) { return pushed; }
    const Status numbers = firstFault({checkNumber(force, "force"), checkNumber(point, "point")});
    if (!numbers.ok()) { return numbers; }
    const Vec2 sum = body->force + force;
    const Real torque = body->torque + cross(toReal(point - world.motions[id.index].center), force);
    if (!isInRange(sum) || !isInRange(static_cast<double>(torque))) { return {StatusCode::outOfRange, "force"}; }
    makeReady(world, id.index, wake);
    body->force = sum;
    body->torque = torque;
    return Status::success();
}

Status World::applyTorque(BodyId id, Real torque, Wake wake) {
    WorldState& world = *state_;
    Body* body = world.bodies.find(id);
    const Status pushed = checkTakesPart(body);
    if (!pushed.ok()) { return pushed; }
    const Status number = checkNumber(static_cast<double>(torque), "torque");
    if (!number.ok()) { return number; }
    const Real sum = body->torque + torque;
    if (!isInRange(static_cast<double>(sum))) { return {StatusCode::outOfRange, "torque"}; }
    makeReady(world, id.index, wake);
    body->torque = sum;
    return Status::success();
}

Status World::applyImpulse(BodyId id, Vec2 impulse, DVec2 point) {
    WorldState& world = *state_;
    const Body* body = world.bodies.find(id);
    const Status pushed = checkDynamic(body);
    if (!pushed.ok()) { return pushed; }
    const Status numbers = firstFault({checkNumber(impulse, "impulse"), checkNumber(point, "point")});
    if (!numbers.ok()) { return numbers; }
    const BodyMotion& motion = world.motions[id.index];
    const Vec2 velocity = motion.velocity + body->inverseMass * impulse;
    const Real spin = motion.angularVelocity + body->inverseInertia * cross(toReal(point - motion.center), impulse);
    const bool good = isInRange(velocity) && isInRange(static_cast<double>(spin));
    if (!good) { return {StatusCode::outOfRange, "impulse"}; }
    setInMotion(world, id.index, velocity, spin);
    return Status::success();
}

Status World::applyAngularImpulse(BodyId id, Real impulse) {
    WorldState& world = *state_;
    const Body* body = world.bodies.find(id);
    const Status pushed = checkDynamic(body);
    if (!pushed.ok()) { return pushed; }
    const Status number = checkNumber(static_cast<double>(impulse), "impulse");
    if (!number.ok()) { return number; }
    const BodyMotion& motion = world.motions[id.index];
    const Real spin = motion.angularVelocity + body->inverseInertia * impulse;
    if (!isInRange(static_cast<double>(spin))) { return {StatusCode::outOfRange, "impulse"}; }
    setInMotion(world, id.index, motion.velocity, spin);
    return Status::success();
}

Status World::setAwake(BodyId id, bool awake) {
    WorldState& world = *state_;
    Body* body = world.bodies.find(id);
    const Status pushed = checkTakesPart(body);
    if (!pushed.ok()) { return pushed; }
    if (awake || body->heldIn != kNoIndex) { rouse(world, id.index); }
    if (!awake && body->awake) {
        body->awake = false;
        body->role = BodyRole::idle;
        body->nextAsleep = id.index;
        body->force = {};  // for the next step, which it does not take part in
        body->torque = 0;
        world.motions[id.index].velocity = {};
        world.motions[id.index].angularVelocity = 0;
        noteRest(world, id.index);
        world.jointChains.noteTurn(body->holdingJoints);
        leaveAwake(world, id.index);
        ++world.parked.rested;
    }
    return Status::success();
}

}  // namespace swept::inline SWEPT_PRECISION
