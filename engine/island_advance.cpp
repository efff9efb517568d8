#include "island_advance.h"

#include <algorithm>
#include <cmath>

#include "contact_manifold.h"
#include "ghosts.h"
#include "modes.h"
#include "profile.h"
#include "rod_turn.h"
#include "slides.h"
#include "sweep_obstacles.h"
#include "tied_group.h"
#include "tolerances.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// The shortest part of a step, as a share of it.
constexpr double kShortestPart = 1.0 / 128;
/// After so many tries, or once the budget of impacts is used up, what is left of the step is gone through in so many
/// parts. Each try moves all members: a large island has fewer of them, and fewer parts in the end.
constexpr std::size_t kMaxTries = 64;
constexpr std::size_t kMaxMemberTries = 1024;
constexpr std::size_t kMaxMemberTriesOfFast = 256;
/// With fewer tries than this every one of them is in vain.
constexpr std::size_t kFewestTries = 2;
constexpr std::size_t kLastParts = 8;
/// Radians that a member may turn in a part: sweeps go straight from pose to pose.
constexpr double kMaxTurn = 0.5;
/// Without joints the way of a turning body is straight; only what it looks like from its partner changes.
constexpr double kMaxLooseTurn = 2;
/// Radians in the shortest part beyond which no turn is followed: the rest of the step is one part.
constexpr double kHopelessTurn = 1024;
/// Radians in a sub-step that joints still follow well.
constexpr double kMaxTurnOfSubStep = 1.0 / 16;
/// Sub-steps of any part of an island with joints: what an impact gives to one body goes through one or two joints in
/// each. With one, ragdolls at 100 m/s came apart by 9 cm, with four by 5 to 8, with eight by 4, and waited a tenth of
/// the time.
constexpr int kFewestJointedSubSteps = 8;
/// A part that was already made to fit, and still ends at an impact, is cut there if that leaves at least so much of
/// it.
constexpr double kGoodFit = 0.5;
/// After an impact the next part may be so many times as long as the one before.
constexpr double kGrowth = 4;

struct Island {
    WorldState& world;
    SolveDesk& desk;
    FastIsland& fast;
    FlightScratch& scratch;
    double dt;
    double elapsed = 0;
    double shortest = 0;
    double usualSubStep = 0;   ///< of the world, s
    double subStep = 0;        ///< that the impulses of the held contacts belong to, s
    double subStepBefore = 0;  ///< the part that is being tried
    std::size_t eventsBefore = 0;
};

std::uint64_t pairKey(std::uint32_t a, std::uint32_t b) {
    return a < b ? (std::uint64_t{a} << 32) | b : (std::uint64_t{b} << 32) | a;
}

void listHeldPairs(FastIsland& fast) {
    fast.heldPairs.clear();
    for (const Contact& contact : fast.held) { fast.heldPairs.push_back(pairKey(contact.shapeA, contact.shapeB)); }
    std::sort(fast.heldPairs.begin(), fast.heldPairs.end());
}

double fastestSpin(const WorldState& world, std::span<const std::uint32_t> members) {
    double fastest = 0;
    for (const std::uint32_t slot : members) {
        fastest = std::max(fastest, std::fabs(static_cast<double>(world.motions[slot].angularVelocity)));
    }
    return fastest;
}

double fastestSpin(const Island& island) {
    double fastest = fastestSpin(island.world, island.fast.members);
    for (const std::uint32_t slot : island.fast.jointSlots) {
        fastest = std::max(fastest, rodTurnOf(island.world, island.world.joints[slot]));
    }
    return fastest;
}

/// Kinematic bodies stand where they are at that time.
void placeKinematics(Island& island, double time) {
    for (std::size_t i = 0; i < island.fast.kinematics.size(); ++i) {
        const std::uint32_t slot = island.fast.kinematics[i];
        const BodyMotion& start = island.fast.kinematicsAtStart[i];
        BodyMotion& motion = island.world.motions[slot];
        motion.center = start.center + time * toDouble(start.velocity);
        motion.angle = start.angle + time * static_cast<double>(start.angularVelocity);
        updatePose(island.world, slot);
    }
}

Real reachWithin(const WorldState& world, const Shape& shape, Real time) {
    if (world.bodies[shape.body].def.type == BodyType::fixed) { return 0; }
    const Real motion = motionBound(world, shape.body, time);
    return std::clamp(motion, kMinReachRatio * shape.extent, kMaxReachRatio * shape.extent);
}

/// Static and kinematic shapes within reach that no contact knows yet: the island left the boxes of the start of the
/// step.
void findGround(Island& island, const Shape& own, std::uint32_t slot, Real time) {
    WorldState& world = island.world;
    FastIsland& fast = island.fast;
    const Aabb box = boundsOf(own.polygon, world.motions[own.body].pose);
    fast.found.clear();
    world.broadphase->queryGround(grown(box, reachWithin(world, own, time)), [&](ProxyId id) {
        fast.found.push_back(world.proxyShapes[static_cast<std::uint32_t>(id)]);
        return true;
    });
    std::sort(fast.found.begin(), fast.found.end());
    for (const std::uint32_t found : fast.found) {
        const Shape& other = world.shapes[found];
        if (world.bodies[other.body].isDynamic() || other.def.sensor || !mayTouch(world, own, other)) { continue; }
        const std::uint64_t key = pairKey(slot, found);
        const auto place = std::lower_bound(fast.heldPairs.begin(), fast.heldPairs.end(), key);
        if (place != fast.heldPairs.end() && *place == key) { continue; }
        fast.heldPairs.insert(place, key);
        fast.held.push_back(contactOf(world, slot, found));
        fast.sources.push_back(kNoIndex);
    }
}

void collideHeld(Island& island, double time) {
    WorldState& world = island.world;
    const auto length = static_cast<Real>(time);
    for (const std::uint32_t member : island.fast.members) {
        for (const std::uint32_t slot : world.bodies[member].shapes) {
            const Shape& own = world.shapes[slot];
            if (!own.def.sensor) { findGround(island, own, slot, length); }
        }
    }
    island.fast.heldSlides.resize(island.fast.held.size());
    for (std::size_t i = 0; i < island.fast.held.size(); ++i) {
        Contact& contact = island.fast.held[i];
        const Transform bInA = relativePoseOf(world, contact);
        const Real reach = reachWithin(world, world.shapes[contact.shapeA], length) +
                           reachWithin(world, world.shapes[contact.shapeB], length);
        island.fast.heldSlides[i] = slideOf(contact, bInA);
        renewManifold(world, contact, bInA, {reach, reach});
    }
    std::vector<std::uint32_t>& all = island.fast.heldIndices;
    while (all.size() < island.fast.held.size()) { all.push_back(static_cast<std::uint32_t>(all.size())); }
    dropGhosts(world, island.fast.held, island.fast.heldSlides, std::span(all).first(island.fast.held.size()),
               island.fast.members, island.fast.nextGroundContact);
    island.desk.counters.manifolds += island.fast.held.size();
}

/// Normal impulse that a point of a held contact had at the start of the step, N·s in a sub-step of the usual length.
Real carriedAtStart(const Island& island, std::size_t index, FeatureId id) {
    const std::uint32_t source = island.fast.sources[index];
    if (source == kNoIndex) { return 0; }
    const Contact& start = island.world.contacts[source];
    for (std::size_t k = 0; k < static_cast<std::size_t>(start.manifold.count); ++k) {
        if (start.manifold.points[k].id == id) { return start.normalImpulse[k]; }
    }
    return 0;
}

/// Makes the impulses that contacts start from those of sub-steps of another length. What a contact carries grows with
/// that length, what an impact gives does not: longer sub-steps start from no more than there was in the last one, or
/// at the start of the step. (They did: an impact in an eighth of the usual sub-step came back eight times as strong,
/// and a pile of 21 gained a quarter of all energy in one step; test Energy.NeverGrowsUnderGravity.)
void setSubStep(Island& island, double seconds) {
    const auto factor = static_cast<Real>(seconds / island.subStep);
    const auto share = static_cast<Real>(seconds / island.usualSubStep);
    island.subStep = seconds;
    if (factor == 1) { return; }
    for (std::size_t i = 0; i < island.fast.held.size(); ++i) {
        Contact& contact = island.fast.held[i];
        for (std::size_t k = 0; k < static_cast<std::size_t>(contact.manifold.count); ++k) {
            const Real before = contact.normalImpulse[k];
            if (!(before > 0)) { continue; }
            Real now = before * factor;
            if (factor > 1) {
                const Real carried = carriedAtStart(island, i, contact.manifold.points[k].id);
                now = std::min(now, std::max(before, share * carried));
            }
            contact.normalImpulse[k] = now;
            contact.tangentImpulse[k] *= now / before;
        }
    }
}

/// Reactions of the joints are means over the step so far, impulses of contacts sums.
void addUpReactions(Island& island, double time) {
    const auto share = static_cast<Real>(time / island.dt);
    for (std::size_t i = 0; i < island.fast.held.size(); ++i) {
        for (std::size_t k = 0; k < 2; ++k) { island.fast.held[i].totalImpulse[k] += island.fast.totals[i][k]; }
    }
    for (std::size_t i = 0; i < island.fast.jointSlots.size(); ++i) {
        Joint& joint = island.world.joints[island.fast.jointSlots[i]];
        const Joint& before = island.fast.jointsBefore[i];
        joint.reactionForce = before.reactionForce + share * joint.reactionForce;
        joint.reactionTorque = before.reactionTorque + share * joint.reactionTorque;
    }
}

int subStepsFor(const Island& island, double time) {
    const Effort effort = island.world.bodies[island.fast.members[0]].effort;
    const int usual = subStepsOf(island.world.settings);
    const int asked = effort.isCrowd ? swept::subStepsFor(effort, usual) : usual;
    const bool isJointed = !island.fast.jointSlots.empty();
    const bool isBudgeted = hasErrorBudget(island.world.settings);
    // Light links that heavy bodies swing past whip round within a part, unforeseen by the spin at its start: what the
    // effort says of the whole step (doublingsForWhips) goes for its parts. With a budget it may be fewer sub-steps
    // than asked for: joints that then open too far are advanced again (effort_trial.h).
    const int chosen = swept::subStepsFor(effort, usual);
    const int atLeast = isJointed && isBudgeted ? 1 : asked;
    const int standard = isJointed || isBudgeted ? std::max(atLeast, chosen) : asked;
    const double share = std::ceil(standard * time / island.dt * (1 - kShortestPart));
    if (!isJointed) { return std::clamp(static_cast<int>(share), 1, standard); }
    const double turns = std::ceil(fastestSpin(island) * time / kMaxTurnOfSubStep);
    const int fewest = std::min(kFewestJointedSubSteps, standard);
    return std::clamp(static_cast<int>(std::min<double>(standard, std::max(turns, share))), fewest, standard);
}

void solvePart(Island& island, double time) {
    FastIsland& fast = island.fast;
    const StepPart part{
        .begin = island.elapsed, .length = time, .dt = island.dt, .subSteps = subStepsFor(island, time)};
    setSubStep(island, time / part.subSteps);
    fast.totals.clear();
    for (Contact& contact : fast.held) {
        fast.totals.push_back(contact.totalImpulse);
        contact.totalImpulse = {};
    }
    solveGroup(island.world,
               {.desk = island.desk,
                .role = BodyRole::together,
                .effort = island.world.bodies[fast.members[0]].effort,
                .bodies = fast.group,
                .contacts = fast.held,
                .joints = fast.jointSlots},
               part);
    addUpReactions(island, time);
}

/// @param isTried  whether the part may be taken back
void remember(Island& island, bool isTried) {
    FastIsland& fast = island.fast;
    fast.membersBefore.clear();
    for (const std::uint32_t slot : fast.members) {
        const BodyMotion& motion = island.world.motions[slot];
        fast.membersBefore.push_back(motion);
        island.world.bodies[slot].startCenter = motion.center;
        island.world.bodies[slot].startAngle = motion.angle;
    }
    if (isTried) { fast.heldBefore = fast.held; }
    island.subStepBefore = island.subStep;
    fast.jointsBefore.clear();
    for (const std::uint32_t slot : fast.jointSlots) { fast.jointsBefore.push_back(island.world.joints[slot]); }
    island.eventsBefore = island.desk.events.size();
}

void takeBack(Island& island) {
    FastIsland& fast = island.fast;
    for (std::size_t i = 0; i < fast.members.size(); ++i) {
        island.world.motions[fast.members[i]] = fast.membersBefore[i];
    }
    for (std::size_t i = 0; i < fast.jointSlots.size(); ++i) {
        island.world.joints[fast.jointSlots[i]] = fast.jointsBefore[i];
    }
    fast.held = fast.heldBefore;
    island.subStep = island.subStepBefore;
    fast.sources.resize(fast.held.size());
    auto& events = island.desk.events;
    events.erase(events.begin() + static_cast<std::ptrdiff_t>(island.eventsBefore), events.end());
}

/// @param share  of the step that the part takes
bool isSweptMember(const WorldState& world, std::uint32_t slot, double share) {
    const Body& body = world.bodies[slot];
    return isSwept(modeOf(world, body)) && (body.startled || movedFast(world, slot, share));
}

/// All members stand where they were at a fraction of the part, and did not fall in the rest of it.
void cutPart(Island& island, double time, double fraction) {
    FastIsland& fast = island.fast;
    for (std::size_t i = 0; i < fast.members.size(); ++i) {
        const BodyMotion& before = fast.membersBefore[i];
        BodyMotion& motion = island.world.motions[fast.members[i]];
        motion.center = before.center + fraction * (motion.center - before.center);
        motion.angle = before.angle + fraction * (motion.angle - before.angle);
        updatePose(island.world, fast.members[i]);
        takeBackFall(island.world, fast.members[i], (1 - fraction) * time);
    }
}

/// Where a part ends within the step the way may bend: what watches it needs to know (sensors).
void notePoses(Island& island, double time) {
    for (const std::uint32_t slot : island.fast.members) {
        const BodyMotion& motion = island.world.motions[slot];
        if (!isSweptMember(island.world, slot, time / island.dt)) { continue; }
        island.scratch.impactPoses.push_back({.body = island.world.bodies.idOf(slot),
                                              .position = motion.pose.position,
                                              .angle = motion.angle,
                                              .fraction = island.elapsed / island.dt});
    }
}

void holdMembers(Island& island, double time) {
    const StepPart part{.begin = island.elapsed, .length = time, .dt = island.dt};
    for (const std::uint32_t slot : island.fast.members) {
        if (!isSweptMember(island.world, slot, time / island.dt)) { continue; }
        ++island.scratch.sweeps;
        const bool stops = modeOf(island.world, island.world.bodies[slot]) == ContinuousMode::stop;
        clampAtImpact(island.world, slot, part, stops ? LostTimeReason::stop : LostTimeReason::clamp, island.scratch);
    }
}

void begin(Island& island) {
    FastIsland& fast = island.fast;
    island.shortest = kShortestPart * island.dt;
    island.usualSubStep = island.subStep = island.dt / subStepsOf(island.world.settings);
    fast.kinematicsAtStart.clear();
    for (const std::uint32_t slot : fast.kinematics) { fast.kinematicsAtStart.push_back(island.world.motions[slot]); }
    fast.membersAtStart.clear();
    for (const std::uint32_t slot : fast.members) { fast.membersAtStart.push_back(island.world.motions[slot]); }
    for (const std::uint32_t slot : fast.jointSlots) {
        island.world.joints[slot].reactionForce = {};
        island.world.joints[slot].reactionTorque = 0;
    }
    fast.group = fast.members;
    fast.group.insert(fast.group.end(), fast.kinematics.begin(), fast.kinematics.end());
}

/// What the next step and its report need: poses at the start of the step, kinematic bodies there, contacts.
void finish(Island& island) {
    FastIsland& fast = island.fast;
    for (std::size_t i = 0; i < fast.kinematics.size(); ++i) {
        island.world.motions[fast.kinematics[i]] = fast.kinematicsAtStart[i];
    }
    for (std::size_t i = 0; i < fast.members.size(); ++i) {
        Body& body = island.world.bodies[fast.members[i]];
        body.startCenter = fast.membersAtStart[i].center;
        body.startAngle = fast.membersAtStart[i].angle;
    }
    setSubStep(island, island.usualSubStep);
    for (std::size_t i = 0; i < fast.held.size(); ++i) {
        if (fast.sources[i] == kNoIndex) { continue; }
        island.world.contacts[fast.sources[i]] = fast.held[i];
        ContactProbe& probe = island.world.probes[fast.sourceProbes[i]];
        probe.apartUntil = 0;  // what it has now is that of another pose
        probe.isIdle = false;
    }
}

/// Visits of members that all tries of an island may make.
std::size_t memberTries(const WorldSettings& settings) {
    return settings.profile == Profile::fast ? kMaxMemberTriesOfFast : kMaxMemberTries;
}

/// Tries one part. @return seconds that the island got on, or 0: taken back, to be tried with `next`
double tryPart(Island& island, double time, bool fits, double& next) {
    const bool isLast = time < 2 * island.shortest;  // try: it stays as it is
    remember(island, !isLast);
    placeKinematics(island, island.elapsed);
    // The whole step begins with the contacts that it has found already.
    if (island.elapsed > 0 || time < island.dt) {
        listHeldPairs(island.fast);
        collideHeld(island, time);
    }
    solvePart(island, time);
    next = std::max(kGrowth * time, kGrowth * island.shortest);
    if (isLast) {
        holdMembers(island, time);
        return time;
    }
    const double fraction =
        firstImpactOf(island.world, island.fast.members, {.length = time, .dt = island.dt}, island.scratch);
    if (!(fraction < 1)) { return time; }
    ++island.scratch.impacts;
    if (fits && fraction >= kGoodFit && fraction * time >= island.shortest) {
        cutPart(island, time, fraction);
        return fraction * time;
    }
    takeBack(island);
    next = std::max(fraction * time, island.shortest);
    return 0;
}

/// A body on its own that slides fast, and strikes something on its way, flies this step: the solver shares such a blow
/// among floor and wall less well, and may throw it up.
bool fliesInstead(const Island& island) {
    const FastIsland& fast = island.fast;
    if (island.elapsed > 0 || fast.members.size() != 1 || !fast.jointSlots.empty()) { return false; }
    const Body& body = island.world.bodies[fast.members[0]];
    return !body.deepContact && !body.touchesDynamic && body.holdingJoints == 0;
}

}  // namespace

bool isOnePart(const WorldState& world, std::span<const std::uint32_t> members, double dt) {
    return fastestSpin(world, members) * dt <= kMaxLooseTurn;
}

double firstImpactOf(WorldState& world, std::span<const std::uint32_t> members, const StepPart& part,
                     FlightScratch& scratch) {
    double first = 1;
    for (const std::uint32_t slot : members) {
        if (!isSweptMember(world, slot, part.length / part.dt)) { continue; }
        ++scratch.sweeps;
        const FirstImpact impact = impactOfPath(world, slot, part.length, first, scratch);
        if (impact.hit) { first = impact.fraction; }
    }
    return first;
}

std::size_t mostTogether(const WorldSettings& settings) { return memberTries(settings) / kFewestTries; }

void advanceIsland(WorldState& world, SolveDesk& desk, double dt, FlightScratch& scratch, double met) {
    Island island{world, desk, desk.island, scratch, dt};
    begin(island);
    const bool wasTried = met < 1;
    if (wasTried && fliesInstead(island)) {
        finish(island);
        fly(world, island.fast.members[0], dt, scratch);
        return;
    }
    double next = std::max(met * dt, island.shortest);
    const std::size_t tries = std::max(memberTries(world.settings) / island.fast.members.size(), kFewestTries);
    const int mostTries = std::min(static_cast<int>(std::min(tries, kMaxTries)), world.settings.maxImpacts);
    const auto lastParts = static_cast<double>(std::clamp<std::size_t>(tries, 1, kLastParts));
    const double maxTurn = island.fast.jointSlots.empty() ? kMaxLooseTurn : kMaxTurn;
    int made = wasTried ? 1 : 0;
    bool fits = wasTried;
    while (island.elapsed < dt) {
        const double rest = dt - island.elapsed;
        if (made++ == mostTries) { island.shortest = std::max(island.shortest, rest / lastParts); }
        const double spin = fastestSpin(island);
        if (spin * island.shortest > kHopelessTurn) { island.shortest = rest; }
        double time = std::max(next, island.shortest);
        if (spin * time > maxTurn) { time = std::max(maxTurn / spin, island.shortest); }
        if (time > rest - 0.5 * island.shortest) { time = rest; }
        const double gained = tryPart(island, time, fits, next);
        if (gained <= 0 && fliesInstead(island)) {
            finish(island);
            fly(world, island.fast.members[0], dt, scratch);
            return;
        }
        fits = gained <= 0;
        island.elapsed = gained >= rest ? dt : island.elapsed + gained;
        if (gained > 0 && island.elapsed < dt) { notePoses(island, gained); }
    }
    finish(island);
}

}  // namespace swept::inline SWEPT_PRECISION
