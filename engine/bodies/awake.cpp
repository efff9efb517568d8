#include "awake.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "../../shapes/room.h"
#include "../state/tolerances.h"
#include "world_boxes.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

void startResting(Body& body, const BodyMotion& motion) {
    body.restCenter = motion.center;
    body.restAngle = motion.angle;
    body.restTime = 0;
    body.restSteps = 0;
}

}  // namespace

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

void releaseHeld(WorldState& world, std::uint32_t start) {
    const std::uint32_t place = world.bodies[start].heldIn;
    const HeldIsland island = world.held.list[place];
    world.held.close(place);
    std::uint32_t slot = island.last;
    std::uint32_t next = world.bodies[slot].nextAsleep;
    do {
        slot = next;
        Body& body = world.bodies[slot];
        next = std::exchange(body.nextAsleep, slot);  // or what is made fixed now would wake them later
        body.heldIn = kNoIndex;
        body.awake = true;
        body.soughtSteps = kJustReleased;
        body.restSteps += island.restSteps;
        body.restTime += island.restTime;
        world.awake.push_back(slot);
        world.parked.woken.push_back(slot);
    } while (slot != island.last);
}

void releaseAllHeld(WorldState& world) {
    if (world.held.inUse.empty()) { return; }
    for (std::size_t i = 0; i < world.held.list.size(); ++i) {
        if (world.held.list[i].bodies > 0) { releaseHeld(world, world.held.list[i].last); }
    }
}

void rouse(WorldState& world, std::uint32_t slot) {
    wake(world, slot);
    startResting(world.bodies[slot], world.motions[slot]);
}

void wakeToRest(WorldState& world, std::uint32_t slot) {
    const std::size_t before = world.awake.size();
    wake(world, slot);
    for (std::size_t i = before; i < world.awake.size(); ++i) { world.bodies[world.awake[i]].soughtSteps = 0; }
}

void rouseToRest(WorldState& world, std::uint32_t slot) {
    wakeToRest(world, slot);
    startResting(world.bodies[slot], world.motions[slot]);
}

void notePut(Body& body) {
    body.isPut = true;
    body.groundNormal = {};
    body.soughtSteps = 0;
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

void wakeJoined(WorldState& world, std::uint32_t body) {
    for (const std::uint32_t slot : world.bodies[body].joints) {
        const Joint& joint = world.joints[slot];
        for (const std::uint32_t other : joint.allBodies()) {
            if (other != body && joint.holds()) { rouse(world, other); }
        }
    }
}

void removeFromAwake(WorldState& world, std::uint32_t slot) {
    wake(world, slot);
    if (world.bodies[slot].awake) { leaveAwake(world, slot); }
}

double restTimeOf(const WorldState& world, const Body& body) {
    const auto gravity = static_cast<double>(length(world.settings.gravity));
    if (!(gravity > 0)) { return kWeightlessRest; }
    return kRestTimes * std::sqrt(static_cast<double>(body.extent) / gravity);
}

}  // namespace swept::inline SWEPT_PRECISION
