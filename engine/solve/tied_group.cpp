#include "tied_group.h"

#include <algorithm>
#include <optional>

#include "../state/profile.h"
#include "joint_builder.h"
#include "joint_results.h"
#include "search_debt.h"
#include "tied_bodies.h"
#include "tied_contacts.h"
#include "tied_hinges.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Contacts with restitution of a group that bounce together; among more of them each bounces in its turn: to find out
/// who bounces together takes as long as all else, and what of it is left undone is lost. (Of 400 elastic disks that
/// jostle each other 18 % of their energy was left after a second that way, and is 67 % in turn.)
constexpr std::size_t kMostReflected = 256;
/// Of hundreds in profile `fast`, that took longer than all else in their solves (`swept bench world`, spinner), and in
/// crowds a quarter of theirs; of so many (21 balls racked have 45) it takes up to a third of a step.
constexpr std::size_t kMostReflectedOfCrowd = 64;
/// Of no more that bounce together, or of fewer than all others, each is a constraint on its own, and those others take
/// the short way into blocks: one bouncy ball in a pile took everybody off it before. More of them are solved in blocks
/// themselves.
constexpr std::size_t kMostAlone = 24;

/// As `jointSoftness` has it of iterated joints. A whole step, after one as long, has the sub-steps that it asks for.
Real leastClosingOf(const WorldState& world, const TiedGroup& group, const StepPart& part) {
    const double closing = world.closingTime * world.closingStretch;
    if (!(part.length < closing)) { return 0; }
    return static_cast<Real>(closing) / static_cast<Real>(standardSubSteps(world.settings, group.effort));
}

/// What is known of a solve before its contacts are looked at.
struct SolvePlan {
    Real time;          ///< that it goes through, s
    Real h;             ///< of a sub-step, s
    DirectScope scope;  ///< what is solved all at once
    bool isIterated;    ///< nothing is
    bool hasJoints;
    const StepPart& part;
};

SolvePlan planOf(const TiedGroup& group, const StepPart& part) {
    const auto time = static_cast<Real>(part.length);
    const DirectScope scope = group.effort.isSettled ? DirectScope::none : group.effort.direct;
    return {.time = time,
            .h = time / static_cast<Real>(part.subSteps),
            .scope = scope,
            .isIterated = scope == DirectScope::none,
            .hasJoints = !group.joints.empty(),
            .part = part};
}

/// Impulses that contacts keep are those of the world's sub-steps; but islands that advance keep their own, and joints
/// those of their last solve.
Real keptImpulseScale(const WorldState& world, const TiedGroup& group, const StepPart& part) {
    if (group.role != BodyRole::solved) { return 1; }
    return static_cast<Real>(subStepsOf(world.settings)) / static_cast<Real>(part.subSteps);
}

/// How the contacts of a group come to the solver, and how they bounce.
struct ContactWay {
    std::size_t bouncing = 0;  ///< with restitution
    bool inTurn = false;       ///< these bounce one after the other
    bool areLinked = false;    ///< by links, from which the solver makes blocks; else each is a constraint
};

/// Links them where they may be. @pre the bodies of the group have their slots
ContactWay linkContacts(const WorldState& world, const TiedGroup& group, const SolvePlan& plan,
                        TiedContacts& contacts) {
    if (!plan.isIterated || world.watched) { return {.bouncing = contacts.countBouncing()}; }
    const bool isCrowd = world.settings.profile == Profile::fast || group.effort.isCrowd();
    const std::size_t bouncing = contacts.link();
    const bool inTurn = bouncing > (isCrowd ? kMostReflectedOfCrowd : kMostReflected);
    const bool areFew = bouncing <= kMostAlone || 2 * bouncing < group.desk.batch.links.size();
    const bool areLinked = areFew || inTurn;
    if (!areLinked) { contacts.unlink(); }
    if (areLinked && bouncing > 0) { contacts.letBounce(inTurn); }
    return {bouncing, inTurn, areLinked};
}

/// Where iterated, hinges have links.
void addJoints(WorldState& world, const TiedGroup& group, const SolvePlan& plan, TiedHinges& hinges) {
    const SolveTimes times(plan.part, plan.h);
    group.desk.batch.mayGlide = !world.drivenJoints.empty();
    for (const std::uint32_t i : group.joints) {
        const JointTie& tie = world.jointTies[i];
        if (tie.isHinge && plan.isIterated) {
            hinges.link(i, tie);
        } else {
            addConstraint(group.desk.batch, world, i, times);
        }
    }
}

SolverSettings settingsOf(const WorldState& world, const TiedGroup& group, const SolvePlan& plan,
                          const ContactWay& way) {
    const bool isFast = world.settings.profile == Profile::fast;
    return {.dt = plan.time,
            .subSteps = plan.part.subSteps,
            .relaxPasses = relaxPassesFor(group.effort, relaxPassesOf(world.settings)),
            .restitutionThreshold = length(world.settings.gravity) * static_cast<Real>(plan.part.dt),
            .maxSpeed = world.settings.maxSpeed,
            .joints = plan.hasJoints,
            .bounces = way.bouncing > 0 && !way.inTurn,
            .bouncesInTurn = way.inTurn,
            .coarseImpacts = isFast,
            .direct = plan.scope,
            .left = group.effort.left,
            .leastClosing = leastClosingOf(world, group, plan.part),
            .hasManyBodies = group.effort.isLarge,
            .settled = group.effort.isSettled};
}

SolveReport solveBatch(WorldState& world, const TiedGroup& group, const SolverSettings& settings) {
    SolverBatch& batch = group.desk.batch;
    const SolveReport report = group.desk.solver.solve(batch, settings, *group.desk.loops);
    if (settings.joints) {
        readConstraints(batch, world, settings.dt);
        batch.clearJoints();  // so that nobody need look for any in a solve without
    }
    return report;
}

/// Only who took long pays: beside one heap that is searched in vain others are solved all at once.
void rememberSearch(WorldState& world, const TiedGroup& group, const StepPart& part, const SolveReport& report) {
    const SolveDesk& desk = group.desk;
    for (std::size_t i = 0; i < desk.bodies.size(); ++i) {
        Body& body = world.bodies[desk.bodies[i]];
        if (!isMember(body, group)) { continue; }
        const SearchEffort own = report.isDirect ? desk.solver.searchEffortOf(static_cast<BodySlot>(i + 1))
                                                 : SearchEffort{.isLong = true, .isInVain = true};
        if (!own.isLong) { continue; }
        const SearchCost cost{.rounds = own.rounds,
                              .subSteps = part.subSteps,
                              .bodies = own.bodies,
                              .isLarge = group.effort.isLarge,
                              .isSolved = !own.isInVain};
        body.searchDebt = searchDebtAfter(body.searchDebt, cost);
    }
}

/// @param subStepsAsked  which islands that are solved by themselves need not have taken
void countSolve(SolveDesk& desk, const SolveReport& report, int subStepsAsked, bool isSettled,
                std::size_t constraints) {
    StepCounters& counters = desk.counters;
    const std::uint64_t bodies = desk.batch.states.size() - 1;
    counters.colours = std::max(counters.colours, static_cast<std::uint64_t>(report.colours));
    const bool ownSubSteps = report.mostSubSteps > 0;
    const auto subSteps = static_cast<std::uint64_t>(ownSubSteps ? report.mostSubSteps : subStepsAsked);
    counters.bodySubSteps += ownSubSteps ? report.bodySubSteps : bodies * subSteps;
    counters.subSteps += subSteps;
    ++counters.effortClasses;
    counters.mostSubSteps = std::max(counters.mostSubSteps, subSteps);
    counters.directBodies += report.isDirect ? bodies : 0;
    counters.settledBodies += isSettled ? bodies : 0;
    counters.factorisations += static_cast<std::uint64_t>(report.direct.factorisations);
    counters.directRounds += static_cast<std::uint64_t>(report.direct.rounds);
    counters.directGivenUp += static_cast<std::uint64_t>(report.direct.givenUp);
    counters.bounceRounds += static_cast<std::uint64_t>(report.bounceRounds);
    counters.speedsLimited += static_cast<std::uint64_t>(report.speedsLimited);
    counters.constraints += constraints;
}

}  // namespace

bool solveGroup(WorldState& world, const TiedGroup& group, const StepPart& part) {
    const SolvePlan plan = planOf(group, part);
    SolveDesk& desk = group.desk;
    desk.batch.clearAllButJoints();  // those went when they had been read
    TiedContacts contacts(world, group, part, plan.h, keptImpulseScale(world, group, part));
    giveSlots(world, group, plan.time);
    const ContactWay way = linkContacts(world, group, plan, contacts);
    std::optional<TiedHinges> hinges;
    // Links, and so colours, are known without a look at the bodies.
    setBodies(world, group, plan.isIterated ? plan.h : plan.h / 2, [&] {
        if (plan.hasJoints) {
            hinges.emplace(world, group, plan.h, part);
            addJoints(world, group, plan, *hinges);
        }
        if (way.areLinked) { desk.solver.colourAhead(desk.batch, !plan.hasJoints, desk.standing); }
    });
    if (!way.areLinked) { contacts.addConstraints(); }
    const SolveReport report = solveBatch(world, group, settingsOf(world, group, plan, way));
    if (!way.areLinked) { contacts.readConstraints(); }
    desk.isExact = report.isExact;
    desk.anyGaveWay = report.direct.givenUp > 0;
    desk.anyLeft = report.anyLeft;
    readBodies(world, group, plan.time, plan.h, part.dt);
    const bool isSearch = plan.scope == DirectScope::all;
    const bool isSolved = !isSearch || (report.isDirect && report.direct.givenUp == 0);
    if (isSearch) { rememberSearch(world, group, part, report); }
    countSolve(desk, report, part.subSteps, group.effort.isSettled, contacts.count() + group.joints.size());
    return isSolved;
}

}  // namespace swept::inline SWEPT_PRECISION
