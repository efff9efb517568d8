#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <span>

#include "../../shapes/branchless.h"
#include "../../shapes/cache_line.h"
#include "../../shapes/compiler.h"
#include "../islands/note_touching.h"
#include "../modes/modes.h"
#include "../state/tolerances.h"
#include "step.h"
#include "waking.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Bodies per block of a parallel loop.
constexpr std::size_t kRoleGrain = 128;
/// Of those that are asked for their islands alone.
constexpr std::size_t kRootGrain = 512;

/// Bodies that are fetched ahead: most of them are written, and others read them since.
constexpr std::size_t kResetAhead = 16;

/// @param coming  of the same worker
SWEPT_FORCE_INLINE void fetchForReset(const WorldState& world, std::span<const std::uint32_t> coming) {
    if (coming.size() <= kResetAhead) { return; }
    const std::uint32_t slot = coming[kResetAhead];
    const Body& body = world.bodies[slot];
    fetchToWrite(body.awake);
    fetchToWrite(body.startAngle);
    prefetch(&world.motions[slot]);
    prefetch(&world.glances[slot]);
}

/// @param restSpeed  `restSpeedOf` the step
void resetBody(WorldState& world, std::uint32_t slot, Real restSpeed, Real dt) {
    Body& body = world.bodies[slot];
    const BodyMotion& motion = world.motions[slot];
    body.fresh = body.deepContact = body.sunk = false;
    body.bounces = body.rests = body.strikes = body.startled = body.flung = false;
    // What just woke has no bound yet.
    const Real known = world.glances[slot].motion;
    const Real bound = known < 0 ? motionBound(world, slot, dt) : known;
    body.fast = body.extent > 0 && bound > kFastRatio * body.extent;
    const bool isAtRest = isStill(body, motion, restSpeed, dt);
    if (!isAtRest) { body.soughtSteps = 0; }
    world.traits[slot] = static_cast<BodyTraits>(kIsAwake | (body.isDynamic() ? kIsDynamic : 0) |
                                                 (body.fast ? kIsFast : 0) | (isAtRest ? kIsStill : 0));
    body.startCenter = motion.center;
    body.startAngle = motion.angle;
}

/// @param awake  that were reset
void speedUpFreeBullets(WorldState& world, std::span<const std::uint32_t> awake, Real dt) {
    for (const std::uint32_t slot : awake) {
        const Real known = world.glances[slot].motion;
        Body& body = world.bodies[slot];
        if (!isFastFreeBullet(world, body, known < 0 ? motionBound(world, slot, dt) : known)) { continue; }
        body.fast = true;
        world.traits[slot] = static_cast<BodyTraits>(world.traits[slot] | kIsFast);
    }
}

void startle(WorldState& world, const Contact& contact, Real dt) {
    if (contact.sensor || contact.dynamicA == contact.dynamicB) { return; }
    const std::uint32_t kinematic = contact.dynamicB ? contact.bodyA : contact.bodyB;
    const std::uint32_t other = contact.dynamicB ? contact.bodyB : contact.bodyA;
    const Body& mover = world.bodies[kinematic];
    if (mover.def.type != BodyType::kinematic || !mover.awake) { return; }
    Body& body = world.bodies[other];
    if (!(body.extent > 0)) { return; }
    if (!(motionBound(world, kinematic, dt) > kFastRatio * contact.extent)) { return; }
    const std::size_t before = world.awake.size();
    wake(world, other);
    resetBodies(world, std::span(world.awake).subspan(before), dt);
    body.fast = body.startled = true;
    // Nor is it held (held_islands.h): what passes over it in this step may not touch it yet.
    world.traits[other] = static_cast<BodyTraits>((world.traits[other] | kIsFast) & ~kIsStill);
}

/// A moving kinematic body passes over what rests as fast as that could pass under it: everything in the box of its
/// coming step is awake and fast.
void startleNearKinematicBodies(WorldState& world, Real dt) {
    const auto mayStartle = [&world](std::uint32_t slot) { return isAwakeKinematic(world.traits[slot]); };
    for (std::size_t i = 0; i < world.probes.size(); ++i) {
        const ContactProbe& probe = world.probes[i];
        if (probe.isPlain || !(mayStartle(probe.bodyA) || mayStartle(probe.bodyB))) { continue; }
        startle(world, world.contacts[probe.contact], dt);
    }
}

bool isFlyer(const WorldState& world, const Body& body) {
    const bool isFlung = body.fast && (body.strikes || !body.rests);
    const bool isAlone = body.holdingJoints == 0 && !body.touchesDynamic && !body.deepContact;
    if (!isAlone || !(isFlung || body.bounces)) { return false; }
    const ContinuousMode mode = modeOf(world, body);
    return isFlung ? isSwept(mode) : mode == ContinuousMode::subStep;
}

/// @param traits  of the body, which is awake
BodyRole roleOf(const WorldState& world, const Body& body, BodyTraits traits) {
    if ((traits & kIsDynamic) == 0) { return BodyRole::free; }
    if (isFlyer(world, body)) { return BodyRole::flyer; }
    return body.holdingJoints == 0 && !body.hasContact ? BodyRole::free : BodyRole::solved;
}

/// What it can tell from the traits, which are small, is left to who lists the bodies in order. Of most bodies it looks
/// at their first lines of memory alone.
void giveRoles(WorldState& world) {
    std::atomic<std::uint32_t> bullets = 0;
    std::atomic<bool> isAnyFast = false;
    world.loops->run(world.awake.size(), kRoleGrain, [&](std::size_t begin, std::size_t end, int) {
        std::uint32_t some = 0;
        bool isOneFast = false;
        for (std::size_t i = begin; i < end; ++i) {
            BodyTraits& traits = world.traits[world.awake[i]];
            Body& body = world.bodies[world.awake[i]];
            body.hasContact = (traits & kHasContact) != 0;
            body.touchesDynamic = (traits & kTouchesDynamic) != 0;
            body.role = roleOf(world, body, traits);
            if (body.role != BodyRole::solved) { body.effort = {}; }
            if (body.role == BodyRole::flyer) { traits |= kIsFlyer; }
            if (body.role == BodyRole::solved) { traits |= kIsTied; }
            const bool isBullet = world.bulletBodies > 0 && body.def.bullet;
            some += isBullet ? 1 : 0;
            isOneFast = isOneFast || body.fast || body.sunk || isBullet || body.role == BodyRole::flyer;
        }
        if (some > 0) { bullets.fetch_add(some, std::memory_order_relaxed); }
        if (isOneFast) { isAnyFast.store(true, std::memory_order_relaxed); }
    });
    world.bullets = bullets;
    world.anyFast = isAnyFast;
}

/// In order of waking. Which role is next, nothing foretells: each is written down, and kept if it was meant.
void listRoles(WorldState& world) {
    const std::size_t count = world.awake.size();
    world.flyers.resize(count);
    world.tied.resize(count);
    std::size_t flyers = 0;
    std::size_t tied = 0;
    for (const std::uint32_t slot : world.awake) {
        const BodyTraits traits = world.traits[slot];
        world.flyers[flyers] = slot;
        world.tied[tied] = slot;
        flyers += (traits & kIsFlyer) != 0 ? 1 : 0;
        tied += (traits & kIsTied) != 0 ? 1 : 0;
    }
    world.flyers.resize(flyers);
    world.tied.resize(tied);
    world.counters.freeBodies += count - flyers - tied;
}

}  // namespace

void resetBodies(WorldState& world, std::span<const std::uint32_t> awake, Real dt) {
    const Real restSpeed = restSpeedOf(world, dt);
    for (std::size_t i = 0; i < awake.size(); ++i) {
        fetchForReset(world, awake.subspan(i));
        resetBody(world, awake[i], restSpeed, dt);
    }
    if (world.bulletBodies > 0) { speedUpFreeBullets(world, awake, dt); }
}

void assignRoles(WorldState& world, Real dt) {
    if (world.kinematicBodies > 0) {
        const std::size_t before = world.awake.size();
        startleNearKinematicBodies(world, dt);
        if (!world.parked.woken.empty()) { listUnparked(world); }
        const std::size_t startled = world.awake.size();
        wakeOnward(world, before);
        if (!world.parked.woken.empty()) { listUnparked(world); }
        resetBodies(world, std::span(world.awake).subspan(startled), dt);
    }
    world.islands.reset(world.bodies.slotCount(), world.awake);
    noteTouching(world, dt);
    giveRoles(world);
    listRoles(world);
    world.counters.solvedBodies = world.tied.size();
    world.counters.settledBodies = world.held.bodies;
    world.counters.islands = world.held.inUse.size();
    world.counters.flyers = world.flyers.size();
    world.counters.awakeBodies = world.awake.size() + world.held.bodies;
}

/// By contacts the bodies are united already.
void findIslands(WorldState& world) {
    if (!world.jointChains.areCurrent) { findJointChains(world); }
    for (const JointChains::Member& member : world.jointChains.members) {
        world.islands.unite(member.body, member.lowest);
    }
    world.counters.islands += findRoots(world);
}

std::uint64_t findRoots(WorldState& world) {
    world.tiedRoots.resize(world.tied.size());
    if (world.tied.empty()) { return 0; }
    std::atomic<std::uint64_t> count = 0;
    world.loops->run(world.tied.size(), kRootGrain, [&world, &count](std::size_t begin, std::size_t end, int) {
        std::uint64_t some = 0;
        for (std::size_t i = begin; i < end; ++i) {
            const std::uint32_t root = world.islands.rootOf(world.tied[i]);
            world.tiedRoots[i] = root;
            some += root == world.tied[i] ? 1 : 0;
        }
        count.fetch_add(some, std::memory_order_relaxed);
    });
    world.islands.flatten(world.tied, world.tiedRoots);
    return count;
}

}  // namespace swept::inline SWEPT_PRECISION
