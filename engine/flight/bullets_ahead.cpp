#include "bullets_ahead.h"

#include <algorithm>

#include "../bodies/awake.h"
#include "../contacts/may_touch.h"
#include "../state/tolerances.h"
#include "bullet_start.h"
#include "sweep_circles.h"
#include "sweep_obstacles.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Of the way of a body: how far beside it joints may lead it. On a circle it turns by half a radian for that.
constexpr double kStrayRatio = 0.25;

/// Where a body gets to if nothing but forces act on it.
Sweep straightPath(const WorldState& world, std::uint32_t slot, Real dt) {
    const BodyMotion& motion = world.motions[slot];
    Sweep path{.localCenter = {}, .c0 = motion.center, .c1 = motion.center, .a0 = 0, .a1 = 0};
    const Body& body = world.bodies[slot];
    if (body.awake) { path.c1 += toDouble(dt * (motion.velocity + dt * accelerationOf(world, body))); }
    return path;
}

double lengthOf(const Sweep& path) { return length(path.c1 - path.c0); }

bool isFast(const WorldState& world, std::uint32_t slot) { return (world.traits[slot] & kIsFast) != 0; }

/// How far any point of what is awake and dynamic may get, and whether one of them is fast.
struct Hurry {
    Real farthest = 0;
    bool isAnyFast = false;
};

Hurry hurryOf(const WorldState& world) {
    Hurry hurry;
    for (const std::uint32_t slot : world.awake) {
        if ((world.traits[slot] & kIsDynamic) == 0) { continue; }
        hurry.farthest = std::max(hurry.farthest, world.glances[slot].motion);
        hurry.isAnyFast = hurry.isAnyFast || isFast(world, slot);
    }
    return hurry;
}

bool mayTouchAny(const WorldState& world, const Body& body, const Shape& other) {
    return std::any_of(body.shapes.begin(), body.shapes.end(), [&](std::uint32_t own) {
        return !world.shapes[own].def.sensor && mayTouch(world, world.shapes[own], other);
    });
}

/// Dynamic bodies whose shapes are near the path, and may touch the bullet: in order, each once.
void findNear(WorldState& world, std::uint32_t bullet, const Aabb& box) {
    std::vector<std::uint32_t>& found = world.bulletWork.found;
    found.clear();
    const Body& body = world.bodies[bullet];
    world.broadphase->queryDynamic({&box, 1}, [&](std::size_t, ProxyId id) {
        const Shape& shape = world.shapes[world.proxyShapes[static_cast<std::uint32_t>(id)]];
        if (shape.body == bullet || shape.def.sensor || !world.bodies[shape.body].isDynamic()) { return; }
        if (mayTouchAny(world, body, shape)) { found.push_back(shape.body); }
    });
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
}

void findAheadOf(WorldState& world, std::uint32_t bullet, Real farthest, Real dt) {
    const Body& body = world.bodies[bullet];
    const Sweep path = straightPath(world, bullet, dt);
    const double stray = kStrayRatio * lengthOf(path);
    const Aabb box = boxOfPath(path, static_cast<double>(body.radius) + stray);
    findNear(world, bullet, grown(box, (1 + static_cast<Real>(kStrayRatio)) * farthest));
    for (const std::uint32_t other : world.bulletWork.found) {
        // What is slow has contacts ahead of all that it does.
        if (!isFast(world, bullet) && !isFast(world, other)) { continue; }
        const Sweep otherPath = straightPath(world, other, dt);
        const auto circles = static_cast<double>((1 + kMaxReachRatio) * (body.radius + world.bodies[other].radius));
        if (stayBeyond(path, otherPath, circles + stray + kStrayRatio * lengthOf(otherPath))) { continue; }
        wake(world, other);
        world.bulletWork.ahead.push_back({bullet, other});
    }
}

}  // namespace

bool isJointedBullet(const WorldState& world, std::uint32_t slot) {
    return world.bodies[slot].holdingJoints > 0 && isBullet(world, slot);
}

bool hasJointedBullet(const WorldState& world, std::span<const std::uint32_t> slots) {
    if (world.jointChains.bullets.empty()) { return false; }
    return std::any_of(slots.begin(), slots.end(), [&](std::uint32_t slot) { return isJointedBullet(world, slot); });
}

void findAhead(WorldState& world, Real dt) {
    world.bulletWork.ahead.clear();
    const Hurry hurry = hurryOf(world);
    if (!hurry.isAnyFast) { return; }
    for (const std::uint32_t slot : world.jointChains.bullets) {
        if (isJointedBullet(world, slot)) { findAheadOf(world, slot, hurry.farthest, dt); }
    }
}

void tieAhead(WorldState& world) {
    for (const auto& [bullet, other] : world.bulletWork.ahead) {
        world.islands.unite(bullet, other);
        for (const std::uint32_t slot : {bullet, other}) {
            world.traits[slot] = static_cast<BodyTraits>(world.traits[slot] | kHasContact | kTouchesDynamic);
        }
    }
}

}  // namespace swept::inline SWEPT_PRECISION
