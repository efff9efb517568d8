#include "tied_group.h"

#include <algorithm>
#include <optional>

#include "../state/profile.h"
#include "joint_builder.h"
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
/// Of 25 or more in profile `fast`, that took longer than all else in their solves (`swept bench world`, spinner), and
/// in crowds a quarter of theirs.
constexpr std::size_t kMostReflectedOfCrowd = 24;
/// Of no more that bounce together each is a constraint on its own, and all others take the short way into blocks: one
/// bouncy ball in a pile took everybody off it before. More of them are solved in blocks themselves.
constexpr std::size_t kMostAlone = 24;

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
    countSolve(desk, report, part.subSteps, group.effort.isSettled, contacts.count() + group.joints.size());
    return isSolved;
}

}  // namespace swept::inline SWEPT_PRECISION
