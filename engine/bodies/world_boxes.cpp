#include "world_boxes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "../state/tolerances.h"
#include "body_mode.h"
#include "travel.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// How a kinematic body moves in its next step: the same for all of its shapes, which may be thousands.
struct KinematicStep {
    DVec2 way;
    bool turns;
    // Of one that turns:
    WorldTransform end;
    Real bulge;  ///< a point leaves the straight line between both ends by that much of its arm at most
};

KinematicStep kinematicStep(const WorldState& world, std::uint32_t slot) {
    const BodyMotion& motion = world.motions[slot];
    const DVec2 center = motion.center + world.lastDt * toDouble(motion.velocity);
    const double angle = motion.angle + world.lastDt * static_cast<double>(motion.angularVelocity);
    const DVec2 way = center - motion.center;
    // Most platforms do not turn, and a sine and a cosine are most of a pose.
    if (angle == motion.angle) { return {.way = way, .turns = false, .end = motion.pose, .bulge = 0}; }
    const double turn = angle - motion.angle;
    return {.way = way,
            .turns = true,
            .end = poseOf(center, angle, world.bodies[slot].localCenter),
            .bulge = static_cast<Real>(std::min(turn * turn / 8, 2.0))};
}

/// Of a kinematic body; of others nothing.
std::optional<KinematicStep> stepIfKinematic(const WorldState& world, std::uint32_t slot) {
    if (world.bodies[slot].def.type != BodyType::kinematic) { return std::nullopt; }
    return kinematicStep(world, slot);
}

/// The box of a kinematic shape spans its whole next step: others are swept against it there.
Aabb spanningBox(const Shape& shape, const WorldTransform& pose, const KinematicStep& step, Real reach) {
    if (!step.turns) { return boundsOf(shape.polygon, pose, step.way, reach); }
    const Real around = reach + step.bulge * shape.radius;
    return hullOf(boundsOf(shape.polygon, pose, {}, around), boundsOf(shape.polygon, step.end, {}, around));
}

/// What is fast leaves its box in every step, so a box that is quickly made is better than a tight one: that of its
/// circle, unless it is much wider than the shape.
bool isRoundEnough(const WorldState& world, const Shape& shape) {
    const Body& body = world.bodies[shape.body];
    return body.fast && body.isDynamic() && shape.radius <= kRoundRatio * shape.extent;
}

Aabb circleBox(DVec2 center, double radius) {
    return roundedOutward({center.x - radius, center.y - radius}, {center.x + radius, center.y + radius});
}

/// Of a body that is moved so far in the step at most.
/// @param step  of `stepIfKinematic`
Aabb neededBoxOf(const WorldState& world, const Shape& shape, Real motion, const std::optional<KinematicStep>& step) {
    const Body& body = world.bodies[shape.body];
    if (body.def.type == BodyType::fixed) { return boundsOf(shape.polygon, world.motions[shape.body].pose); }
    const Real reach = reachOfMotion(motion, shape.extent, modeOf(world, body) == ContinuousMode::speculative);
    if (isRoundEnough(world, shape)) {
        const Real radius = shape.radius + reach;
        return circleBox(world.motions[shape.body].center,
                         static_cast<double>(radius) * (1 + static_cast<double>(kEpsilon)));
    }
    const WorldTransform& pose = world.motions[shape.body].pose;
    return step ? spanningBox(shape, pose, *step, reach) : boundsOf(shape.polygon, pose, {}, reach);
}

}  // namespace

Aabb neededBox(const WorldState& world, const Shape& shape) {
    return neededBoxOf(world, shape, reachMotion(world, shape.body, static_cast<Real>(world.lastDt)),
                       stepIfKinematic(world, shape.body));
}

namespace {

Aabb fattened(const WorldState& world, const Shape& shape, const Aabb& needed) {
    const Body& body = world.bodies[shape.body];
    if (body.def.type == BodyType::fixed) { return needed; }
    const Vec2 way = static_cast<Real>(world.lastDt) * world.motions[shape.body].velocity;
    const Real farthest = length(way);
    const Real margin = kBoxMarginRatio * shape.extent;
    // What is too fast to look ahead leaves any margin in the next step.
    if (!(kBoxStepsAhead * farthest <= kMaxAheadRatio * shape.extent)) { return needed; }
    // Among others a box that reaches ahead finds more than it saves, and so does a margin that does not last.
    if (body.hasContact) { return farthest > margin ? needed : grown(needed, margin); }
    const Vec2 ahead = kBoxStepsAhead * way;
    return grown(hullOf(needed, {needed.lower + ahead, needed.upper + ahead}), margin);
}

}  // namespace

Aabb fatBox(const WorldState& world, const Shape& shape) { return fattened(world, shape, neededBox(world, shape)); }

namespace {

/// Before the boxes of its shapes are made anew. @return its motion in the step, at most, as far as boxes ask for it
Real noteBoxes(WorldState& world, std::uint32_t slot) {
    const auto dt = static_cast<Real>(world.lastDt);
    const Body& body = world.bodies[slot];
    const Vec2 velocity = world.motions[slot].velocity;
    world.travels[slot].boxRoom = 0;
    const Real alongAxis = dt * std::max(std::fabs(velocity.x), std::fabs(velocity.y));
    // What is fast along one axis is told without a root: no box reaches farther ahead than its own.
    if (alongAxis >= kMaxReachRatio * body.widest && modeOf(world, body) != ContinuousMode::speculative) {
        world.travels[slot].boxMotion = std::numeric_limits<Real>::max();
        return alongAxis;
    }
    const Real bound = reachMotion(world, slot, dt);
    // Contacts reach that far ahead of what moves less.
    const Real least = kMinReachRatio * body.extent;
    const bool isSlow = bound <= least && body.isDynamic();
    BodyTravel& travel = world.travels[slot];
    travel.boxMotion = isSlow ? least : bound;
    if (isSlow) {
        travel.boxRoom = static_cast<double>(kRestRoomRatio * body.extent);
        travel.boxCenter = world.motions[slot].center;
        travel.boxAngle = world.motions[slot].angle;
    }
    return travel.boxMotion;
}

/// As nearly always of what rests: its boxes were made with room for how far it moved since.
bool keepsBoxes(const WorldState& world, std::uint32_t slot) {
    const BodyTravel& travel = world.travels[slot];
    if (!(travel.boxRoom > 0)) { return false; }
    const BodyMotion& motion = world.motions[slot];
    const double moved = lengthAtMost(motion.center - travel.boxCenter) +
                         std::fabs(motion.angle - travel.boxAngle) * static_cast<double>(world.bodies[slot].reach);
    return moved <= travel.boxRoom / 2 &&  // half of it is for rounding
           reachMotion(world, slot, static_cast<Real>(world.lastDt)) <= travel.boxMotion;
}

/// Kept for the stage of contacts of the next step.
const Aabb& renewNeededBox(WorldState& world, const Shape& shape, Real motion,
                           const std::optional<KinematicStep>& step) {
    const auto room = static_cast<Real>(world.travels[shape.body].boxRoom);
    const Aabb needed = neededBoxOf(world, shape, motion, step);
    return world.neededBoxes[static_cast<std::size_t>(shape.proxy)] = room > 0 ? grown(needed, room) : needed;
}

/// Makes the boxes of a body's shapes anew, from one of them on. @param motion  of `noteBoxes`
/// @param take  takes a proxy whose box is too small now, and the one for its place
template <class Take>
void fitBoxes(WorldState& world, std::uint32_t body, std::size_t first, Real motion, const Take& take) {
    const std::optional<KinematicStep> step = stepIfKinematic(world, body);
    const std::span<const std::uint32_t> shapes = world.bodies[body].shapes;
    for (const std::uint32_t slot : shapes.subspan(first)) {
        const Shape& shape = world.shapes[slot];
        const Aabb& needed = renewNeededBox(world, shape, motion, step);
        if (!contains(world.broadphase->box(shape.proxy), needed)) {
            take(shape.proxy, fattened(world, shape, needed));
        }
    }
}

/// Likewise of a whole body, unless they still fit.
template <class Take>
void visitOutgrown(WorldState& world, std::uint32_t body, const Take& take) {
    if (keepsBoxes(world, body)) { return; }
    const Real motion = noteBoxes(world, body);
    fitBoxes(world, body, 0, motion, take);
}

void moveProxy(WorldState& world, ProxyId proxy, const Aabb& box) {
    world.counters.proxiesMoved += world.broadphase->move(proxy, box).ok() ? 1 : 0;
}

}  // namespace

void renewBoxes(WorldState& world, std::uint32_t body) {
    visitOutgrown(world, body, [&world](ProxyId proxy, const Aabb& box) {
        (void)world.broadphase->moveInParallel(proxy, box);  // refused: it keeps its box
    });
}

void updateProxies(WorldState& world, std::uint32_t body) {
    if (!world.bodies[body].def.enabled) { return; }
    visitOutgrown(world, body, [&world](ProxyId proxy, const Aabb& box) { moveProxy(world, proxy, box); });
}

void updateProxiesFrom(WorldState& world, std::uint32_t body, std::size_t first, const BodyTravel& before) {
    if (!world.bodies[body].def.enabled) { return; }
    const Real motion = noteBoxes(world, body);
    // What was in no step yet is where its boxes were made: of the same motion, and with the same room, they are these.
    const BodyTravel& now = world.travels[body];
    const bool isWhereItWas = world.bodies[body].fresh && world.bodies[body].awake;
    const bool areSame = isWhereItWas && now.boxMotion == before.boxMotion && now.boxRoom == before.boxRoom;
    fitBoxes(world, body, areSame ? first : 0, motion,
             [&world](ProxyId proxy, const Aabb& box) { moveProxy(world, proxy, box); });
}

void renewProxies(WorldState& world, std::uint32_t body) {
    if (!world.bodies[body].def.enabled) { return; }
    const Real motion = noteBoxes(world, body);
    const std::optional<KinematicStep> step = stepIfKinematic(world, body);
    for (const std::uint32_t slot : world.bodies[body].shapes) {
        const Shape& shape = world.shapes[slot];
        moveProxy(world, shape.proxy, fattened(world, shape, renewNeededBox(world, shape, motion, step)));
        (void)world.broadphase->renewPairs(shape.proxy);  // the shape owns it: never stale
    }
}

void reachWithVelocity(WorldState& world, std::uint32_t body) {
    const bool isFaster = reachMotion(world, body, static_cast<Real>(world.lastDt)) > world.travels[body].boxMotion;
    if (isFaster) { updateProxies(world, body); }
}

}  // namespace swept::inline SWEPT_PRECISION
