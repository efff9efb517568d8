#include "island_advance.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "../flight/bullets_ahead.h"
#include "../flight/chain_crossing.h"
#include "../flight/clamp.h"
#include "../flight/ground_on_the_way.h"
#include "../flight/solved_path.h"
#include "../flight/whirls.h"
#include "../modes/modes.h"
#include "../solve/lent_energy.h"
#include "../solve/solve_outcome.h"
#include "../solve/tied_group.h"
#include "../state/profile.h"
#include "cut_motion.h"
#include "island_contacts.h"
#include "member_meetings.h"
#include "part_sub_steps.h"
#include "yield_to_ground.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// After so many tries, or once the budget of impacts is used up, what is left of the step is gone through in so many
/// parts. Each try moves all members: a large island has fewer of them, and fewer parts in the end.
constexpr std::size_t kMaxTries = 64;
constexpr std::size_t kMaxMemberTries = 1024;
constexpr std::size_t kMaxMemberTriesOfFast = 256;
/// With fewer tries than this every one of them is in vain.
constexpr std::size_t kFewestTries = 2;
constexpr std::size_t kLastParts = 8;
/// Radians in the shortest part beyond which no turn is followed: the rest of the step is one part.
constexpr double kHopelessTurn = 1024;
/// A part that was already made to fit, and still ends at an impact, is cut there if that leaves at least so much of
/// it.
constexpr double kGoodFit = 0.5;

/// How far one island has come in the step.
struct Course {
    WorldState& world;
    IslandDesk& desk;
    AdvancingIsland& island;
    FlightScratch& scratch;
    double dt;
    GroundOnTheWay ground{world, scratch};
    double elapsed = 0;
    double shortest = 0;
    double next = 0;           ///< seconds of the next part, if it turns no faster, and the step is not over before
    int made = 0;              ///< tries so far
    bool fits = false;         ///< the next part ends where the one before, taken back, met something
    double subStepBefore = 0;  ///< the part that is being tried
    std::size_t eventsBefore = 0;
};

/// Reactions of the joints are means over the step so far.
void addUpReactions(Course& course, double time) {
    const auto share = static_cast<Real>(time / course.dt);
    for (std::size_t i = 0; i < course.island.jointSlots.size(); ++i) {
        Joint& joint = course.world.joints[course.island.jointSlots[i]];
        const Joint& before = course.island.jointsBefore[i];
        joint.reactionForce = before.reactionForce + share * joint.reactionForce;
        joint.reactionTorque = before.reactionTorque + share * joint.reactionTorque;
    }
}

/// @return whether it was solved as it should be
bool solvePart(Course& course, double time) {
    AdvancingIsland& island = course.island;
    yieldToGround(course.world, island);
    const StepPart part{.begin = course.elapsed,
                        .length = time,
                        .dt = course.dt,
                        .subSteps = subStepsOfPart(course.world, island, time, course.dt)};
    setSubStep(course.world, island, time / part.subSteps);
    putTotalsAside(island);
    island.group = island.members;
    course.ground.addMet(island.group);
    const bool isSolved = solveGroup(course.world,
                                     {.desk = course.desk,
                                      .role = BodyRole::together,
                                      .effort = course.world.bodies[island.members[0]].effort,
                                      .bodies = island.group,
                                      .contacts = island.contacts,
                                      .joints = island.jointSlots},
                                     part);
    addUpTotals(island);
    addUpReactions(course, time);
    return isSolved;
}

/// Whether the contacts of the island are solved all at once, which may be in vain.
bool isSearched(const Course& course) {
    return course.world.bodies[course.island.members[0]].effort.direct == DirectScope::all;
}

/// What is left of the step is iterated. Impulses of a search that is given up in one of its later sub-steps are
/// nothing to go on from: they may have grown in all of the ones before (`DirectContacts::isSqueezed`).
void iterateTheRest(Course& course) {
    for (const std::uint32_t slot : course.island.members) {
        Effort& effort = course.world.bodies[slot].effort;
        effort = {.doublings = std::max(effort.doublings, std::int8_t{0})};
    }
}

bool isFirstPart(const Course& course) { return course.elapsed <= 0; }

/// @param isTried  whether the part may be taken back
void remember(Course& course, bool isTried) {
    AdvancingIsland& island = course.island;
    island.membersBefore.clear();
    for (const std::uint32_t slot : island.members) {
        const BodyMotion& motion = course.world.motions[slot];
        island.membersBefore.push_back(outcomeOf(course.world, slot));
        course.world.bodies[slot].startCenter = motion.center;
        course.world.bodies[slot].startAngle = motion.angle;
    }
    if (isTried) { rememberIslandContacts(island, isFirstPart(course)); }
    course.subStepBefore = course.island.subStep;
    island.jointsBefore.clear();
    for (const std::uint32_t slot : island.jointSlots) { island.jointsBefore.push_back(course.world.joints[slot]); }
    course.eventsBefore = course.desk.events.size();
}

void takeBack(Course& course) {
    AdvancingIsland& island = course.island;
    for (std::size_t i = 0; i < island.members.size(); ++i) {
        restore(course.world, island.members[i], island.membersBefore[i]);
    }
    for (std::size_t i = 0; i < island.jointSlots.size(); ++i) {
        course.world.joints[island.jointSlots[i]] = island.jointsBefore[i];
    }
    takeBackIslandContacts(course.world, island, isFirstPart(course));
    island.subStep = course.subStepBefore;
    auto& events = course.desk.events;
    events.erase(events.begin() + static_cast<std::ptrdiff_t>(course.eventsBefore), events.end());
}

/// @param share  of the step that the part takes
bool isSweptMember(const WorldState& world, std::uint32_t slot, double share) {
    const Body& body = world.bodies[slot];
    return isSwept(modeOf(world, body)) && (body.startled || movedFast(world, slot, share));
}

/// All members stand where they were at a fraction of the part.
void cutPart(Course& course, double time, double fraction) {
    const AdvancingIsland& island = course.island;
    for (std::size_t i = 0; i < island.members.size(); ++i) {
        cutMotion(course.world, island.members[i], island.membersBefore[i].motion, time, fraction);
    }
}

/// Where a part ends within the step the way may bend: what watches it needs to know (sensors).
void notePoses(Course& course, double time) {
    for (const std::uint32_t slot : course.island.members) {
        const BodyMotion& motion = course.world.motions[slot];
        if (!isSweptMember(course.world, slot, time / course.dt)) { continue; }
        course.scratch.impactPoses.push_back({.body = course.world.bodies.idOf(slot),
                                              .position = motion.pose.position,
                                              .angle = motion.angle,
                                              .fraction = course.elapsed / course.dt});
    }
}

bool isSunk(const WorldState& world, std::uint32_t slot) {
    return world.bodies[slot].sunk && isSwept(modeOf(world, world.bodies[slot]));
}

void hold(WorldState& world, std::uint32_t slot, const StepPart& part, FlightScratch& scratch) {
    ++scratch.counters.sweeps;
    const bool stops = modeOf(world, world.bodies[slot]) == ContinuousMode::stop;
    clampAtImpact(world, slot, part, stops ? LostTimeReason::stop : LostTimeReason::clamp, scratch);
}

/// What contacts and sweeps know of what members cross goes for both.
void shareCrossings(AdvancingIsland& island, FlightScratch& scratch) {
    for (const Contact& contact : island.contacts) {
        const ChainPasser passer{.segment = contact.shapeA, .shape = contact.shapeB};
        const auto isSame = [&](const ChainPasser& other) { return other == passer; };
        if (!contact.passes || std::any_of(scratch.chains.crossings.begin(), scratch.chains.crossings.end(), isSame)) {
            continue;
        }
        scratch.chains.crossings.push_back(passer);
    }
}

/// @param isLast  whether nobody looks for impacts of the part: else those that are sunk are held alone
void holdMembers(Course& course, double time, bool isLast) {
    const StepPart part{.begin = course.elapsed, .length = time, .dt = course.dt};
    if (!isLast) { return holdSunk(course.world, course.island.members, part, course.scratch); }
    for (const std::uint32_t slot : course.island.members) {
        if (!isSunk(course.world, slot) && !isSweptMember(course.world, slot, time / course.dt)) { continue; }
        hold(course.world, slot, part, course.scratch);
    }
}

/// The ground of contacts and joints.
void meetWhatIsKnown(Course& course) {
    for (const Contact& contact : course.island.contacts) {
        course.ground.meet(contact.bodyA);
        course.ground.meet(contact.bodyB);
    }
    for (const std::uint32_t joint : course.island.jointSlots) {
        for (const std::uint32_t slot : course.world.joints[joint].allBodies()) { course.ground.meet(slot); }
    }
}

void begin(Course& course) {
    AdvancingIsland& island = course.island;
    course.shortest = kShortestPart * course.dt;
    island.usualSubStep = island.subStep = course.dt / subStepsOf(course.world.settings);
    if (course.scratch.ground != nullptr) { meetWhatIsKnown(course); }
    island.membersAtStart.clear();
    for (const std::uint32_t slot : island.members) {
        island.membersAtStart.push_back(outcomeOf(course.world, slot));
        beginCrossings(course.world, slot, course.scratch);
    }
    for (const std::uint32_t slot : island.jointSlots) {
        course.world.joints[slot].reactionForce = {};
        course.world.joints[slot].reactionTorque = 0;
    }
    if (const LentEnergy* const lent = lentOf(course.world, island.jointSlots)) { island.lentAtStart = *lent; }
}

/// What the next step and its report need: poses at the start of the step, kinematic bodies there, contacts.
void finish(Course& course) {
    AdvancingIsland& island = course.island;
    course.ground.goBack();
    for (std::size_t i = 0; i < island.members.size(); ++i) {
        Body& body = course.world.bodies[island.members[i]];
        body.startCenter = island.membersAtStart[i].motion.center;
        body.startAngle = island.membersAtStart[i].motion.angle;
    }
    setSubStep(course.world, island, island.usualSubStep);
    storeIslandContacts(course.world, course.desk);
}

/// Visits of members that all tries of an island may make.
std::size_t memberTries(const WorldSettings& settings) {
    return settings.profile == Profile::fast ? kMaxMemberTriesOfFast : kMaxMemberTries;
}

/// The part stays as it is. @return its length
double accept(Course& course, double time) {
    const StepPart part{.begin = course.elapsed, .length = time, .dt = course.dt};
    noteCrossingsOf(course.world, course.island.members, part, course.scratch);
    return time;
}

/// Tries one part. @return seconds that the island got on, or 0: taken back, to be tried with `Course::next`
double tryPart(Course& course, double time) {
    const bool isLast = time < 2 * course.shortest;  // try: it stays as it is
    remember(course, !isLast || isSearched(course));
    course.ground.goTo(course.elapsed);
    // The whole step begins with the contacts that it has found already.
    if (course.elapsed > 0 || time < course.dt) {
        course.island.crossing = course.scratch.chains.crossings;
        std::sort(course.island.crossing.begin(), course.island.crossing.end());
        collideIslandContacts(course.world, course.desk, time, course.scratch.ground);
        shareCrossings(course.island, course.scratch);
    }
    course.scratch.chains.meetsBacks = !course.scratch.chains.crossings.empty();
    if (!solvePart(course, time)) {
        takeBack(course);
        iterateTheRest(course);
        return tryPart(course, time);
    }
    course.next = growthOf(course.world.settings) * std::max(time, course.shortest);
    if (isLast) {
        holdMembers(course, time, true);
        return accept(course, time);
    }
    const double fraction =
        firstImpactOf(course.world, course.island.members, {.length = time, .dt = course.dt}, course.scratch);
    if (!(fraction < 1)) {
        holdMembers(course, time, false);
        return accept(course, time);
    }
    ++course.scratch.counters.impacts;
    if (course.fits && fraction >= kGoodFit && fraction * time >= course.shortest) {
        cutPart(course, time, fraction);
        holdMembers(course, fraction * time, false);
        return accept(course, fraction * time);
    }
    takeBack(course);
    course.next = std::max(fraction * time, course.shortest);
    return 0;
}

bool isOnChain(const AdvancingIsland& island) {
    return std::any_of(island.contacts.begin(), island.contacts.end(),
                       [](const Contact& contact) { return contact.ofChain && contact.pressed; });
}

/// Seconds of the next part of an island that turns too fast for one. What rides on a curve has parts of one length: in
/// each it turns by as much as the ground did in the one before, and pays for the way that it went straight on
/// (curved_ground.h).
double longestTurning(const Course& course, double rest, double most) {
    return isOnChain(course.island) ? rest / std::ceil(rest / most) : most;
}

/// Seconds of any part of an island with a whirl (whirls.h): so short that it turns by little, but no shorter than half
/// of the tries allow.
double longestOfWhirl(const Course& course, int mostTries) {
    const double spin = fastestWhirl(course.world, course.island.members);
    return spin > 0 ? std::max(kWhirlTurn / spin, 2 * course.dt / mostTries) : course.dt;
}

/// A body on its own that slides fast, and strikes something on its way, flies this step: the solver shares such a blow
/// among floor and wall less well, and may throw it up.
bool fliesInstead(const Course& course) {
    const AdvancingIsland& island = course.island;
    if (course.elapsed > 0 || island.members.size() != 1 || !island.jointSlots.empty()) { return false; }
    const Body& body = course.world.bodies[island.members[0]];
    return !body.deepContact && !body.touchesDynamic && body.holdingJoints == 0;
}

void flyInstead(Course& course) {
    finish(course);
    course.scratch.chains.crossings.clear();
    fly(course.world, course.island.members[0], course.dt, course.scratch);
}

}  // namespace

double firstImpactOf(WorldState& world, std::span<const std::uint32_t> members, const StepPart& part,
                     FlightScratch& scratch) {
    double first = 1;
    for (const std::uint32_t slot : members) {
        if (!isSweptMember(world, slot, part.length / part.dt)) { continue; }
        ++scratch.counters.sweeps;
        scratch.isSunk = false;
        const FirstImpact impact = impactOfPath(world, slot, part.length, first, scratch, true);
        if (scratch.isSunk) { world.bodies[slot].sunk = true; }
        if (impact.hit) { first = impact.fraction; }
    }
    if (mayMembersMeet(world, members)) { first = firstMeetingOf(world, members, part, first, scratch); }
    return first;
}

void holdSunk(WorldState& world, std::span<const std::uint32_t> members, const StepPart& part, FlightScratch& scratch) {
    for (const std::uint32_t slot : members) {
        if (isSunk(world, slot)) { hold(world, slot, part, scratch); }
    }
}

void noteCrossingsOf(const WorldState& world, std::span<const std::uint32_t> members, const StepPart& part,
                     FlightScratch& scratch) {
    if (!scratch.chains.meetsBacks) { return; }
    const auto crosses = [&](std::uint32_t slot) {
        return std::any_of(scratch.chains.crossings.begin(), scratch.chains.crossings.end(),
                           [&](const ChainPasser& passer) { return world.shapes[passer.shape].body == slot; });
    };
    for (const std::uint32_t slot : members) {
        if (isSweptMember(world, slot, part.length / part.dt) || crosses(slot)) {
            noteCrossingsOfPath(world, slot, part.length, scratch);
        }
    }
}

std::size_t mostTogether(const WorldSettings& settings) { return memberTries(settings) / kFewestTries; }

void advanceIsland(WorldState& world, IslandDesk& desk, double dt, FlightScratch& scratch, double met) {
    Course course{world, desk, desk.island, scratch, dt};
    begin(course);
    const bool wasTried = met < 1;
    if (wasTried && fliesInstead(course)) { return flyInstead(course); }
    course.next = std::max(met * dt, course.shortest);
    course.made = wasTried ? 1 : 0;
    course.fits = wasTried;
    const std::size_t tries = std::max(memberTries(world.settings) / course.island.members.size(), kFewestTries);
    const int mostTries = std::min(static_cast<int>(std::min(tries, kMaxTries)), world.settings.maxImpacts);
    const auto lastParts = static_cast<double>(std::clamp<std::size_t>(tries, 1, kLastParts));
    const double maxTurn = course.island.jointSlots.empty() ? kMaxLooseTurn : kMaxTurn;
    const double mostOfWhirl = longestOfWhirl(course, mostTries);
    while (course.elapsed < dt) {
        const double rest = dt - course.elapsed;
        const bool isOutOfTries = course.made++ == mostTries;
        if (isOutOfTries) { course.shortest = std::max(course.shortest, rest / lastParts); }
        const double spin = fastestSpin(world, course.island.members, course.island.jointSlots, Spinners::all);
        if (spin * course.shortest > kHopelessTurn) { course.shortest = rest; }
        double time = std::max(std::min(course.next, mostOfWhirl), course.shortest);
        if (spin * time > maxTurn) { time = std::max(longestTurning(course, rest, maxTurn / spin), course.shortest); }
        if (time > rest - 0.5 * course.shortest) { time = rest; }
        const double gained = tryPart(course, time);
        if (gained <= 0 && fliesInstead(course)) { return flyInstead(course); }
        course.fits = gained <= 0;
        course.elapsed = gained >= rest ? dt : course.elapsed + gained;
        if (gained > 0 && course.elapsed < dt) { notePoses(course, gained); }
    }
    finish(course);
    endCrossings(scratch);
}

}  // namespace swept::inline SWEPT_PRECISION
