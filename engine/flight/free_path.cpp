#include "free_path.h"

#include <algorithm>
#include <limits>

#include "sweep_obstacles.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Of a speed, after damping: by less than that nothing is multiplied back.
constexpr double kLeastDecay = 0x1p-10;

/// Whether no box of anything static or kinematic is near a path.
bool isClear(const WorldState& world, const Body& body, const Sweep& path) {
    return std::all_of(body.shapes.begin(), body.shapes.end(), [&](std::uint32_t slot) {
        const Shape& own = world.shapes[slot];
        if (own.def.sensor) { return true; }
        bool nothing = true;
        world.broadphase->queryGround(boxOfPath(own, path), [&](ProxyId proxy) {
            // Some kinds of broadphase do not tell what yields from ground.
            const std::uint32_t found = world.proxyShapes[static_cast<std::size_t>(proxy)];
            nothing = world.bodies[world.shapes[found].body].isDynamic();
            return nothing;
        });
        return nothing;
    });
}

}  // namespace

Drift driftOf(const WorldState& world, const Body& body, double time) {
    return {dampedMotion(static_cast<double>(body.def.linearDamping) * time),
            dampedMotion(static_cast<double>(body.def.angularDamping) * time), toDouble(accelerationOf(world, body)),
            static_cast<double>(angularAccelerationOf(body)), time};
}

Sweep freePath(const Body& body, const BodyMotion& motion, const Drift& drift) {
    const double time = drift.time;
    const DVec2 velocity = toDouble(motion.velocity);
    const auto spin = static_cast<double>(motion.angularVelocity);
    const DVec2 path = (drift.linear.phi1 * time) * velocity + (drift.linear.phi2 * time * time) * drift.acceleration;
    return {.localCenter = toDouble(body.localCenter),
            .c0 = motion.center,
            .c1 = motion.center + path,
            .k = path - time * velocity,
            .a0 = motion.angle,
            .a1 = motion.angle + drift.angular.phi1 * time * spin +
                  drift.angular.phi2 * time * time * drift.angularAcceleration};
}

FreeVelocity velocityBefore(DVec2 way, double turn, const Drift& drift) {
    const double time = drift.time;
    const DVec2 byVelocity = way - (drift.linear.phi2 * time * time) * drift.acceleration;
    const double bySpin = turn - drift.angular.phi2 * time * time * drift.angularAcceleration;
    return {toReal(1 / (drift.linear.phi1 * time) * byVelocity),
            static_cast<Real>(bySpin / (drift.angular.phi1 * time))};
}

FreeVelocity velocityBefore(const BodyMotion& end, const Drift& drift) {
    FreeVelocity start{end.velocity, end.angularVelocity};
    if (drift.linear.decay >= kLeastDecay) {
        const DVec2 gain = (drift.linear.phi1 * drift.time) * drift.acceleration;
        start.linear = toReal(1 / drift.linear.decay * (toDouble(end.velocity) - gain));
    }
    if (drift.angular.decay >= kLeastDecay) {
        const double gain = drift.angular.phi1 * drift.time * drift.angularAcceleration;
        start.angular = static_cast<Real>((static_cast<double>(end.angularVelocity) - gain) / drift.angular.decay);
    }
    return start;
}

FreeVelocity velocityAfter(const BodyMotion& motion, const Drift& drift) {
    const DVec2 velocity = toDouble(motion.velocity);
    const auto spin = static_cast<double>(motion.angularVelocity);
    return {
        toReal(drift.linear.decay * velocity + (drift.linear.phi1 * drift.time) * drift.acceleration),
        static_cast<Real>(drift.angular.decay * spin + drift.angular.phi1 * drift.time * drift.angularAcceleration)};
}

bool flyClear(WorldState& world, std::uint32_t slot, double dt) {
    const Body& body = world.bodies[slot];
    if (body.hasContact || world.settings.maxSpeed < std::numeric_limits<Real>::infinity()) { return false; }
    BodyMotion& motion = world.motions[slot];
    const Drift drift = driftOf(world, body, dt);
    const Sweep path = freePath(body, motion, drift);
    if (!isClear(world, body, path)) { return false; }
    const FreeVelocity after = velocityAfter(motion, drift);
    motion.center = path.c1;
    motion.angle = path.a1;
    motion.pose = poseOf(motion.center, motion.angle, body.localCenter);
    motion.velocity = after.linear;
    motion.angularVelocity = after.angular;
    return true;
}

}  // namespace swept::inline SWEPT_PRECISION
