#include "ground_on_the_way.h"

#include <algorithm>

#include "../bodies/body_mass.h"
#include "../state/world_state.h"

namespace swept::inline SWEPT_PRECISION {

void listMovingGround(WorldState& world) {
    MovingGround& ground = world.fastIslands.ground;
    ground.slots.clear();
    if (world.kinematicBodies == 0) { return; }
    ground.places.resize(world.bodies.slotCount());
    ground.atStart.clear();
    for (const std::uint32_t slot : world.awake) {
        if (!isAwakeKinematic(world.traits[slot])) { continue; }
        ground.places[slot] = static_cast<std::uint32_t>(ground.slots.size());
        ground.slots.push_back(slot);
        ground.atStart.push_back(world.motions[slot]);
    }
    ground.isMet.assign(ground.slots.size(), 0);
    ground.met.reserve(ground.slots.size());
}

GroundOnTheWay::GroundOnTheWay(WorldState& world, FlightScratch& scratch) : world_(world), scratch_(scratch) {
    if (!world.fastIslands.ground.slots.empty()) { scratch.ground = this; }
}

void GroundOnTheWay::meet(std::uint32_t slot) {
    MovingGround& ground = world_.fastIslands.ground;
    if (!ground.holds(slot) || ground.isMet[ground.places[slot]] != 0) { return; }
    ground.isMet[ground.places[slot]] = 1;
    ground.met.push_back(ground.places[slot]);
    place(ground.places[slot]);
}

void GroundOnTheWay::goTo(double time) {
    time_ = time;
    for (const std::uint32_t met : world_.fastIslands.ground.met) { place(met); }
}

void GroundOnTheWay::goBack() {
    if (scratch_.ground != this) { return; }
    scratch_.ground = nullptr;
    MovingGround& ground = world_.fastIslands.ground;
    for (const std::uint32_t met : ground.met) {
        world_.motions[ground.slots[met]] = ground.atStart[met];
        ground.isMet[met] = 0;
    }
    ground.met.clear();
}

void GroundOnTheWay::addMet(std::vector<std::uint32_t>& slots) const {
    MovingGround& ground = world_.fastIslands.ground;
    std::sort(ground.met.begin(), ground.met.end());
    for (const std::uint32_t met : ground.met) { slots.push_back(ground.slots[met]); }
}

void GroundOnTheWay::place(std::uint32_t place) {
    const MovingGround& ground = world_.fastIslands.ground;
    const std::uint32_t slot = ground.slots[place];
    const BodyMotion& start = ground.atStart[place];
    BodyMotion& motion = world_.motions[slot];
    motion.center = start.center + time_ * toDouble(start.velocity);
    motion.angle = start.angle + time_ * static_cast<double>(start.angularVelocity);
    updatePose(world_, slot);
}

}  // namespace swept::inline SWEPT_PRECISION
