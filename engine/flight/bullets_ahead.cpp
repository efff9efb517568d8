#include "bullets_ahead.h"

#include <algorithm>
#include <cstddef>
#include <vector>

#include "../bodies/awake.h"
#include "../contacts/may_touch.h"
#include "../containers/boxed_items.h"
#include "../state/tolerances.h"
#include "bullet_start.h"
#include "sweep_circles.h"
#include "sweep_obstacles.h"
#include "whirls.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Of the way of a body: how far beside it joints may lead it. On a circle it turns by half a radian for that.
constexpr double kStrayRatio = 0.25;

double lengthOf(const Sweep& path) { return length(path.c1 - path.c0); }

bool isFast(const WorldState& world, std::uint32_t slot) { return (world.traits[slot] & kIsFast) != 0; }

/// Fast bodies that are awake and dynamic are looked for by their paths; all others move no farther than `drift`.
struct Hurry {
    Real drift = 0;
    bool isAnyFast = false;
};

Hurry hurryOf(const WorldState& world) {
    Hurry hurry;
    for (const std::uint32_t slot : world.awake) {
        if ((world.traits[slot] & kIsDynamic) == 0) { continue; }
        if (isFast(world, slot)) {
            hurry.isAnyFast = true;
        } else {
            hurry.drift = std::max(hurry.drift, world.glances[slot].motion);
        }
    }
    return hurry;
}

double strayOf(const Sweep& path) { return kStrayRatio * lengthOf(path); }

bool mayTouchAny(const WorldState& world, const Body& body, const Shape& other) {
    return std::any_of(body.shapes.begin(), body.shapes.end(), [&](std::uint32_t own) {
        return !world.shapes[own].def.sensor && mayTouch(world, world.shapes[own], other);
    });
}

/// What rests or is slow, and whose shapes are near the path of a fast bullet that they may touch: each body once.
void findSlowNear(WorldState& world, std::uint32_t bullet, const Aabb& box) {
    std::vector<std::uint32_t>& found = world.bulletWork.found;
    found.clear();
    const Body& body = world.bodies[bullet];
    world.broadphase->queryDynamic({&box, 1}, [&](std::size_t, ProxyId id) {
        const Shape& shape = world.shapes[world.proxyShapes[static_cast<std::uint32_t>(id)]];
        if (shape.body == bullet || shape.def.sensor || !world.bodies[shape.body].isDynamic()) { return; }
        if (!isFast(world, shape.body) && mayTouchAny(world, body, shape)) { found.push_back(shape.body); }
    });
    std::sort(found.begin(), found.end());
    found.erase(std::unique(found.begin(), found.end()), found.end());
}

void tryPair(WorldState& world, std::uint32_t bullet, std::uint32_t other, Real dt) {
    const Sweep path = straightPath(world, bullet, dt);
    const Sweep otherPath = straightPath(world, other, dt);
    const auto circles =
        static_cast<double>((1 + kMaxReachRatio) * (world.bodies[bullet].radius + world.bodies[other].radius));
    if (stayBeyond(path, otherPath, circles + strayOf(path) + strayOf(otherPath))) { return; }
    wake(world, other);
    world.bulletWork.ahead.push_back({bullet, other});
}

/// What is slow has contacts ahead of all that it does with what is slow.
void findSlow(WorldState& world, Real drift, Real dt) {
    for (const std::uint32_t slot : world.jointChains.bullets) {
        if (!isFast(world, slot) || !isJointedBullet(world, slot)) { continue; }
        findSlowNear(world, slot, grown(boxAhead(world, slot, dt), (1 + static_cast<Real>(kStrayRatio)) * drift));
        for (const std::uint32_t other : world.bulletWork.found) { tryPair(world, slot, other, dt); }
    }
}

void findFast(WorldState& world, Real dt) {
    world.flightScratch.resize(std::max<std::size_t>(world.flightScratch.size(), 1));
    std::vector<BoxedItem>& movers = world.flightScratch[0].movers;
    movers.clear();
    for (const std::uint32_t slot : world.awake) {
        const bool asks = isJointedBullet(world, slot);
        if ((world.traits[slot] & kIsDynamic) == 0 || !(asks || isFast(world, slot))) { continue; }
        const Aabb box = boxAhead(world, slot, dt);
        if (overlaps(box, box)) { movers.push_back({box, slot, asks}); }
    }
    forEachOverlap(movers, [&](std::uint32_t bullet, std::uint32_t other) {
        if (!isFast(world, bullet) && !isFast(world, other)) { return; }
        if (mayBodiesTouch(world, bullet, other)) { tryPair(world, bullet, other, dt); }
    });
}

}  // namespace

Sweep straightPath(const WorldState& world, std::uint32_t slot, Real dt) {
    const BodyMotion& motion = world.motions[slot];
    Sweep path{.localCenter = {}, .c0 = motion.center, .c1 = motion.center, .a0 = 0, .a1 = 0};
    const Body& body = world.bodies[slot];
    if (body.awake) { path.c1 += toDouble(dt * (motion.velocity + dt * accelerationOf(world, body))); }
    return path;
}

Aabb boxAhead(const WorldState& world, std::uint32_t slot, Real dt) {
    const Sweep path = straightPath(world, slot, dt);
    return boxOfPath(path, static_cast<double>((1 + kMaxReachRatio) * world.bodies[slot].radius) + strayOf(path));
}

bool mayBodiesTouch(const WorldState& world, std::uint32_t one, std::uint32_t other) {
    const Body& body = world.bodies[other];
    return std::any_of(body.shapes.begin(), body.shapes.end(), [&](std::uint32_t shape) {
        return !world.shapes[shape].def.sensor && mayTouchAny(world, world.bodies[one], world.shapes[shape]);
    });
}

bool isJointedBullet(const WorldState& world, std::uint32_t slot) {
    return world.bodies[slot].holdingJoints > 0 && isBullet(world, slot);
}

bool meetsMembers(const WorldState& world, std::uint32_t slot) {
    return isJointedBullet(world, slot) || isWhirl(world, slot);
}

bool mayMembersMeet(const WorldState& world, std::span<const std::uint32_t> members) {
    if (world.jointChains.bullets.empty() && world.bulletWork.whirls.empty()) { return false; }
    return std::any_of(members.begin(), members.end(), [&](std::uint32_t slot) { return meetsMembers(world, slot); });
}

void findAhead(WorldState& world, Real dt) {
    world.bulletWork.ahead.clear();
    const Hurry hurry = hurryOf(world);
    if (!hurry.isAnyFast) { return; }
    findFast(world, dt);
    findSlow(world, hurry.drift, dt);
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
