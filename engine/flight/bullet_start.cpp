#include "bullet_start.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "../../broadphase/wide_kernels.h"
#include "../bodies/place_order.h"
#include "../modes/modes.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

Real speedBound(const WorldState& world, std::uint32_t slot, Real dt) {
    const Body& body = world.bodies[slot];
    return length(world.motions[slot].velocity) +
           (body.isDynamic() ? dt * length(accelerationOf(world, body)) : Real(0));
}

/// How far the solver moved any point of a body in this step, metres.
Real wayOf(const WorldState& world, std::uint32_t slot) {
    const Body& body = world.bodies[slot];
    const BodyMotion& motion = world.motions[slot];
    const double turned = std::fabs(motion.angle - body.startAngle) * static_cast<double>(body.radius);
    return roundedUp(length(motion.center - body.startCenter) + turned);
}

/// How far a body gets within the step, metres: what was moved already went its way, and may have ended it at a stop.
Real reachInStep(const WorldState& world, std::uint32_t slot, Real dt) {
    return std::max(dt * speedBound(world, slot, dt), world.bodies[slot].awake ? wayOf(world, slot) : Real(0));
}

/// Where a body may get that goes no farther than that.
Aabb realmOfReach(const WorldState& world, std::uint32_t slot, Real reach) {
    const Body& body = world.bodies[slot];
    const DVec2 start = body.awake ? body.startCenter : world.motions[slot].center;
    return grown(roundedOutward(start, start), reach + body.radius);
}

/// Of its extent: what moves no farther within a step looks for nobody. Contacts stop it, whatever it meets.
constexpr Real kSlowRatio = Real(1) / 16;

/// @param boxes  of up to eight bodies: where they may get
/// @param reach  how far others get within the step, metres
/// @param reached  by box: set to 1 where there is a bullet in it, or one that may be sent there
void reachThoseAtRest(const WorldState& world, Real reach, std::array<Aabb, kWide> boxes,
                      std::span<std::uint8_t> reached) {
    for (Aabb& box : boxes) { box = grown(box, reach + world.bulletWork.drift); }
    world.broadphase->queryDynamic(boxes, [&](std::size_t lane, ProxyId id) {
        const std::uint32_t shape = world.proxyShapes[static_cast<std::uint32_t>(id)];
        if (isBullet(world, world.shapes[shape].body)) { reached[lane] = 1; }
    });
}

/// Takes out of `early` what is no bullet and gets to no place to which one may get.
void dropOutOfReach(WorldState& world, Real dt) {
    BulletWork& work = world.bulletWork;
    const Real farthest = farthestOf(world, dt);
    work.boxes.clear();
    for (const std::uint32_t slot : work.early) {
        if (isBullet(world, slot)) {
            work.boxes.push_back(realmOfReach(world, slot, reachInStep(world, slot, dt) + farthest));
        }
    }
    WideTree& realms = work.tree;
    realms.pack(work.boxes);
    const std::size_t count = work.early.size();
    work.reached.assign(count, 0);
    world.loops->run((count + kWide - 1) / kWide, 1, [&](std::size_t from, std::size_t to, int) {
        for (std::size_t first = from * kWide; first < std::min(to * kWide, count); first += kWide) {
            const std::size_t last = std::min(first + kWide, count);
            std::array<Aabb, kWide> boxes;
            boxes.fill(kNoBox);
            for (std::size_t i = first; i < last; ++i) {
                const std::uint32_t slot = work.early[i];
                work.reached[i] = isBullet(world, slot) || dissolvedClashOf(world, slot) != kNoIndex ? 1 : 0;
                if (work.reached[i] != 0) { continue; }
                boxes[i - first] = realmOfReach(world, slot, reachInStep(world, slot, dt));
            }
            widestKernels().queries(realms, WideBoxes::of(boxes),
                                    [&](std::uint32_t lane, ProxyId) { work.reached[first + lane] = 1; });
            if (work.areSomeAtRest) {
                reachThoseAtRest(world, farthest, boxes, std::span(work.reached).subspan(first));
            }
        }
    });
    std::size_t kept = 0;
    for (std::size_t i = 0; i < count; ++i) {
        work.early[kept] = work.early[i];
        kept += work.reached[i];
    }
    work.early.resize(kept);
}

}  // namespace

bool isBullet(const WorldState& world, std::uint32_t slot) {
    const Body& body = world.bodies[slot];
    return body.isDynamic() && body.def.bullet && modeOf(world, body) == ContinuousMode::subStep;
}

Real farthestOf(const WorldState& world, Real dt) {
    Real fastest = 0;
    for (const std::uint32_t slot : world.awake) {
        if (world.bodies[slot].isDynamic()) { fastest = std::max(fastest, speedBound(world, slot, dt)); }
    }
    return dt * fastest;
}

Aabb realmAtStart(const WorldState& world, std::uint32_t slot, Real dt) {
    const Body& body = world.bodies[slot];
    if (!body.awake) { return realmOfReach(world, slot, 0); }
    const BodyGlance& glance = world.glances[slot];
    // What is struck in a clash of its own may become faster, and of what woke since the glance tells nothing.
    const bool isKnown = glance.isAwake() && body.role != BodyRole::together;
    const Real reach = dt * (length(glance.velocity) + dt * length(glance.pull));
    return realmOfReach(world, slot, isKnown ? reach : world.bulletWork.farthest);
}

std::uint32_t dissolvedClashOf(const WorldState& world, std::uint32_t slot) {
    const FastIslands& fast = world.fastIslands;
    if (!fast.anyDissolved) { return kNoIndex; }
    const std::uint32_t number = fast.numbers[slot];
    return number != kNoIndex && fast.clashes[number] == ClashEnd::dissolved ? number : kNoIndex;
}

void findEarly(WorldState& world, Real dt) {
    BulletWork& work = world.bulletWork;
    work.early.clear();
    work.drift = 0;
    std::uint32_t bullets = 0;
    bool mayBeOutOfReach = false;
    for (const std::uint32_t slot : world.awake) {
        const Body& body = world.bodies[slot];
        if (!body.isDynamic()) { continue; }
        const bool isOne = isBullet(world, slot);
        const bool isOfClash = dissolvedClashOf(world, slot) != kNoIndex;
        const bool isEarly = body.fast || isOfClash || (isOne && body.role == BodyRole::flyer);
        const Real way = isEarly ? 0 : wayOf(world, slot);
        // A motor may set off what was at rest, and so was not fast as the step began.
        if (isEarly || way > (isOne ? kSlowRatio : body.slowRatio()) * body.extent) {
            work.early.push_back(slot);
            bullets += isOne ? 1 : 0;
            mayBeOutOfReach = mayBeOutOfReach || (!isOne && !isOfClash);
        } else {
            work.drift = std::max(work.drift, way);
        }
    }
    work.areSomeAtRest = bullets < world.bulletBodies;
    orderByPlace(world, work.early);
    if (mayBeOutOfReach) { dropOutOfReach(world, dt); }
}

}  // namespace swept::inline SWEPT_PRECISION
