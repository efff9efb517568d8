#include "yield_to_ground.h"

#include <algorithm>

namespace swept::inline SWEPT_PRECISION {
namespace {

bool hasMetGround(const AdvancingIsland& island) {
    return std::any_of(island.contacts.begin(), island.contacts.end(),
                       [](const Contact& contact) { return contact.manifold.count > 0; });
}

bool isLedByKinematic(const WorldState& world, const AdvancingIsland& island) {
    const auto isKinematic = [&world](std::uint32_t slot) {
        return world.bodies[slot].def.type == BodyType::kinematic;
    };
    return std::any_of(island.jointSlots.begin(), island.jointSlots.end(), [&](std::uint32_t joint) {
        const auto bodies = world.joints[joint].allBodies();
        return std::any_of(bodies.begin(), bodies.end(), isKinematic);
    });
}

}  // namespace

void yieldToGround(WorldState& world, const AdvancingIsland& island) {
    if (world.kinematicBodies == 0 || world.bodies[island.members[0]].effort.direct != DirectScope::islands) { return; }
    if (!hasMetGround(island) || !isLedByKinematic(world, island)) { return; }
    for (const std::uint32_t slot : island.members) { world.bodies[slot].effort.direct = DirectScope::none; }
}

}  // namespace swept::inline SWEPT_PRECISION
