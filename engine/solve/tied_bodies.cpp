#include "tied_bodies.h"

#include <array>
#include <atomic>
#include <cmath>

#include "../../shapes/branchless.h"
#include "../../shapes/cache_line.h"
#include "../../shapes/compiler.h"
#include "../../solver/halves.h"
#include "../../solver/wide/wide_motion.h"
#include "../crew/beside.h"
#include "../state/tolerances.h"
#include "adrift_chains.h"
#include "curved_ground.h"
#include "energy_guard.h"
#include "leaps.h"
#include "squeezed_bodies.h"
#include "strained_bodies.h"
#include "turning_ground.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Bodies per block of a parallel loop.
constexpr std::size_t kListGrain = 128;
constexpr std::size_t kSetGrain = 32;  ///< one of them does something else
constexpr std::size_t kReadGrain = 128;

/// Bodies that are fetched ahead, where a solve gives them back.
constexpr std::size_t kTakenBackAhead = 12;

void setDrive(BodyDrive& drive, const WorldState& world, const Body& body, Real h) {
    if (!body.isDynamic()) {
        drive = {};
        return;
    }
    const auto step = static_cast<double>(h);
    const DampedMotion linear = dampedMotion(static_cast<double>(body.def.linearDamping) * step);
    const DampedMotion angular = dampedMotion(static_cast<double>(body.def.angularDamping) * step);
    drive.gain = static_cast<Real>(linear.phi1 * step) * accelerationOf(world, body);
    drive.angularGain = static_cast<Real>(angular.phi1 * step) * angularAccelerationOf(body);
    drive.decay = static_cast<Real>(linear.decay);
    drive.angularDecay = static_cast<Real>(angular.decay);
}

/// `SolveDesk::takesPart`
constexpr std::uint8_t kIsMoved = 1;
constexpr std::uint8_t kStands = 2;

/// Gives those of the group that are solved, and the kinematic bodies that they may meet, their slots, in order. Each
/// is looked at by any worker, which is what it costs: bodies are large.
void listTaking(WorldState& world, const TiedGroup& group) {
    SolveDesk& desk = group.desk;
    desk.takesPart.resize(group.bodies.size());
    desk.loops->run(group.bodies.size(), kListGrain, [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i) {
            const Body& body = world.bodies[group.bodies[i]];
            if (body.def.type == BodyType::kinematic) {
                desk.takesPart[i] = kStands;
            } else {
                desk.takesPart[i] = isMember(body, group) ? kIsMoved : 0;
            }
        }
    });
    desk.bodies.resize(group.bodies.size());
    desk.standing.clear();
    std::size_t count = 0;
    for (std::size_t i = 0; i < group.bodies.size(); ++i) {
        const std::uint32_t slot = group.bodies[i];
        const bool takes = desk.takesPart[i] != 0;
        desk.bodies[count] = slot;
        world.solverSlots[slot] = static_cast<BodySlot>(count + 1) & maskOf<BodySlot>(takes);  // the fixed one if not
        count += takes ? 1 : 0;
        if (desk.takesPart[i] == kStands) { desk.standing.push_back(static_cast<BodySlot>(count)); }
    }
    desk.bodies.resize(count);
}

/// Made in place: what is written down in pieces and copied as a whole has to wait for the pieces, which took half of
/// the time here.
void setBody(WorldState& world, SolveDesk& desk, BodySlot place, std::uint32_t slot, Real h) {
    const Body& body = world.bodies[slot];
    const BodyMotion& motion = world.motions[slot];
    desk.localCenters[place] = body.localCenter;
    BodyState& state = desk.batch.states[place];
    state.velocity = motion.velocity;
    state.angularVelocity = motion.angularVelocity;
    state.deltaAngle = 0;
    state.deltaPosition = {};
    state.deltaRotation = {};
    BodyInertia& inertia = desk.batch.inertias[place];
    inertia.inverseMass = body.inverseMass;
    inertia.inverseInertia = body.inverseInertia;
    setDrive(desk.batch.drives[place], world, body, h);
}

/// How the solver moved a body.
struct Moves {
    bool isFlung = false;  ///< at least as far as a fast body, measured generously
    bool isLeap = false;   ///< and much farther than its speeds tell (leaps.h)

    void add(const Moves& more) {
        isFlung = isFlung || more.isFlung;
        isLeap = isLeap || more.isLeap;
    }
};

/// Of the way that an even motion at its speeds would be.
constexpr Real kLeapWays = 8;

/// Of its rim, at most.
Real speedOf(Vec2 velocity, Real spin, Real radius) {
    return std::fabs(velocity.x) + std::fabs(velocity.y) + std::fabs(spin) * radius;
}

/// Here a few instructions tell it, and nobody else need ask. @param before  its motion
Moves movesOf(const Body& body, const BodyMotion& before, const BodyState& state, Real time) {
    const Real moved = speedOf(state.deltaPosition, state.deltaAngle, body.radius);
    if (!(moved > kFastRatio * body.extent)) { return {}; }
    const Real speed = speedOf(before.velocity, before.angularVelocity, body.radius) +
                       speedOf(state.velocity, state.angularVelocity, body.radius);
    return {.isFlung = true, .isLeap = moved > kLeapWays * time * speed};
}

/// All but its pose.
Moves readBody(WorldState& world, std::uint32_t slot, const BodyState& state, Real time) {
    Body& body = world.bodies[slot];
    BodyMotion& motion = world.motions[slot];
    const Moves moves = movesOf(body, motion, state, time);
    if (moves.isFlung) { body.flung = true; }
    motion.center += toDouble(state.deltaPosition);
    motion.angle += static_cast<double>(state.deltaAngle);
    motion.velocity = state.velocity;
    motion.angularVelocity = state.angularVelocity;
    return moves;
}

/// Bodies whose sines and cosines, which are most of a pose, are found side by side.
constexpr std::size_t kPosesAtOnce = 32;

/// @param coming  of the same worker
SWEPT_FORCE_INLINE void fetchToTakeBack(const WorldState& world, std::span<const std::uint32_t> coming) {
    if (coming.size() <= kTakenBackAhead) { return; }
    const std::uint32_t slot = coming[kTakenBackAhead];
    fetchToWrite(world.motions[slot]);
    fetchToWrite(world.solverSlots[slot]);
    prefetch(&world.bodies[slot]);
}

/// Of the first few of a range of those that took part. Their slots end here: no other solve must take them for its
/// own.
/// @return what any of them did
Moves readFew(WorldState& world, SolveDesk& desk, bool isWatched, Real time, std::size_t begin, std::size_t rangeEnd) {
    const std::size_t end = std::min(begin + kPosesAtOnce, rangeEnd);
    std::array<double, kPosesAtOnce> angles;
    std::array<Rotation, kPosesAtOnce> rotations;
    std::array<std::size_t, kPosesAtOnce> places;
    const FindRotations find = rotationKernel();
    std::size_t count = 0;
    Moves any;
    for (std::size_t i = begin; i < end; ++i) {
        fetchToTakeBack(world, std::span(desk.bodies).subspan(i, rangeEnd - i));
        const std::uint32_t slot = desk.bodies[i];
        BodyState& state = desk.batch.states[i + 1];
        world.solverSlots[slot] = kFixedSlot;
        if (!isMovable(desk.batch.inertias[i + 1])) { continue; }
        if (Body& body = world.bodies[slot]; mayRide(body) && !isOnTurning(desk, static_cast<BodySlot>(i + 1))) {
            followCurve(world, slot, body, state, time);
        } else {
            body.groundNormal = {};
        }
        if (isWatched) { noteEnergy(desk.energyEntries[i], world, slot, state, time); }
        any.add(readBody(world, slot, state, time));
        places[count] = i;
        angles[count++] = world.motions[slot].angle;
    }
    (find != nullptr ? find : findRotations)(std::span(angles).first(count), rotations);
    for (std::size_t k = 0; k < count; ++k) {
        BodyMotion& motion = world.motions[desk.bodies[places[k]]];
        motion.pose = poseOf(motion.center, rotations[k], desk.localCenters[places[k] + 1]);
    }
    return any;
}

/// @return what any of them did
Moves readSome(WorldState& world, SolveDesk& desk, bool isWatched, Real time, std::size_t begin, std::size_t end) {
    Moves any;
    for (; begin < end; begin += kPosesAtOnce) { any.add(readFew(world, desk, isWatched, time, begin, end)); }
    return any;
}

}  // namespace

void giveSlots(WorldState& world, const TiedGroup& group, Real time) {
    SolveDesk& desk = group.desk;
    listTaking(world, group);
    const std::size_t slots = desk.bodies.size() + 1;
    desk.batch.states.resize(slots);
    desk.batch.inertias.resize(slots);
    desk.batch.drives.resize(slots);
    desk.localCenters.assign(1, {});
    desk.localCenters.resize(slots);
    findStrained(world, group);
    findTurningGround(world, group, time);
}

void setBodies(WorldState& world, const TiedGroup& group, Real h, FunctionRef<void()> beside) {
    SolveDesk& desk = group.desk;
    runBeside(*desk.loops, beside, desk.bodies.size(), kSetGrain, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            setBody(world, desk, static_cast<BodySlot>(i + 1), desk.bodies[i], h);
        }
    });
}

/// What each body did is found by any worker, and added up in order.
void readBodies(WorldState& world, const TiedGroup& group, Real time, Real h, double dt) {
    SolveDesk& desk = group.desk;
    const bool isWatched = openAccounts(world, group);
    if (isWatched) { desk.energyEntries.resize(desk.bodies.size()); }
    keepSpinOfAdrift(world, group);
    if (isWatched) { limitSqueezed(world, group, time); }
    std::atomic<bool> anyFlung = false;
    std::atomic<bool> anyLeap = false;
    const std::size_t count = desk.bodies.size();
    runInHalves(*desk.loops, count / 2, count, kReadGrain, [&](std::size_t begin, std::size_t end) {
        const Moves moves = readSome(world, desk, isWatched, time, begin, end);
        if (moves.isFlung) { anyFlung.store(true, std::memory_order_relaxed); }
        if (moves.isLeap) { anyLeap.store(true, std::memory_order_relaxed); }
    });
    desk.anyFlung = desk.anyFlung || anyFlung;
    if (!isWatched) { return; }
    book(world, desk);
    settleAccounts(world, group, time, h, dt);
    if (anyLeap) { undoLeaps(world, group, static_cast<double>(time)); }
}

}  // namespace swept::inline SWEPT_PRECISION
