#include "energy_guard.h"

#include <algorithm>
#include <cmath>

#include "driven_joints.h"
#include "energy_gain.h"
#include "energy_shares.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Does work, as long as it lasts; one that stands still is as good as static.
bool isCarrier(const WorldState& world, std::uint32_t slot) {
    const BodyMotion& motion = world.motions[slot];
    return world.bodies[slot].def.type == BodyType::kinematic &&
           (motion.velocity != Vec2{} || motion.angularVelocity != 0);
}

void noteContact(WorldState& world, const Contact& contact) {
    if (contact.sensor || contact.manifold.count == 0) { return; }
    const std::uint32_t other = contact.dynamicB ? contact.bodyA : contact.bodyB;
    EnergyAccount& account = accountOf(world, contact.dynamicB ? contact.bodyB : contact.bodyA);
    account.isTouching = true;
    account.isDriven = account.isDriven || contact.isBelt;
    if (contact.dynamicA == contact.dynamicB) { return; }
    account.isDriven = account.isDriven || isCarrier(world, other);
    account.isGrounded = account.isGrounded || contact.pressed;
    const Vec2 normal = rotate(world.motions[contact.bodyA].pose.rotation, contact.manifold.normal);
    const double impulse = static_cast<double>(contact.totalImpulse[0]) + static_cast<double>(contact.totalImpulse[1]);
    account.push += (contact.dynamicB ? impulse : -impulse) * toDouble(normal);
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

/// Gears and pulleys hold more than two bodies.
void noteJoint(WorldState& world, std::uint32_t joint) {
    const std::span<const std::uint32_t> bodies = world.joints[joint].allBodies();
    for (const std::uint32_t slot : bodies) {
        if (!world.bodies[slot].isDynamic()) { continue; }
        EnergyAccount& account = accountOf(world, slot);
        for (const std::uint32_t other : bodies) {
            account.isAnchored = account.isAnchored || !world.bodies[other].isDynamic();
            if (isCarrier(world, other)) { noteCarrier(world, account, other); }
        }
    }
}

/// Who is led, and goes no faster than that can make it. @pre what leads is noted
void findDriven(WorldState& world, const SolveDesk& desk) {
    for (std::size_t i = 0; i < desk.bodies.size(); ++i) {
        if (!isMovable(desk.batch.inertias[i + 1])) { continue; }
        EnergyAccount& account = accountOf(world, desk.bodies[i]);
        if (!account.isLed) { continue; }
        const Body& body = world.bodies[desk.bodies[i]];
        const bool isCarried = account.carrier != EnergyAccount::kNone;
        const double arm =
            isCarried ? length(world.motions[desk.bodies[i]].center - world.motions[account.carrier].center) : 0;
        account.led += 0.5 * (body.mass * squared(account.leadSpeed + account.leadSpin * arm) +
                              inertiaOf(body) * squared(account.leadSpin));
    }
    for (const std::uint32_t root : desk.energyRoots) {
        EnergyAccount& account = world.energyAccounts[root];
        account.isDriven = account.isDriven || (account.isLed && account.kinetic <= kMostLead * account.led);
    }
}

/// Joints that are solved exactly have accounts of their own (`JointIsland`).
bool isPassive(const TiedGroup& group, const JointTie& tie) {
    return tie.isPassive && group.effort.direct != DirectScope::islands;
}

/// Which islands have joints, and whether these drive them or hold them to something.
void noteJointed(WorldState& world, const TiedGroup& group) {
    const auto moves = [&world](std::uint32_t slot) { return (world.traits[slot] & kIsDynamic) != 0; };
    for (const std::uint32_t joint : group.joints) {
        const JointTie& tie = world.jointTies[joint];
        EnergyAccount& account = accountOf(world, moves(tie.bodyA) ? tie.bodyA : tie.bodyB);
        account.isJointed = true;
        account.isDriven = account.isDriven || !isPassive(group, tie);
        account.isAnchored = account.isAnchored || !moves(tie.bodyA) || !moves(tie.bodyB);
    }
}

/// @pre `noteJointed`
bool mayDrift(const EnergyAccount& account) {
    return account.isJointed && !account.isAnchored && !account.isDriven &&
           excessOf(account) > kGainRounding * account.kinetic;
}

/// How islands go as a whole that nothing holds. @pre `noteJointed`
void findDrifts(WorldState& world, SolveDesk& desk) {
    std::vector<IslandMotion>& islands = desk.islandMotions;
    islands.clear();
    for (std::size_t i = 0; i < desk.bodies.size(); ++i) {
        if (!isMovable(desk.batch.inertias[i + 1])) { continue; }
        EnergyAccount& account = accountOf(world, desk.bodies[i]);
        if (!mayDrift(account)) { continue; }
        if (account.motion == kNoIndex) {
            account.motion = static_cast<std::uint32_t>(islands.size());
            islands.push_back({.root = world.islands.find(desk.bodies[i])});
        }
        const double mass = world.bodies[desk.bodies[i]].mass;
        islands[account.motion].mass += mass;
        islands[account.motion].velocity += mass * toDouble(world.motions[desk.bodies[i]].velocity);
    }
    for (const IslandMotion& island : islands) {
        EnergyAccount& account = world.energyAccounts[island.root];
        account.drift = squared(island.velocity) / (2 * island.mass);
        account.motion = kNoIndex;
    }
}

/// What else has a part in the motion of the islands.
void noteOthers(WorldState& world, const TiedGroup& group) {
    const bool hasJoints = !group.joints.empty();
    if (group.role == BodyRole::solved) {
        for (const TouchingPair& pair : world.touching) {
            if (!pair.areDynamic() || hasJoints || pair.isBelt) { noteContact(world, world.contacts[pair.contact]); }
        }
    } else {
        for (const Contact& contact : group.contacts) { noteContact(world, contact); }
    }
    for (const std::uint32_t joint : group.joints) { noteJoint(world, joint); }
    if (hasJoints) { findDriven(world, group.desk); }
}

}  // namespace

bool openAccounts(WorldState& world, const TiedGroup& group) {
    if (group.effort.isSettled) { return false; }
    group.desk.energySolve = world.energySolves.fetch_add(1, std::memory_order_relaxed) + 1;
    group.desk.energyRoots.clear();
    world.energyAccounts.resize(world.bodies.slotCount());
    return true;
}

EnergyEntry entryOf(const WorldState& world, std::uint32_t slot, const BodyState& state, Real time) {
    const Body& body = world.bodies[slot];
    const BodyMotion& before = world.motions[slot];
    EnergyEntry entry;
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
    }
    return entry;
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
                *account = {.solve = desk.energySolve};
                desk.energyRoots.push_back(root);
            }
            sums = EnergySums(*account);
        }
        sums.add(desk.energyEntries[i]);
    }
    if (account != nullptr) { sums.writeTo(*account); }
}

void settleAccounts(WorldState& world, const TiedGroup& group, Real time) {
    const std::vector<std::uint32_t>& roots = group.desk.energyRoots;
    const bool hasJoints = !group.joints.empty();
    const auto hasGainedAnything = [&](std::uint32_t root) { return hasGained(world.energyAccounts[root]); };
    const double part = world.jointChains.isAnyLoose ? kGainRounding : kJointedGain;
    const auto hasGainedIfTied = [&](std::uint32_t root) {  // not known yet which ones are
        const EnergyAccount& account = world.energyAccounts[root];
        return account.gained - account.work > part * account.kinetic;
    };
    const bool any = std::any_of(roots.begin(), roots.end(), hasGainedAnything) ||
                     (hasJoints && std::any_of(roots.begin(), roots.end(), hasGainedIfTied));
    if (!any) { return; }
    if (hasJoints) { noteJointed(world, group); }
    noteDriven(world, group);
    const auto drifts = [&](std::uint32_t root) { return mayDrift(world.energyAccounts[root]); };
    if (std::any_of(roots.begin(), roots.end(), drifts)) { findDrifts(world, group.desk); }
    const bool mayTouch = group.role == BodyRole::solved ? !world.touching.empty() : !group.contacts.empty();
    const double hanging = mayTouch ? kMostFallsInTouch : kMostFalls;
    const auto mayHaveGained = [&](std::uint32_t root) {
        const EnergyAccount& account = world.energyAccounts[root];
        return !account.isDriven && hasGained(account, account.isAnchored ? hanging : 0);
    };
    if (std::none_of(roots.begin(), roots.end(), mayHaveGained)) { return; }
    noteOthers(world, group);
    // What platforms carry gains all the time, and is driven.
    const auto pays = [&](std::uint32_t root) {
        return hasGained(world.energyAccounts[root]) && !world.energyAccounts[root].isDriven;
    };
    if (std::none_of(roots.begin(), roots.end(), pays)) { return; }
    takeBackGains(world, group, static_cast<double>(time));
}

}  // namespace swept::inline SWEPT_PRECISION
