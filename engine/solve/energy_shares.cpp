#include "energy_shares.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "energy_gain.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

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
    forEachMoved(desk,
                 [&](std::size_t i, std::uint32_t slot) { visit(world.bodies[slot], desk.energyEntries[i], slot); });
}

/// What the motion of islands that nothing holds comes to by what pulls at them alone, in so many seconds. Joints with
/// gaps push at two points, and so turn an island from nothing (by ten orders of magnitude in a step, where masses are
/// thousands : 1).
class FreeMotions {
public:
    FreeMotions(WorldState& world, SolveDesk& desk, double time)
        : world_(world), desk_(desk), time_(time), before_(desk.motionsBefore) {
        before_.assign(desk.islandMotions.size(), {});
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
    std::vector<IslandMotion>& before_;
};

double rigidEnergy(const IslandMotion& island, DVec2 velocity, double spin) {
    return 0.5 * (island.mass * squared(velocity) + island.inertia * squared(spin));
}

/// Where all of the motion relative to it is not enough, what joints gained moves the island as a whole. (A chain whose
/// joints contradicted each other as it lay on the ground slid away at 640 m/s.)
/// @param all  kinetic energy that it has now
void slowDown(IslandMotion& island, double excess, double all) {
    const double kept = rigidEnergy(island, island.keptVelocity, island.keptSpin);
    const double left = speedLeft(kept, excess, all);
    island.keptVelocity = left * island.keptVelocity;
    island.keptSpin *= left;
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
        } else if (account.isJointed && hasGainedAtOnce(account) &&
                   !(speedLeft(account.kinetic, excessOf(account), account.kinetic) > 0)) {
            island.keptVelocity = {};  // how it slid along the ground is lost in that, too
            island.keptSpin = 0;
        }
        const double rigid = rigidEnergy(island, island.velocity, island.spin);
        const double paid = rigid - rigidEnergy(island, island.keptVelocity, island.keptSpin);
        const double relative = account.kinetic - rigid;
        const double due = dueOf(account) - paid;
        if (due > 0) { island.share = speedLeft(relative, due, account.kinetic); }
        // Shaking that adds up is all relative.
        const double excess = hasGainedAtOnce(account) ? excessOf(account) - paid : 0;
        if (account.isJointed && excess > relative) { slowDown(island, excess - relative, account.kinetic); }
    }
}

}  // namespace

void takeBackGains(WorldState& world, const TiedGroup& group, double time) {
    findIslandMotions(world, group);
    findShares(world, group.desk, time);
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
