#include "body_mass.h"

#include <algorithm>
#include <cmath>

#include "../state/number_range.h"
#include "body_measures.h"
#include "body_mode.h"
#include "levers.h"
#include "line_skin.h"
#include "travel.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

bool isMassless(const Body& body) { return body.isDynamic() && body.mass <= 0; }

/// @pre the body is dynamic, and its shapes are weighed
MassProperties massOfShapes(WorldState& world, const Body& body) {
    std::vector<MassProperties>& parts = world.massParts;
    parts.clear();
    for (const std::uint32_t slot : body.shapes) { parts.push_back(world.shapeMasses[slot]); }
    const MassProperties sum = combine(parts);
    // In double the fourth power of a length overflows within the range of lengths. `addShape` refuses one shape that
    // is so large; what is so as a whole, or was added to a static body, has no mass, so `step` refuses it.
    return isWeighable(sum) && isInRange(sum.center) ? sum : MassProperties{};
}

}  // namespace

void countBody(WorldState& world, const Body& body, std::int32_t sign) {
    const auto add = [sign](std::uint32_t& sum, bool isOne) { sum += isOne ? static_cast<std::uint32_t>(sign) : 0U; };
    const bool isIn = body.def.enabled;
    add(world.fixedBodies, body.def.type == BodyType::fixed || !isIn);
    add(world.kinematicBodies, isIn && body.def.type == BodyType::kinematic);
    add(world.bulletBodies, isIn && body.isDynamic() && body.def.bullet);
    if (body.def.bullet && body.holdingJoints > 0) { world.jointChains.areCurrent = false; }  // they list those
    add(world.watchedBodies, isIn && isWatched(body.def.continuous.value_or(ContinuousMode::off)));
    add(world.masslessBodies, isIn && isMassless(body));
}

void weigh(WorldState& world, std::span<const std::uint32_t> shapes) {
    for (const std::uint32_t slot : shapes) {
        const Shape& shape = world.shapes[slot];
        world.shapeMasses[slot] = massOf(givenPolygon(shape), shape.def.density);
    }
}

void updateMass(WorldState& world, std::uint32_t slot, bool isBuilt) {
    Body& body = world.bodies[slot];
    noteTravel(world, slot);  // with the radius of before
    const bool wasMassless = isMassless(body);
    MassProperties total;
    if (body.isDynamic()) { total = massOfShapes(world, body); }
    if (body.def.mass > 0) {
        const double given = static_cast<double>(body.def.mass);
        total.inertia = total.mass > 0 ? total.inertia * (given / total.mass) : 0;
        total.mass = given;
    }
    if (body.def.inertia > 0) { total.inertia = static_cast<double>(body.def.inertia); }
    const Vec2 center = body.isDynamic() && total.mass > 0 ? toReal(total.center) : Vec2{};
    BodyMotion& motion = world.motions[slot];
    const DVec2 before = motion.center;
    motion.center = apply(motion.pose, center);
    const Vec2 carried = motion.velocity + cross(motion.angularVelocity, toReal(motion.center - before));
    if (!isBuilt && isInRange(carried)) { motion.velocity = carried; }
    body.startCenter += motion.center - before;
    noteNewCenter(world, slot, motion.center - before);
    body.localCenter = center;
    body.mass = body.isDynamic() && hasInverse(total.mass) ? total.mass : 0;
    body.inertia = body.isDynamic() ? total.inertia : 0;
    body.inverseMass = body.mass > 0 ? static_cast<Real>(1 / body.mass) : Real(0);
    world.mostInverseMass = std::max(world.mostInverseMass, body.inverseMass);
    if (body.inverseMass > 0) { world.leastInverseMass = std::min(world.leastInverseMass, body.inverseMass); }
    resistTurns(world, slot);
    world.travels[slot].boxRoom = 0;
    measure(world, slot);
    if (!body.awake) { noteRest(world, slot); }
    if (!body.def.enabled) { return; }
    world.masslessBodies += isMassless(body) ? 1 : 0;
    world.masslessBodies -= wasMassless ? 1 : 0;
}

void updatePose(WorldState& world, std::uint32_t slot) {
    BodyMotion& motion = world.motions[slot];
    motion.pose = poseOf(motion.center, motion.angle, world.bodies[slot].localCenter);
}

}  // namespace swept::inline SWEPT_PRECISION
