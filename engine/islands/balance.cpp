#include "balance.h"

#include <algorithm>
#include <cmath>

#include "../../solver/closeness.h"
#include "../../solver/softness.h"
#include "../bodies/travel.h"
#include "../contacts/contact_tests.h"
#include "../containers/any_of.h"
#include "../state/profile.h"
#include "../state/world_state.h"
#include "load_paths.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// On earth at 60 Hz 0.6 mm/s, and 0.05 % of the weight: what trembles by the give of its contacts, and creeps into
/// them, is off by more (a tenth more in three steps: it goes on for a hundredth of a millimetre).
constexpr RestLimits kFastLimits{.speed = Real(1) / (1 << 8),
                                 .pull = Real(1) / (1 << 11),
                                 .torque = Real(1) / (1 << 11),
                                 .gap = Real(1) / (1 << 12),
                                 .overlap = std::numeric_limits<Real>::infinity()};
constexpr RestLimits kAccurateLimits{.speed = Real(1) / (1 << 14),
                                     .pull = Real(1) / (1 << 14),
                                     .torque = Real(1) / (1 << 13),
                                     .gap = Real(1) / (1 << 12),
                                     .overlap = std::numeric_limits<Real>::infinity()};
/// At 60 Hz on earth, 6 µm in ten seconds. A direct solve leaves less than a thousandth of the speed, and of overlaps a
/// little less than here. (With no more than that, what rounding found beyond it here and within it there was solved
/// directly for ever, and left as it was.) With pulls of sixteen times as much a stack of 200 boxes moved by 12 µm
/// before it was solved again, instead of by 0.1; in float the impulses under 250 boxes are rounded to as much: higher
/// ones are solved more often.
constexpr RestLimits kDirectLimits{.speed = Real(1) / (1 << 18),
                                   .pull = Real(1) / (1 << 16),
                                   .torque = Real(1) / (1 << 13),
                                   .gap = Real(5) / (1 << 22),
                                   .overlap = Real(5) / (1 << 22)};
/// The same for large islands, but for gaps and overlaps (what presses against others on all sides keeps more): to
/// close what the search for their first impulses left takes 60 steps of 25 ms with 1275 boxes side by side, and the
/// search as many more.
constexpr RestLimits kLargeDirectLimits{.speed = kDirectLimits.speed,
                                        .pull = kDirectLimits.pull,
                                        .torque = kDirectLimits.torque,
                                        .gap = Real(1) / (1 << 12),
                                        .overlap = Real(1) / (1 << 12)};

/// Impulses that were sought, instead of having come about, are no balance where the contact would push its bodies out:
/// where it is so many times as deep as it gives way under them. (A box that was made 0.5 m deep in the ground, at
/// rest, stayed there for ever.)
constexpr Real kMostGive = 4;

bool isSlow(const Body& body, const BodyMotion& motion, Real speed) {
    return lengthSquared(motion.velocity) <= square(speed) && std::fabs(motion.angularVelocity) * body.radius <= speed;
}

/// Marks islands that something moves in. @return whether there are others
bool markRestless(WorldState& world) {
    const std::vector<BodyTraits>& traits = world.traits;
    const auto isStill = [&traits](std::uint32_t slot) { return (traits[slot] & kIsStill) != 0; };
    if (noneOf(world.tied, isStill)) { return false; }
    world.islandRests.resize(world.bodies.slotCount());
    for (const std::uint32_t slot : world.awake) { world.islandRests[slot] = {}; }
    std::size_t moving = 0;
    for (std::size_t i = 0; i < world.tied.size(); ++i) {
        if (isStill(world.tied[i])) { continue; }
        world.islandRests[world.tiedRoots[i]].isRestless = true;
        ++moving;
    }
    for (const JointChain& chain : world.jointChains.list) { restOf(world, chain.lowest).isRestless = true; }
    for (const Stirred& stirred : world.stirs.bodies) {
        if (world.bodies[stirred.body].awake) { restOf(world, stirred.body).isRestless = true; }
    }
    return moving < world.tied.size();
}

/// What acts on the bodies of those that are left. @return whether there are any
bool listPulls(WorldState& world, Real dt, Real gravityStep) {
    bool any = false;
    const bool hasLoads = world.settings.profile == Profile::accurate;
    world.islandPulls.resize(std::max<std::size_t>(world.islandPulls.size(), world.bodies.slotCount()));
    for (const std::uint32_t slot : world.tied) {
        const std::uint32_t root = world.islands.find(slot);
        IslandRest& rest = world.islandRests[root];
        if (rest.isRestless) { continue; }
        const Body& body = world.bodies[slot];
        if (hasLoads) {
            rest.isDirect = world.islandLoads[root].effort.direct == DirectScope::all;
            rest.isLarge = world.islandLoads[root].effort.isLarge;
        }
        rest.isPushed = rest.isPushed || body.force != Vec2{};
        rest.soughtSteps = std::max(rest.soughtSteps, body.soughtSteps);
        rest.isRestless = body.torque != 0 || body.role != BodyRole::solved ||
                          (rest.isDirect && !isSlow(body, world.motions[slot], kDirectLimits.speed * gravityStep));
        world.islandPulls[slot] = {(static_cast<Real>(body.mass) * dt) * accelerationOf(world, body), 0};
        any = true;
    }
    return any;
}

/// Of a point to an impulse along the normal of its contact, 1/kg.
Real responseOf(const WorldState& world, const TouchingPair& pair, Vec2 normal, Vec2 armA, Vec2 armB) {
    const auto responseOfBody = [&world, normal](std::uint32_t slot, Vec2 arm) {
        const Body& body = world.bodies[slot];
        return static_cast<Real>(1 / body.mass) + static_cast<Real>(body.inverseInertia) * square(cross(arm, normal));
    };
    return (pair.dynamicA ? responseOfBody(pair.bodyA, armA) : Real(0)) +
           (pair.dynamicB ? responseOfBody(pair.bodyB, armB) : Real(0));
}

/// Adds what a contact gave the bodies in the last step. @return whether it may stay as it is
bool weighContact(WorldState& world, const TouchingPair& pair, const IslandRest& rest, Real subSteps, Real dt) {
    const RestLimits limits = limitsOf(world, rest);
    const bool isFound = rest.isSought && !rest.isDirect;
    const Contact& contact = world.contacts[pair.contact];
    const BodyMotion& a = world.motions[pair.bodyA];
    const BodyMotion& b = world.motions[pair.bodyB];
    const Vec2 normal = rotate(a.pose.rotation, contact.manifold.normal);
    const Vec2 tangent = rightPerp(normal);
    const Vec2 originFromA = toReal(a.pose.position - a.center);
    const Vec2 fromBToA = toReal(a.center - b.center);
    const Real radius = movedRadius(world, pair);
    if (pair.rolls()) {
        const Real twist = subSteps * contact.rollingImpulse();
        if (pair.dynamicA) { world.islandPulls[pair.bodyA].torque -= twist; }
        if (pair.dynamicB) { world.islandPulls[pair.bodyB].torque += twist; }
    }
    for (std::size_t i = 0; i < static_cast<std::size_t>(contact.manifold.count); ++i) {
        const Vec2 armA = rotate(a.pose.rotation, contact.manifold.points[i].point) + originFromA;
        const Vec2 armB = armA + fromBToA;
        const Real separation = contact.manifold.points[i].separation;
        const bool presses = contact.normalImpulse[i] > 0;
        // A point that was closed to a rounding, and is measured anew, is off by two.
        const Real rounding = 2 * separationRounding(armA, armB);
        const Real gap = std::max(limits.gap * radius, rounding);
        Real overlap = std::max(limits.overlap * radius, rounding);
        if (isFound) {
            const Real cycles = pair.areDynamic() ? kContactCycles : groundCyclesOf(world.settings);
            const Real give = giveOfSubStep(cycles, dt / subSteps, contact.normalImpulse[i],
                                            responseOf(world, pair, normal, armA, armB));
            overlap = std::max(gap, kMostGive * give);
        }
        if (presses ? separation > gap || separation < -overlap : separation < -gap) { return false; }
        const Vec2 impulse = subSteps * (contact.normalImpulse[i] * normal + contact.tangentImpulse[i] * tangent);
        if (pair.dynamicA) {
            Pull& pull = world.islandPulls[pair.bodyA];
            pull.force -= impulse;
            pull.torque -= cross(armA, impulse);
        }
        if (pair.dynamicB) {
            Pull& pull = world.islandPulls[pair.bodyB];
            pull.force += impulse;
            pull.torque += cross(armB, impulse);
        }
    }
    return true;
}

void weighContacts(WorldState& world, Real dt) {
    const auto subSteps = static_cast<Real>(subStepsOf(world.settings));
    for (const TouchingPair& pair : world.touching) {
        if (!isTied(world, pair)) { continue; }
        IslandRest& rest = restOf(world, pair.dynamicBody());
        if (rest.isRestless) { continue; }
        const bool onKinematic =
            !pair.areDynamic() && world.bodies[pair.dynamicA ? pair.bodyB : pair.bodyA].def.type == BodyType::kinematic;
        rest.isRestless = onKinematic || pair.isBelt;
        rest.isOff = rest.isOff || !weighContact(world, pair, rest, subSteps, dt);
    }
}

bool isBalanced(const Body& body, const Pull& pull, const RestLimits& limits, Real gravityStep) {
    const Real weight = static_cast<Real>(body.mass) * gravityStep;
    const bool turns = body.inverseInertia > 0;
    return lengthSquared(pull.force) <= square(limits.pull * weight) &&
           (!turns || std::fabs(pull.torque) <= limits.torque * weight * body.radius);
}

/// @return whether some of the islands that are still are in balance
bool weighIslands(WorldState& world, Real step, Real gravityStep) {
    if (!listPulls(world, step, gravityStep)) { return false; }
    weighContacts(world, step);
    for (const std::uint32_t slot : world.tied) {
        IslandRest& rest = restOf(world, slot);
        if (rest.isRestless || rest.isOff) { continue; }
        rest.isOff = !isBalanced(world.bodies[slot], world.islandPulls[slot], limitsOf(world, rest), gravityStep);
    }
    return anyOf(world.tied, [&world](std::uint32_t slot) {
        const IslandRest& rest = restOf(world, slot);
        return !rest.isRestless && !rest.isOff;
    });
}

/// After so many steps in which an island was still without being in balance others are sought: at once, unless it was
/// held until now and something concerns it, then after pauses that double.
bool isTimeToSeek(std::uint16_t steps) { return steps == 0 || (steps > kJustReleased && (steps & (steps - 1U)) == 0); }
/// Round and round at the longest pause.
std::uint16_t stepsAfter(std::uint16_t steps) {
    return static_cast<std::uint16_t>(steps + 1 < 2 * kLongestPause ? steps + 1 : kLongestPause);
}

/// Chooses the islands for which a balance is sought. @return whether there are any
bool chooseSought(WorldState& world) {
    bool any = false;
    for (const std::uint32_t slot : world.tied) {
        IslandRest& rest = restOf(world, slot);
        if (rest.isRestless || !rest.isOff) { continue; }
        rest.isSought = !rest.isPushed && isTimeToSeek(rest.soughtSteps);
        any = any || rest.isSought;
        world.bodies[slot].soughtSteps = stepsAfter(rest.soughtSteps);
    }
    return any;
}

}  // namespace

IslandRest& restOf(WorldState& world, std::uint32_t slot) { return world.islandRests[world.islands.find(slot)]; }

RestLimits limitsOf(const WorldState& world, const IslandRest& rest) {
    if (!rest.isDirect) { return restLimitsFor(world.settings.profile); }
    return rest.isLarge ? kLargeDirectLimits : kDirectLimits;
}

Real movedRadius(const WorldState& world, const TouchingPair& pair) {
    const Real a = world.bodies[pair.bodyA].radius;
    const Real b = world.bodies[pair.bodyB].radius;
    if (pair.areDynamic()) { return std::min(a, b); }
    return pair.dynamicA ? a : b;
}

RestLimits restLimitsFor(Profile profile) { return profile == Profile::fast ? kFastLimits : kAccurateLimits; }

Real restSpeedOf(const WorldState& world, Real dt) {
    return restLimitsFor(world.settings.profile).speed * length(world.settings.gravity) * dt;
}

bool isStill(const Body& body, const BodyMotion& motion, Real speed, Real dt) {
    if (!isSlow(body, motion, speed)) { return false; }
    if (body.isPut) { return true; }
    const double way = lengthAtMost(motion.center - body.startCenter) +
                       std::fabs(motion.angle - body.startAngle) * static_cast<double>(body.radius);
    return way <= static_cast<double>(speed * dt);
}

bool findBalancedIslands(WorldState& world, double dt) {
    const auto step = static_cast<Real>(dt);
    const Real gravityStep = length(world.settings.gravity) * step;
    if (!markRestless(world)) { return false; }
    makeRoomForLoads(world);
    bool any = weighIslands(world, step, gravityStep);
    if (chooseSought(world) && handLoadsDown(world, dt)) {
        for (const std::uint32_t slot : world.tied) {
            IslandRest& rest = restOf(world, slot);
            rest.isOff = rest.isOff && !rest.isSought;
        }
        any = weighIslands(world, step, gravityStep);
    }
    for (const std::uint32_t slot : world.tied) {
        IslandRest& rest = restOf(world, slot);
        rest.isRestless = rest.isRestless || rest.isOff;
    }
    return any;
}

}  // namespace swept::inline SWEPT_PRECISION
