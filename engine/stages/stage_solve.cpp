#include <algorithm>
#include <atomic>
#include <limits>

#include "../../shapes/cache_line.h"
#include "../../shapes/compiler.h"
#include "../bodies/body_mass.h"
#include "../containers/any_of.h"
#include "../containers/sort_few.h"
#include "../crew/shared_choice.h"
#include "../islands/effort_budget.h"
#include "../islands/effort_trial.h"
#include "../solve/solve_desk.h"
#include "../solve/tied_group.h"
#include "../state/profile.h"
#include "step.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// @return whether the speed was cut
bool limitSpeed(Vec2& velocity, Real maxSpeed) {
    const Real speed = length(velocity);
    if (!(speed > maxSpeed)) { return false; }
    velocity = (maxSpeed / speed) * velocity;
    return true;
}

/// Bodies per block of a parallel loop.
constexpr std::size_t kFreeGrain = 64;
/// Joints, likewise.
constexpr std::size_t kJointGrain = 256;

/// Exact solution of v′ = a − c·v, ω′ = α − c·ω over dt. Touches the body's own motion alone. @return how often its
/// speed was cut: never of what is kinematic, which all others of the step took to move as it was told
std::uint64_t moveFreely(WorldState& world, std::uint32_t slot, double dt) {
    const Body& body = world.bodies[slot];
    BodyMotion& motion = world.motions[slot];
    const bool dynamic = body.isDynamic();
    const Real maxSpeed = dynamic ? world.settings.maxSpeed : std::numeric_limits<Real>::infinity();
    std::uint64_t limited = limitSpeed(motion.velocity, maxSpeed) ? 1 : 0;
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
    limited += limitSpeed(motion.velocity, maxSpeed) ? 1 : 0;
    if (motion.angle == angleBefore) {  // much of what flies does not turn, and sines and cosines are most of a pose
        motion.pose = poseOf(motion.center, motion.pose.rotation, body.localCenter);
    } else {
        updatePose(world, slot);
    }
    return limited;
}

/// Bodies that are fetched ahead.
constexpr std::size_t kFetchedAhead = 12;

SWEPT_FORCE_INLINE void fetchFree(const WorldState& world, std::uint32_t slot) {
    const Body& body = world.bodies[slot];
    prefetch(&body.role);
    if ((world.traits[slot] & (kIsTied | kIsFlyer)) != 0) { return; }
    prefetch(&body.def.type);
    prefetch(&body.def.linearDamping);
    fetchToWrite(world.motions[slot]);
}

/// Classes in the order in which the first of their bodies woke up; under a budget those with few sub-steps first,
/// since what misses it comes again with more.
void listClasses(WorldState& world, bool areAllSolved, bool budgeted) {
    std::vector<Effort>& efforts = world.efforts;
    efforts.clear();
    for (std::size_t i = 0; i < world.tied.size(); ++i) {
        const Effort& effort = world.tiedEfforts[i];
        if (!efforts.empty() && effort == efforts.back()) { continue; }  // as mostly: no body is asked
        if (!areAllSolved && world.bodies[world.tied[i]].role != BodyRole::solved) { continue; }
        if (std::find(efforts.begin(), efforts.end(), effort) == efforts.end()) { efforts.push_back(effort); }
    }
    if (budgeted) {
        sortFew(efforts, [](Effort a, Effort b) { return a.doublings < b.doublings; });
    }
}

/// @param isAlone  all that is tied is of the class: then small traits tell, and no body is asked
void listJointsOfClass(WorldState& world, Effort effort, bool isAlone) {
    world.tiedJoints.clear();
    if (world.activeJoints.empty()) { return; }
    const auto isOfClass = [&world, effort, isAlone](std::uint32_t slot) {
        if (isAlone) { return (world.traits[slot] & kIsTied) != 0; }
        return world.bodies[slot].role == BodyRole::solved && world.bodies[slot].effort == effort;
    };
    const auto isJointOfClass = [&world, &isOfClass](std::uint32_t joint) {
        const JointTie& tie = world.jointTies[joint];
        if (isOfClass(tie.bodyA) || isOfClass(tie.bodyB)) { return true; }
        if (tie.isPair) { return false; }
        const std::span<const std::uint32_t> bodies = world.joints[joint].allBodies();
        return anyOf(bodies, isOfClass);
    };
    forEachMeant(*world.loops, world.activeJoints, kJointGrain, world.answers, isJointOfClass,
                 [&world](std::uint32_t joint) { world.tiedJoints.push_back(joint); });
}

/// @pre its joints are listed @return whether it was solved as it should be
bool solveClass(WorldState& world, Effort effort, double dt) {
    SolveDesk& desk = world.mainDesk;
    const bool isSolved =
        solveGroup(world,
                   {.desk = desk,
                    .effort = effort,
                    .bodies = world.kinematicBodies > 0 ? std::span<const std::uint32_t>(world.awake) : world.tied,
                    .contacts = world.contacts,
                    .touching = world.touching,
                    .joints = world.tiedJoints},
                   {.length = dt, .dt = dt, .subSteps = subStepsFor(effort, subStepsOf(world.settings))});
    clearDesk(world, desk);
    return isSolved;
}

}  // namespace

void moveFreeBodies(WorldState& world, double dt) {
    if (world.counters.freeBodies == 0) { return; }
    std::atomic<std::uint64_t> limited = 0;
    world.loops->run(world.awake.size(), kFreeGrain, [&](std::size_t begin, std::size_t end, int) {
        std::uint64_t some = 0;
        const std::span<const std::uint32_t> awake = world.awake;
        for (std::size_t i = begin; i < end; ++i) {
            if (i + kFetchedAhead < end) { fetchFree(world, awake[i + kFetchedAhead]); }
            const std::uint32_t slot = awake[i];
            const Body& body = world.bodies[slot];
            if (body.role == BodyRole::free && body.isDynamic()) { some += moveFreely(world, slot, dt); }
        }
        if (some > 0) { limited.fetch_add(some, std::memory_order_relaxed); }
    });
    world.counters.speedsLimited += limited;
}

void solveTiedBodies(WorldState& world, double dt) {
    world.anyFlung = false;
    if (world.tied.empty()) { return; }
    const bool areAllSolved = !world.fastIslands.any;
    const bool budgeted = hasErrorBudget(world.settings);
    listClasses(world, areAllSolved, budgeted);
    std::vector<Effort>& efforts = world.efforts;
    world.mainDesk.loops = world.loops;
    std::uint8_t retries = 0;
    // What is taken back, as it was searched in vain or missed its budget, comes again: its islands are of a class
    // later in the list, with more work.
    for (std::size_t place = 0; place < efforts.size(); ++place) {
        const Effort effort = efforts[place];
        const bool isTried = budgeted && !effort.isSettled;
        const bool isSearch = effort.direct == DirectScope::all && !effort.isSettled;
        listJointsOfClass(world, effort, areAllSolved && efforts.size() == 1);
        if (isTried || isSearch) { rememberClass(world, effort); }
        const bool isSolved = solveClass(world, effort, dt);
        if (isSearch && !isSolved) {
            takeBackClass(world, place, {.doublings = std::max(effort.doublings, std::int8_t{0}), .retry = ++retries});
        } else if (isTried) {
            takeBackMissed(world, place, dt);
        }
    }
}

bool moveKinematicBodies(WorldState& world, double dt) {
    bool areSound = true;
    for (const std::uint32_t slot : world.awake) {
        if (world.bodies[slot].def.type != BodyType::kinematic) { continue; }
        moveFreely(world, slot, dt);
        areSound = areSound && isSound(world.motions[slot]);
    }
    return areSound;
}

}  // namespace swept::inline SWEPT_PRECISION
