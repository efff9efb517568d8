#include <algorithm>
#include <cmath>
#include <span>

#include "../bodies/awake.h"
#include "../bodies/body_joints.h"
#include "../bodies/travel.h"
#include "../bodies/world_boxes.h"
#include "../contacts/contact_fetch.h"
#include "../crew/beside.h"
#include "../islands/held_islands.h"
#include "../solve/joint_builder.h"
#include "../state/tolerances.h"
#include "event_order.h"
#include "step.h"

namespace swept::inline SWEPT_PRECISION {

namespace {

/// Bodies per block whose boxes are compared.
constexpr std::size_t kProxyGrain = 64;
/// Bodies per awake one up to which boxes are moved side by side: all are gone through for what moved then. (Of 200 000
/// boxes, wide tree, one thread: 100 moved 92 µs instead of 7, 3000 moved 172 instead of 103; of 20 000, 3000 moved 91
/// instead of 127.)
constexpr std::size_t kMostPerAwake = 16;
/// Bodies per block whose rest is counted.
constexpr std::size_t kRestGrain = 128;

/// Since it began to rest, a step ago and `restTime` before that.
bool hardlyMoved(const WorldState& world, const Body& body, const BodyMotion& motion, double dt) {
    const double moved = length(motion.center - body.restCenter) +
                         std::fabs(motion.angle - body.restAngle) * static_cast<double>(body.radius);
    const double creep = static_cast<double>(world.settings.sleepSpeed) * (body.restTime + dt);
    return moved <= static_cast<double>(kRestRatio * body.extent) + creep;
}

void countRest(const WorldState& world, Body& body, const BodyMotion& motion, double dt) {
    if (hardlyMoved(world, body, motion, dt)) {
        body.restTime += dt;
        ++body.restSteps;
        return;
    }
    body.restCenter = motion.center;
    body.restAngle = motion.angle;
    body.restTime = 0;
    body.restSteps = 0;
}

/// How far something goes on that only damping slows down, by its speed: without end where there is none.
double wayLeft(Real speed, Real damping) {
    return speed > 0 ? static_cast<double>(speed) / static_cast<double>(damping) : 0;
}

/// Whether nothing moves the body, and it hardly will move ever. What drifts goes on, however slowly, unless that is
/// what sleeps; what flies is still for a moment where it turns back.
bool staysByItself(const WorldState& world, const Body& body, const BodyMotion& motion) {
    if (accelerationOf(world, body) != Vec2{}) { return false; }  // a torque is over with its step
    const Real speed = length(motion.velocity);
    const Real spin = std::fabs(motion.angularVelocity);
    if (speed + body.radius * spin <= world.settings.sleepSpeed) { return true; }
    const double way = wayLeft(speed, body.def.linearDamping) +
                       static_cast<double>(body.radius) * wayLeft(spin, body.def.angularDamping);
    return way <= static_cast<double>(kRestRatio * body.extent);
}

bool isTired(const WorldState& world, const Body& body, const BodyMotion& motion) {
    if (body.restSteps < kRestSteps || body.restTime < restTimeOf(world, body)) { return false; }
    if (!body.def.allowSleep) { return false; }
    return body.hasContact || body.holdingJoints > 0 || staysByItself(world, body, motion);
}

/// Of all that is awake.
void countRests(WorldState& world, double dt) {
    world.tiredness.resize(world.awake.size());
    world.loops->run(world.awake.size(), kRestGrain, [&world, dt](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i) {
            Body& body = world.bodies[world.awake[i]];
            world.tiredness[i] = Tiredness::kinematic;
            if (!body.isDynamic()) { continue; }
            const BodyMotion& motion = world.motions[world.awake[i]];
            countRest(world, body, motion, dt);
            world.tiredness[i] = isTired(world, body, motion) ? Tiredness::tired : Tiredness::restless;
        }
    });
}

bool movesKinematically(const WorldState& world, std::uint32_t slot) {
    if (isAwakeDynamic(world, slot)) { return false; }  // as mostly: no body is asked
    const BodyMotion& motion = world.motions[slot];
    return world.bodies[slot].def.type == BodyType::kinematic &&
           (motion.velocity != Vec2{} || motion.angularVelocity != 0);
}

/// Marks the islands that a moving kinematic body or a belt keeps awake.
void keepAwakeByDrives(WorldState& world) {
    const bool mayMove = world.kinematicBodies > 0;
    for (const ContactProbe& probe : world.probes) {
        if (probe.isPlain && !probe.isBelt) { continue; }
        const bool movesA = mayMove && movesKinematically(world, probe.bodyA);
        const bool movesB = mayMove && movesKinematically(world, probe.bodyB);
        if (!probe.isBelt && !movesA && !movesB) { continue; }
        const Contact& contact = world.contacts[probe.contact];
        if (!contact.isSolid()) { continue; }
        if (contact.isBelt) { world.islandRestless[world.islands.find(contact.dynamicBody())] = 1; }
        if (movesA) { world.islandRestless[world.islands.find(contact.bodyB)] = 1; }
        if (movesB) { world.islandRestless[world.islands.find(contact.bodyA)] = 1; }
    }
    if (!mayMove) { return; }
    for (const std::uint32_t i : world.activeJoints) {
        if (!world.joints.isAlive(i)) { continue; }  // broke in this step
        const auto bodies = world.joints[i].allBodies();
        const bool isMoved = std::any_of(bodies.begin(), bodies.end(),
                                         [&](std::uint32_t slot) { return movesKinematically(world, slot); });
        if (!isMoved) { continue; }
        for (const std::uint32_t slot : bodies) { world.islandRestless[world.islands.find(slot)] = 1; }
    }
}

void fallAsleep(WorldState& world, std::uint32_t slot) {
    Body& body = world.bodies[slot];
    BodyMotion& motion = world.motions[slot];
    body.awake = false;
    body.role = BodyRole::idle;
    motion.velocity = {};
    motion.angularVelocity = 0;
    noteRest(world, slot);
    world.jointChains.noteTurn(body.holdingJoints);
    // Into the ring of its island, whose last member is remembered by root.
    const std::uint32_t root = world.islands.find(slot);
    const std::uint32_t last = world.islandRing[root];
    if (last == kNoIndex) {
        body.nextAsleep = slot;
    } else {
        body.nextAsleep = world.bodies[last].nextAsleep;
        world.bodies[last].nextAsleep = slot;
    }
    world.islandRing[root] = slot;
    ++world.parked.rested;
    ++world.counters.fellAsleep;
    world.bodiesFellAsleep.push_back(world.bodies.idOf(slot));
}

/// Of all that is awake, as it was counted, whole islands fall asleep.
void restIslands(WorldState& world) {
    const std::vector<Tiredness>& tiredness = world.tiredness;
    world.islandRestless.resize(world.bodies.slotCount());
    world.islandRing.resize(world.bodies.slotCount());
    for (const std::uint32_t slot : world.awake) {  // and so all roots
        world.islandRestless[slot] = 0;
        world.islandRing[slot] = kNoIndex;
    }
    for (std::size_t i = 0; i < world.awake.size(); ++i) {
        if (tiredness[i] == Tiredness::restless) { world.islandRestless[world.islands.find(world.awake[i])] = 1; }
    }
    keepAwakeByDrives(world);
    std::size_t kept = 0;
    for (std::size_t i = 0; i < world.awake.size(); ++i) {
        const std::uint32_t slot = world.awake[i];
        if (tiredness[i] != Tiredness::kinematic && world.islandRestless[world.islands.find(slot)] == 0) {
            fallAsleep(world, slot);
        } else {
            world.awake[kept++] = slot;
        }
    }
    world.awake.resize(kept);
}

/// A kinematic body got where the box of its step ends. The next step makes the box for what it moves then, before
/// anything looks at it.
bool isInBoxOfStep(const WorldState& world, std::uint32_t slot) {
    return world.bodies[slot].def.type == BodyType::kinematic;
}

}  // namespace

/// Several workers make boxes side by side, and give those that were outgrown to the broadphase, beside one who puts
/// the events into their order. What is no more than a block, or few among many that sleep, is moved one by one: to
/// gather it first takes longer.
void moveProxiesAndSortEvents(WorldState& world) {
    const std::size_t movable = world.bodies.size() - world.fixedBodies;
    if (world.awake.size() <= kProxyGrain || kMostPerAwake * world.awake.size() < movable) {
        for (const std::uint32_t slot : world.awake) {
            if (!isInBoxOfStep(world, slot)) { updateProxies(world, slot); }
        }
        sortEvents(world);
        return putEventsInOrder(world);
    }
    const std::span<const std::uint32_t> awake = world.awake;
    world.broadphase->beginMoves();
    const auto sort = [&world] { sortEvents(world); };
    runBeside(*world.loops, sort, awake.size(), kProxyGrain, [&world, awake](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            fetchForBoxes(world, awake.subspan(i, end - i));
            if (!isInBoxOfStep(world, awake[i])) { renewBoxes(world, awake[i]); }
        }
    });
    world.counters.proxiesMoved += world.broadphase->endMoves(*world.loops);
    putEventsInOrder(world);
}

void breakJoints(WorldState& world) {
    for (const std::uint32_t i : world.activeJoints) {
        if (!world.jointTies[i].mayBreak) { continue; }  // or a gear that went with its joint
        const Joint& joint = world.joints[i];
        const bool force = joint.base.breakForce && length(joint.reactionForce) > *joint.base.breakForce;
        const bool torque = joint.base.breakTorque && std::fabs(joint.reactionTorque) > *joint.base.breakTorque;
        if (!force && !torque) { continue; }
        const JointId id = world.joints.idOf(i);
        world.jointBreaks.push_back({.joint = id,
                                     .bodyA = joint.base.bodyA,
                                     .bodyB = joint.base.bodyB,
                                     .userData = joint.base.userData,
                                     .point = anchorAOf(world, joint),
                                     .force = toDouble(joint.reactionForce),
                                     .torque = static_cast<double>(joint.reactionTorque)});
        removeJoint(world, id);
    }
}

void putToSleep(WorldState& world, double dt) {
    restHeld(world, dt);
    countRests(world, dt);
    // Where all moves, which is most steps of what is awake, no island is asked.
    const std::vector<Tiredness>& tiredness = world.tiredness;
    if (std::find(tiredness.begin(), tiredness.end(), Tiredness::tired) != tiredness.end()) { restIslands(world); }
    std::vector<BodyId>& asleep = world.bodiesFellAsleep;
    if (asleep.empty()) { return; }
    std::sort(asleep.begin(), asleep.end(), [](BodyId a, BodyId b) { return a.index < b.index; });
}

void countLostTime(WorldState& world) {
    for (const LostTimeEntry& entry : world.lostTime) { world.bodies[entry.body.index].lostTime += entry.seconds; }
    const LostTimeEntry* last = nullptr;
    for (const LostTimeEntry& entry : world.lostTime) {  // sorted by body
        const bool isOver = world.bodies[entry.body.index].lostTime > world.settings.maxLostTime;
        world.counters.overLostTime += isOver && (last == nullptr || last->body != entry.body) ? 1 : 0;
        last = &entry;
    }
}

}  // namespace swept::inline SWEPT_PRECISION
