#include <algorithm>
#include <vector>

#include "../bodies/awake.h"
#include "../contacts/pairs_of_shapes.h"
#include "../state/world_state.h"
#include "../world.h"
#include "surfaces.h"

/// Surfaces of shapes and, one by one, of the segments of chains: each is in the definition of its slot.

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Slots of a shape stand together in the list of its body, those of a chain in their order.
/// @return none: it has fewer segments
std::uint32_t slotOfSegment(const WorldState& world, ShapeId id, std::uint32_t segment) {
    const std::vector<std::uint32_t>& slots = world.bodies[world.shapes[id.index].body].shapes;
    const auto head = std::find(slots.begin(), slots.end(), id.index);
    if (segment >= static_cast<std::size_t>(slots.end() - head)) { return kNoIndex; }
    const std::uint32_t slot = *(head + static_cast<std::ptrdiff_t>(segment));
    return world.shapes[slot].head == id.index ? slot : kNoIndex;
}

/// Gives these slots of one shape the surfaces. Of those that act otherwise, contacts mix anew, and what touches wakes.
void changeSurfaces(WorldState& world, std::span<const std::uint32_t> slots, std::span<const Surface> surfaces) {
    std::vector<std::uint32_t> changed;
    for (std::size_t i = 0; i < slots.size(); ++i) {
        if (!actAlike(surfaceOf(world.shapes[slots[i]].def), surfaces[i])) { changed.push_back(slots[i]); }
    }
    const std::uint32_t body = world.shapes[slots.front()].body;
    std::span<const std::uint32_t> places;
    if (!changed.empty()) {
        std::sort(changed.begin(), changed.end());
        const auto isChanged = [&](ProxyId proxy) {
            return std::binary_search(changed.begin(), changed.end(),
                                      world.proxyShapes[static_cast<std::size_t>(proxy)]);
        };
        places = pairsOf(world, changed, [&](const ContactPair& pair) {
            return (pair.bodyA == body && isChanged(pair.proxyA)) || (pair.bodyB == body && isChanged(pair.proxyB));
        });
        wakeAcross(world, body, places);
    }
    for (std::size_t i = 0; i < slots.size(); ++i) {
        setDefinition(world, slots[i], withSurface(world.shapes[slots[i]].def, surfaces[i]));
    }
    mixSurfacesOf(world, places);
    if (!changed.empty()) { rouse(world, body); }
}

}  // namespace

std::uint32_t World::segmentCount(ShapeId id) const {
    std::uint32_t count = 0;
    for (std::uint32_t slot = isValid(id) ? id.index : kNoIndex; slot != kNoIndex;
         slot = state_->shapes[slot].nextInChain) {
        ++count;
    }
    return count;
}

Surface World::surface(ShapeId id, std::uint32_t segment) const {
    const std::uint32_t slot = isValid(id) ? slotOfSegment(*state_, id, segment) : kNoIndex;
    return slot != kNoIndex ? surfaceOf(state_->shapes[slot].def) : Surface{};
}

Status World::setSurface(ShapeId id, std::uint32_t segment, const Surface& surface) {
    WorldState& world = *state_;
    if (!isValid(id)) { return {StatusCode::staleId, "shape"}; }
    const std::uint32_t slot = slotOfSegment(world, id, segment);
    if (slot == kNoIndex) { return {StatusCode::outOfRange, "segment"}; }
    const Status good = checkSurface(surface);
    if (!good.ok()) { return good; }
    changeSurfaces(world, std::span(&slot, 1), std::span(&surface, 1));
    return Status::success();
}

Status World::setSurfaces(ShapeId id, std::span<const Surface> surfaces) {
    WorldState& world = *state_;
    if (!isValid(id)) { return {StatusCode::staleId, "shape"}; }
    std::vector<std::uint32_t> slots;
    listSlots(world, id.index, slots);
    const Status good = checkSurfaces(surfaces, slots.size());
    if (!good.ok()) { return good; }
    changeSurfaces(world, slots, surfaces);
    return Status::success();
}

}  // namespace swept::inline SWEPT_PRECISION
