#include "held_islands.h"

#include <algorithm>
#include <limits>
#include <utility>

#include "../bodies/awake.h"
#include "../bodies/travel.h"
#include "../state/profile.h"
#include "../state/tolerances.h"
#include "balance.h"
#include "tied_roots.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

bool maySetAside(const WorldState& world, const IslandRest& rest) {
    // What has a budget of errors is not left with any that iteration may yet take away.
    return !rest.isRestless && !rest.isPushed && (rest.isDirect || !hasErrorBudget(world.settings));
}

/// After all that were added before.
void addBody(WorldState& world, std::uint32_t place, std::uint32_t slot) {
    HeldIsland& island = world.held.list[place];
    Body& body = world.bodies[slot];
    if (island.bodies == 0) {
        body.nextAsleep = slot;
    } else {
        body.nextAsleep = world.bodies[island.last].nextAsleep;
        world.bodies[island.last].nextAsleep = slot;
    }
    island.last = slot;
    ++island.bodies;
    ++world.held.bodies;
    ++world.parked.rested;
    body.heldIn = place;
    body.awake = false;
    body.role = BodyRole::idle;
    world.traits[slot] = 0;
    world.motions[slot].velocity = {};
    world.motions[slot].angularVelocity = 0;
    noteRest(world, slot);
    if (!world.settings.sleep) { return; }
    constexpr double kNever = std::numeric_limits<double>::infinity();
    const double time = body.def.allowSleep ? restTimeOf(world, body) - body.restTime : kNever;
    island.stepsToSleep = std::max(island.stepsToSleep, kRestSteps - body.restSteps);
    island.timeToSleep = std::max(island.timeToSleep, time);
}

void fallAsleepTogether(WorldState& world, std::uint32_t place) {
    const std::uint32_t first = world.held.list[place].last;
    std::uint32_t slot = first;
    do {
        Body& body = world.bodies[slot];
        body.heldIn = kNoIndex;
        body.restSteps += world.held.list[place].restSteps;
        world.bodiesFellAsleep.push_back(world.bodies.idOf(slot));
        slot = body.nextAsleep;
    } while (slot != first);
    world.counters.fellAsleep += world.held.list[place].bodies;
    world.held.close(place);
}

/// What they carry goes on as it was in the last sub-step: totals begin anew in every step.
void keepTotals(WorldState& world) {
    const auto subSteps = static_cast<Real>(subStepsOf(world.settings));
    for (const TouchingPair& pair : world.touching) {
        if (world.bodies[pair.dynamicBody()].heldIn == kNoIndex) { continue; }
        Contact& contact = world.contacts[pair.contact];
        for (std::size_t i = 0; i < pair.points; ++i) { contact.totalImpulse[i] = subSteps * contact.normalImpulse[i]; }
    }
}

}  // namespace

void holdBalancedIslands(WorldState& world) {
    const std::uint32_t before = world.held.bodies;
    for (const std::uint32_t slot : world.tied) {
        IslandRest& rest = restOf(world, slot);
        if (!maySetAside(world, rest)) { continue; }
        if (rest.heldIn == kNoIndex) { rest.heldIn = world.held.open(slot); }
        addBody(world, rest.heldIn, slot);
    }
    if (world.held.bodies == before) { return; }
    world.counters.settledBodies += world.held.bodies - before;
    const auto isHeld = [&world](std::uint32_t slot) { return world.bodies[slot].heldIn != kNoIndex; };
    keepTotals(world);
    std::erase_if(world.awake, isHeld);
    std::erase_if(world.tied, isHeld);
    findRoots(world);
    world.counters.solvedBodies = world.tied.size();
}

void restHeld(WorldState& world, double dt) {
    const std::vector<std::uint32_t>& inUse = world.held.inUse;
    for (std::size_t i = inUse.size(); i > 0; --i) {  // from behind: the last one takes the place of one that goes
        const std::uint32_t place = inUse[i - 1];
        HeldIsland& island = world.held.list[place];
        ++island.restSteps;
        island.restTime += dt;
        const bool isTired = island.restSteps >= island.stepsToSleep && island.restTime >= island.timeToSleep;
        if (isTired) { fallAsleepTogether(world, place); }
    }
}

}  // namespace swept::inline SWEPT_PRECISION
