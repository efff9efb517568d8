#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <optional>

#include "../../shapes/cache_line.h"
#include "../../shapes/compiler.h"
#include "../containers/sort_few.h"
#include "../crew/shared_choice.h"
#include "../islands/effort_budget.h"
#include "../modes/modes.h"
#include "../solve/joint_builder.h"
#include "../solve/tied_bodies.h"
#include "../solve/tied_contacts.h"
#include "../solve/tied_group.h"
#include "../solve/tied_hinges.h"
#include "../state/body_mass.h"
#include "../state/profile.h"
#include "../state/tolerances.h"
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

/// Contacts with restitution of a group that bounce together; among more of them each bounces in its turn: to find out
/// who bounces together takes as long as all else, and what of it is left undone is lost. (Of 400 elastic disks that
/// jostle each other 18 % of their energy was left after a second that way, and is 67 % in turn.)
constexpr std::size_t kMostReflected = 256;
/// Of 25 or more in profile `fast`, that took longer than all else in their solves (`swept bench world`, spinner), and
/// in crowds a quarter of theirs.
constexpr std::size_t kMostReflectedOfCrowd = 24;
/// Of no more that bounce together each is a constraint on its own, and all others take the short way into blocks: one
/// bouncy ball in a pile took everybody off it before. More of them are solved in blocks themselves.
constexpr std::size_t kMostAlone = 24;

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

/// As `jointSoftness` has it of iterated joints. A whole step, after one as long, has the sub-steps that it asks for.
Real leastClosingOf(const WorldState& world, const TiedGroup& group, const StepPart& part) {
    const double closing = world.closingTime * world.closingStretch;
    if (!(part.length < closing)) { return 0; }
    return static_cast<Real>(closing) / static_cast<Real>(standardSubSteps(world.settings, group.effort));
}

/// @param h  seconds of a sub-step
/// @param areIterated  then hinges have links
void addJoints(WorldState& world, const TiedGroup& group, TiedHinges& hinges, bool areIterated, Real h,
               const StepPart& part) {
    const auto dt = static_cast<Real>(part.dt);
    const auto left = static_cast<Real>(part.dt - part.begin);
    group.desk.batch.mayGlide = !world.drivenJoints.empty();
    for (const std::uint32_t i : group.joints) {
        const JointTie& tie = world.jointTies[i];
        if (tie.isHinge && areIterated) {
            hinges.link(i, tie);
        } else {
            addConstraint(group.desk.batch, world, i, h, dt, left);
        }
    }
}

SolveReport solveWithJoints(WorldState& world, const TiedGroup& group, const SolverSettings& settings) {
    SolverBatch& batch = group.desk.batch;
    const SolveReport report = group.desk.solver.solve(batch, settings, *group.desk.loops);
    readConstraints(batch, world, settings.dt);
    batch.clearJoints();  // so that nobody need look for any in a solve without
    return report;
}

/// Only who took long pays: beside one heap that is searched in vain others are solved all at once.
/// @param all  nothing was searched
void rememberSearch(WorldState& world, const TiedGroup& group, const SearchCost& cost, bool all) {
    const SolveDesk& desk = group.desk;
    for (std::size_t i = 0; i < desk.bodies.size(); ++i) {
        Body& body = world.bodies[desk.bodies[i]];
        if (!isMember(body, group)) { continue; }
        if (all || desk.solver.tookLong(static_cast<BodySlot>(i + 1))) {
            body.searchDebt = searchDebtAfter(body.searchDebt, cost);
        }
    }
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

bool solveGroup(WorldState& world, const TiedGroup& group, const StepPart& part) {
    const auto dt = static_cast<Real>(part.dt);
    const auto time = static_cast<Real>(part.length);
    const Real h = time / static_cast<Real>(part.subSteps);
    const Real threshold = length(world.settings.gravity) * dt;
    SolveDesk& desk = group.desk;
    desk.batch.clearAllButJoints();  // those went when they had been read
    const DirectScope scope = group.effort.isSettled ? DirectScope::none : group.effort.direct;
    const int usual = subStepsOf(world.settings);
    const Real scale =
        group.role == BodyRole::solved ? static_cast<Real>(usual) / static_cast<Real>(part.subSteps) : Real(1);
    TiedContacts contacts(world, group, part, h, scale);
    const bool isIterated = scope == DirectScope::none;
    const bool mayLink = isIterated && !world.watched;
    const bool hasJoints = !group.joints.empty();
    const bool onlyContacts = !hasJoints;
    const bool isCrowd = world.settings.profile == Profile::fast || group.effort.isCrowd;
    giveSlots(world, group);
    const std::size_t bouncing = mayLink ? contacts.link() : contacts.countBouncing();
    const bool inTurn = mayLink && bouncing > (isCrowd ? kMostReflectedOfCrowd : kMostReflected);
    const bool areLinked = mayLink && (bouncing <= kMostAlone || inTurn);
    if (mayLink && !areLinked) { contacts.unlink(); }
    if (areLinked && bouncing > 0) { contacts.letBounce(inTurn); }
    std::optional<TiedHinges> hinges;
    // Links, and so colours, are known without a look at the bodies.
    setBodies(world, group, isIterated ? h : h / 2, [&] {
        if (!onlyContacts) {
            hinges.emplace(world, group, h, part);
            addJoints(world, group, *hinges, isIterated, h, part);
        }
        if (areLinked) { desk.solver.colourAhead(desk.batch, onlyContacts, desk.standing); }
    });
    if (!areLinked) { contacts.addConstraints(); }
    const SolverSettings settings{.dt = time,
                                  .subSteps = part.subSteps,
                                  .relaxPasses = relaxPassesFor(group.effort, relaxPassesOf(world.settings)),
                                  .restitutionThreshold = threshold,
                                  .maxSpeed = world.settings.maxSpeed,
                                  .joints = hasJoints,
                                  .bounces = bouncing > 0 && !inTurn,
                                  .bouncesInTurn = inTurn,
                                  .coarseImpacts = world.settings.profile == Profile::fast,
                                  .direct = scope,
                                  .leastClosing = leastClosingOf(world, group, part),
                                  .patient = group.effort.isLarge,
                                  .takenBack = group.role == BodyRole::solved,
                                  .settled = group.effort.isSettled};
    const SolveReport report =
        onlyContacts ? desk.solver.solve(desk.batch, settings, *desk.loops) : solveWithJoints(world, group, settings);
    if (!areLinked) { contacts.readConstraints(); }
    readBodies(world, group, time, h);
    const bool isSolved = scope != DirectScope::all || (report.isDirect && report.direct.givenUp == 0);
    if (scope == DirectScope::all) {
        rememberSearch(world, group,
                       {.rounds = report.direct.rounds,
                        .subSteps = part.subSteps,
                        .bodies = desk.batch.states.size() - 1,
                        .isLarge = group.effort.isLarge,
                        .isSolved = isSolved},
                       !report.isDirect);
    }
    StepCounters& counters = desk.counters;
    counters.colours = std::max(counters.colours, static_cast<std::uint64_t>(report.colours));
    const bool ownSubSteps = report.mostSubSteps > 0;
    const auto subSteps = static_cast<std::uint64_t>(ownSubSteps ? report.mostSubSteps : part.subSteps);
    counters.bodySubSteps += ownSubSteps ? report.bodySubSteps : (desk.batch.states.size() - 1) * subSteps;
    counters.subSteps += subSteps;
    ++counters.effortClasses;
    counters.mostSubSteps = std::max(counters.mostSubSteps, subSteps);
    counters.directBodies += report.isDirect ? desk.batch.states.size() - 1 : 0;
    counters.settledBodies += group.effort.isSettled ? desk.batch.states.size() - 1 : 0;
    counters.factorisations += static_cast<std::uint64_t>(report.direct.factorisations);
    counters.directRounds += static_cast<std::uint64_t>(report.direct.rounds);
    counters.directGivenUp += static_cast<std::uint64_t>(report.direct.givenUp);
    counters.bounceRounds += static_cast<std::uint64_t>(report.bounceRounds);
    counters.speedsLimited += static_cast<std::uint64_t>(report.speedsLimited);
    counters.constraints += contacts.count() + group.joints.size();
    return isSolved;
}

void solveTiedBodies(WorldState& world, double dt) {
    world.anyFlung = false;
    if (world.counters.solvedBodies == 0) { return; }
    // Class after class, in the order in which the first of their bodies woke up.
    std::vector<Effort>& efforts = world.efforts;
    efforts.clear();
    const bool areAllSolved = !world.fastIslands.any;
    for (std::size_t i = 0; i < world.tied.size(); ++i) {
        const Effort effort = world.tiedEfforts[i];
        if (!efforts.empty() && effort == efforts.back()) { continue; }  // as mostly: no body is asked
        if (!areAllSolved && world.bodies[world.tied[i]].role != BodyRole::solved) { continue; }
        if (std::find(efforts.begin(), efforts.end(), effort) == efforts.end()) { efforts.push_back(effort); }
    }
    SolveDesk& desk = world.mainDesk;
    desk.loops = world.loops;
    const bool budgeted = hasErrorBudget(world.settings);
    if (budgeted) {
        sortFew(efforts, [](Effort a, Effort b) { return a.doublings < b.doublings; });
    }
    std::uint8_t retries = 0;
    for (std::size_t place = 0; place < efforts.size(); ++place) {  // grows as it goes
        const Effort effort = efforts[place];
        const bool isTried = budgeted && !effort.isSettled;
        const bool areAlike = areAllSolved && efforts.size() == 1;  // then small traits tell, and no body is asked
        const auto isOfClass = [&](std::uint32_t slot) {
            if (areAlike) { return (world.traits[slot] & kIsTied) != 0; }
            return world.bodies[slot].role == BodyRole::solved && world.bodies[slot].effort == effort;
        };
        world.tiedJoints.clear();
        const auto isJointOfClass = [&](std::uint32_t joint) {
            const JointTie& tie = world.jointTies[joint];
            if (isOfClass(tie.bodyA) || isOfClass(tie.bodyB)) { return true; }
            if (tie.isPair) { return false; }
            const std::span<const std::uint32_t> bodies = world.joints[joint].allBodies();
            return std::any_of(bodies.begin(), bodies.end(), isOfClass);
        };
        forEachMeant(*world.loops, world.activeJoints, kJointGrain, world.answers, isJointOfClass,
                     [&world](std::uint32_t joint) { world.tiedJoints.push_back(joint); });
        const bool isSearch = effort.direct == DirectScope::all && !effort.isSettled;
        if (isTried || isSearch) { rememberClass(world, effort); }
        const bool isSolved =
            solveGroup(world,
                       {.desk = desk,
                        .effort = effort,
                        .bodies = world.kinematicBodies > 0 ? std::span<const std::uint32_t>(world.awake) : world.tied,
                        .contacts = world.contacts,
                        .joints = world.tiedJoints},
                       {.length = dt, .dt = dt, .subSteps = subStepsFor(effort, subStepsOf(world.settings))});
        clearDesk(world, desk);
        if (isSearch && !isSolved) {
            takeBackClass(world, place, {.doublings = std::max(effort.doublings, std::int8_t{0}), .retry = ++retries});
        } else if (isTried) {
            takeBackMissed(world, place, dt);
        }
    }
}

void moveKinematicBodies(WorldState& world, double dt) {
    for (const std::uint32_t slot : world.awake) {
        if (world.bodies[slot].def.type != BodyType::kinematic) { continue; }
        moveFreely(world, slot, dt);
    }
}

}  // namespace swept::inline SWEPT_PRECISION
