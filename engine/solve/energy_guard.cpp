#include "energy_guard.h"

#include <algorithm>
#include <cmath>

#include "../../solver/joint_islands/joint_island.h"
#include "../containers/any_of.h"
#include "curved_ground.h"
#include "driven_joints.h"
#include "energy_calm.h"
#include "energy_gain.h"
#include "energy_shares.h"
#include "energy_sources.h"
#include "joint_builder.h"
#include "lent_energy.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// What is kinematic does work as it moves. At rest it is as good as static.
bool doesWork(const WorldState& world, std::uint32_t slot) {
    const BodyMotion& motion = world.motions[slot];
    return world.bodies[slot].def.type == BodyType::kinematic &&
           (motion.velocity != Vec2{} || motion.angularVelocity != 0);
}

void noteCarrier(const WorldState& world, EnergyAccount& account, std::uint32_t slot) {
    const BodyMotion& motion = world.motions[slot];
    const double spin = std::fabs(static_cast<double>(motion.angularVelocity));
    account.isLed = true;
    account.leadSpeed = std::max(account.leadSpeed, static_cast<double>(length(motion.velocity)));
    if (account.carrier == EnergyAccount::kNone || spin > account.leadSpin) {
        account.carrier = slot;
        account.leadSpin = spin;
    }
}

void noteContact(WorldState& world, const Contact& contact) {
    if (contact.sensor || contact.manifold.count == 0) { return; }
    const std::uint32_t other = contact.dynamicB ? contact.bodyA : contact.bodyB;
    EnergyAccount& account = accountOf(world, contact.dynamicB ? contact.bodyB : contact.bodyA);
    account.isTouching = true;
    account.isFed = account.isFed || contact.isBelt;
    if (contact.dynamicA == contact.dynamicB) { return; }
    account.meetsGround = true;
    if (doesWork(world, other)) {
        if (account.isDoubled) { noteCarrier(world, account, other); }
        account.isFed = account.isFed || !account.isDoubled;
    }
    account.isGrounded = account.isGrounded || contact.pressed;
    account.isOnChain = account.isOnChain || (contact.pressed && contact.ofChain);
    const Vec2 normal = rotate(world.motions[contact.bodyA].pose.rotation, contact.manifold.normal);
    const double impulse = static_cast<double>(contact.totalImpulse[0]) + static_cast<double>(contact.totalImpulse[1]);
    account.push += (contact.dynamicB ? impulse : -impulse) * toDouble(normal);
}

/// Gears and pulleys hold more than two bodies.
void noteJoint(WorldState& world, std::uint32_t joint) {
    const std::span<const std::uint32_t> bodies = world.joints[joint].allBodies();
    for (const std::uint32_t slot : bodies) {
        if (!world.bodies[slot].isDynamic()) { continue; }
        EnergyAccount& account = accountOf(world, slot);
        for (const std::uint32_t other : bodies) {
            account.isAnchored = account.isAnchored || !world.bodies[other].isDynamic();
            if (doesWork(world, other)) { noteCarrier(world, account, other); }
        }
    }
}

/// Of a joint that does not hold, by far, at least this. Where it is one of several that hold an island to what it does
/// not move, or the island presses on something static, they cannot all hold; of a single one, what hangs there may be
/// heavy, or whirl.
constexpr Real kTornGap = Real(1) / 8;

/// Kinematic bodies do work, and so do joints that calls move. What they lead may hang on levers, or whirl, and go as
/// fast as it likes, unless its joints are torn or closed at once: then what goes faster than `kMostLead` has it is not
/// fed. (A box on joints to two things that part, by a metre in a second, was at 350 m/s when they stopped, and with
/// welds beyond all numbers.)
/// @pre what leads is noted
void findFed(WorldState& world, const TiedGroup& group) {
    const SolveDesk& desk = group.desk;
    forEachMoved(desk, [&](std::size_t, std::uint32_t slot) {
        EnergyAccount& account = accountOf(world, slot);
        if (!account.isLed) { return; }
        const Body& body = world.bodies[slot];
        const bool isCarried = account.carrier != EnergyAccount::kNone;
        const double arm = isCarried ? length(world.motions[slot].center - world.motions[account.carrier].center) : 0;
        account.led += 0.5 * (body.mass * squared(account.leadSpeed + account.leadSpin * arm) +
                              inertiaOf(body) * squared(account.leadSpin));
    });
    const auto isFast = [](const EnergyAccount& account) {
        return account.isLed && !account.isFed && account.kinetic > kMostLead * account.led && hasGained(account);
    };
    for (const std::uint32_t i : group.joints) {
        const JointTie& tie = world.jointTies[i];
        EnergyAccount& account = accountOf(world, tie);
        const bool isHeldTwice = account.anchors >= 2 || account.isGrounded;
        if (account.solve != desk.energySolve || !isHeldTwice || account.isTorn || !isFast(account)) { continue; }
        account.isTorn = gapOf(world, world.joints[i]) > kTornGap;
    }
    for (const std::uint32_t root : desk.energyRoots) {
        EnergyAccount& account = world.energyAccounts[root];
        const bool mayPay = account.isTorn || ((account.isYanked || account.isDoubled) && isFast(account));
        account.isFed = account.isFed || (account.isLed && !mayPay);
    }
}

void noteJointed(EnergyAccount& account, const JointChain& chain, bool isExact, std::uint32_t anchors) {
    account.isJointed = true;
    account.isDoubled = account.isDoubled || chain.doubled > 0;
    account.isFed = account.isFed || (isExact && !account.gaveWay);
    account.isAnchored = account.isAnchored || anchors > 0;
    account.anchors += anchors;
}

void noteWhatGaveWay(WorldState& world, const SolveDesk& desk) {
    forEachMoved(desk, [&](std::size_t i, std::uint32_t slot) {
        const auto own = static_cast<BodySlot>(i + 1);
        if (!desk.isExactOf(own) || desk.solver.gaveWay(own)) { accountOf(world, slot).gaveWay = true; }
    });
}

/// Which islands have joints, and whether these drive them or hold them to something. Joints that are solved exactly
/// have accounts of their own (`JointIsland`), but for what nothing holds and gave way; drives that are followed make
/// no error.
void noteJointed(WorldState& world, const TiedGroup& group) {
    const bool isExact = group.desk.isExact;
    if (group.role == BodyRole::solved) {  // most of all that is awake: what is known of whole chains is enough
        for (const JointChain& chain : world.jointChains.list) {
            EnergyAccount& account = accountOf(world, chain.lowest);
            const bool isIn = account.solve == group.desk.energySolve;
            if (isIn) { noteJointed(account, chain, isExact, chain.anchors); }
        }
        return;
    }
    for (const std::uint32_t joint : group.joints) {
        const JointTie& tie = world.jointTies[joint];
        const std::uint32_t slot = isAwakeDynamic(world, tie.bodyA) ? tie.bodyA : tie.bodyB;
        const JointChain& chain = world.jointChains.of(slot);
        const bool isAnchored = !isAwakeDynamic(world, tie.bodyA) || !isAwakeDynamic(world, tie.bodyB);
        noteJointed(accountOf(world, slot), chain, isExact, isAnchored ? 1 : 0);
    }
}

/// @pre `noteJointed`
bool mayDrift(const EnergyAccount& account) {
    return account.isJointed && !account.isAnchored && !account.isFed &&
           (account.owed > 0 || excessOf(account) > kGainRounding * account.kinetic);
}

/// How islands go as a whole that nothing holds. @pre `noteJointed`
void findDrifts(WorldState& world, SolveDesk& desk) {
    std::vector<IslandMotion>& islands = desk.islandMotions;
    islands.clear();
    forEachMoved(desk, [&](std::size_t, std::uint32_t slot) {
        EnergyAccount& account = accountOf(world, slot);
        if (!mayDrift(account)) { return; }
        if (account.motion == kNoIndex) {
            account.motion = static_cast<std::uint32_t>(islands.size());
            islands.push_back({.root = world.islands.find(slot)});
        }
        const double mass = world.bodies[slot].mass;
        islands[account.motion].mass += mass;
        islands[account.motion].velocity += mass * toDouble(world.motions[slot].velocity);
    });
    for (const IslandMotion& island : islands) {
        EnergyAccount& account = world.energyAccounts[island.root];
        account.drift = squared(island.velocity) / (2 * island.mass);
        account.motion = kNoIndex;
    }
}

/// Of an island without joints: whether the pairs up to this one tell that it is fed; then no more is asked of them.
bool noteFeed(WorldState& world, const TouchingPair& pair) {
    EnergyAccount& account = accountOf(world, pair.dynamicBody());
    const std::uint32_t other = pair.dynamicB ? pair.bodyA : pair.bodyB;
    return account.isFed = account.isFed || pair.isBelt || doesWork(world, other);
}

/// What else has a part in the motion of the islands.
void noteOthers(WorldState& world, const TiedGroup& group) {
    const bool hasJoints = !group.joints.empty();
    if (group.role == BodyRole::solved) {
        for (const TouchingPair& pair : world.touching) {
            const bool isAsked = hasJoints || ((!pair.areDynamic() || pair.isBelt) && !noteFeed(world, pair));
            if (isAsked) { noteContact(world, world.contacts[pair.contact]); }
        }
    } else {
        for (const Contact& contact : group.contacts) { noteContact(world, contact); }
    }
    if (group.role != BodyRole::solved || world.kinematicBodies > 0) {  // of others all is known
        for (const std::uint32_t joint : group.joints) { noteJoint(world, joint); }
    }
    if (hasJoints) { findFed(world, group); }
}

}  // namespace

bool openAccounts(WorldState& world, const TiedGroup& group) {
    if (group.effort.isSettled) { return false; }
    group.desk.energySolve = world.energySolves.fetch_add(1, std::memory_order_relaxed) + 1;
    group.desk.energyRoots.clear();
    world.energyAccounts.resize(world.bodies.slotCount());
    return true;
}

void noteEnergy(EnergyEntry& entry, const WorldState& world, std::uint32_t slot, const BodyState& state, Real time) {
    const Body& body = world.bodies[slot];
    const BodyMotion& before = world.motions[slot];
    entry = {};
    if (body.inverseMass > 0) {
        const double half = 0.5 / static_cast<double>(body.inverseMass);
        const DVec2 pull = toDouble(accelerationOf(world, body));
        const double after = squared(toDouble(state.velocity));  // squares of slow speeds underflow in `Real`
        entry.kinetic = half * after;
        entry.gained = half * (after - squared(toDouble(before.velocity)));
        entry.work = 2 * half * dot(pull, toDouble(state.deltaPosition));
        entry.velocityBefore = before.velocity;
        entry.moved = state.deltaPosition;
        entry.fall = half * dot(pull, pull) * squared(static_cast<double>(time));
    }
    if (body.inverseInertia > 0) {
        const double half = 0.5 / static_cast<double>(body.inverseInertia);
        const double after = squared(static_cast<double>(state.angularVelocity));
        entry.turningKinetic = half * after;
        entry.turningGained = half * (after - squared(static_cast<double>(before.angularVelocity)));
        entry.turningWork = static_cast<double>(body.torque) * static_cast<double>(state.deltaAngle);
        entry.spinBefore = before.angularVelocity;
        entry.turned = state.deltaAngle;
    }
}

namespace {

/// What is added up of an account.
struct EnergySums {
    explicit EnergySums(const EnergyAccount& account)
        : kinetic(account.kinetic), gained(account.gained), work(account.work), fall(account.fall) {}

    void add(const EnergyEntry& entry) {
        kinetic += entry.kinetic;
        gained += entry.gained;
        work += entry.work;
        fall += entry.fall;
        kinetic += entry.turningKinetic;
        gained += entry.turningGained;
        work += entry.turningWork;
    }
    void writeTo(EnergyAccount& account) const {
        account.kinetic = kinetic;
        account.gained = gained;
        account.work = work;
        account.fall = fall;
    }

    double kinetic;
    double gained;
    double work;
    double fall;
};

/// Copied: GCC 12 makes a loop of what fills an account with zeros, which took half of the time of `book`.
constexpr EnergyAccount kNewAccount;

}  // namespace

/// Added up outside of memory as long as bodies are of one island, as mostly: each sum there waits for the one before.
void book(WorldState& world, SolveDesk& desk) {
    EnergyAccount* account = nullptr;
    EnergySums sums{EnergyAccount{}};
    std::uint32_t root = kNoIndex;
    for (std::size_t i = 0; i < desk.bodies.size(); ++i) {
        if (!isMovable(desk.batch.inertias[i + 1])) { continue; }
        const std::uint32_t next = world.islands.find(desk.bodies[i]);
        if (next != root) {
            if (account != nullptr) { sums.writeTo(*account); }
            root = next;
            account = &world.energyAccounts[root];
            if (account->solve != desk.energySolve) {
                *account = kNewAccount;
                account->solve = desk.energySolve;
                desk.energyRoots.push_back(root);
            }
            sums = EnergySums(*account);
        }
        sums.add(desk.energyEntries[i]);
    }
    if (account != nullptr) { sums.writeTo(*account); }
}

void settleAccounts(WorldState& world, const TiedGroup& group, Real time, Real h, double dt) {
    const std::vector<std::uint32_t>& roots = group.desk.energyRoots;
    const bool hasJoints = !group.joints.empty();
    const SolveDesk& desk = group.desk;
    if (desk.isExact && (desk.anyGaveWay || desk.anyLeft)) { noteWhatGaveWay(world, desk); }
    if (hasJoints && world.jointChains.mayAnyLend) { noteLent(world, group, time, dt); }
    const auto hasGainedAnything = [&](std::uint32_t root) { return hasGained(world.energyAccounts[root]); };
    const double part = world.jointChains.isAnyLoose ? kGainRounding : kJointedGain;
    const auto hasGainedIfTied = [&](std::uint32_t root) {  // not known yet which ones are
        const EnergyAccount& account = world.energyAccounts[root];
        return account.gained - account.work > part * account.kinetic;
    };
    const bool any = anyOf(roots, hasGainedAnything) || (hasJoints && anyOf(roots, hasGainedIfTied));
    const bool mayRide = mayRideTogether(world, group.desk);
    if (!any && !mayRide) { return; }
    if (hasJoints) {
        noteJointed(world, group);
        bookMotors(world, group, static_cast<double>(time));
        bookSprings(world, group, h);
    }
    markDrivenAccounts(world, group);
    if (mayRide) {
        noteOthers(world, group);
        payForLift(world, group.desk, static_cast<double>(time));
    }
    if (!any) { return; }
    const auto drifts = [&](std::uint32_t root) { return mayDrift(world.energyAccounts[root]); };
    if (anyOf(roots, drifts)) { findDrifts(world, group.desk); }
    const bool mayTouch = group.role == BodyRole::solved ? !world.touching.empty() : !group.contacts.empty();
    const double hanging = mayTouch ? kMostFallsInTouch : kMostFalls;
    const auto mayHaveGained = [&](std::uint32_t root) {
        const EnergyAccount& account = world.energyAccounts[root];
        return !account.isFed && (account.owed > 0 || hasGained(account, account.isAnchored ? hanging : 0));
    };
    if (noneOf(roots, mayHaveGained)) { return; }
    if (!mayRide) { noteOthers(world, group); }
    // What platforms carry gains all the time, and is fed.
    const auto pays = [&](std::uint32_t root) {
        return hasGained(world.energyAccounts[root]) && !world.energyAccounts[root].isFed;
    };
    if (noneOf(roots, pays)) { return; }
    takeBackGains(world, group, static_cast<double>(time));
    if (hasJoints) { calmTorn(world, group, static_cast<double>(time)); }
}

}  // namespace swept::inline SWEPT_PRECISION
