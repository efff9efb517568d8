#include "effort.h"

#include <algorithm>
#include <cmath>

#include "../solve/search_debt.h"
#include "../state/profile.h"
#include "balance.h"
#include "blows.h"
#include "hard_pull.h"
#include "held_islands.h"
#include "island_load.h"
#include "settled.h"
#include "thin_loops.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Sub-steps are no longer than this part of the time √(extent/|gravity|) in which things fall their own size.
constexpr double kSubStepRatio = 0.1;
/// Stacks that iteration carries badly: centres so many times as far apart as their thinnest body is thick, or masses
/// so far apart. Three boxes of one size are 2 apart, but for what they sink in by: at 2 they were solved all at once
/// in the first step, sank in under the springs of the next ones, and were never high again.
constexpr double kHighStack = 1.5;
constexpr Real kHeavyRatio = 8;
/// The same of ragdolls: they carry no more than themselves. (Fifty whose forearms weigh a tenth of the trunk took nine
/// times as long, for joints that hold within a micrometre instead of 0.4 mm.)
constexpr Real kHeavyLimbRatio = 32;
/// What is heavy on few light ones, such as a table on its legs, need not be at rest for that. (A block of 1000 kg that
/// was dropped from 1 cm on two boxes of 1 kg sank in by 2.2 cm, one of 10 000 kg through them; now 13 nm.) Larger
/// heaps that move find no more in it than iteration does, and take up to twice the time.
constexpr std::uint32_t kFewInWeb = 16;
/// Towers of equal masses are iterated for so many steps after a search in vain: for long they might not stand it.
constexpr std::uint16_t kPauseOfTower = 16;
/// Joints in an island that iteration brings together badly.
constexpr std::uint32_t kLongChain = 16;
/// The same of beams that hang on the ground. (Eight bars of 10 kg bent by 8 cm under 50 kg.)
constexpr std::uint32_t kLongBeam = 4;
/// What rests and is solved all at once makes do with an eighth of the sub-steps: its error does not depend on them. At
/// rest is what is no faster than this part of what gravity gives it in a step; blows are shared out by iteration,
/// unless masses are far apart.
constexpr std::int8_t kTowerDoublings = -3;
constexpr double kRestRatioOfFall = 1.0 / 8;
/// A large web that was solved so is given up later: its first impulses are found in a few steps. (1275 boxes side by
/// side have 2.5 cm/s after the first.)
constexpr double kStirRatioOfFall = 1.0 / 2;
/// Fewer sub-steps than this do not follow what whips about at the end of a chain: joints are then left to iteration.
constexpr int kFewestSubStepsForJoints = 8;
/// What jostles: so many bodies at least (`kFewestInCrowd`), this part of which is on the move, as fast as in a fall of
/// 1/32 of its extent; or with all joints powered, a ragdoll's, also where it lies or nothing holds it. Half of the
/// sub-steps do there, with one pass of relaxation, as long as springs of those carry what may lie on the thinnest body
/// with an error below this part of it. (With all that is faster than an eighth of what gravity gives in a step on the
/// move, a pyramid that had been disturbed breathed by 5 cm for ever; a stack of twenty boxes that is dropped sinks in
/// farther.)
constexpr std::uint32_t kFewestInRagdoll = 8;
constexpr std::uint32_t kMovingShare = 8;
constexpr double kCrowdErrorRatio = 1.0 / 32;
constexpr Effort kCrowd{.doublings = -1, .stir = Stir::crowd};
/// A heap is stirred where so many are on the move as in the smallest crowd, in what sinks in by so little when its
/// springs become those of half of the sub-steps that nothing gets on the move by that: no heap keeps itself stirred.
constexpr std::uint32_t kFewestStirring = kFewestInCrowd / kMovingShare;
/// Moving masses on joints farther apart than this need shorter sub-steps. A light link that the heavy body swings past
/// whips round with a speed that goes by the root of the ratio, and joints are closed to the second order in the turn
/// of a sub-step: beyond half a radian that tears them. `swept envelope`, map "chain": 16 sub-steps hold 560 : 1, not
/// 1000 : 1; with 32 that, too, tore when it swung for ten seconds. What hangs at the end, as an antenna on a car, or
/// lies loose on it is no such link: nothing swings past it.
constexpr Real kWhipRatio = 128;

/// From `fewest` on, until the sub-steps are short enough for the thinnest body.
std::int8_t doublingsFor(const IslandLoad& load, std::int8_t fewest, double gravity, double dt, int subSteps) {
    std::int8_t doublings = fewest;
    if (!(gravity > 0) || !(load.thinnest > 0)) { return doublings; }
    // Squares are compared: 0.1² · extent/|g| against h².
    const double longest = kSubStepRatio * kSubStepRatio * static_cast<double>(load.thinnest) / gravity;
    const auto isLong = [&] {
        const double h = dt / subStepsFor({.doublings = doublings}, subSteps);
        return h * h > longest;
    };
    while (isLong() && subStepsFor({.doublings = static_cast<std::int8_t>(doublings + 1)}, subSteps) <= kMostSubSteps) {
        ++doublings;
    }
    return doublings;
}

/// Whether the contacts tie the bodies, and the ground, together without closing a loop: a tower, not a wall.
bool isTree(const IslandLoad& load) { return load.contacts + load.joints <= load.bodies; }

/// Contact graphs of convex bodies in the plane are planar, and have fewer edges than three times the nodes.
bool isPlanar(const IslandLoad& load) { return load.contacts <= 3 * load.bodies; }

/// Whether contacts that close loops are few enough to be solved all at once. (Heaps of 600 boxes that came to rest on
/// springs asked for a hundred rounds in each step, and slipped whenever they changed from one to the other.)
bool isWeb(const IslandLoad& load) {
    const bool mayBegin = load.bodies <= kSmallWebBodies && load.debt == 0;
    return load.bodies <= kMostWebBodies && isPlanar(load) && (mayBegin || load.staysPut) && load.debt < kMostDebt;
}

/// How far the top of a heap sinks in under its weight, metres: each of its layers gives way by h²·|g| for each that it
/// carries, and for the heaviest body as well.
double sagOf(double layers, double heaviest, double give) { return layers * ((layers + 1) / 2 + heaviest) * give; }

/// Whether all joints are those of ragdolls: hinges with limits, in chains that nothing holds, longer than those of
/// cars and shorter than ropes.
bool isOfDolls(const IslandLoad& load) {
    const bool isInSize = load.longestChain + 1 >= kFewestInRagdoll && load.longestChain < kLongChain;
    return load.limitedHinges == load.joints && isInSize && !load.isAnchored;
}

/// Whether islands that are iterated are many bodies on the move, none of which carries much: as many layers as the
/// island is high, and the heaviest that lies loose. The springs give way by about h²·|g| under the weight of the body
/// that they hold. Ragdolls that lie about, or that nothing holds up, are a crowd, too, on the move or about to be (in
/// `rain` those just made were solved all at once twice, for a tenth of all time); what hangs on its drives and rests
/// is not.
bool isCrowd(const IslandLoad& load, bool rests, double gravity, double dt, int subSteps) {
    // Joints that carry one another have to have a drive, or be a net or a doll: chains tighten.
    const bool isRagdoll = load.joints > 0 && (load.powered == load.joints || isOfDolls(load));
    const bool isLoose = isRagdoll && (load.contacts > 0 || !load.isAnchored);
    const bool isNet = load.hasLoop && load.contacts == 0;
    const bool isPile = load.joints * kMovingShare <= load.bodies && !isTree(load);
    const std::uint32_t fewest = isRagdoll ? kFewestInRagdoll : kFewestInCrowd;
    const auto thinnest = static_cast<double>(load.thinnest);
    if (load.bodies < fewest || !(isRagdoll || isNet || isPile) || !(thinnest > 0)) { return false; }
    const double h = dt / subStepsFor(kCrowd, subSteps);
    const double give = gravity * h * h;
    const double most = kCrowdErrorRatio * thinnest;
    const double layers = (load.highest - load.lowest) / thinnest;
    const auto heaviest = static_cast<double>(load.heaviestLoose / load.lightest);
    const bool isStirred = load.moving >= kFewestStirring && sagOf(layers, heaviest, give) <= most;
    const bool moves = isStirred || kMovingShare * load.moving >= load.bodies;
    const bool jostles = isLoose || (!rests && moves);
    return jostles && (layers + heaviest) * give <= most;
}

/// Joints that nothing touches are always solved all at once. Where there are contacts, too, that is worth it only
/// where iteration over joints is hopeless. Contacts are then iterated on what answers as the joints hold it, or, where
/// there is too much of either for that, the two take turns. (They did so everywhere: a blow on a body of one kilogram
/// that a weld holds to thirty reaches these only a thirtieth at a time, and what closed the gap meanwhile pushed from
/// the ground. Of 400 such pairs that fell four flew off, of pairs that two joints hold up to 32.)
DirectScope scopeForJoints(const IslandLoad& load, bool isTouching, int subSteps) {
    const bool isCoarse = subSteps < kFewestSubStepsForJoints;
    const bool maySolveIt = !load.hasLoop || load.bodies <= kMostLoopBodies || !load.hasWideLoop;
    if (!isTouching && load.plainJoints == load.joints && maySolveIt) { return DirectScope::islands; }
    // A loop may be taut: what closes its gaps is then near infinite (a straight bridge between two posts).
    if (load.hasLoop || isCoarse) { return DirectScope::none; }
    // A heavy drum that light things tumble in hangs on its joint no worse than without them. And what lies loose, or
    // flies, gets on with light bodies whose turn is held only when both are iterated: a ball that hit a welded sign of
    // 1/60 of its mass moved it within a pass of contacts, and was thrown back when the joint closed its gap.
    const Real heaviest = load.holdsAngles ? load.heaviestJointed : heaviestOf(load);
    // A beam that welds hold to the ground bends under what lies on it by what each weld gives way, times its length.
    const bool isBeam = load.longestBeam >= kLongBeam;
    // What hangs at an end, and touches nothing, passes nothing on: however light, it is in nobody's way. And a doll
    // carries no more than itself, unless something lies on it.
    const Real leastCarrier = isOfDolls(load)
                                  ? std::max(load.heaviestJointed / kHeavyLimbRatio, load.heaviestLoose / kHeavyRatio)
                                  : heaviest / kHeavyRatio;
    const bool isHopeless = isBeam || load.longestChain >= kLongChain || leastCarrier >= load.lightestCarrier;
    // Two that hold the same bodies work against each other, the more so the nearer they come to a toggle.
    const bool isDoubled = load.joints >= load.bodies && load.plainJoints == load.joints;
    // What joints tie to the ground contacts with the ground may contradict, and then both win by turns.
    const bool mayAgree = isTouching && !load.isAnchored && !load.isContradicted;
    if (mayAgree && mayBeJointed(load.contacts, load.bodies) && (isHopeless || isDoubled)) {
        return DirectScope::jointed;
    }
    if (isHopeless && load.softJoints < load.joints) { return DirectScope::joints; }
    if (isTouching) { return DirectScope::none; }
    return load.softJoints == load.joints ? DirectScope::softJoints : DirectScope::freeJoints;
}

/// Whether drives go on with joints that nothing touches as an equation, instead of that scope.
bool mayBeFollowed(const IslandLoad& load, DirectScope scope) {
    const bool isDirect = scope == DirectScope::freeJoints || scope == DirectScope::joints;
    return isDirect && load.contacts == 0 && !load.hasLoop && load.plainJoints + load.jointsWithDrives == load.joints;
}

/// Half as long for four times the ratio; never for what is at rest.
std::int8_t doublingsForWhips(const IslandLoad& load, int subSteps) {
    std::int8_t doublings = 0;
    Real leastHeld = heaviestOf(load) / kWhipRatio;
    while (leastHeld > load.lightestLink &&
           subStepsFor({.doublings = static_cast<std::int8_t>(doublings + 1)}, subSteps) <= kMostSubSteps) {
        ++doublings;
        leastHeld /= 4;
    }
    return doublings;
}

/// What resists rolling is a third row of a contact, which a solve of all contacts does not know.
DirectScope scopeForContacts(const IslandLoad& load, bool rests) {
    if (load.resistsRolling) { return DirectScope::none; }
    const bool isHigh = load.highest - load.lowest >= kHighStack * static_cast<double>(load.thinnest);
    const bool isHeavy = heaviestOf(load) >= kHeavyRatio * load.lightest;
    const bool isStack = load.bodies > 1 && load.thinnest > 0;
    const bool needsIt = (isHigh && rests) || isHeavy;
    const bool isTower = isTree(load) && (isHeavy || load.debt <= kMostDebt - kPauseOfTower);
    const bool isFew = isHeavy && load.bodies <= kFewInWeb;
    const bool mayHaveIt = isTower || ((rests || isFew) && isWeb(load));
    return isStack && needsIt && mayHaveIt ? DirectScope::all : DirectScope::none;
}

/// What all islands share.
struct StepScale {
    double gravity = 0;     ///< m/s²
    double dt = 0;          ///< s
    int subSteps = 1;       ///< that the settings ask for
    bool mayJostle = true;  ///< the number of sub-steps is the profile's own
};

/// @param pull  m/s², that contacts carry
Effort effortFor(const IslandLoad& load, const StepScale& step, double pull) {
    const bool isKnown = load.staysPut && load.bodies > kSmallWebBodies;
    const double restSpeed = (isKnown ? kStirRatioOfFall : kRestRatioOfFall) * step.gravity * step.dt;
    const bool rests = static_cast<double>(load.fastest) <= restSpeed * restSpeed;
    const bool isTouching = load.contacts > 0;
    const bool jostles = step.mayJostle && isCrowd(load, rests, step.gravity, step.dt, step.subSteps);
    if (load.joints > 0) {
        const DirectScope scope = scopeForJoints(load, isTouching, step.subSteps);
        // To solve joints all at once keeps energy, but not where drives take it.
        const bool mayBeCrowd =
            scope == DirectScope::none || scope == DirectScope::softJoints || scope == DirectScope::freeJoints;
        if (jostles && mayBeCrowd) { return kCrowd; }
        // Islands see to that themselves.
        const bool isFollowed = mayBeFollowed(load, scope);
        const bool mayWhip = scope != DirectScope::none && scope != DirectScope::islands && !rests;
        return {.doublings = mayWhip ? doublingsForWhips(load, step.subSteps) : std::int8_t{0},
                .direct = isFollowed ? DirectScope::islandsWithDrives : scope,
                .left = isFollowed ? scope : Effort{}.left,
                .isInTurns = scope == DirectScope::joints && isTouching};
    }
    const DirectScope scope = scopeForContacts(load, rests);
    if (jostles && scope == DirectScope::none) { return kCrowd; }
    const std::int8_t fewest = scope == DirectScope::all && rests ? kTowerDoublings : std::int8_t{0};
    return {.doublings = doublingsFor(load, fewest, pull, step.dt, step.subSteps),
            .direct = scope,
            .isLarge = scope == DirectScope::all && !isTree(load) && load.bodies > kSmallWebBodies};
}

/// Bodies per block of a parallel loop.
constexpr std::size_t kEffortGrain = 128;

/// At a body on its own; m/s².
double pullOf(const WorldState& world, const Body& body, const StepScale& step) {
    if (!isPulledHard(world, body, static_cast<Real>(step.dt))) { return step.gravity; }
    return std::max(step.gravity, static_cast<double>(length(accelerationOf(world, body))));
}

void assignByLoad(WorldState& world, double dt) {
    const bool fast = world.settings.profile == Profile::fast;
    findIslandLoads(world);
    const StepScale step{.gravity = static_cast<double>(length(world.settings.gravity)),
                         .dt = dt,
                         .subSteps = subStepsOf(world.settings),
                         .mayJostle = !hasErrorBudget(world.settings) && !world.settings.subSteps};
    const auto pullAt = [&world, &step](std::uint32_t slot, const IslandLoad& load) {
        const bool mayBeHard = load.bodies == 1 && (world.traits[slot] & kIsFast) != 0;
        return mayBeHard ? pullOf(world, world.bodies[slot], step) : step.gravity;
    };
    bool areAnyStruck = false;
    for (const std::uint32_t slot : world.tied) {
        IslandLoad& load = world.islandLoads[slot];
        if (load.bodies == 0) { continue; }
        load.effort = fast ? Effort{} : effortFor(load, step, pullAt(slot, load));
        if (!fast) { expectBlows(load, step.gravity); }
        areAnyStruck = areAnyStruck || load.mayBeStruck;
    }
    if (areAnyStruck) { markStruckIslands(world, dt); }
}

/// Chains that nothing touched, whose joints were solved all at once in the last step, and that are iterated in this
/// one.
void listLoosened(WorldState& world) {
    for (const JointChain& chain : world.jointChains.list) {
        const Body& body = world.bodies[chain.lowest];
        const DirectScope scope = body.effort.direct;
        const bool wasExact = scope == DirectScope::islands || scope == DirectScope::islandsWithDrives ||
                              scope == DirectScope::freeJoints;
        if (body.role != BodyRole::solved || !wasExact) { continue; }
        const Effort& effort = world.islandLoads[world.islands.find(chain.lowest)].effort;
        if (effort.direct == DirectScope::none) { world.loosenedChains.push_back(chain.lowest); }
    }
}

}  // namespace

void assignEfforts(WorldState& world, double dt) {
    world.loosenedChains.clear();
    if (world.tied.empty()) { return; }
    const bool budgeted = hasErrorBudget(world.settings);
    const bool isByLoad = world.settings.profile == Profile::accurate || budgeted;
    if (isByLoad) { assignByLoad(world, dt); }
    if (budgeted) { keepErrorBudgets(world, dt); }
    if (findBalancedIslands(world, dt)) {
        if (isByLoad) { markSettledIslands(world); }
        holdBalancedIslands(world);
    }
    if (isByLoad && !budgeted && !world.activeJoints.empty()) { slowHangingIslands(world, dt); }
    if (isByLoad) { listLoosened(world); }
    world.tiedEfforts.resize(world.tied.size());
    static constexpr Effort kUsual;
    world.loops->run(world.tied.size(), kEffortGrain, [&world, isByLoad](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i) {
            const std::uint32_t slot = world.tied[i];
            const Effort& effort = isByLoad ? world.islandLoads[world.tiedRoots[i]].effort : kUsual;
            world.tiedEfforts[i] = effort;
            world.bodies[slot].effort = effort;
        }
    });
}

}  // namespace swept::inline SWEPT_PRECISION
