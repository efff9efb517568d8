#include "energy_guard.h"

#include <algorithm>
#include <cmath>

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Rounding of velocities, as a part of the kinetic energy.
constexpr double kRounding = 8 * static_cast<double>(kEpsilon);
/// What rests trembles by its contacts' give: this part of the energy that it would gain in free fall is no gain.
constexpr double kTremble = 1.0 / 1024;

/// Of this part of its energy islands with joints may gain anything. And nets give way: one that sags swings back with
/// what its gaps held, by four times as much in a step as it would gain in free fall. What takes turns with contacts is
/// held closer: it bursts with up to hundreds of times that.
constexpr double kJointedPart = 1.0 / 64;
constexpr double kMostFalls = 16;
constexpr double kMostFallsInTouch = 1.0 / 4;

double excessOf(const EnergyAccount& account) { return account.gained - std::max(account.work, 0.0); }

/// @param falls  that joints may give back
bool hasGained(const EnergyAccount& account, double falls) {
    if (account.isJointed) {  // without a fall nothing tells what is much
        return account.fall > 0 && excessOf(account) > kJointedPart * account.kinetic + falls * account.fall;
    }
    return excessOf(account) > kRounding * account.kinetic + kTremble * account.fall;
}
bool hasGained(const EnergyAccount& account) {
    return hasGained(account, account.isTouching ? kMostFallsInTouch : kMostFalls);
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

/// Joints that are solved exactly have accounts of their own (`JointIsland`).
void noteJoint(WorldState& world, const TiedGroup& group, std::uint32_t joint) {
    const JointTie& tie = world.jointTies[joint];
    const bool isPassive = tie.isPassive && group.effort.direct != DirectScope::islands;
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
        account.isDriven = account.isDriven || !isPassive || isCarried;
        account.isAnchored = account.isAnchored || isAnchored;
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
    for (const std::uint32_t joint : group.joints) { noteJoint(world, group, joint); }
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

/// What is left of the motion relative to that of the island takes back what was gained. The ground pushes an island
/// away from it; how it slides along it, that is none of the ground's doing, and stays: a stack that landed on ice lost
/// most of its momentum otherwise.
void findShares(WorldState& world, SolveDesk& desk) {
    for (IslandMotion& island : desk.islandMotions) {
        const EnergyAccount& account = world.energyAccounts[island.root];
        if (account.isAnchored) {
            island.velocity = {};
            island.spin = 0;
        } else if (account.isGrounded) {
            island.velocity = alongGround(island.velocity, account.push);
            island.spin = 0;
        }
        const double rigid =
            0.5 * (island.mass * dot(island.velocity, island.velocity) + island.inertia * island.spin * island.spin);
        const double relative = account.kinetic - rigid;
        island.share = relative > excessOf(account) ? std::sqrt(1 - excessOf(account) / relative) : 0;
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
        entry.fall = half * dot(pull, pull) * squared(static_cast<double>(time));
    }
    if (body.inverseInertia > 0) {
        const double half = 0.5 / static_cast<double>(body.inverseInertia);
        const double after = squared(static_cast<double>(state.angularVelocity));
        entry.turningKinetic = half * after;
        entry.turningGained = half * (after - squared(static_cast<double>(before.angularVelocity)));
        entry.turningWork = static_cast<double>(body.torque) * static_cast<double>(state.deltaAngle);
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

void settleAccounts(WorldState& world, const TiedGroup& group) {
    const std::vector<std::uint32_t>& roots = group.desk.energyRoots;
    const auto hasGainedAnything = [&](std::uint32_t root) { return hasGained(world.energyAccounts[root]); };
    if (std::none_of(roots.begin(), roots.end(), hasGainedAnything)) { return; }
    for (const std::uint32_t joint : group.joints) {
        const JointTie& tie = world.jointTies[joint];
        accountOf(world, world.bodies[tie.bodyA].isDynamic() ? tie.bodyA : tie.bodyB).isJointed = true;
    }
    const auto mayHaveGained = [&](std::uint32_t root) {
        return hasGained(world.energyAccounts[root], kMostFallsInTouch);
    };
    if (std::none_of(roots.begin(), roots.end(), mayHaveGained)) { return; }
    noteOthers(world, group);
    // What platforms carry gains all the time, and is driven.
    const auto pays = [&](std::uint32_t root) {
        return hasGained(world.energyAccounts[root]) && !world.energyAccounts[root].isDriven;
    };
    if (std::none_of(roots.begin(), roots.end(), pays)) { return; }
    findIslandMotions(world, group);
    findShares(world, group.desk);
    forEachGainer(world, group, [&](std::uint32_t slot, const EnergyAccount& account) {
        const IslandMotion& island = group.desk.islandMotions[account.motion];
        BodyMotion& motion = world.motions[slot];
        const DVec2 arm = armOf(world, island, slot);
        const DVec2 rigid = island.velocity + island.spin * DVec2{-arm.y, arm.x};
        motion.velocity = toReal(rigid + island.share * (toDouble(motion.velocity) - rigid));
        if (!(world.bodies[slot].inverseInertia > 0)) { return; }
        const auto spin = static_cast<double>(motion.angularVelocity);
        motion.angularVelocity = static_cast<Real>(island.spin + island.share * (spin - island.spin));
    });
}

}  // namespace swept::inline SWEPT_PRECISION
