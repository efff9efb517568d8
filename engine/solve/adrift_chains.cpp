#include "adrift_chains.h"

#include <cmath>
#include <cstdint>
#include <vector>

#include "energy_gain.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Where it is in the list of chains; `kNoIndex` of what is no chain that drifts by itself.
std::uint32_t adriftChainOf(const WorldState& world, std::uint32_t slot) {
    const JointChains& chains = world.jointChains;
    const std::uint32_t lowest = world.islands.rootOf(slot);  // of an island that is a chain and nothing else
    if (lowest >= chains.places.size()) { return kNoIndex; }  // it is younger than the chains
    const std::uint32_t place = chains.places[lowest];
    const bool isChain = place < chains.list.size() && chains.list[place].lowest == lowest;
    return isChain && chains.list[place].isAdrift ? place : kNoIndex;
}

/// Whether nothing turns it but its joints, and what it touches of dynamic bodies.
bool keepsSpin(const Body& body) {
    const bool isDamped = body.def.linearDamping != 0 || body.def.angularDamping != 0;
    const bool isFree = body.inverseMass > 0 && body.inverseInertia > 0;
    return isFree && (!body.hasContact || body.touchesDynamic) && body.torque == 0 && !isDamped;
}

/// What touches something that is not of the chain is turned by it. @pre of each chain that is kept all joined bodies
/// of its island are in it
void dropTouched(const WorldState& world, const TiedGroup& group, std::vector<ChainSpin>& spins) {
    const auto look = [&](std::uint32_t a, std::uint32_t b, bool areDynamic) {
        const std::uint32_t own = world.bodies[a].isDynamic() ? a : b;
        const std::uint32_t place = adriftChainOf(world, own);
        if (place == kNoIndex) { return; }
        const bool isInside = areDynamic && world.bodies[a].holdingJoints > 0 && world.bodies[b].holdingJoints > 0;
        ChainSpin& spin = spins[group.role != BodyRole::solved ? 0 : place];
        spin.isKept = spin.isKept && isInside;
    };
    if (group.role == BodyRole::solved) {
        for (const TouchingPair& pair : world.touching) { look(pair.bodyA, pair.bodyB, pair.areDynamic()); }
        return;
    }
    for (const Contact& contact : group.contacts) {
        if (contact.isSolid()) { look(contact.bodyA, contact.bodyB, contact.dynamicA && contact.dynamicB); }
    }
}

}  // namespace

void keepSpinOfAdrift(const WorldState& world, const TiedGroup& group) {
    const JointChains& chains = world.jointChains;
    SolveDesk& desk = group.desk;
    const bool isExact = group.effort.direct == DirectScope::islands;
    if (!chains.isAnyAdrift || chains.tieSleepers || group.joints.empty() || isExact) { return; }
    std::vector<ChainSpin>& spins = desk.chainSpins;
    // What goes from impact to impact is one island, and is solved many times in a step.
    const bool isOne = group.role != BodyRole::solved;
    spins.assign(isOne ? 1 : chains.list.size(), {});
    const auto forEachMember = [&](const auto& visit) {
        for (std::size_t i = 0; i < desk.bodies.size(); ++i) {
            const std::uint32_t slot = desk.bodies[i];
            if (world.bodies[slot].holdingJoints == 0 || !isMovable(desk.batch.inertias[i + 1])) { continue; }
            const std::uint32_t place = adriftChainOf(world, slot);
            if (place == kNoIndex) { continue; }
            ChainSpin& spin = spins[isOne ? 0 : place];
            if (!spin.isKept) { continue; }
            spin.members = chains.list[place].bodies;
            const DVec2 before = world.motions[slot].center - world.motions[chains.list[place].lowest].center;
            visit(spin, slot, before, desk.batch.states[i + 1]);
        }
    };
    forEachMember([&](ChainSpin& spin, std::uint32_t slot, DVec2 before, const BodyState& state) {
        const Body& body = world.bodies[slot];
        const Vec2 acceleration = accelerationOf(world, body);
        if (spin.bodies++ == 0) { spin.acceleration = acceleration; }
        spin.isKept = keepsSpin(body) && acceleration == spin.acceleration;
        spin.touches = spin.touches || body.hasContact;
        spin.mass += body.mass;
        spin.before.center += body.mass * before;
        spin.before.velocity += body.mass * toDouble(world.motions[slot].velocity);
        spin.after.center += body.mass * (before + toDouble(state.deltaPosition));
        spin.after.velocity += body.mass * toDouble(state.velocity);
    });
    bool touch = false;
    for (ChainSpin& spin : spins) {
        spin.isKept = spin.isKept && spin.bodies > 0 && spin.bodies == spin.members;
        // What an island meets on its way its bodies do not know.
        touch = touch || (spin.isKept && (spin.touches || isOne));
    }
    if (touch) { dropTouched(world, group, spins); }
    bool isAny = false;
    for (ChainSpin& spin : spins) {
        if (!spin.isKept) { continue; }
        for (ChainSpin::Whole* const whole : {&spin.before, &spin.after}) {
            whole->center = (1 / spin.mass) * whole->center;
            whole->velocity = (1 / spin.mass) * whole->velocity;
        }
        isAny = true;
    }
    if (!isAny) { return; }
    forEachMember([&](ChainSpin& spin, std::uint32_t slot, DVec2 before, const BodyState& state) {
        const Body& body = world.bodies[slot];
        const BodyMotion& motion = world.motions[slot];
        const DVec2 armBefore = before - spin.before.center;
        const DVec2 arm = before + toDouble(state.deltaPosition) - spin.after.center;
        spin.inertia += body.mass * dot(arm, arm) + body.inertia;
        spin.gained += body.mass * (cross(arm, toDouble(state.velocity) - spin.after.velocity) -
                                    cross(armBefore, toDouble(motion.velocity) - spin.before.velocity)) +
                       body.inertia * static_cast<double>(state.angularVelocity - motion.angularVelocity);
    });
    forEachMember([&](ChainSpin& spin, std::uint32_t, DVec2 before, BodyState& state) {
        const double change = -spin.gained / spin.inertia;
        if (!std::isfinite(change)) { return; }
        const DVec2 arm = before + toDouble(state.deltaPosition) - spin.after.center;
        state.velocity += toReal(change * DVec2{-arm.y, arm.x});
        const Real speed = length(state.velocity);
        if (speed > world.settings.maxSpeed) { state.velocity = (world.settings.maxSpeed / speed) * state.velocity; }
        state.angularVelocity += static_cast<Real>(change);
    });
}

}  // namespace swept::inline SWEPT_PRECISION
