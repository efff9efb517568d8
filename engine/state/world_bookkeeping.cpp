#include <algorithm>
#include <cmath>

#include "../../shapes/room.h"
#include "../contacts/pairs_of_shapes.h"
#include "../contacts/travel.h"
#include "../islands/levers.h"
#include "../modes/modes.h"
#include "body_measures.h"
#include "number_range.h"
#include "tolerances.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

void startResting(Body& body, const BodyMotion& motion) {
    body.restCenter = motion.center;
    body.restAngle = motion.angle;
    body.restTime = 0;
    body.restSteps = 0;
}

bool isMassless(const Body& body) { return body.isDynamic() && body.mass <= 0; }

/// @pre the body is dynamic, and its shapes are weighed
MassProperties massOfShapes(WorldState& world, const Body& body) {
    std::vector<MassProperties>& parts = world.massParts;
    parts.clear();
    for (const std::uint32_t slot : body.shapes) { parts.push_back(world.shapeMasses[slot]); }
    const MassProperties sum = combine(parts);
    // In double the fourth power of a length overflows within the range of lengths: what has no mass that is a number
    // has none, so `step` refuses it.
    const bool isSound = std::isfinite(sum.mass) && std::isfinite(sum.inertia) && isInRange(sum.center);
    return isSound ? sum : MassProperties{};
}

bool jointForbids(const WorldState& world, std::uint32_t bodyA, std::uint32_t bodyB) {
    for (const std::uint32_t slot : fewerJoints(world, bodyA, bodyB)) {
        const Joint& joint = world.joints[slot];
        const bool connects =
            (joint.bodyA == bodyA && joint.bodyB == bodyB) || (joint.bodyA == bodyB && joint.bodyB == bodyA);
        if (connects && joint.keepsApart()) { return true; }
    }
    return false;
}

/// A gear that the joint is part of.
std::optional<JointId> gearOn(const WorldState& world, JointId id) {
    const Joint& joint = world.joints[id.index];
    for (const std::uint32_t slot : fewerJoints(world, joint.bodyA, joint.bodyB)) {
        const auto* part = std::get_if<JointPart<GearJointDef, GearConstraint>>(&world.joints[slot].parts);
        if (part != nullptr && (part->def.jointA == id || part->def.jointB == id)) { return world.joints.idOf(slot); }
    }
    return std::nullopt;
}

}  // namespace

std::span<const std::uint32_t> fewerJoints(const WorldState& world, std::uint32_t bodyA, std::uint32_t bodyB) {
    const std::vector<std::uint32_t>& ofA = world.bodies[bodyA].joints;
    const std::vector<std::uint32_t>& ofB = world.bodies[bodyB].joints;
    return ofA.size() <= ofB.size() ? ofA : ofB;
}

bool mayTouch(const WorldState& world, const Shape& a, const Shape& b) {
    if (a.body == b.body || !shouldCollide(a.def.filter, b.def.filter)) { return false; }
    const auto isFixed = [&world](const Shape& shape) { return world.bodies[shape.body].def.type == BodyType::fixed; };
    const bool isSensed = a.def.sensor || b.def.sensor;  // without, somebody asks for one that is dynamic
    if (isSensed && isFixed(a) && isFixed(b)) { return false; }
    return !jointForbids(world, a.body, b.body);
}

void wake(WorldState& world, std::uint32_t start) {
    const BodyDef& def = world.bodies[start].def;
    if (world.bodies[start].awake || def.type == BodyType::fixed || !def.enabled) { return; }
    if (world.bodies[start].heldIn != kNoIndex) { return releaseHeld(world, start); }
    std::uint32_t slot = start;
    do {
        Body& body = world.bodies[slot];
        const std::uint32_t next = body.nextAsleep;
        body.awake = true;
        body.nextAsleep = slot;
        startResting(body, world.motions[slot]);
        world.jointChains.noteTurn(body.holdingJoints);
        world.awake.push_back(slot);
        world.parked.woken.push_back(slot);
        ++world.counters.wokeUp;
        slot = next;
    } while (slot != start);
}

void rouse(WorldState& world, std::uint32_t slot) {
    wake(world, slot);
    startResting(world.bodies[slot], world.motions[slot]);
}

void setInMotion(WorldState& world, std::uint32_t slot, Vec2 velocity, Real angularVelocity) {
    rouse(world, slot);
    BodyMotion& motion = world.motions[slot];
    motion.velocity = velocity;
    motion.angularVelocity = angularVelocity;
    reachWithVelocity(world, slot);
}

void wakeAll(WorldState& world) {
    if (!anyAsleep(world)) { return; }
    for (std::uint32_t slot = 0; slot < world.bodies.slotCount(); ++slot) {
        if (world.bodies.isAlive(slot) && !world.bodies[slot].fresh) { wake(world, slot); }
    }
}

bool disturbs(const WorldState& world, std::uint32_t slot) {
    const Body& body = world.bodies[slot];
    const BodyMotion& motion = world.motions[slot];
    const bool moves = motion.velocity != Vec2{} || motion.angularVelocity != 0;
    return body.awake && (body.isDynamic() || moves);
}

void leaveAwake(WorldState& world, std::uint32_t slot) {
    ++world.departures[slot];
    ++world.awakeGaps;
}

void closeUpAwake(WorldState& world) {
    if (world.awakeGaps == 0) { return; }
    world.awakeGaps = 0;
    std::erase_if(world.awake, [&world](std::uint32_t slot) {
        const bool isGap = world.departures[slot] > 0;
        world.departures[slot] -= isGap ? 1 : 0;
        return isGap;
    });
}

void makeRoomToWake(WorldState& world) {
    const std::size_t most = world.bodies.size() + 1 - world.fixedBodies - awakeCount(world);
    makeRoom(world.awake, world.awake.size() + most);
    makeRoom(world.parked.woken, world.parked.woken.size() + most);
    makeRoom(world.held.free, world.held.list.size());
}

void restAnew(WorldState& world) {
    closeUpAwake(world);
    for (const std::uint32_t slot : world.awake) { startResting(world.bodies[slot], world.motions[slot]); }
}

bool canHold(const WorldState& world, const Joint& joint) {
    const std::span<const std::uint32_t> bodies = joint.allBodies();
    const auto isEnabled = [&world](std::uint32_t body) { return world.bodies[body].def.enabled; };
    if (!std::all_of(bodies.begin(), bodies.end(), isEnabled)) { return false; }
    const bool movesA = world.bodies[joint.bodyA].isDynamic() && joint.type() != JointType::mouse;
    return movesA || world.bodies[joint.bodyB].isDynamic();
}

void wakeJoined(WorldState& world, std::uint32_t body) {
    for (const std::uint32_t slot : world.bodies[body].joints) {
        const Joint& joint = world.joints[slot];
        for (const std::uint32_t other : joint.allBodies()) {
            if (other != body && joint.holds()) { rouse(world, other); }
        }
    }
}

void dropContacts(WorldState& world, std::uint32_t slot) {
    const std::span<const std::uint32_t> places =
        pairsOf(world, world.bodies[slot].shapes,
                [slot](const ContactPair& pair) { return pair.bodyA == slot || pair.bodyB == slot; });
    wakeAcross(world, slot, places);
    wakeJoined(world, slot);
    removePairs(world, places);
}

void removeFromAwake(WorldState& world, std::uint32_t slot) {
    wake(world, slot);
    if (world.bodies[slot].awake) { leaveAwake(world, slot); }
}

void countBody(WorldState& world, const Body& body, std::int32_t sign) {
    const auto add = [sign](std::uint32_t& sum, bool isOne) { sum += isOne ? static_cast<std::uint32_t>(sign) : 0U; };
    const bool isIn = body.def.enabled;
    add(world.fixedBodies, body.def.type == BodyType::fixed || !isIn);
    add(world.kinematicBodies, isIn && body.def.type == BodyType::kinematic);
    add(world.bulletBodies, isIn && body.isDynamic() && body.def.bullet);
    add(world.watchedBodies, isIn && isWatched(body.def.continuous.value_or(ContinuousMode::off)));
    add(world.masslessBodies, isIn && isMassless(body));
}

void weigh(WorldState& world, std::span<const std::uint32_t> shapes) {
    for (const std::uint32_t slot : shapes) {
        const Shape& shape = world.shapes[slot];
        world.shapeMasses[slot] = massOf(shape.polygon, shape.def.density);
    }
}

void updateMass(WorldState& world, std::uint32_t slot) {
    Body& body = world.bodies[slot];
    noteTravel(world, slot);  // with the radius of before
    const bool wasMassless = isMassless(body);
    MassProperties total;
    if (body.isDynamic()) { total = massOfShapes(world, body); }
    if (body.def.mass > 0) {
        const double given = static_cast<double>(body.def.mass);
        total.inertia = total.mass > 0 ? total.inertia * (given / total.mass) : 0;
        total.mass = given;
    }
    if (body.def.inertia > 0) { total.inertia = static_cast<double>(body.def.inertia); }
    const Vec2 center = body.isDynamic() && total.mass > 0 ? toReal(total.center) : Vec2{};
    BodyMotion& motion = world.motions[slot];
    const DVec2 before = motion.center;
    motion.center = apply(motion.pose, center);
    // The velocity given is that of the centre of mass, wherever the first shapes put it. Later all points go on as
    // they did.
    const Vec2 carried = motion.velocity + cross(motion.angularVelocity, toReal(motion.center - before));
    if (!body.fresh && isInRange(carried)) { motion.velocity = carried; }
    body.startCenter += motion.center - before;
    noteNewCenter(world, slot, motion.center - before);
    body.localCenter = center;
    body.mass = body.isDynamic() && hasInverse(total.mass) ? total.mass : 0;
    body.inertia = body.isDynamic() ? total.inertia : 0;
    body.inverseMass = body.mass > 0 ? static_cast<Real>(1 / body.mass) : Real(0);
    resistTurns(world, slot);
    world.travels[slot].boxRoom = 0;
    measure(world, slot);
    if (!body.awake) { noteRest(world, slot); }
    if (!body.def.enabled) { return; }
    world.masslessBodies += isMassless(body) ? 1 : 0;
    world.masslessBodies -= wasMassless ? 1 : 0;
}

void updatePose(WorldState& world, std::uint32_t slot) {
    BodyMotion& motion = world.motions[slot];
    motion.pose = poseOf(motion.center, motion.angle, world.bodies[slot].localCenter);
}

Real bounceThreshold(const WorldState& world, const Body& body, Real dt) {
    return dt * std::max(length(world.settings.gravity), length(accelerationOf(world, body)));
}

Real contactReach(const WorldState& world, const Shape& shape) {
    const Body& body = world.bodies[shape.body];
    if (body.def.type == BodyType::fixed) { return 0; }
    const auto dt = static_cast<Real>(world.lastDt);
    const bool isAhead = modeOf(world, body) == ContinuousMode::speculative;
    const Real most = kMaxReachRatio * shape.extent;
    const Vec2 velocity = world.motions[shape.body].velocity;
    // What is fast along one axis is told without a root, and many of those that are asked for their reach are.
    if (!isAhead && dt * std::max(std::fabs(velocity.x), std::fabs(velocity.y)) >= most) { return most; }
    return reachOfMotion(motionBound(world, shape.body, dt), shape.extent, isAhead);
}

std::uint32_t bodyOfFewerShapes(const WorldState& world, const Joint& joint) {
    const Body& a = world.bodies[joint.bodyA];
    const Body& b = world.bodies[joint.bodyB];
    // As many: not the one that many others may lie on.
    if (a.shapes.size() == b.shapes.size()) { return a.isDynamic() ? joint.bodyA : joint.bodyB; }
    return a.shapes.size() < b.shapes.size() ? joint.bodyA : joint.bodyB;
}

void removeJoint(WorldState& world, JointId id, std::uint32_t leaving) {
    while (const std::optional<JointId> gear = gearOn(world, id)) { removeJoint(world, *gear, leaving); }
    const Joint& joint = world.joints[id.index];
    world.jointTies[id.index] = {};
    world.jointChains.areCurrent = false;
    for (const std::uint32_t slot : joint.allBodies()) {
        Body& body = world.bodies[slot];
        std::erase(body.joints, id.index);
        body.holdingJoints -= joint.holds() ? 1 : 0;
        if (isAtLever(body)) { resistTurns(world, slot); }
        rouse(world, slot);
    }
    const bool mayMeet = joint.bodyA != leaving && joint.bodyB != leaving;
    // So that the pairs it kept apart are found, each of which has a shape of either.
    if (joint.keepsApart() && mayMeet) { renewProxies(world, bodyOfFewerShapes(world, joint)); }
    world.joints.erase(id);
}

double restTimeOf(const WorldState& world, const Body& body) {
    const auto gravity = static_cast<double>(length(world.settings.gravity));
    if (!(gravity > 0)) { return kWeightlessRest; }
    return kRestTimes * std::sqrt(static_cast<double>(body.extent) / gravity);
}

void removeApartContacts(WorldState& world) {
    const std::span<const std::uint32_t> apart = world.lists.apart;
    if (apart.empty()) { return; }
    std::vector<ContactProbe>& probes = world.probes;
    const auto at = [&probes](std::size_t place) { return probes.begin() + static_cast<std::ptrdiff_t>(place); };
    world.droppedPairs.clear();
    auto kept = at(apart.front());
    for (std::size_t i = 0; i < apart.size(); ++i) {
        world.droppedPairs.push_back(probes[apart[i]]);
        reportEnd(world, probes[apart[i]], world.contactEvents);
        kept = std::copy(at(apart[i] + 1), at(i + 1 < apart.size() ? apart[i + 1] : probes.size()), kept);
    }
    probes.resize(probes.size() - apart.size());
    dropPairs(world, world.droppedPairs);
}

}  // namespace swept::inline SWEPT_PRECISION
