#include "squeezed_bodies.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "../bodies/body_form.h"
#include "../contacts/contact_making.h"
#include "../containers/any_of.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// What is so many times as heavy as what it presses is not moved by it.
constexpr Real kFarHeavier = 64;

/// Or pressed, and is overlapped so far that it was pushed elsewhere.
bool bearsOn(const Contact& contact) {
    return contact.totalImpulse[0] + contact.totalImpulse[1] > 0 || deepestSeparation(contact.manifold) < 0;
}

class SqueezeLimiter {
public:
    SqueezeLimiter(WorldState& world, const TiedGroup& group, Real time)
        : world_(world), group_(group), desk_(group.desk), islands_(group.desk.squeezed), time_(time) {}

    void limit() {
        if (!mayBeSqueezed()) { return; }
        islands_.resize(world_.bodies.slotCount());
        forEachMovable([this](BodySlot slot) { islandOf(slot) = {}; });
        forEachContact([this](const Contact& contact) { note(contact); });
        if (!isAny_) { return; }
        noteJoints();
        forEachMovable([this](BodySlot slot) {
            SqueezedIsland& island = islandOf(slot);
            island.speed = std::max(island.speed, speedBefore(slot));
        });
        desk_.isLimited.assign(desk_.bodies.size() + 1, 0);
        forEachMovable([this](BodySlot slot) { limitOne(slot); });
        if (!isAnyLimited_) { return; }
        forEachContact([this](Contact& contact) { forget(contact); });
    }

private:
    /// Whether anything presses, and anybody got on faster than the slowest of that lets him.
    bool mayBeSqueezed() const {
        constexpr Real kNothing = std::numeric_limits<Real>::infinity();
        Real slowest = kFarHeavier * world_.leastInverseMass <= world_.mostInverseMass ? Real(0) : kNothing;
        for (const BodySlot slot : desk_.standing) {
            const BodyState& state = desk_.batch.states[slot];
            if (state.velocity == Vec2{} && state.angularVelocity == 0) { continue; }
            slowest = state.angularVelocity == 0 ? std::min(slowest, length(state.velocity)) : Real(0);
        }
        if (!(slowest < kNothing)) { return false; }
        for (std::size_t i = 1; i <= desk_.bodies.size(); ++i) {
            if (isMovable(desk_.batch.inertias[i]) && gains(static_cast<BodySlot>(i), kMostSqueezed * slowest)) {
                return true;
            }
        }
        return false;
    }

    /// Squares first: few are so fast.
    bool gains(BodySlot slot, Real least) const {
        const BodyState& state = desk_.batch.states[slot];
        const BodyInertia& inertia = desk_.batch.inertias[slot];
        const Real most = square(least);
        const Real turn = std::max(square(state.angularVelocity), square(state.deltaAngle / time_));
        if (!(lengthSquared(state.velocity) > most) && !(lengthSquared(state.deltaPosition) > most * square(time_)) &&
            !(turn * inertia.inverseMass > most * inertia.inverseInertia)) {
            return false;
        }
        const Body& body = world_.bodies[desk_.bodies[slot - 1U]];
        const Real way = std::max(length(state.velocity), length(state.deltaPosition) / time_);
        return std::max(way, gyrationOf(body) * std::sqrt(turn)) > speedBefore(slot) + gainOf(body);
    }

    template <class Visit>
    void forEachContact(const Visit& visit) {
        if (group_.role == BodyRole::solved) {
            for (const TouchingPair& pair : world_.touching) { visit(world_.contacts[pair.contact]); }
            return;
        }
        for (Contact& contact : group_.contacts) {
            if (contact.isSolid()) { visit(contact); }
        }
    }

    template <class Visit>
    void forEachMovable(const Visit& visit) const {
        for (std::size_t i = 1; i <= desk_.bodies.size(); ++i) {
            if (isMovable(desk_.batch.inertias[i])) { visit(static_cast<BodySlot>(i)); }
        }
    }

    SqueezedIsland& islandOf(BodySlot slot) const { return islands_[world_.islands.find(desk_.bodies[slot - 1U])]; }

    void note(const Contact& contact) {
        if (!bearsOn(contact)) { return; }
        if (contact.dynamicA) { noteGround(contact, contact.bodyA, contact.bodyB); }
        if (contact.dynamicB) { noteGround(contact, contact.bodyB, contact.bodyA); }
    }

    void noteGround(const Contact& contact, std::uint32_t body, std::uint32_t other) {
        const BodySlot slot = world_.solverSlots[body];
        if (slot == kFixedSlot) { return; }
        const BodySlot ground = world_.solverSlots[other];
        const BodyInertia& inertia = desk_.batch.inertias[ground];
        const bool isHeavy = isMovable(inertia);
        if (isHeavy && !(kFarHeavier * inertia.inverseMass <= desk_.batch.inertias[slot].inverseMass)) { return; }
        SqueezedIsland& island = islandOf(slot);
        const Real drag = contact.isBelt ? std::fabs(surfaceOf(world_, contact).speed) : Real(0);
        island.lead = std::max(island.lead, drag + (ground == kFixedSlot ? Real(0) : leadOf(other, body)));
        const BodySlot number = ground + 1;
        island.isSqueezed = island.isSqueezed || (island.ground != 0 && island.ground != number);
        island.ground = number;
        isAny_ = isAny_ || (island.isSqueezed && island.lead > 0);
    }

    /// How fast one body goes where it touches another one, at most.
    Real leadOf(std::uint32_t leader, std::uint32_t body) const {
        const BodyMotion& motion = world_.motions[leader];
        const Vec2 arm = toReal(world_.motions[body].center - motion.center);
        return length(motion.velocity + cross(motion.angularVelocity, arm)) +
               std::fabs(motion.angularVelocity) * world_.bodies[body].radius + fallOf(world_.bodies[leader]);
    }

    /// What the solve gives it whatever it touches, m/s.
    Real fallOf(const Body& body) const {
        return body.isDynamic() ? length(accelerationOf(world_, body)) * time_ : Real(0);
    }

    /// The same of whatever turns it.
    Real gainOf(const Body& body) const {
        return std::max(fallOf(body), gyrationOf(body) * std::fabs(angularAccelerationOf(body)) * time_);
    }

    /// What motors, springs and targets move is left alone: they give any speed.
    void noteJoints() {
        for (const std::uint32_t i : group_.joints) {
            const JointTie& tie = world_.jointTies[i];
            const bool isDriven = !tie.isPassive || tie.isSprung || tie.isPowered;
            const std::span<const std::uint32_t> bodies = world_.joints[i].allBodies();
            for (const std::uint32_t body : bodies) {
                if (world_.solverSlots[body] == kFixedSlot || !world_.bodies[body].isDynamic()) { continue; }
                SqueezedIsland& island = islands_[world_.islands.find(body)];
                island.isDriven = island.isDriven || isDriven;
                for (const std::uint32_t other : bodies) {
                    if (world_.bodies[other].def.type != BodyType::kinematic) { continue; }
                    island.lead = std::max(island.lead, leadOf(other, body));
                }
            }
        }
    }

    /// As the solve began.
    Real speedBefore(BodySlot slot) const {
        const std::uint32_t body = desk_.bodies[slot - 1U];
        const BodyMotion& motion = world_.motions[body];
        return std::max(length(motion.velocity), gyrationOf(world_.bodies[body]) * std::fabs(motion.angularVelocity));
    }

    void limitOne(BodySlot slot) {
        const SqueezedIsland& island = islandOf(slot);
        if (!island.isSqueezed || !(island.lead > 0) || island.isDriven) { return; }
        const Body& body = world_.bodies[desk_.bodies[slot - 1U]];
        const Real arm = gyrationOf(body);
        const Real most = mostSqueezedSpeed(island.speed + gainOf(body), island.lead);
        BodyState& state = desk_.batch.states[slot];
        bool isLimited = shortenTo(state.velocity, most);
        isLimited = shortenTo(state.deltaPosition, most * time_) || isLimited;
        if (arm > 0) {
            isLimited = shortenTo(state.angularVelocity, most / arm) || isLimited;
            isLimited = shortenTo(state.deltaAngle, most / arm * time_) || isLimited;
        }
        desk_.isLimited[slot] = isLimited ? 1 : 0;
        isAnyLimited_ = isAnyLimited_ || isLimited;
    }

    void forget(Contact& contact) const {
        const auto isLimited = [this](std::uint32_t body) { return desk_.isLimited[world_.solverSlots[body]] != 0; };
        if (!isLimited(contact.bodyA) && !isLimited(contact.bodyB)) { return; }
        contact.normalImpulse = contact.tangentImpulse = {};
    }

    WorldState& world_;
    const TiedGroup& group_;
    SolveDesk& desk_;
    std::vector<SqueezedIsland>& islands_;
    Real time_;
    bool isAny_ = false;
    bool isAnyLimited_ = false;
};

}  // namespace

void limitSqueezed(WorldState& world, const TiedGroup& group, Real time) { SqueezeLimiter(world, group, time).limit(); }

}  // namespace swept::inline SWEPT_PRECISION
