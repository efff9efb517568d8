#include "travel.h"

#include "../../shapes/manifold_memory.h"
#include "../state/tolerances.h"
#include "body_mode.h"
#include "world_boxes.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// More than any of the sums and products here loses by rounding, relative to its result.
constexpr double kRounding = 8 * std::numeric_limits<double>::epsilon();

/// Rounded up, so that the difference of any two sums is no less than what was added between them.
void addTurned(BodyTravel& travel, double length) { travel.turned = nextUp(travel.turned + length * (1 + kRounding)); }

/// Where all contact points of a body are, with what rounding of poses may make of it (`rememberApart`).
/// @param ahead  how far its contacts reach
Real reachFrom(const Body& body, DVec2 center, Real ahead) {
    constexpr Real kRelative = 1 + 2 * kVerdictRounding;
    return (body.radius + ahead) * kRelative + static_cast<Real>(2 * kRounding * sumNorm(center));
}

}  // namespace

void noteTravel(WorldState& world, std::uint32_t slot) {
    const BodyMotion& motion = world.motions[slot];
    BodyTravel& travel = world.travels[slot];
    if (motion.angle != travel.angle) {
        addTurned(travel, std::fabs(motion.angle - travel.angle) * static_cast<double>(world.bodies[slot].radius));
        travel.angle = motion.angle;
    }
    world.glances[slot].center = motion.center;
}

void noteNewCenter(WorldState& world, std::uint32_t slot, DVec2 shift) {
    if (shift == DVec2{}) { return; }
    // Contacts compare centres: what the shift may take away from a later motion is added here.
    addTurned(world.travels[slot], lengthAtMost(shift));
    world.glances[slot].center = world.motions[slot].center;
}

void noteRest(WorldState& world, std::uint32_t slot) {
    noteTravel(world, slot);
    BodyGlance& glance = world.glances[slot];
    const Body& body = world.bodies[slot];
    glance.motion = -1;
    world.travels[slot].boxRoom = 0;
    world.travels[slot].boxMotion = 0;
    glance.isFast = false;
    glance.ahead = 0;
    glance.turned = world.travels[slot].turned;
    const bool isFixed = body.def.type == BodyType::fixed;
    // How far contacts reach beyond what sleeps depends on the coming steps.
    const Real ahead = isFixed ? 0 : kMaxReachRatio * body.widest;
    glance.reach = reachFrom(body, glance.center, ahead);
    if (isFixed || !body.def.enabled) { return; }
    glance.ahead = ahead;
    for (const std::uint32_t index : body.shapes) {
        const Shape& shape = world.shapes[index];
        world.neededBoxes[static_cast<std::size_t>(shape.proxy)] =
            grown(boundsOf(shape.polygon, world.motions[slot].pose), kMaxReachRatio * shape.extent);
    }
}

void noteMotion(WorldState& world, std::uint32_t slot) {
    const Body& body = world.bodies[slot];
    noteTravel(world, slot);
    BodyGlance& glance = world.glances[slot];
    const Real reaching = reachMotion(glance.motion, glance.isStirred, body.widest);
    glance.ahead = reachOfMotion(reaching, body.widest, false);
    glance.turned = world.travels[slot].turned;
    glance.reach = reachFrom(body, glance.center, glance.ahead);
    if (body.isDynamic()) {
        const BodyMotion& motion = world.motions[slot];
        glance.isFast = body.extent > 0 && glance.motion > kFastRatio * body.extent;
        glance.velocity = motion.velocity;
        glance.pull = accelerationOf(world, body);
        glance.swing = std::fabs(motion.angularVelocity) * body.radius;
        glance.widest = body.widest;
    }
    // As nearly always: its boxes were made where it is, and it is no faster than it was.
    if (reaching <= world.travels[slot].boxMotion) { return; }
    world.travels[slot].boxRoom = 0;
    for (const std::uint32_t index : body.shapes) {
        world.neededBoxes[static_cast<std::size_t>(world.shapes[index].proxy)] = neededBox(world, world.shapes[index]);
    }
}

void rememberApart(const WorldState& world, ContactProbe& probe, Real room) {
    const BodyGlance& a = world.glances[probe.bodyA];
    const BodyGlance& b = world.glances[probe.bodyB];
    const DVec2 offset = b.center - a.center;
    probe.offset = toReal(offset);
    // Poses are rounded: rotations and relative positions to `Real`, positions to double.
    const double size = static_cast<double>(a.reach + b.reach) + sumNorm(offset);
    const double rounding =
        static_cast<double>(kVerdictRounding) * size + kRounding * (sumNorm(a.center) + sumNorm(b.center));
    probe.apartUntil = (a.turned + b.turned + (static_cast<double>(room) - rounding)) * (1 - kRounding);
}

Real contactReach(const WorldState& world, const Shape& shape) {
    const Body& body = world.bodies[shape.body];
    if (body.def.type == BodyType::fixed) { return 0; }
    const auto dt = static_cast<Real>(world.lastDt);
    const bool isAhead = modeOf(world, body) == ContinuousMode::speculative;
    const Real most = kMaxReachRatio * shape.extent;
    const Vec2 velocity = world.motions[shape.body].velocity;
    // What is fast along one axis is told without a root, and many of those that are asked for their reach are.
    if (!isAhead && dt * std::max(std::fabs(velocity.x), std::fabs(velocity.y)) >= most) { return most; }
    return reachOfMotion(reachMotion(world, shape.body, dt), shape.extent, isAhead);
}

bool isAhead(const WorldState& world, const Contact& contact) {
    const Real usual = world.shapes[contact.shapeA].extent + world.shapes[contact.shapeB].extent;
    return deepestSeparation(contact.manifold) > kMaxReachRatio * usual;
}

}  // namespace swept::inline SWEPT_PRECISION
