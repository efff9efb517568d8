#include "energy_guard.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Rounding of velocities, as a part of the kinetic energy.
constexpr double kRounding = 8 * static_cast<double>(kEpsilon);
/// What rests trembles by its contacts' give: this part of the energy that it would gain in free fall is no gain.
constexpr double kTremble = 1.0 / 1024;

/// Of this part of its energy islands with joints may gain anything. And nets give way: one that sags swings back with
/// what its gaps held, by four times as much in a step as it would gain in free fall. What takes turns with contacts is
/// held closer: it bursts with up to hundreds of times that. What nothing holds falls as a whole, and sags nowhere.
constexpr double kJointedPart = 1.0 / 64;
constexpr double kMostFalls = 16;
constexpr double kMostFallsInTouch = 1.0 / 4;

/// Overlaps are pushed out without speed, which lifts at no cost. Joints pay for that as well: what hung on limits rose
/// step by step, and was given what it fell again (five boxes by 11 m in 15 s, once the first one had a thousandth of
/// its inertia).
double excessOf(const EnergyAccount& account) {
    return account.gained - (account.isJointed ? account.work : std::max(account.work, 0.0));
}

/// @param falls  that joints may give back
bool hasGained(const EnergyAccount& account, double falls) {
    if (account.isJointed) {
        const double kinetic = account.isTouching ? account.kinetic : account.kinetic - account.drift;
        return excessOf(account) > kJointedPart * kinetic + falls * account.fall;
    }
    return excessOf(account) > kRounding * account.kinetic + kTremble * account.fall;
}
bool hasGained(const EnergyAccount& account) {
    const double hanging = account.isAnchored ? kMostFalls : 0;
    return hasGained(account, account.isTouching ? kMostFallsInTouch : hanging);
}

double squared(double x) { return x * x; }
double squared(DVec2 v) { return dot(v, v); }

EnergyAccount& accountOf(WorldState& world, std::uint32_t slot) {
    return world.energyAccounts[world.islands.find(slot)];
}

/// Of the members of the group, those whose island gained.
template <class Visit>
void forEachGainer(WorldState& world, const TiedGroup& group, const Visit& visit) {
    for (const std::uint32_t slot : group.bodies) {
        const Body& body = world.bodies[slot];
        if (!body.isDynamic() || !isMember(body, group)) { continue; }
        EnergyAccount& account = accountOf(world, slot);
        if (account.solve == group.desk.energySolve && !account.isDriven && hasGained(account)) {
            visit(slot, account);
        }
    }
}

void noteContact(WorldState& world, const Contact& contact) {
    if (contact.sensor || contact.manifold.count == 0) { return; }
    const std::uint32_t other = contact.dynamicB ? contact.bodyA : contact.bodyB;
    EnergyAccount& account = accountOf(world, contact.dynamicB ? contact.bodyB : contact.bodyA);
    account.isTouching = true;
    if (contact.dynamicA == contact.dynamicB) { return; }
    account.isDriven = account.isDriven || world.bodies[other].def.type == BodyType::kinematic;
    account.isGrounded = account.isGrounded || contact.pressed;
    const Vec2 normal = rotate(world.motions[contact.bodyA].pose.rotation, contact.manifold.normal);
    const double impulse = static_cast<double>(contact.totalImpulse[0]) + static_cast<double>(contact.totalImpulse[1]);
    account.push += (contact.dynamicB ? impulse : -impulse) * toDouble(normal);
}

/// Gears and pulleys hold more than two bodies.
void noteJoint(WorldState& world, std::uint32_t joint) {
    bool isAnchored = false;
    bool isCarried = false;
    const std::span<const std::uint32_t> bodies = world.joints[joint].allBodies();
    for (const std::uint32_t slot : bodies) {
        isAnchored = isAnchored || world.bodies[slot].def.type == BodyType::fixed;
        isCarried = isCarried || world.bodies[slot].def.type == BodyType::kinematic;
    }
    for (const std::uint32_t slot : bodies) {
        if (!world.bodies[slot].isDynamic()) { continue; }
        EnergyAccount& account = accountOf(world, slot);
        account.isDriven = account.isDriven || isCarried;
        account.isAnchored = account.isAnchored || isAnchored;
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
           excessOf(account) > kRounding * account.kinetic;
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
            if (!pair.areDynamic() || hasJoints) { noteContact(world, world.contacts[pair.contact]); }
        }
    } else {
        for (const Contact& contact : group.contacts) { noteContact(world, contact); }
    }
    for (const std::uint32_t joint : group.joints) { noteJoint(world, joint); }
}

double inertiaOf(const Body& body) { return body.inverseInertia > 0 ? body.inertia : 0; }

DVec2 armOf(const WorldState& world, const IslandMotion& island, std::uint32_t slot) {
    return world.motions[slot].center - world.motions[island.root].center - island.center;
}

/// Their centres of mass, and how these move and they turn.
void findIslandMotions(WorldState& world, const TiedGroup& group) {
    std::vector<IslandMotion>& islands = group.desk.islandMotions;
    islands.clear();
    forEachGainer(world, group, [&](std::uint32_t slot, EnergyAccount& account) {
        const std::uint32_t root = world.islands.find(slot);
        if (account.motion == kNoIndex) {
            account.motion = static_cast<std::uint32_t>(islands.size());
            islands.push_back({.root = root});
        }
        IslandMotion& island = islands[account.motion];
        const double mass = world.bodies[slot].mass;
        island.mass += mass;
        island.center += mass * (world.motions[slot].center - world.motions[root].center);
        island.velocity += mass * toDouble(world.motions[slot].velocity);
    });
    for (IslandMotion& island : islands) {
        island.center = (1 / island.mass) * island.center;
        island.velocity = (1 / island.mass) * island.velocity;
    }
    forEachGainer(world, group, [&](std::uint32_t slot, const EnergyAccount& account) {
        IslandMotion& island = islands[account.motion];
        const Body& body = world.bodies[slot];
        const DVec2 arm = armOf(world, island, slot);
        island.inertia += body.mass * dot(arm, arm) + inertiaOf(body);
        island.spin += body.mass * cross(arm, toDouble(world.motions[slot].velocity) - island.velocity) +
                       inertiaOf(body) * static_cast<double>(world.motions[slot].angularVelocity);
    });
    for (IslandMotion& island : islands) { island.spin = island.inertia > 0 ? island.spin / island.inertia : 0; }
}

/// The part of a velocity that the ground did not push along.
DVec2 alongGround(DVec2 velocity, DVec2 push) {
    const double square = dot(push, push);
    return square > 0 ? velocity - (dot(velocity, push) / square) * push : DVec2{};
}

/// Of a group, and of members before a solve.
template <class Visit>
void forEachEntry(const WorldState& world, const SolveDesk& desk, const Visit& visit) {
    for (std::size_t i = 0; i < desk.bodies.size(); ++i) {
        if (isMovable(desk.batch.inertias[i + 1])) {
            visit(world.bodies[desk.bodies[i]], desk.energyEntries[i], desk.bodies[i]);
        }
    }
}

/// What the motion of islands that nothing holds comes to by what pulls at them alone, in so many seconds. Joints with
/// gaps push at two points, and so turn an island from nothing (by ten orders of magnitude in a step, where masses are
/// thousands : 1).
class FreeMotions {
public:
    FreeMotions(WorldState& world, const SolveDesk& desk, double time) : world_(world), desk_(desk), time_(time) {
        before_.resize(desk.islandMotions.size());
        forEachEntry(world, desk, [this](const Body& body, const EnergyEntry& entry, std::uint32_t slot) {
            IslandMotion* const before = motionOf(slot);
            if (before == nullptr) { return; }
            before->mass += body.mass;
            before->center += body.mass * placeBefore(entry, slot);
            before->velocity += body.mass * toDouble(entry.velocityBefore);
            before->keptVelocity += (body.mass * time_) * toDouble(accelerationOf(world_, body));
        });
        for (IslandMotion& before : before_) {
            if (!(before.mass > 0)) { continue; }
            before.center = (1 / before.mass) * before.center;
            before.velocity = (1 / before.mass) * before.velocity;
            before.keptVelocity = before.velocity + (1 / before.mass) * before.keptVelocity;
        }
        forEachEntry(world, desk, [this](const Body& body, const EnergyEntry& entry, std::uint32_t slot) {
            IslandMotion* const before = motionOf(slot);
            if (before == nullptr) { return; }
            const DVec2 arm = placeBefore(entry, slot) - before->center;
            const DVec2 pull = time_ * toDouble(accelerationOf(world_, body));
            const double turn = static_cast<double>(entry.spinBefore) * inertiaOf(body);
            before->spin += body.mass * cross(arm, toDouble(entry.velocityBefore) - before->velocity + pull) + turn +
                            time_ * static_cast<double>(body.torque);
        });
    }

    /// No more than that: damping may have left less. @pre nothing holds the island, or carries it
    void limit(IslandMotion& island, std::size_t place) const {
        const IslandMotion& before = before_[place];
        if (squared(island.velocity) > squared(before.keptVelocity)) { island.keptVelocity = before.keptVelocity; }
        const double most = island.inertia > 0 ? std::fabs(before.spin) / island.inertia : 0;
        island.keptSpin = std::clamp(island.spin, -most, most);
    }

private:
    IslandMotion* motionOf(std::uint32_t slot) {
        const EnergyAccount& account = accountOf(world_, slot);
        const bool isIn = account.solve == desk_.energySolve && account.motion != kNoIndex;
        return isIn ? &before_[account.motion] : nullptr;
    }
    /// Relative to where the root is now.
    DVec2 placeBefore(const EnergyEntry& entry, std::uint32_t slot) {
        const std::uint32_t root = world_.islands.find(slot);
        return world_.motions[slot].center - world_.motions[root].center - toDouble(entry.moved);
    }

    WorldState& world_;
    const SolveDesk& desk_;
    double time_;
    std::vector<IslandMotion> before_;
};

double rigidEnergy(const IslandMotion& island, DVec2 velocity, double spin) {
    return 0.5 * (island.mass * squared(velocity) + island.inertia * squared(spin));
}

/// What is left of the motion relative to that of the island takes back what was gained. The ground pushes an island
/// away from it; how it slides along it, that is none of the ground's doing, and stays: a stack that landed on ice lost
/// most of its momentum otherwise.
void findShares(WorldState& world, SolveDesk& desk, double time) {
    std::optional<FreeMotions> free;
    for (std::size_t i = 0; i < desk.islandMotions.size(); ++i) {
        IslandMotion& island = desk.islandMotions[i];
        const EnergyAccount& account = world.energyAccounts[island.root];
        if (account.isAnchored) {
            island.velocity = {};
            island.spin = 0;
        } else if (account.isGrounded) {
            island.velocity = alongGround(island.velocity, account.push);
            island.spin = 0;
        }
        island.keptVelocity = island.velocity;
        island.keptSpin = island.spin;
        if (account.isJointed && !account.isAnchored && !account.isGrounded) {
            if (!free) { free.emplace(world, desk, time); }
            free->limit(island, i);
        }
        const double rigid = rigidEnergy(island, island.velocity, island.spin);
        const double excess = excessOf(account) - (rigid - rigidEnergy(island, island.keptVelocity, island.keptSpin));
        const double relative = account.kinetic - rigid;
        if (excess > 0) { island.share = relative > excess ? std::sqrt(1 - excess / relative) : 0; }
    }
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
    const double part = world.jointChains.isAnyLoose ? kRounding : kJointedPart;
    const auto hasGainedAnything = [&](std::uint32_t root) {  // not known yet whether by joints: in either case
        const EnergyAccount& account = world.energyAccounts[root];
        return hasGained(account) || (hasJoints && account.gained - account.work > part * account.kinetic);
    };
    if (std::none_of(roots.begin(), roots.end(), hasGainedAnything)) { return; }
    if (hasJoints) { noteJointed(world, group); }
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
    findIslandMotions(world, group);
    findShares(world, group.desk, static_cast<double>(time));
    forEachGainer(world, group, [&](std::uint32_t slot, const EnergyAccount& account) {
        const IslandMotion& island = group.desk.islandMotions[account.motion];
        BodyMotion& motion = world.motions[slot];
        const DVec2 arm = armOf(world, island, slot);
        const DVec2 across{-arm.y, arm.x};
        const DVec2 relative = toDouble(motion.velocity) - island.velocity - island.spin * across;
        motion.velocity = toReal(island.keptVelocity + island.keptSpin * across + island.share * relative);
        if (!(world.bodies[slot].inverseInertia > 0)) { return; }
        const auto spin = static_cast<double>(motion.angularVelocity);
        motion.angularVelocity = static_cast<Real>(island.keptSpin + island.share * (spin - island.spin));
    });
}

}  // namespace swept::inline SWEPT_PRECISION
