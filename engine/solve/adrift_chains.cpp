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

/// The accounts of chains that drift in a solve, and their members there.
class AdriftChains {
public:
    AdriftChains(const WorldState& world, const TiedGroup& group)
        : world_(world), group_(group), spins_(group.desk.chainSpins) {
        spins_.assign(isOne_ ? 1 : world.jointChains.list.size(), {});
    }

    /// Sums over the members of each chain, m its mass: Σm, Σm·c and Σm·v, before the solve and after it. Whose members
    /// are not all there, are pulled apart, or turned by something else, is dropped.
    void addUpMotions() {
        forEachMember([this](ChainSpin& spin, std::uint32_t slot, DVec2 before, const BodyState& state) {
            const Body& body = world_.bodies[slot];
            const Vec2 acceleration = accelerationOf(world_, body);
            if (spin.bodies++ == 0) { spin.acceleration = acceleration; }
            spin.isKept = keepsSpin(body) && acceleration == spin.acceleration;
            spin.touches = spin.touches || body.hasContact;
            spin.mass += body.mass;
            spin.before.center += body.mass * before;
            spin.before.velocity += body.mass * toDouble(world_.motions[slot].velocity);
            spin.after.center += body.mass * (before + toDouble(state.deltaPosition));
            spin.after.velocity += body.mass * toDouble(state.velocity);
        });
        bool touch = false;
        for (ChainSpin& spin : spins_) {
            spin.isKept = spin.isKept && spin.bodies > 0 && spin.bodies == spin.members;
            // What an island meets on its way its bodies do not know.
            touch = touch || (spin.isKept && (spin.touches || isOne_));
        }
        if (touch) { dropTouched(world_, group_, spins_); }
    }

    /// Centre and velocity of each chain as a whole: Σm·c / Σm, Σm·v / Σm. @return whether there is any chain left
    bool findWholes() {
        bool isAny = false;
        for (ChainSpin& spin : spins_) {
            if (!spin.isKept) { continue; }
            for (ChainSpin::Whole* const whole : {&spin.before, &spin.after}) {
                whole->center = (1 / spin.mass) * whole->center;
                whole->velocity = (1 / spin.mass) * whole->velocity;
            }
            isAny = true;
        }
        return isAny;
    }

    /// About the centre of its chain each member has the inertia m·|r|² + I and the spin m·r × (v − V) + I·ω: the sum
    /// of the first after the solve, and what the sum of the second gained in it.
    void addUpSpins() {
        forEachMember([this](ChainSpin& spin, std::uint32_t slot, DVec2 before, const BodyState& state) {
            const Body& body = world_.bodies[slot];
            const BodyMotion& motion = world_.motions[slot];
            const DVec2 armBefore = before - spin.before.center;
            const DVec2 arm = before + toDouble(state.deltaPosition) - spin.after.center;
            spin.inertia += body.mass * dot(arm, arm) + body.inertia;
            spin.gained += body.mass * (cross(arm, toDouble(state.velocity) - spin.after.velocity) -
                                        cross(armBefore, toDouble(motion.velocity) - spin.before.velocity)) +
                           body.inertia * static_cast<double>(state.angularVelocity - motion.angularVelocity);
        });
    }

    /// The chain turns as one by what it gained, over its inertia, less.
    void turnBack() {
        const Real maxSpeed = world_.settings.maxSpeed;
        forEachMember([maxSpeed](ChainSpin& spin, std::uint32_t, DVec2 before, BodyState& state) {
            const double change = -spin.gained / spin.inertia;
            if (!std::isfinite(change)) { return; }
            const DVec2 arm = before + toDouble(state.deltaPosition) - spin.after.center;
            state.velocity += toReal(change * DVec2{-arm.y, arm.x});
            const Real speed = length(state.velocity);
            if (speed > maxSpeed) { state.velocity = (maxSpeed / speed) * state.velocity; }
            state.angularVelocity += static_cast<Real>(change);
        });
    }

private:
    /// Of chains that are still kept: calls `visit(spin, slot, center, state)` with the centre of the member before the
    /// solve, relative to that of the lowest one.
    template <class Visit>
    void forEachMember(const Visit& visit) {
        const JointChains& chains = world_.jointChains;
        SolveDesk& desk = group_.desk;
        for (std::size_t i = 0; i < desk.bodies.size(); ++i) {
            const std::uint32_t slot = desk.bodies[i];
            if (world_.bodies[slot].holdingJoints == 0 || !isMovable(desk.batch.inertias[i + 1])) { continue; }
            if (desk.isExactOf(static_cast<BodySlot>(i + 1))) { continue; }
            const std::uint32_t place = adriftChainOf(world_, slot);
            if (place == kNoIndex) { continue; }
            ChainSpin& spin = spins_[isOne_ ? 0 : place];
            if (!spin.isKept) { continue; }
            spin.members = chains.list[place].bodies;
            const DVec2 before = world_.motions[slot].center - world_.motions[chains.list[place].lowest].center;
            visit(spin, slot, before, desk.batch.states[i + 1]);
        }
    }

    const WorldState& world_;
    const TiedGroup& group_;
    /// What goes from impact to impact is one island, and is solved many times in a step.
    const bool isOne_ = group_.role != BodyRole::solved;
    std::vector<ChainSpin>& spins_;  ///< by place in the list of chains, or of the one alone
};

}  // namespace

void keepSpinOfAdrift(const WorldState& world, const TiedGroup& group) {
    const JointChains& chains = world.jointChains;
    if (!chains.isAnyAdrift || chains.tieSleepers || group.joints.empty()) { return; }
    if (group.desk.isExact && !group.desk.anyLeft) { return; }
    AdriftChains adrift(world, group);
    adrift.addUpMotions();
    if (!adrift.findWholes()) { return; }
    adrift.addUpSpins();
    adrift.turnBack();
}

}  // namespace swept::inline SWEPT_PRECISION
