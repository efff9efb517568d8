#include "sensor_ways.h"

#include <algorithm>
#include <cmath>
#include <span>

#include "../../shapes/trig.h"
#include "../bodies/body_measures.h"
#include "../bodies/body_mode.h"
#include "../bodies/travel.h"
#include "../contacts/pair_boxes.h"
#include "../containers/sort_few.h"
#include "../state/tolerances.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

bool isOfLowerBody(const ImpactOfBody& impact, std::uint32_t slot) { return impact.body < slot; }

/// From the first impact of the body on, if it has any.
std::span<const ImpactOfBody> impactsFrom(const WorldState& world, std::uint32_t slot) {
    const std::vector<ImpactOfBody>& impacts = world.sensorSweeps.impacts;
    const auto first = std::lower_bound(impacts.begin(), impacts.end(), slot, isOfLowerBody);
    return std::span(impacts).subspan(static_cast<std::size_t>(first - impacts.begin()));
}

bool hadImpact(const WorldState& world, std::uint32_t slot) {
    const std::span<const ImpactOfBody> impacts = impactsFrom(world, slot);
    return !impacts.empty() && impacts.front().body == slot;
}

bool fliesFreely(const Body& body) {
    return body.isDynamic() && (body.role == BodyRole::flyer || body.role == BodyRole::free);
}

/// `Sweep::k` of a part of a flight. It goes as flights do (free_path.h), along the parabola to where it would be at
/// the end of the step that begins as fast as it does: of what is damped, where that is tells how fast.
/// @param way  of the part, which takes so long, s
/// @param share  of the time from its start to the end of the step
DVec2 curvatureOf(const WorldState& world, const Body& body, DVec2 way, double time, double share) {
    const DVec2 acceleration = toDouble(accelerationOf(world, body));
    if (!(body.def.linearDamping > 0)) { return (0.5 * time * time) * acceleration; }
    DampedMotion damped = dampedMotion(static_cast<double>(body.def.linearDamping) * time / share);
    damped.phi1 = std::max(damped.phi1, 0.5);  // or it would come back from where it never was
    const DVec2 byForce = (damped.phi2 * time * time) * acceleration;
    // With s for the share, T = time / s: way = s² (φ₁ T v + φ₂ T² a) + s (1 − s) T v, k = s² (φ₁ T v + φ₂ T² a − T v).
    const DVec2 bySpeed = 1 / (share * share * damped.phi1 + share * (1 - share)) * (way - byForce);
    return (share * share * (damped.phi1 - 1)) * bySpeed + byForce;
}

/// No point of a shape of that radius moves farther on what has no impacts, metres.
double farthestWay(const WorldState& world, std::uint32_t slot, Real radius, double dt) {
    const Body& body = world.bodies[slot];
    if (!body.awake) { return 0; }
    const BodyMotion& motion = world.motions[slot];
    const DVec2 moved = motion.center - body.startCenter;
    double way = lengthAtMost(moved) + std::fabs(motion.angle - body.startAngle) * static_cast<double>(radius);
    // It may come back to where it was: no part of a parabola is longer than its chord and that.
    if (fliesFreely(body)) { way += lengthAtMost(curvatureOf(world, body, moved, dt, 1)) / 2; }
    return way;
}

/// What is long, or far from the centre of its body, has a smaller box by its poses.
Aabb boxOfPoses(const Body& body, const Shape& shape, const std::vector<Waypoint>& points, Real room) {
    double turn = 0;
    for (std::size_t i = 1; i < points.size(); ++i) {
        turn = std::max(turn, std::fabs(points[i].angle - points[i - 1].angle));
    }
    // A point that turns leaves the straight line between both ends by that much of its arm at most.
    const Real reach = room + static_cast<Real>(std::min(turn * turn / 8, 2.0)) * shape.radius;
    const auto boxAt = [&](const Waypoint& point) {
        return boundsOf(shape.polygon, poseOf(point.center, point.angle, body.localCenter), {}, reach);
    };
    Aabb box = boxAt(points.front());
    for (std::size_t i = 1; i < points.size(); ++i) { box = hullOf(box, boxAt(points[i])); }
    return box;
}

/// From one waypoint to the next one.
Sweep sweepOfLeg(const WorldState& world, const Body& body, const Waypoint& start, const Waypoint& end, double dt) {
    Sweep sweep{.localCenter = toDouble(body.localCenter),
                .c0 = start.center,
                .c1 = end.center,
                .a0 = start.angle,
                .a1 = end.angle};
    const double time = (end.fraction - start.fraction) * dt;
    const bool stands = start.center == end.center && body.role == BodyRole::flyer;
    if (!fliesFreely(body) || stands || !(time > 0)) { return sweep; }
    const double share = (end.fraction - start.fraction) / (1 - start.fraction);
    sweep.k = curvatureOf(world, body, end.center - start.center, time, share);
    return sweep;
}

}  // namespace

void listImpactsByBody(WorldState& world) {
    std::vector<ImpactOfBody>& impacts = world.sensorSweeps.impacts;
    impacts.clear();
    for (std::size_t i = 0; i < world.impactPoses.size(); ++i) {
        impacts.push_back({world.impactPoses[i].body.index, static_cast<std::uint32_t>(i)});
    }
    std::sort(impacts.begin(), impacts.end());
}

bool mayPassUnseen(const WorldState& world, std::uint32_t slot, double dt) {
    const Body& body = world.bodies[slot];
    if (!isSwept(modeOf(world, body))) { return false; }
    // What has sensors may meet anything with them.
    const Real least = body.hasSensor ? world.leastPassed : std::min(body.leastPassed, world.leastPassedOfSensors);
    // The other one moves by no more than the other half.
    return farthestWay(world, slot, body.reach, dt) > static_cast<double>(least) / 2 || hadImpact(world, slot);
}

bool passesUnseen(const WorldState& world, const SensorPair& pair, double dt) {
    const Shape& a = world.shapes[pair.sensor];
    const Shape& b = world.shapes[pair.other];
    const double way = farthestWay(world, a.body, a.radius, dt) + farthestWay(world, b.body, b.radius, dt);
    return way > static_cast<double>(std::min(leastPassed(a), leastPassed(b))) || hadImpact(world, a.body) ||
           hadImpact(world, b.body);
}

void findWaypoints(const WorldState& world, std::uint32_t slot, std::vector<Waypoint>& points) {
    const Body& body = world.bodies[slot];
    points.clear();
    // What no step moves stands where it was put.
    const BodyMotion& motion = world.motions[slot];
    points.push_back({0, body.awake ? body.startCenter : motion.center, body.awake ? body.startAngle : motion.angle});
    for (const ImpactOfBody& impact : impactsFrom(world, slot)) {
        if (impact.body != slot) { break; }
        const ImpactPose& pose = world.impactPoses[impact.place];
        const DVec2 arm = toDouble(rotate(rotationFromAngle(pose.angle), body.localCenter));
        points.push_back({pose.fraction, pose.position + arm, pose.angle});
    }
    sortFew(points, [](const Waypoint& a, const Waypoint& b) { return a.fraction < b.fraction; });
    if (points.back().fraction < 1) { points.push_back({1, world.motions[slot].center, world.motions[slot].angle}); }
}

Sweep wayBetween(const WorldState& world, std::uint32_t slot, const std::vector<Waypoint>& points, double from,
                 double to, double dt) {
    auto next = std::find_if(points.begin() + 1, points.end(), [from](const Waypoint& p) { return p.fraction > from; });
    if (next == points.end()) { --next; }
    const Waypoint& end = *next;
    const Waypoint& start = *(next - 1);
    const Sweep sweep = sweepOfLeg(world, world.bodies[slot], start, end, dt);
    const double whole = end.fraction - start.fraction;
    if (!(whole > 0)) { return sweep; }
    return part(sweep, std::clamp((from - start.fraction) / whole, 0.0, 1.0),
                std::clamp((to - start.fraction) / whole, 0.0, 1.0));
}

bool isClearOnWay(const WorldState& world, std::uint32_t slot, std::span<const Aabb> boxes, double dt) {
    if (hadImpact(world, slot)) { return false; }
    const Body& body = world.bodies[slot];
    const DVec2 start = body.startCenter;
    const DVec2 end = world.motions[slot].center;
    const double bulge = fliesFreely(body) ? lengthAtMost(curvatureOf(world, body, end - start, dt, 1)) / 4 : 0;
    // All of it is in its circle; no width is more than two radii (see `findPairsOnWay`).
    const Real reach = Real(1.5) * body.reach + static_cast<Real>(bulge);
    const DVec2 lower{std::min(start.x, end.x), std::min(start.y, end.y)};
    const DVec2 upper{std::max(start.x, end.x), std::max(start.y, end.y)};
    const Aabb way = grown(roundedOutward(lower, upper), reach);
    return std::none_of(boxes.begin(), boxes.end(), [&](const Aabb& box) { return overlapAtOnce<Real>(box, way); });
}

Aabb boxOfWay(const WorldState& world, const Shape& shape, const std::vector<Waypoint>& points, Real room) {
    if (shape.radius > kRoundRatio * shape.extent) { return boxOfPoses(world.bodies[shape.body], shape, points, room); }
    DVec2 lower = points.front().center;
    DVec2 upper = lower;
    for (const Waypoint& point : points) {
        lower = {std::min(lower.x, point.center.x), std::min(lower.y, point.center.y)};
        upper = {std::max(upper.x, point.center.x), std::max(upper.y, point.center.y)};
    }
    return grown(roundedOutward(lower, upper), shape.radius + room);
}

double bulgeOfWay(const WorldState& world, std::uint32_t slot, const std::vector<Waypoint>& points, double dt) {
    double bulge = 0;
    for (std::size_t i = 1; i < points.size(); ++i) {
        const DVec2 k = sweepOfLeg(world, world.bodies[slot], points[i - 1], points[i], dt).k;
        bulge = std::max(bulge, lengthAtMost(k) / 4);
    }
    return bulge;
}

}  // namespace swept::inline SWEPT_PRECISION
