#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <tuple>
#include <vector>

#include "../bodies/body_mass.h"
#include "modes.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// A body that was cut to the limit must not be cut again for the rounding of the cut (of `float`, and of positions).
constexpr Real kLimitRounding = 1 + Real(0x1p-18);

/// Smallest width, radius included. Segments have none of their own: their `extent` is their length.
Real widthOf(const Shape& shape) { return shape.polygon.count <= 2 ? 2 * shape.polygon.radius : shape.extent; }

Real thinnestSolid(const WorldState& world, std::uint32_t body) {
    Real thinnest = std::numeric_limits<Real>::infinity();
    for (const std::uint32_t slot : world.bodies[body].shapes) {
        const Shape& shape = world.shapes[slot];
        if (!shape.def.sensor) { thinnest = std::min(thinnest, widthOf(shape)); }
    }
    return thinnest;
}

/// Over all static and kinematic shapes; kept until one comes or goes.
Real thinnestWall(WorldState& world) {
    if (world.thinnestWall) { return *world.thinnestWall; }
    Real thinnest = std::numeric_limits<Real>::infinity();
    for (std::uint32_t slot = 0; slot < world.shapes.slotCount(); ++slot) {
        if (!world.shapes.isAlive(slot)) { continue; }
        const Shape& shape = world.shapes[slot];
        const Body& body = world.bodies[shape.body];
        if (shape.def.sensor || body.isDynamic() || !body.def.enabled) { continue; }
        thinnest = std::min(thinnest, widthOf(shape));
    }
    world.thinnestWall = thinnest;
    return thinnest;
}

bool isLimited(const WorldState& world, const Body& body) {
    return body.isDynamic() && modeOf(world, body) == ContinuousMode::speedLimit;
}

/// The part of its way that the limit takes from a body is time that it would have needed.
void enterCap(WorldState& world, std::uint32_t slot, double share, double dt) {
    ++world.counters.speedsCapped;
    world.lostTime.push_back(
        {.body = world.bodies.idOf(slot), .seconds = (1 - share) * dt, .reason = LostTimeReason::speedLimit});
}

/// Scales the velocities so that, with what the forces of the step add, no point is faster than the limit.
void limitVelocity(WorldState& world, std::uint32_t slot, double dt) {
    const auto step = static_cast<Real>(dt);
    const Body& body = world.bodies[slot];
    BodyMotion& motion = world.motions[slot];
    const Real limit = speedLimitOf(world, slot, step);
    const Real own = length(motion.velocity) + std::fabs(motion.angularVelocity) * body.radius;
    const Real gain =
        step * (length(accelerationOf(world, body)) + std::fabs(angularAccelerationOf(body)) * body.radius);
    if (!(own > 0) || own + gain <= limit * kLimitRounding) { return; }
    const Real share = std::max(limit - gain, Real(0)) / own;
    motion.velocity = share * motion.velocity;
    motion.angularVelocity = share * motion.angularVelocity;
    enterCap(world, slot, static_cast<double>(share), dt);
}

/// What pushed a body within the step must not move it farther than the limit either: back along its way.
void limitWay(WorldState& world, std::uint32_t slot, double dt) {
    const Body& body = world.bodies[slot];
    BodyMotion& motion = world.motions[slot];
    const double most = static_cast<double>(speedLimitOf(world, slot, static_cast<Real>(dt))) * dt;
    const DVec2 moved = motion.center - body.startCenter;
    const double turned = motion.angle - body.startAngle;
    const double way = length(moved) + std::fabs(turned) * static_cast<double>(body.radius);
    if (way <= most * static_cast<double>(kLimitRounding)) { return; }
    const double share = most / way;
    motion.center = body.startCenter + share * moved;
    motion.angle = body.startAngle + share * turned;
    motion.velocity = static_cast<Real>(share) * motion.velocity;
    motion.angularVelocity = static_cast<Real>(share) * motion.angularVelocity;
    updatePose(world, slot);
    enterCap(world, slot, share, dt);
}

}  // namespace

Real speedLimitOf(WorldState& world, std::uint32_t body, Real dt) {
    const Real both = thinnestSolid(world, body) + thinnestWall(world);
    return both / (2 * dt);
}

void limitSpeeds(WorldState& world, double dt) {
    for (const std::uint32_t slot : world.awake) {
        if (isLimited(world, world.bodies[slot])) { limitVelocity(world, slot, dt); }
    }
}

void joinCaps(WorldState& world, double dt) {
    std::vector<LostTimeEntry>& lost = world.lostTime;
    if (world.counters.speedsCapped < 2) { return; }
    std::sort(lost.begin(), lost.end(), [](const LostTimeEntry& a, const LostTimeEntry& b) {
        return std::tie(a.body.index, a.reason, a.seconds) < std::tie(b.body.index, b.reason, b.seconds);
    });
    auto last = lost.begin();
    for (auto entry = std::next(last); entry != lost.end(); ++entry) {
        const bool isCap = entry->reason == LostTimeReason::speedLimit && last->reason == entry->reason;
        if (isCap && last->body == entry->body) {
            last->seconds += (1 - last->seconds / dt) * entry->seconds;
            --world.counters.speedsCapped;
        } else {
            *++last = *entry;
        }
    }
    lost.erase(std::next(last), lost.end());
}

void limitWays(WorldState& world, double dt) {
    for (const std::uint32_t slot : world.awake) {
        const Body& body = world.bodies[slot];
        // Nothing pushes a free body but a bullet.
        const bool isPushed = body.role != BodyRole::free || world.bulletBodies > 0;
        if (isPushed && isLimited(world, body)) { limitWay(world, slot, dt); }
    }
}

}  // namespace swept::inline SWEPT_PRECISION
