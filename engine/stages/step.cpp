#include "step.h"

#include <chrono>

#include "../bodies/awake.h"
#include "../bodies/body_measures.h"
#include "../contacts/flush_landings.h"
#include "../contacts/pairs_of_shapes.h"
#include "../contacts/stirred.h"
#include "../crew/beside.h"
#include "../islands/effort.h"
#include "../islands/reset_bodies.h"
#include "../modes/modes.h"
#include "../solve/driven_joints.h"
#include "../solve/joint_rest.h"
#include "../solve/joint_start.h"
#include "../solve/remainder_loads.h"
#include "../solve/step_change.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Gives a stage the time since it was made, or since the last call; costs nothing when nobody asked.
class StageClock {
public:
    explicit StageClock(bool on) : on_(on) {
        if (on_) { last_ = Clock::now(); }
    }
    void stop(double& stage) {
        if (!on_) { return; }
        const Clock::time_point now = Clock::now();
        stage = std::chrono::duration<double>(now - last_).count();
        last_ = now;
    }

private:
    using Clock = std::chrono::steady_clock;
    bool on_;
    Clock::time_point last_;
};

/// @pre `WorldState::stepped`: some of these may have fallen asleep since
void clearForces(WorldState& world) {
    const auto clear = [&world](std::uint32_t slot) {
        world.bodies[slot].force = {};
        world.bodies[slot].torque = 0;
    };
    world.forcesGiven = false;
    for (const std::uint32_t slot : world.stepped) { clear(slot); }
    for (const std::uint32_t slot : world.pushedAsleep) { clear(slot); }
    world.pushedAsleep.clear();
}

/// Of more than one slot in so many it is faster to go through all of them in order.
constexpr std::size_t kFewShare = 64;

/// What was not awake in the last step has none, and what is held lost them.
void resetTraits(WorldState& world) {
    std::vector<BodyTraits>& traits = world.traits;
    if (kFewShare * world.stepped.size() > traits.size()) {
        traits.clear();
    } else {
        for (const std::uint32_t slot : world.stepped) { traits[slot] = 0; }
    }
    traits.resize(world.bodies.slotCount(), 0);
}

/// One worker notices contacts while the others forget what bodies did in the last step, but of what wakes then.
/// @param noticed  called when contacts are
void noticeAndReset(WorldState& world, Real dt, FunctionRef<void()> noticed) {
    resetTraits(world);
    world.awake.reserve(world.bodies.size());  // so that nothing moves when something wakes
    listTouching(world);
    const std::span<const std::uint32_t> before = world.awake;
    const auto notice = [&world, noticed] {
        noticeContacts(world);
        noticed();
    };
    constexpr std::size_t kResetGrain = 32;  // each range has the first of its bodies fetched late
    runBeside(*world.loops, notice, before.size(), kResetGrain,
              [&world, before, dt](std::size_t begin, std::size_t end) {
                  resetBodies(world, before.subspan(begin, end - begin), dt);
              });
    resetBodies(world, std::span(world.awake).subspan(before.size()), dt);
}

// --- the stages, each of which `StageTimes` has a time of. Of what each consists of, what may have nothing to do is
// not even called then: it costs the comparison in front of it.

/// What calls since the last step left to be done, and what another length of the step changes.
void prepareStep(WorldState& world, double dt) {
    ++world.steps;
    closeUpPairs(world);
    closeUpAwake(world);
    if (!world.unmeasured.empty()) { measureAnew(world); }
    const double before = world.lastDt;
    if (dt != before) { changeStep(world, dt); }
    if (dt != before || world.remainder.isOne) { noteStepLength(world, dt); }
    const bool varies = dt != before || world.closingTime > dt || world.recentSteps.longest < dt;
    if (varies) { world.closingTime = closingTimeAfter(world, before, dt); }
    if (world.closingStretch > 1) { world.closingStretch = closingStretchOf(world, dt); }
    world.watched = world.watchedBodies > 0 || isWatched(world.settings.continuous);
}

/// Boxes reach as far as this step may ask, then pairs of them are found.
void reachAndPair(WorldState& world, double dt) {
    if (world.watched) {
        limitSpeeds(world, dt);
        reachAhead(world);
    }
    if (world.kinematicBodies > 0) { reachWithKinematicBodies(world); }
    findStirred(world, dt);
    if (!world.drivenJoints.empty()) { beginDriven(world, dt); }
    findPairs(world);
}

/// What is solved together, and how.
void formIslands(WorldState& world, double dt) {
    assignRoles(world, static_cast<Real>(dt));
    findIslands(world);
    assignEfforts(world, dt);
    bearReactions(world, world.loosenedChains);
    if (!world.newJoints.empty()) { startJoints(world, dt); }
    world.fastIslands.any = world.fastIslands.anyDissolved = false;
    if (world.anyFast) { findFastIslands(world); }
}

void solve(WorldState& world, double dt) {
    if (world.remainder.isOne) { rememberLoads(world); }
    moveFreeBodies(world, dt);
    if (world.fastIslands.any) { beginFastIslands(world, dt); }
    const bool mayLand = !world.landings.meeting.empty();
    if (mayLand) { mergeLandings(world); }
    solveTiedBodies(world, dt);
    if (mayLand) { partLandings(world); }
    if (world.fastIslands.any) { advanceFastIslands(world, dt); }
    putBackOverflown(world);
    if (world.watched) { limitWays(world, dt); }
}

void sweep(WorldState& world, double dt) {
    const bool sweeps = world.anyFast || world.anyFlung;
    if (sweeps) { sweepFastBodies(world, dt); }
    const bool areMovedSound = world.kinematicBodies == 0 || moveKinematicBodies(world, dt);
    if (sweeps || !areMovedSound) { putBackOverflown(world); }
    if (!world.sensors.empty()) { sweepSensors(world, dt); }
}

void finishStep(WorldState& world, double dt) {
    if (world.anyRestLoads) { loosenMoving(world, dt); }
    if (!world.activeJoints.empty()) { breakJoints(world); }
    if (!world.drivenJoints.empty()) { endDriven(world); }
    if (world.remainder.isOne) { goOnWithLoads(world); }
    if (world.watched) { joinCaps(world, dt); }
    moveProxiesAndSortEvents(world);
    world.stepped = world.awake;
    if (world.settings.sleep) { putToSleep(world, dt); }
    if (world.forcesGiven) { clearForces(world); }
    if (!world.lostTime.empty()) { countLostTime(world); }
}

}  // namespace

void runStages(WorldState& world, double dt) {
    prepareStep(world, dt);
    StageClock clock(world.settings.measureStageTimes);
    reachAndPair(world, dt);
    clock.stop(world.stageTimes.pairs);
    collideContacts(world);
    noticeAndReset(world, static_cast<Real>(dt), [&] { clock.stop(world.stageTimes.collide); });
    formIslands(world, dt);
    clock.stop(world.stageTimes.islands);
    solve(world, dt);
    clock.stop(world.stageTimes.solve);
    sweep(world, dt);
    clock.stop(world.stageTimes.continuous);
    finishStep(world, dt);
    clock.stop(world.stageTimes.finish);
}

}  // namespace swept::inline SWEPT_PRECISION
