#include "reset_bodies.h"

#include "../../shapes/cache_line.h"
#include "../../shapes/compiler.h"
#include "../modes/modes.h"
#include "../state/tolerances.h"
#include "balance.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Bodies that are fetched ahead: most of them are written, and others read them since.
constexpr std::size_t kResetAhead = 16;

/// @param coming  of the same worker
SWEPT_FORCE_INLINE void fetchForReset(const WorldState& world, std::span<const std::uint32_t> coming) {
    if (coming.size() <= kResetAhead) { return; }
    const std::uint32_t slot = coming[kResetAhead];
    const Body& body = world.bodies[slot];
    fetchToWrite(body.awake);
    fetchToWrite(body.startAngle);
    prefetch(&world.motions[slot]);
    prefetch(&world.glances[slot]);
}

/// @param restSpeed  `restSpeedOf` the step
void resetBody(WorldState& world, std::uint32_t slot, Real restSpeed, Real dt) {
    Body& body = world.bodies[slot];
    const BodyMotion& motion = world.motions[slot];
    body.deepContact = body.sunk = false;
    body.bounces = body.rests = body.strikes = body.startled = body.flung = false;
    // What just woke has no bound yet.
    const Real known = world.glances[slot].motion;
    const Real bound = known < 0 ? motionBound(world, slot, dt) : known;
    body.fast = body.extent > 0 && bound > body.slowRatio() * body.extent;
    const bool isAtRest = isStill(body, motion, restSpeed, dt);
    if (!isAtRest) { body.soughtSteps = 0; }
    body.fresh = body.isPut = false;
    world.traits[slot] = static_cast<BodyTraits>(kIsAwake | (body.isDynamic() ? kIsDynamic : 0) |
                                                 (body.fast ? kIsFast : 0) | (isAtRest ? kIsStill : 0));
    body.startCenter = motion.center;
    body.startAngle = motion.angle;
}

/// @param awake  that were reset
void speedUpFreeBullets(WorldState& world, std::span<const std::uint32_t> awake, Real dt) {
    for (const std::uint32_t slot : awake) {
        const Real known = world.glances[slot].motion;
        Body& body = world.bodies[slot];
        if (!isFastFreeBullet(world, body, known < 0 ? motionBound(world, slot, dt) : known)) { continue; }
        body.fast = true;
        world.traits[slot] = static_cast<BodyTraits>(world.traits[slot] | kIsFast);
    }
}

}  // namespace

void resetBodies(WorldState& world, std::span<const std::uint32_t> awake, Real dt) {
    const Real restSpeed = restSpeedOf(world, dt);
    for (std::size_t i = 0; i < awake.size(); ++i) {
        fetchForReset(world, awake.subspan(i));
        resetBody(world, awake[i], restSpeed, dt);
    }
    if (world.bulletBodies > 0) { speedUpFreeBullets(world, awake, dt); }
}

}  // namespace swept::inline SWEPT_PRECISION
