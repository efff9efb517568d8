#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <span>

#include "../bodies/awake.h"
#include "../contacts/noticing.h"
#include "../flight/bullets_ahead.h"
#include "../flight/whirls.h"
#include "../islands/joint_chains.h"
#include "../islands/note_touching.h"
#include "../islands/reset_bodies.h"
#include "../islands/tied_roots.h"
#include "../modes/modes.h"
#include "../state/tolerances.h"
#include "step.h"
#include "waking.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Bodies per block of a parallel loop.
constexpr std::size_t kRoleGrain = 128;

void startle(WorldState& world, const Contact& contact, Real dt) {
    if (contact.sensor || contact.dynamicA == contact.dynamicB) { return; }
    const std::uint32_t kinematic = contact.dynamicB ? contact.bodyA : contact.bodyB;
    const std::uint32_t other = contact.dynamicB ? contact.bodyB : contact.bodyA;
    const Body& mover = world.bodies[kinematic];
    if (mover.def.type != BodyType::kinematic || !mover.awake) { return; }
    Body& body = world.bodies[other];
    if (!(body.extent > 0)) { return; }
    if (!(motionBound(world, kinematic, dt) > body.slowRatio() * contact.extent)) { return; }
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

/// What bullets that joints hold may meet in this step is awake.
void wakeAheadOfBullets(WorldState& world, Real dt) {
    if (!world.jointChains.areCurrent) { findJointChains(world); }
    const std::size_t before = world.awake.size();
    if (!world.jointChains.bullets.empty()) { findAhead(world, dt); }
    findWhirls(world, dt);
    if (world.jointChains.bullets.empty() && world.bulletWork.whirls.empty()) { return; }
    if (!world.parked.woken.empty()) { listUnparked(world); }
    wakeOnward(world, before);
    if (!world.parked.woken.empty()) { listUnparked(world); }
    resetBodies(world, std::span(world.awake).subspan(before), dt);
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
            if (body.role == BodyRole::free) { body.groundNormal = {}; }
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

void assignRoles(WorldState& world, Real dt) {
    world.bulletWork.ahead.clear();
    world.bulletWork.whirls.clear();
    if (world.kinematicBodies > 0) {
        const std::size_t before = world.awake.size();
        startleNearKinematicBodies(world, dt);
        if (!world.parked.woken.empty()) { listUnparked(world); }
        const std::size_t startled = world.awake.size();
        wakeOnward(world, before);
        if (!world.parked.woken.empty()) { listUnparked(world); }
        resetBodies(world, std::span(world.awake).subspan(startled), dt);
    }
    const bool mayBulletsBeJointed = world.bulletBodies > 0 && world.joints.size() > 0;
    if (mayBulletsBeJointed) { wakeAheadOfBullets(world, dt); }
    world.islands.reset(world.bodies.slotCount(), world.awake);
    noteTouching(world, dt);
    if (mayBulletsBeJointed) { tieAhead(world); }
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

}  // namespace swept::inline SWEPT_PRECISION
