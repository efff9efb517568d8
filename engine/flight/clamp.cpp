#include "clamp.h"

#include <algorithm>
#include <cmath>

#include "../bodies/travel.h"
#include "solved_path.h"
#include "sweep_obstacles.h"
#include "take_along.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// A body that stood for some time did not fall in it: takes back the speed that its acceleration gave it, as far as it
/// moves along it. Kept, that speed would be energy without a height to pay for it.
void takeBackFall(WorldState& world, std::uint32_t slot, double seconds) {
    Vec2& velocity = world.motions[slot].velocity;
    const Vec2 acceleration = accelerationOf(world, world.bodies[slot]);
    const Real along = dot(velocity, acceleration);
    if (!(along > 0)) { return; }
    velocity -= std::min(static_cast<Real>(seconds), along / lengthSquared(acceleration)) * acceleration;
}

/// How fast a point that goes with a body gets on in a direction, m/s.
double speedAlong(const BodyMotion& motion, DVec2 place, DVec2 direction) {
    const Vec2 velocity = motion.velocity + cross(motion.angularVelocity, toReal(place - motion.center));
    return dot(toDouble(velocity), direction);
}

/// Whether something kinematic touches the body from behind, as seen along a direction.
bool pressesAlong(const WorldState& world, const FlightObstacle& obstacle, const BodyMotion& motion, DVec2 direction) {
    const Shape& other = world.shapes[obstacle.other];
    if (world.bodies[other.body].def.type != BodyType::kinematic) { return false; }
    const Real reach = contactReach(world, world.shapes[obstacle.own]) + contactReach(world, other);
    const WorldTransform& pose = world.motions[other.body].pose;
    const Manifold manifold = obstacleManifold(world, obstacle, pose, motion.pose, reach);
    return manifold.count > 0 && dot(toDouble(rotate(pose.rotation, manifold.normal)), direction) > 0;
}

/// How fast what is kinematic presses a body in a direction, or pulls it by a joint, m/s.
double kinematicSpeed(const WorldState& world, std::uint32_t slot, DVec2 direction, const FlightScratch& scratch) {
    if (world.kinematicBodies == 0) { return 0; }
    const BodyMotion& motion = world.motions[slot];
    double speed = 0;
    for (const FlightObstacle& obstacle : scratch.obstacles) {
        if (!pressesAlong(world, obstacle, motion, direction)) { continue; }
        const std::uint32_t presser = world.shapes[obstacle.other].body;
        speed = std::max(speed, speedAlong(world.motions[presser], motion.center, direction));
    }
    for (const std::uint32_t slotOfJoint : world.bodies[slot].joints) {
        const Joint& joint = world.joints[slotOfJoint];
        if (!joint.holds()) { continue; }
        for (const std::uint32_t puller : joint.allBodies()) {
            if (world.bodies[puller].def.type != BodyType::kinematic) { continue; }
            speed = std::max(speed, speedAlong(world.motions[puller], motion.center, direction));
        }
    }
    return speed;
}

/// How much of a path a body did not go, by its centre and its turn.
struct ShareMissed {
    double all = 0;
    /// Of it, what is lost. What contacts that give under a load press into the ground, step by step, loses nothing by
    /// not getting there.
    double lost = 0;
};

/// Of what was set off the ground.
/// @param asked  where the solver moved it
/// @param reached  on its way from the start of the path to where it is now
ShareMissed shareMissed(const WorldState& world, std::uint32_t slot, const Sweep& path, const BodyMotion& asked,
                        const BodyMotion& reached, double time, const FlightScratch& scratch) {
    const auto arm = static_cast<double>(world.bodies[slot].radius);
    const DVec2 setOff = world.motions[slot].center;
    const double way = length(path.c1 - path.c0) + arm * std::fabs(path.a1 - path.a0);
    const double turnMissed = arm * std::fabs(asked.angle - reached.angle);
    const double missed = length(asked.center - reached.center) + turnMissed;
    const double all = missed < way ? missed / way : 1;
    const DVec2 into = asked.center - setOff;
    const double depth = length(into);
    const double pressed =
        depth > 0 ? std::min(depth, time * kinematicSpeed(world, slot, (1 / depth) * into, scratch)) : 0;
    const double lost = pressed + length(setOff - reached.center) + turnMissed;
    return {.all = all, .lost = lost < way ? lost / way : (lost > 0 ? 1.0 : 0.0)};
}

}  // namespace

void clampAtImpact(WorldState& world, std::uint32_t slot, const StepPart& part, LostTimeReason reason,
                   FlightScratch& scratch) {
    const Body& body = world.bodies[slot];
    BodyMotion& motion = world.motions[slot];
    const Sweep path = pathOf(world, slot);
    const BodyMotion asked = motion;
    FirstImpact first = impactOfPath(world, slot, part.length, 1, scratch);
    if (!first.hit) { return; }
    const bool slides = slideAlongSunk(world, slot, part.length, first, scratch);
    const BodyMotion stopped = motionAt(pathOf(world, slot), first.fraction, body.localCenter);
    const double stayed = 1 - first.fraction;
    const ShareMissed share = slides ? shareMissed(world, slot, path, asked, stopped, part.length, scratch)
                                     : ShareMissed{.all = stayed, .lost = stayed};
    motion.center = stopped.center;
    motion.angle = stopped.angle;
    motion.pose = stopped.pose;
    ++scratch.counters.impacts;
    takeBackFall(world, slot, share.all * part.length);
    const double lost = share.lost * part.length;
    if (lost > 0) { scratch.lostTime.push_back({.body = world.bodies.idOf(slot), .seconds = lost, .reason = reason}); }
    if (first.fraction >= 1) { return; }  // it went straight to where it is
    scratch.impactPoses.push_back({.body = world.bodies.idOf(slot),
                                   .position = motion.pose.position,
                                   .angle = motion.angle,
                                   .fraction = (part.begin + first.fraction * part.length) / part.dt});
    takeAlong(world, slot, motion, first.fraction * part.length, part.length, scratch);
}

}  // namespace swept::inline SWEPT_PRECISION
