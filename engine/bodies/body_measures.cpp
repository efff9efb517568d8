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

enum class Measure : std::uint8_t { reach, leastPassed, sensor, line, extent, widest, radius };

/// Whether of some measures of a body one may be attained by no shape that it has: a look at a few shapes tells of
/// most levels, whose tiles are of few sizes.
bool isAnyLost(const WorldState& world, std::uint32_t slot, std::uint32_t attained) {
    constexpr std::size_t kMostAsked = 16;
    const Body& body = world.bodies[slot];
    // The last ones: what was destroyed is often put back.
    const std::size_t first = body.shapes.size() - std::min(body.shapes.size(), kMostAsked);
    for (std::size_t i = body.shapes.size(); attained != 0 && i > first; --i) {
        attained &= ~measuresAttained(body, world.shapes[body.shapes[i - 1]]);
    }
    return attained != 0;
}

/// The last sensor that is left tells how small sensors are.
bool isOnlySensorNew(const WorldState& world, std::uint32_t slot) {
    if (world.sensors.size() != 1) { return false; }
    const Shape& shape = world.shapes[world.sensors.front()];
    return shape.body == slot && leastPassed(shape) != world.leastPassedOfSensors;
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

std::uint32_t measuresAttained(const Body& body, const Shape& shape) {
    std::uint32_t attained = 0;
    const auto note = [&attained](Measure measure, bool isAttained) {
        attained |= isAttained ? 1U << static_cast<unsigned>(measure) : 0U;
    };
    note(Measure::reach, shape.radius >= body.reach);
    note(Measure::leastPassed, leastPassed(shape) <= body.leastPassed);
    note(Measure::sensor, shape.def.sensor);
    if (shape.def.sensor) { return attained; }
    note(Measure::line, shape.isLine);
    note(Measure::extent, shape.extent <= body.extent);
    note(Measure::widest, shape.extent >= body.widest);
    note(Measure::radius, shape.radius >= body.radius);
    return attained;
}

void noteLoss(WorldState& world, std::uint32_t body, std::uint32_t attained) {
    if (!isAnyLost(world, body, attained) && !isOnlySensorNew(world, body)) { return; }
    // As many as are taken away one after the other between two steps.
    if (world.unmeasured.empty() || world.unmeasured.back() != body) { world.unmeasured.push_back(body); }
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
