#include "take_along.h"

#include "sweep_obstacles.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

bool isKinematic(const WorldState& world, const FlightObstacle& obstacle) {
    return world.bodies[world.shapes[obstacle.other].body].def.type == BodyType::kinematic;
}

Sweep standing(const Body& body, const BodyMotion& motion) {
    return {.localCenter = toDouble(body.localCenter),
            .c0 = motion.center,
            .c1 = motion.center,
            .a0 = motion.angle,
            .a1 = motion.angle};
}

DVec2 turnedBy(DVec2 arm, double angle) {
    const Rotation turn = rotationFromAngle(angle);
    const auto s = static_cast<double>(turn.s);
    const auto c = static_cast<double>(turn.c);
    return {c * arm.x - s * arm.y, s * arm.x + c * arm.y};
}

/// The way of a body that is fixed to another one. Its centre goes round that one's: a parabola through both ends and
/// the middle of the way is that arc, but for the fourth power of the turn.
Sweep carriedWay(const Body& body, const BodyMotion& motion, const Sweep& carrier) {
    const DVec2 arm = motion.center - carrier.c0;
    const double turn = carrier.a1 - carrier.a0;
    const auto centerAfter = [&](double part) { return centerAt(carrier, part) + turnedBy(arm, part * turn); };
    Sweep way = standing(body, motion);
    way.c1 = centerAfter(1);
    way.a1 = motion.angle + turn;
    way.k = 4 * (0.5 * (way.c0 + way.c1) - centerAfter(0.5));
    return way;
}

}  // namespace

void takeAlong(const WorldState& world, std::uint32_t slot, BodyMotion& motion, double from, double to,
               FlightScratch& scratch) {
    if (world.kinematicBodies == 0 || !(from < to)) { return; }
    const Body& body = world.bodies[slot];
    const Sweep stands = standing(body, motion);
    findObstacles(world, slot, stands, from, scratch);
    std::erase_if(scratch.obstacles, [&](const FlightObstacle& obstacle) { return !isKinematic(world, obstacle); });
    const FirstImpact met = firstImpact(world, stands, from, to, scratch);
    if (!met.hit) { return; }
    const std::uint32_t carrier = world.shapes[scratch.obstacles[met.obstacle].other].body;
    const double since = from + met.fraction * (to - from);
    const Sweep way = carriedWay(body, motion, obstacleSweep(world, carrier, since, to));
    findObstacles(world, slot, way, since, scratch);
    std::erase_if(scratch.obstacles,
                  [&](const FlightObstacle& obstacle) { return world.shapes[obstacle.other].body == carrier; });
    const FirstImpact stopped = firstImpact(world, way, since, to, scratch);
    const BodyMotion carried = motionAt(way, stopped.hit ? stopped.fraction : 1, body.localCenter);
    motion.center = carried.center;
    motion.angle = carried.angle;
    motion.pose = carried.pose;
}

}  // namespace swept::inline SWEPT_PRECISION
