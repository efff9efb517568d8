#include "waking.h"

#include "step.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// What is awake wakes what it touches.
void wakeAcrossContacts(WorldState& world) {
    for (const TouchingPair& pair : world.touching) {
        if (!pair.areDynamic() || world.bodies[pair.bodyA].awake == world.bodies[pair.bodyB].awake) { continue; }
        wake(world, world.bodies[pair.bodyA].awake ? pair.bodyB : pair.bodyA);
    }
}

}  // namespace

void wakeAcrossJoints(WorldState& world, std::size_t from) {
    for (std::size_t i = from; i < world.awake.size(); ++i) {  // grows as it goes
        const std::uint32_t slot = world.awake[i];
        if (!disturbs(world, slot)) { continue; }
        for (const std::uint32_t index : world.bodies[slot].joints) {
            const Joint& joint = world.joints[index];
            if (!joint.holds()) { continue; }
            for (const std::uint32_t other : joint.allBodies()) { wake(world, other); }
        }
    }
}

void wakeOnward(WorldState& world, std::size_t from) {
    while (from < world.awake.size() && anyAsleep(world)) {
        const std::size_t before = world.awake.size();
        if (world.joints.size() > 0) { wakeAcrossJoints(world, from); }
        if (!world.parked.woken.empty()) { listUnparked(world); }
        wakeAcrossContacts(world);
        from = before;
    }
}

}  // namespace swept::inline SWEPT_PRECISION
