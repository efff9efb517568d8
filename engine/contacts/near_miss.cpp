#include "near_miss.h"

#include <algorithm>
#include <array>

#include "../../shapes/distance.h"
#include "../../toi/time_of_impact.h"
#include "../../toi/toi_polygon.h"
#include "../modes/modes.h"
#include "../state/tolerances.h"
#include "../state/world_state.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// What a body does in the step if nothing holds it.
struct FreeMotion {
    const BodyMotion& start;
    Vec2 velocity{};
    Real spin = 0;
    Vec2 pull{};  ///< m/s²

    FreeMotion(const WorldState& world, std::uint32_t slot) : start(world.motions[slot]) {
        const Body& body = world.bodies[slot];
        if (!body.awake && body.isDynamic()) { return; }
        velocity = start.velocity;
        spin = start.angularVelocity;
        if (body.isDynamic()) { pull = accelerationOf(world, body); }
    }
    Vec2 velocityAt(DVec2 point) const { return velocity + cross(spin, toReal(point - start.center)); }
    Sweep path(Vec2 localCenter, Real dt) const {
        const DVec2 fall = toDouble(square(dt) / 2 * pull);
        return {.localCenter = toDouble(localCenter),
                .c0 = start.center,
                .c1 = start.center + toDouble(dt * velocity) + fall,
                .k = fall,
                .a0 = start.angle,
                .a1 = start.angle + static_cast<double>(dt * spin)};
    }
};

/// How deep the solver would find a point at the end of the step, metres; at most 0: it would do nothing.
Real depthAhead(const WorldState& world, const Contact& contact, const FreeMotion& a, const FreeMotion& b, Real dt) {
    const WorldTransform& pose = world.motions[contact.bodyA].pose;
    const Vec2 normal = rotate(pose.rotation, contact.manifold.normal);
    const Real fall = -square(dt) / 2 * dot(b.pull - a.pull, normal);
    Real deepest = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(contact.manifold.count); ++i) {
        const DVec2 point = apply(pose, contact.manifold.points[i].point);
        const Real approach = -dot(b.velocityAt(point) - a.velocityAt(point), normal);
        deepest = std::max(deepest, dt * approach + fall - contact.manifold.points[i].separation);
    }
    return deepest;
}

WorldTransform endOf(const Sweep& path) {
    return poseOf(centerAt(path, 1), rotationFromAngle(angleAt(path, 1)), toReal(path.localCenter));
}

}  // namespace

bool isNearMiss(const WorldState& world, const Contact& contact, Real dt) {
    if (world.watched && isAhead(world, contact)) { return false; }  // the mode is just that
    const FreeMotion a(world, contact.bodyA);
    const FreeMotion b(world, contact.bodyB);
    const Real depth = depthAhead(world, contact, a, b, dt);
    if (!(depth > 0)) { return false; }
    const Polygon& shapeA = world.shapes[contact.shapeA].polygon;
    const Polygon& shapeB = world.shapes[contact.shapeB].polygon;
    const Real slop = kTargetRatio * contact.extent;
    const Real level = -std::min({slop, depth / 2, shapeA.radius + shapeB.radius});
    const Sweep pathA = a.path(world.bodies[contact.bodyA].localCenter, dt);
    const Sweep pathB = b.path(world.bodies[contact.bodyB].localCenter, dt);
    // Mostly they have met by the end.
    const Transform bInA = relativeTransform(endOf(pathA), endOf(pathB));
    if (distance(shapeA, shapeB, bInA).distance <= level) { return false; }
    const ToiSettings settings{.target = static_cast<double>(level),
                               .tolerance = static_cast<double>(std::min(slop, depth) / 8)};
    const Toi toi = timeOfImpact(asToiPolygon(shapeA), pathA, asToiPolygon(shapeB), pathB, settings);
    return toi.state == ToiState::separated;
}

}  // namespace swept::inline SWEPT_PRECISION
