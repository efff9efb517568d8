#include <span>

#include "../bodies/awake.h"
#include "../bodies/world_boxes.h"
#include "../contacts/may_touch.h"
#include "../contacts/pairs_of_shapes.h"
#include "../islands/held_islands.h"
#include "../state/world_state.h"
#include "../world.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Ends the contacts of a body that are forbidden now. What is allowed now is found as the next step begins.
void askAnew(WorldState& world, std::uint32_t body) {
    const auto shapeOf = [&world](ProxyId proxy) -> const Shape& {
        return world.shapes[world.proxyShapes[static_cast<std::size_t>(proxy)]];
    };
    const std::span<const std::uint32_t> forbidden =
        pairsOf(world, world.bodies[body].shapes, [&](const ContactPair& pair) {
            return pair.bodyA == body && !mayTouch(world, shapeOf(pair.proxyA), shapeOf(pair.proxyB));
        });
    if (forbidden.empty()) { return renewProxies(world, body); }
    wakeAcross(world, body, forbidden);
    rouse(world, body);
    removePairs(world, forbidden);
    renewProxies(world, body);
}

}  // namespace

void World::setContactFilter(const ContactFilter* filter) {
    WorldState& world = *state_;
    if (filter == nullptr && world.contactFilter == nullptr) { return; }
    world.contactFilter = filter;
    releaseAllHeld(world);
    wakeAll(world);
    restAnew(world);
    for (std::uint32_t slot = 0; slot < world.bodies.slotCount(); ++slot) {
        if (world.bodies.isAlive(slot)) { askAnew(world, slot); }
    }
}

}  // namespace swept::inline SWEPT_PRECISION
