#include "body_measures.h"

#include <algorithm>
#include <limits>
#include <span>

#include "../state/tolerances.h"
#include "../state/world_state.h"
#include "travel.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// For sensors, which see bodies by all that these have, other sensors too (mode_sensors.cpp).
void addPassed(WorldState& world, Body& body, const Shape& shape) {
    const Real passed = leastPassed(shape);
    body.reach = std::max(body.reach, shape.radius);
    body.leastPassed = std::min(body.leastPassed, passed);
    world.leastPassed = std::min(world.leastPassed, passed);
    if (!shape.def.sensor) { return; }
    body.hasSensor = true;
    const bool isOnly = world.sensors.size() == 1;
    world.leastPassedOfSensors = isOnly ? passed : std::min(world.leastPassedOfSensors, passed);
}

void addMeasures(WorldState& world, Body& body, std::span<const std::uint32_t> shapes) {
    for (const std::uint32_t slot : shapes) {
        Shape& shape = world.shapes[slot];
        shape.radius = radiusAbout(shape.polygon, body.localCenter);
        addPassed(world, body, shape);
        if (shape.def.sensor) { continue; }
        body.hasLine = body.hasLine || shape.isLine;
        body.extent = body.extent > 0 ? std::min(body.extent, shape.extent) : shape.extent;
        body.widest = std::max(body.widest, shape.extent);
        body.radius = std::max(body.radius, shape.radius);
    }
    if (body.isDynamic() && body.widest > 0) { world.leastWidth = std::min(world.leastWidth, body.widest); }
}

}  // namespace

Real leastPassed(const Shape& shape) { return (shape.isLine ? kTargetRatio : kFastRatio) * shape.extent; }

void measure(WorldState& world, std::uint32_t slot) {
    Body& body = world.bodies[slot];
    body.extent = 0;
    body.widest = 0;
    body.radius = 0;
    body.reach = 0;
    body.leastPassed = std::numeric_limits<Real>::infinity();
    body.hasSensor = body.hasLine = false;
    addMeasures(world, body, body.shapes);
}

void measureAdded(WorldState& world, std::uint32_t slot, std::size_t first) {
    Body& body = world.bodies[slot];
    noteTravel(world, slot);  // with the radius of before
    addMeasures(world, body, std::span(body.shapes).subspan(first));
    if (!body.awake) { noteRest(world, slot); }
}

void measureAnew(WorldState& world) {
    std::vector<std::uint32_t>& slots = world.unmeasured;
    std::sort(slots.begin(), slots.end());
    slots.erase(std::unique(slots.begin(), slots.end()), slots.end());
    for (const std::uint32_t slot : slots) {
        // Another body may be in its place by now.
        if (!world.bodies.isAlive(slot) || world.bodies[slot].isDynamic()) { continue; }
        noteTravel(world, slot);
        measure(world, slot);
        if (!world.bodies[slot].awake) { noteRest(world, slot); }
    }
    slots.clear();
}

}  // namespace swept::inline SWEPT_PRECISION
