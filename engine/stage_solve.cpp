#include <algorithm>
#include <atomic>
#include <cmath>

#include "constraint_builder.h"
#include "joint_builder.h"
#include "modes.h"
#include "profile.h"
#include "step.h"
#include "tied_group.h"
#include "tolerances.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// @return whether the speed was cut
bool limitSpeed(Vec2& velocity, Real maxSpeed) {
    const Real speed = length(velocity);
    if (!(speed > maxSpeed)) { return false; }
    velocity = (maxSpeed / speed) * velocity;
    return true;
}

/// Free bodies per block of a parallel loop.
constexpr std::size_t kFreeGrain = 64;

/// Exact solution of v′ = a − c·v, ω′ = α − c·ω over dt. Touches the body's own motion alone. @return how often its
/// speed was cut
std::uint64_t moveFreely(WorldState& world, std::uint32_t slot, double dt) {
    const Body& body = world.bodies[slot];
    BodyMotion& motion = world.motions[slot];
    std::uint64_t limited = limitSpeed(motion.velocity, world.settings.maxSpeed) ? 1 : 0;
    const bool dynamic = body.isDynamic();
    const DampedMotion linear = dampedMotion(dynamic ? static_cast<double>(body.def.linearDamping) * dt : 0);
    const DampedMotion angular = dampedMotion(dynamic ? static_cast<double>(body.def.angularDamping) * dt : 0);
    const DVec2 acceleration = dynamic ? toDouble(accelerationOf(world, body)) : DVec2{};
    const double angularAcceleration = dynamic ? static_cast<double>(angularAccelerationOf(body)) : 0;
    const DVec2 velocity = toDouble(motion.velocity);
    const auto spin = static_cast<double>(motion.angularVelocity);
    motion.center += (linear.phi1 * dt) * velocity + (linear.phi2 * dt * dt) * acceleration;
    const double angleBefore = motion.angle;
    motion.angle += angular.phi1 * dt * spin + angular.phi2 * dt * dt * angularAcceleration;
    motion.velocity = toReal(linear.decay * velocity + (linear.phi1 * dt) * acceleration);
    motion.angularVelocity = static_cast<Real>(angular.decay * spin + angular.phi1 * dt * angularAcceleration);
    limited += limitSpeed(motion.velocity, world.settings.maxSpeed) ? 1 : 0;
    if (motion.angle == angleBefore) {  // much of what flies does not turn, and sines and cosines are most of a pose
        motion.pose = poseOf(motion.center, motion.pose.rotation, body.localCenter);
    } else {
        updatePose(world, slot);
    }
    return limited;
}

BodyDrive driveOf(const WorldState& world, const Body& body, Real h) {
    if (!body.isDynamic()) { return {}; }
    const auto step = static_cast<double>(h);
    const DampedMotion linear = dampedMotion(static_cast<double>(body.def.linearDamping) * step);
    const DampedMotion angular = dampedMotion(static_cast<double>(body.def.angularDamping) * step);
    return {.gain = static_cast<Real>(linear.phi1 * step) * accelerationOf(world, body),
            .angularGain = static_cast<Real>(angular.phi1 * step) * angularAccelerationOf(body),
            .decay = static_cast<Real>(linear.decay),
            .angularDecay = static_cast<Real>(angular.decay)};
}

bool isMember(const Body& body, const TiedGroup& group) {
    return body.role == group.role && body.effort == group.effort;
}

/// Slots for all that is solved, and for the kinematic bodies it may meet. Free bodies were moved already: a kinematic
/// one takes part with its velocity and its pose at the start of the step.
void addBodies(WorldState& world, const TiedGroup& group, Real h) {
    for (const std::uint32_t slot : group.bodies) {
        Body& body = world.bodies[slot];
        if (!isMember(body, group) && body.def.type != BodyType::kinematic) { continue; }
        const BodyMotion& motion = world.motions[slot];
        const BodyState state{.velocity = motion.velocity, .angularVelocity = motion.angularVelocity};
        body.slot = world.batch.addBody(state, {body.inverseMass, body.inverseInertia}, driveOf(world, body, h));
    }
}

bool isSolved(const WorldState& world, const Contact& contact, const TiedGroup& group) {
    return contact.isSolid() &&
           (isMember(world.bodies[contact.bodyA], group) || isMember(world.bodies[contact.bodyB], group));
}

Real approachSpeedOf(const ContactConstraint& constraint, const SolverBatch& batch) {
    Real fastest = 0;
    for (std::size_t i = 0; i < static_cast<std::size_t>(constraint.count); ++i) {
        const ContactConstraintPoint& point = constraint.points[i];
        const Vec2 velocity = velocityAt(batch.states[constraint.slotB], point.anchorB) -
                              velocityAt(batch.states[constraint.slotA], point.anchorA);
        fastest = std::max(fastest, -dot(velocity, constraint.normal));
    }
    return fastest;
}

/// @param h  seconds of a sub-step. In one shorter than the world's, overlap is pushed out no faster than in that: what
/// the relaxation leaves of the push would be energy.
/// @param scale  of the impulses that are kept, which are those of the world's sub-steps
void addContacts(WorldState& world, const TiedGroup& group, Real dt, Real h, Real scale) {
    const Real usual = dt / static_cast<Real>(standardSubSteps(world.settings, group.effort));
    const Softness softness = softnessOfSubStep(kContactCycles, kContactDampingRatio, std::max(h, usual));
    for (std::size_t i = 0; i < group.contacts.size(); ++i) {
        Contact& contact = group.contacts[i];
        if (!isSolved(world, contact, group)) { continue; }
        ContactConstraint constraint = constraintOf(
            contact.manifold, world.motions[contact.bodyA], world.bodies[contact.bodyA].localCenter,
            world.motions[contact.bodyB], contact.friction, contact.restitution, kPushRatio * contact.extent / dt);
        constraint.slotA = world.bodies[contact.bodyA].slot;
        constraint.slotB = world.bodies[contact.bodyB].slot;
        constraint.softness = softness;
        constraint.source = static_cast<std::uint32_t>(i);
        for (std::size_t k = 0; k < static_cast<std::size_t>(constraint.count); ++k) {
            constraint.points[k].normalImpulse = scale * contact.normalImpulse[k];
            constraint.points[k].tangentImpulse = scale * contact.tangentImpulse[k];
        }
        contact.approachSpeed = approachSpeedOf(constraint, world.batch);
        world.batch.contacts.push_back(constraint);
    }
}

/// What was made ahead is held by its cores (mode `speculative`).
void anchorAhead(WorldState& world, const TiedGroup& group) {
    for (ContactConstraint& constraint : world.batch.contacts) {
        Contact& contact = group.contacts[constraint.source];
        if (!isAhead(world, contact)) { continue; }
        anchorAtCores(constraint, world.shapes[contact.shapeA].polygon.radius,
                      world.shapes[contact.shapeB].polygon.radius);
        contact.approachSpeed = approachSpeedOf(constraint, world.batch);
    }
}

void addJoints(WorldState& world, std::span<const std::uint32_t> joints, Real h, Real dt) {
    for (const std::uint32_t i : joints) { addConstraint(world.batch, world, i, h, dt); }
}

/// What moved at least as far as a fast body, measured generously: here a few instructions tell it, and nobody else
/// need ask.
bool isFlung(const Body& body, const BodyState& state) {
    const Real moved =
        std::fabs(state.deltaPosition.x) + std::fabs(state.deltaPosition.y) + std::fabs(state.deltaAngle) * body.radius;
    return moved > kFastRatio * body.extent;
}

SolveReport solveWithJoints(WorldState& world, std::span<const std::uint32_t> joints, const SolverSettings& settings,
                            Real dt) {
    addJoints(world, joints, settings.dt / static_cast<Real>(settings.subSteps), dt);
    const SolveReport report = world.solver.solve(world.batch, settings, *world.loops);
    readConstraints(world.batch, world, settings.dt);
    world.batch.clearJoints();  // so that nobody need look for any in a solve without
    return report;
}

void readBodies(WorldState& world, const TiedGroup& group) {
    for (const std::uint32_t slot : group.bodies) {
        Body& body = world.bodies[slot];
        if (!isMember(body, group)) { continue; }
        const BodyState& state = world.batch.states[body.slot];
        BodyMotion& motion = world.motions[slot];
        if (isFlung(body, state)) { body.flung = world.anyFlung = true; }
        motion.center += toDouble(state.deltaPosition);
        motion.angle += static_cast<double>(state.deltaAngle);
        motion.velocity = state.velocity;
        motion.angularVelocity = state.angularVelocity;
        updatePose(world, slot);
    }
}

/// A contact that began to press while it approached faster than resting contacts do, or that bounced, is a hit.
void noteHit(WorldState& world, const Contact& contact, const ContactConstraint& constraint, Real threshold,
             const StepPart& part) {
    const ContactConstraintPoint& first = constraint.points[0];
    const ContactConstraintPoint& second = constraint.points[1];
    const Real bounce = std::max(first.bounceApproach, second.bounceApproach);
    const Real speed = std::max(contact.approachSpeed, bounce);
    const Real impulse = first.totalNormalImpulse + second.totalNormalImpulse;
    if (contact.pressed || !(impulse > 0) || !(speed > threshold)) { return; }
    const std::size_t k = second.totalNormalImpulse > first.totalNormalImpulse ? 1 : 0;
    const BodyMotion& a = world.motions[contact.bodyA];
    // The gap closes at the approach speed: a first-order estimate of when in the step.
    const auto gap = static_cast<double>(std::max(contact.manifold.points[k].separation, Real(0)));
    const double wait = std::min(gap / static_cast<double>(speed), part.length);
    world.contactEvents.push_back({.type = ContactEventType::hit,
                                   .shapeA = world.shapes.idOf(world.shapes[contact.shapeA].head),
                                   .shapeB = world.shapes.idOf(world.shapes[contact.shapeB].head),
                                   .bodyA = world.bodies.idOf(contact.bodyA),
                                   .bodyB = world.bodies.idOf(contact.bodyB),
                                   .fraction = (part.begin + wait) / part.dt,
                                   .point = apply(a.pose, contact.manifold.points[k].point),
                                   .normal = constraint.normal,
                                   .approachSpeed = speed,
                                   .impulse = impulse});
}

void readContacts(WorldState& world, std::span<Contact> contacts, Real threshold, const StepPart& part, Real scale) {
    for (const ContactConstraint& constraint : world.batch.contacts) {
        Contact& contact = contacts[constraint.source];
        noteHit(world, contact, constraint, threshold, part);
        contact.pressed = false;
        for (std::size_t k = 0; k < static_cast<std::size_t>(constraint.count); ++k) {
            contact.normalImpulse[k] = constraint.points[k].normalImpulse / scale;
            contact.tangentImpulse[k] = constraint.points[k].tangentImpulse / scale;
            contact.totalImpulse[k] = constraint.points[k].totalNormalImpulse;
            contact.pressed = contact.pressed || contact.totalImpulse[k] > 0;
        }
    }
}

}  // namespace

void moveFreeBodies(WorldState& world, double dt) {
    if (world.counters.freeBodies == 0) { return; }
    std::atomic<std::uint64_t> limited = 0;
    world.loops->run(world.awake.size(), kFreeGrain, [&](std::size_t begin, std::size_t end, int) {
        std::uint64_t some = 0;
        for (std::size_t i = begin; i < end; ++i) {
            const std::uint32_t slot = world.awake[i];
            const Body& body = world.bodies[slot];
            if (body.role == BodyRole::free && body.isDynamic()) { some += moveFreely(world, slot, dt); }
        }
        if (some > 0) { limited.fetch_add(some, std::memory_order_relaxed); }
    });
    world.counters.speedsLimited += limited;
}

void solveGroup(WorldState& world, const TiedGroup& group, const StepPart& part) {
    const auto dt = static_cast<Real>(part.dt);
    const auto time = static_cast<Real>(part.length);
    const Real h = time / static_cast<Real>(part.subSteps);
    const Real threshold = length(world.settings.gravity) * dt;
    world.batch.clearAllButJoints();  // those went when they had been read
    addBodies(world, group, group.effort.direct == DirectScope::none ? h : h / 2);
    const int usual = subStepsOf(world.settings);
    const Real scale =
        group.role == BodyRole::solved ? static_cast<Real>(usual) / static_cast<Real>(part.subSteps) : Real(1);
    addContacts(world, group, dt, h, scale);
    if (world.watched) { anchorAhead(world, group); }
    const SolverSettings settings{.dt = time,
                                  .subSteps = part.subSteps,
                                  .relaxPasses = relaxPassesOf(world.settings),
                                  .restitutionThreshold = threshold,
                                  .maxSpeed = world.settings.maxSpeed,
                                  .joints = !group.joints.empty(),
                                  .bounces = world.bouncyShapes > 0,
                                  .direct = group.effort.direct};
    const SolveReport report = settings.joints ? solveWithJoints(world, group.joints, settings, dt)
                                               : world.solver.solve(world.batch, settings, *world.loops);
    readContacts(world, group.contacts, threshold, part, scale);
    readBodies(world, group);
    StepCounters& counters = world.counters;
    counters.subSteps += static_cast<std::uint64_t>(part.subSteps);
    counters.colours = std::max(counters.colours, static_cast<std::uint64_t>(report.colours));
    counters.bodySubSteps += (world.batch.states.size() - 1) * static_cast<std::uint64_t>(part.subSteps);
    ++counters.effortClasses;
    counters.mostSubSteps = std::max(counters.mostSubSteps, static_cast<std::uint64_t>(part.subSteps));
    counters.directBodies += report.isDirect ? world.batch.states.size() - 1 : 0;
    counters.factorisations += static_cast<std::uint64_t>(report.direct.factorisations);
    counters.directRounds += static_cast<std::uint64_t>(report.direct.rounds);
    counters.directGivenUp += static_cast<std::uint64_t>(report.direct.givenUp);
    counters.bounceRounds += static_cast<std::uint64_t>(report.bounceRounds);
    counters.speedsLimited += static_cast<std::uint64_t>(report.speedsLimited);
    counters.constraints += world.batch.contacts.size() + group.joints.size();
}

void solveTiedBodies(WorldState& world, double dt) {
    world.anyFlung = false;
    if (world.counters.solvedBodies == 0) { return; }
    // Class after class, in the order in which the first of their bodies woke up.
    std::vector<Effort>& efforts = world.efforts;
    efforts.clear();
    for (const std::uint32_t slot : world.awake) {
        const Body& body = world.bodies[slot];
        if (body.role != BodyRole::solved) { continue; }
        if (std::find(efforts.begin(), efforts.end(), body.effort) == efforts.end()) { efforts.push_back(body.effort); }
    }
    for (const Effort effort : efforts) {
        const auto isOfClass = [&](std::uint32_t slot) {
            return world.bodies[slot].role == BodyRole::solved && world.bodies[slot].effort == effort;
        };
        world.tiedJoints.clear();
        for (const std::uint32_t i : world.activeJoints) {
            const std::span<const std::uint32_t> bodies = world.joints[i].allBodies();
            if (std::any_of(bodies.begin(), bodies.end(), isOfClass)) { world.tiedJoints.push_back(i); }
        }
        solveGroup(world,
                   {.effort = effort, .bodies = world.awake, .contacts = world.contacts, .joints = world.tiedJoints},
                   {.length = dt, .dt = dt, .subSteps = subStepsFor(effort, subStepsOf(world.settings))});
    }
}

void moveKinematicBodies(WorldState& world, double dt) {
    for (const std::uint32_t slot : world.awake) {
        if (world.bodies[slot].def.type != BodyType::kinematic) { continue; }
        world.counters.speedsLimited += moveFreely(world, slot, dt);
    }
}

}  // namespace swept::inline SWEPT_PRECISION
