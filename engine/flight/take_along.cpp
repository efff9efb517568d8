#include "take_along.h"

#include <algorithm>
#include <initializer_list>

#include "../../toi/toi_polygon.h"
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

/// How far a body has to leave an obstacle to turn beside it, metres.
/// @param normal  from the obstacle, unit
double roomToTurn(const WorldState& world, const Body& body, const Shape& other, const Sweep& ground,
                  const Sweep& turns, DVec2 normal) {
    const ToiPolygon side = asToiPolygon(other.polygon);
    const double turn = turns.a1 - turns.a0;
    double room = 0;
    for (const std::uint32_t slot : body.shapes) {
        const Shape& own = world.shapes[slot];
        if (own.def.sensor) { continue; }
        const ToiPolygon shape = asToiPolygon(own.polygon);
        const double bulge = static_cast<double>(own.radius - own.polygon.radius) * turn * turn / 8;
        room = std::max(room, bulge + separationAlong(side, ground, shape, turns, 0, normal) -
                                  separationAlong(side, ground, shape, turns, 1, normal));
    }
    return room;
}

/// In a corner there are two walls to leave.
constexpr int kMostLeft = 3;

/// Who may not turn is turned back, beside what took it along, if there is room for that: better turned than squeezed
/// through a wall.
/// @param touched  what took it along
/// @param time  seconds of the step: everything stands as it is then
BodyMotion turnedBack(const WorldState& world, std::uint32_t slot, const BodyMotion& carried, double angle,
                      FlightObstacle touched, double time, FlightScratch& scratch) {
    const Body& body = world.bodies[slot];
    Sweep leaves = standing(body, carried);
    Sweep turns = leaves;
    turns.a1 = angle;
    const auto meets = [&](const Sweep& way) {
        findObstacles(world, slot, way, time, scratch);
        allowSlack(world, way, time, scratch);
        const FirstImpact met = firstImpact(world, way, time, time, scratch, 1, true);
        if (met.hit) { touched = scratch.obstacles[met.obstacle]; }
        return met.hit;
    };
    for (int i = 0; i < kMostLeft; ++i) {
        const Shape& other = world.shapes[touched.other];
        const Sweep ground = obstacleSweep(world, other.body, time, time);
        const DVec2 normal =
            separationAt(asToiPolygon(other.polygon), ground, asToiPolygon(world.shapes[touched.own].polygon), turns, 0)
                .normal;
        leaves.c1 += roomToTurn(world, body, other, ground, turns, normal) * normal;
        turns.c0 = turns.c1 = leaves.c1;
        if (!meets(leaves) && !meets(turns)) { return motionAt(turns, 1, body.localCenter); }
    }
    return carried;
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
    const FlightObstacle touched = scratch.obstacles[met.obstacle];
    const std::uint32_t carrier = world.shapes[touched.other].body;
    const double since = from + met.fraction * (to - from);
    const Sweep way = carriedWay(body, motion, obstacleSweep(world, carrier, since, to));
    findObstacles(world, slot, way, since, scratch);
    std::erase_if(scratch.obstacles,
                  [&](const FlightObstacle& obstacle) { return world.shapes[obstacle.other].body == carrier; });
    const FirstImpact stopped = firstImpact(world, way, since, to, scratch);
    BodyMotion carried = motionAt(way, stopped.hit ? stopped.fraction : 1, body.localCenter);
    if (body.def.fixedRotation) { carried = turnedBack(world, slot, carried, motion.angle, touched, to, scratch); }
    motion.center = carried.center;
    motion.angle = carried.angle;
    motion.pose = carried.pose;
}

}  // namespace swept::inline SWEPT_PRECISION
