#include <algorithm>
#include <cmath>

#include "modes.h"
#include "step.h"
#include "tolerances.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Bodies per block of a parallel loop.
constexpr std::size_t kResetGrain = 128;

void resetBody(WorldState& world, std::uint32_t slot, Real dt) {
    Body& body = world.bodies[slot];
    const BodyMotion& motion = world.motions[slot];
    body.touchesDynamic = body.hasContact = body.deepContact = false;
    body.bounces = body.rests = body.strikes = body.startled = body.flung = false;
    body.fast = body.extent > 0 && motionBound(world, slot, dt) > kFastRatio * body.extent;
    body.startCenter = motion.center;
    body.startAngle = motion.angle;
}

/// A moving kinematic body passes over what rests as fast as that could pass under it: everything in the box of its coming
/// step is awake and fast.
void startleNearKinematicBodies(WorldState& world, Real dt) {
    for (const Contact& contact : world.contacts) {
        const bool kinematicIsA = world.bodies[contact.bodyA].def.type == BodyType::kinematic;
        const std::uint32_t kinematic = kinematicIsA ? contact.bodyA : contact.bodyB;
        const std::uint32_t other = kinematicIsA ? contact.bodyB : contact.bodyA;
        const Body& mover = world.bodies[kinematic];
        if (contact.sensor || mover.def.type != BodyType::kinematic || !mover.awake) { continue; }
        Body& body = world.bodies[other];
        if (!body.isDynamic() || !(body.extent > 0)) { continue; }
        if (!(motionBound(world, kinematic, dt) > kFastRatio * contact.extent)) { continue; }
        const std::size_t before = world.awake.size();
        wake(world, other);
        for (std::size_t i = before; i < world.awake.size(); ++i) { resetBody(world, world.awake[i], dt); }
        body.fast = body.startled = true;
    }
}

/// Contact of a body with something static or kinematic, as far as it decides how the body is moved.
struct Footing {
    bool bounces = false;  ///< it will, or did and is on its way
    bool rests = false;    ///< it is carried, at least at one point
    bool strikes = false;  ///< a point gets there within this step, and not slowly
};

/// A bouncing body flies from impact to impact on a parabola, however slow it is: what comes down from the separation that
/// there is now is faster than what does not bounce. A body that is carried is moved by the solver, however fast it slides,
/// until it strikes something: the solver shares such a blow among the contacts less well, and may throw the body up.
Footing footingOf(const WorldState& world, std::uint32_t slot, std::uint32_t otherSlot, const Contact& contact, Real dt) {
    Footing footing;
    const Body& body = world.bodies[slot];
    const BodyMotion& motion = world.motions[slot];
    const BodyMotion& other = world.motions[otherSlot];
    const Vec2 fromA = rotate(world.motions[contact.bodyA].pose.rotation, contact.manifold.normal);
    const Vec2 normal = contact.bodyB == slot ? fromA : -fromA;
    const Real pull = -dot(accelerationOf(world, body), normal);
    // What is pulled so hard that the pull alone makes it fast would sink into a soft contact.
    const bool carries = pull > 0 && pull * square(dt) <= kFastRatio * body.extent;
    const Real threshold = bounceThreshold(world, body, dt);
    for (std::size_t i = 0; i < static_cast<std::size_t>(contact.manifold.count); ++i) {
        const DVec2 point = apply(world.motions[contact.bodyA].pose, contact.manifold.points[i].point);
        const Vec2 velocity = motion.velocity + cross(motion.angularVelocity, toReal(point - motion.center)) -
                              other.velocity - cross(other.angularVelocity, toReal(point - other.center));
        const Real approach = -dot(velocity, normal);
        const Real gap = std::max(contact.manifold.points[i].separation, Real(0));
        const bool returns = pull > 0 || approach * dt > gap;
        const bool isSlow = square(approach) + 2 * std::max(pull, Real(0)) * gap <= square(threshold);
        footing.bounces = footing.bounces || (contact.restitution > 0 && returns && !isSlow);
        footing.strikes = footing.strikes || (approach * dt > gap && !isSlow);
        footing.rests = footing.rests || (carries && isSlow && gap <= kEndRatio * contact.extent);
    }
    return footing;
}

/// Dynamic bodies that are near each other, one of them fast, but will not meet in this step do not hold each other.
void dropPassers(WorldState& world, Contact& contact, Real dt) {
    const Body& a = world.bodies[contact.bodyA];
    const Body& b = world.bodies[contact.bodyB];
    if (!a.isDynamic() || !b.isDynamic() || (!a.fast && !b.fast)) { return; }
    const Real gap = deepestSeparation(contact.manifold);
    if (gap <= kEndRatio * contact.extent) { return; }
    const BodyMotion& motionA = world.motions[contact.bodyA];
    const BodyMotion& motionB = world.motions[contact.bodyB];
    const Vec2 normal = rotate(motionA.pose.rotation, contact.manifold.normal);
    const Vec2 pull = accelerationOf(world, b) - accelerationOf(world, a);
    const Real turning = std::fabs(motionA.angularVelocity) * a.radius + std::fabs(motionB.angularVelocity) * b.radius;
    const Real closing = turning - dot(motionB.velocity - motionA.velocity, normal) + dt * length(pull);
    if (closing * dt < gap) { contact.manifold.count = 0; }
}

/// What the contacts tell about one of their bodies.
void noteContact(WorldState& world, std::uint32_t slot, std::uint32_t otherSlot, const Contact& contact, Real dt) {
    Body& body = world.bodies[slot];
    const Body& other = world.bodies[otherSlot];
    if (!body.awake) { return; }
    body.hasContact = true;
    if (other.isDynamic()) {
        body.touchesDynamic = true;
        return;
    }
    if (body.isDynamic() && (contact.restitution > 0 || body.fast)) {
        const Footing footing = footingOf(world, slot, otherSlot, contact, dt);
        body.bounces = body.bounces || footing.bounces;
        body.rests = body.rests || footing.rests;
        body.strikes = body.strikes || footing.strikes;
    }
    for (std::size_t i = 0; i < static_cast<std::size_t>(contact.manifold.count); ++i) {
        body.deepContact =
            body.deepContact || contact.manifold.points[i].separation < -kShallowRatio * contact.extent;
    }
}

BodyRole roleOf(const WorldState& world, const Body& body) {
    if (!body.isDynamic()) { return BodyRole::free; }
    const ContinuousMode mode = modeOf(world, body);
    const bool alone = body.holdingJoints == 0 && !body.touchesDynamic;
    const bool isFlung = body.fast && (body.strikes || !body.rests);
    const bool flies = isFlung || (body.bounces && mode == ContinuousMode::subStep);
    if (alone && flies && !body.deepContact && isSwept(mode)) { return BodyRole::flyer; }
    return body.holdingJoints == 0 && !body.hasContact ? BodyRole::free : BodyRole::solved;
}

/// Joints that hold something awake, in the order of their slots: what follows costs nothing for those that sleep.
void listActiveJoints(WorldState& world) {
    world.activeJoints.clear();
    if (world.joints.size() == 0) { return; }
    const auto isAwake = [&world](std::uint32_t slot) {
        return world.bodies[slot].isDynamic() && world.bodies[slot].awake;
    };
    for (const std::uint32_t slot : world.awake) {
        if (!isAwake(slot)) { continue; }
        for (const std::uint32_t index : world.bodies[slot].joints) {
            const Joint& joint = world.joints[index];
            const auto bodies = joint.allBodies();
            const bool isFirst = *std::find_if(bodies.begin(), bodies.end(), isAwake) == slot;
            if (joint.holds() && isFirst) { world.activeJoints.push_back(index); }
        }
    }
    std::sort(world.activeJoints.begin(), world.activeJoints.end());
}

}  // namespace

void assignRoles(WorldState& world, Real dt) {
    bool anyKinematic = false;
    world.bullets = 0;
    world.loops->run(world.awake.size(), kResetGrain, [&world, dt](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i) { resetBody(world, world.awake[i], dt); }
    });
    for (const std::uint32_t slot : world.awake) {
        world.bullets += world.bodies[slot].def.bullet ? 1 : 0;
        anyKinematic = anyKinematic || world.bodies[slot].def.type == BodyType::kinematic;
    }
    if (anyKinematic) { startleNearKinematicBodies(world, dt); }
    for (Contact& contact : world.contacts) {
        if (!contact.isSolid()) { continue; }
        dropPassers(world, contact, dt);
        if (!contact.isSolid()) { continue; }
        ++world.counters.touching;
        noteContact(world, contact.bodyA, contact.bodyB, contact, dt);
        noteContact(world, contact.bodyB, contact.bodyA, contact, dt);
    }
    world.flyers.clear();
    world.anyFast = world.bullets > 0;
    for (const std::uint32_t slot : world.awake) {
        Body& body = world.bodies[slot];
        body.role = roleOf(world, body);
        world.anyFast = world.anyFast || body.fast || body.role == BodyRole::flyer;
        if (body.role == BodyRole::flyer) { world.flyers.push_back(slot); }
        world.counters.freeBodies += body.role == BodyRole::free ? 1 : 0;
        world.counters.solvedBodies += body.role == BodyRole::solved ? 1 : 0;
    }
    world.counters.flyers = world.flyers.size();
    world.counters.awakeBodies = world.awake.size();
}

void findIslands(WorldState& world) {
    world.islands.reset(world.bodies.slotCount());
    const auto tie = [&world](std::uint32_t a, std::uint32_t b) {
        const Body& bodyA = world.bodies[a];
        const Body& bodyB = world.bodies[b];
        if (bodyA.isDynamic() && bodyB.isDynamic() && bodyA.awake && bodyB.awake) { world.islands.unite(a, b); }
    };
    for (const Contact& contact : world.contacts) {
        if (contact.isSolid()) { tie(contact.bodyA, contact.bodyB); }
    }
    listActiveJoints(world);
    for (const std::uint32_t i : world.activeJoints) {
        const auto bodies = world.joints[i].allBodies();
        const auto moves = [&world](std::uint32_t slot) { return world.bodies[slot].isDynamic(); };
        const auto first = std::find_if(bodies.begin(), bodies.end(), moves);
        for (const std::uint32_t other : bodies) { tie(*first, other); }
    }
    for (const std::uint32_t slot : world.awake) {
        const bool isRoot = world.bodies[slot].role == BodyRole::solved && world.islands.find(slot) == slot;
        world.counters.islands += isRoot ? 1 : 0;
    }
}

}  // namespace swept::inline SWEPT_PRECISION
