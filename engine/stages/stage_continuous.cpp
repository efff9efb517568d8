#include <algorithm>

#include "../bodies/world_boxes.h"
#include "../containers/move_all.h"
#include "../counter_list.h"
#include "../crew/shared_choice.h"
#include "../flight/bullets.h"
#include "../flight/chain_crossing.h"
#include "../flight/clamp.h"
#include "../flight/solved_path.h"
#include "../modes/modes.h"
#include "../state/tolerances.h"
#include "step.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Bodies per block: one sweep is work enough.
constexpr std::size_t kFlyerGrain = 2;
/// Likewise, where each is only looked at.
constexpr std::size_t kLookGrain = 128;

/// What is fast, or was flung: the solver moved it as far as only a fast body may, since something hit it within the
/// step.
bool isHeldAtImpacts(const WorldState& world, std::uint32_t slot) {
    const Body& body = world.bodies[slot];
    if (!body.fast && !body.flung && !body.sunk) { return false; }
    const bool done = body.role == BodyRole::flyer || body.role == BodyRole::together;
    if (!body.isDynamic() || done || !isSwept(modeOf(world, body))) { return false; }
    return body.fast || body.sunk || (body.flung && movedFast(world, slot));
}

LostTimeReason reasonOf(const WorldState& world, const Body& body) {
    return modeOf(world, body) == ContinuousMode::stop ? LostTimeReason::stop : LostTimeReason::clamp;
}

void merge(WorldState& world, FlightScratch& scratch) {
    moveAll(world.contactEvents, scratch.events);
    moveAll(world.lostTime, scratch.lostTime);
    moveAll(world.impactPoses, scratch.impactPoses);
    moveAll(world.crossed, scratch.chains.crossed);
    scratch.met.clear();  // by a flight that ended there: its shapes may be gone by the next step, and their slots, too
    addPart(world.counters, scratch.counters);
    scratch.counters = {};
}

}  // namespace

void reachWithKinematicBodies(WorldState& world) {
    for (const std::uint32_t slot : world.awake) {
        if (world.bodies[slot].def.type == BodyType::kinematic) { updateProxies(world, slot); }
    }
}

void sweepFastBodies(WorldState& world, double dt) {
    const auto workers = static_cast<std::size_t>(world.loops->workerCount());
    world.flightScratch.resize(std::max(workers, world.flightScratch.size()));
    if (world.bulletBodies > 0) {
        flyBullets(world, dt);
        if (world.watched) { limitWays(world, dt); }  // of whom they pushed
    }
    forEachMeant(
        *world.loops, world.awake, kLookGrain, world.answers,
        [&world](std::uint32_t slot) { return isHeldAtImpacts(world, slot); },
        [&world](std::uint32_t slot) { world.flyers.push_back(slot); });
    if (world.flyers.empty() && !world.fastIslands.any && world.bulletBodies == 0) { return; }
    world.counters.sweeps += world.flyers.size();
    world.loops->run(world.flyers.size(), kFlyerGrain, [&](std::size_t begin, std::size_t end, int worker) {
        FlightScratch& scratch = world.flightScratch[static_cast<std::size_t>(worker)];
        for (std::size_t i = begin; i < end; ++i) {
            const std::uint32_t slot = world.flyers[i];
            const Body& body = world.bodies[slot];
            if (body.role == BodyRole::flyer) {
                fly(world, slot, dt, scratch);
            } else {
                scratch.chains.meetsBacks = false;
                clampAtImpact(world, slot, {.length = dt, .dt = dt}, reasonOf(world, body), scratch);
                noteCrossingsOfPath(world, slot, dt, scratch);
                endCrossings(scratch);
            }
        }
    });
    for (FlightScratch& scratch : world.flightScratch) { merge(world, scratch); }
    std::sort(world.crossed.begin(), world.crossed.end());
}

}  // namespace swept::inline SWEPT_PRECISION
