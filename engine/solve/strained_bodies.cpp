#include "strained_bodies.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "../../shapes/compiler.h"
#include "../state/profile.h"
#include "joint_builder.h"
#include "torn_joints.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Behind those of the bodies, the desk's grounds hold what presses bodies of several grounds: two entries for each,
/// its place among the contacts, and the entry of what presses the same body and was found before it (0: nothing).
constexpr std::uint32_t kSeveral = 1U << 31;  ///< a body has several grounds: this, and the entry of its last push

/// Two pushes hold a body between them by friction of up to three quarters: from less opposed ones it slips out. So
/// what presses at right angles, as a wall beside a floor, strains nothing.
constexpr Real kOpposed = -Real(1) / 4;  ///< cosine between them
/// Pushes of one ground that are so alike count once: what lies on a thousand segments has one.
constexpr Real kAlike = Real(63) / 64;  ///< likewise
/// From this part of the extent on, an overlap does not tell from where a body is pushed: what is squeezed that far may
/// come out sideways, or on the other side.
constexpr Real kTurnedRatio = Real(1) / 4;

bool presses(const Contact& contact) {
    for (std::size_t k = 0; k < static_cast<std::size_t>(contact.manifold.count); ++k) {
        if (contact.normalImpulse[k] > 0 || contact.manifold.points[k].separation < 0) { return true; }
    }
    return false;
}

bool mayBeTurned(const Contact& contact) {
    return deepestSeparation(contact.manifold) < -kTurnedRatio * contact.extent;
}

class StrainFinder {
public:
    StrainFinder(const WorldState& world, const TiedGroup& group)
        : world_(world), group_(group), grounds_(group.desk.grounds) {}

    void find() {
        const std::size_t slots = group_.desk.bodies.size() + 1;
        grounds_.assign(slots, 0);
        if (!group_.desk.standing.empty()) { noteGrounds(); }
        grounds_.resize(slots);
        for (const std::uint32_t i : group_.joints) {
            const Joint& joint = world_.joints[i];
            if (isTouching(world_, joint) && isTorn(joint)) { notePulled(joint); }
        }
        if (!any_) { grounds_.clear(); }
    }

private:
    /// Few bodies have several grounds: how contacts push is looked at for those alone.
    void noteGrounds() {
        if (group_.role == BodyRole::solved) {
            for (const TouchingPair& pair : world_.touching) { noteGround(pair); }
        } else {
            for (const Contact& contact : group_.contacts) {
                if (contact.isSolid()) { noteGround(contact); }
            }
        }
        grounds_[kFixedSlot] = 0;
        if (haveSeveral_) { notePushes(); }
    }

    void notePushes() {
        if (group_.role == BodyRole::solved) {
            for (const TouchingPair& pair : world_.touching) { notePush(pair, world_.contacts, pair.contact); }
            return;
        }
        for (std::size_t i = 0; i < group_.contacts.size(); ++i) {
            const Contact& contact = group_.contacts[i];
            if (contact.isSolid()) { notePush(contact, group_.contacts, static_cast<std::uint32_t>(i)); }
        }
    }

    /// @pre one of the pair is dynamic
    template <class Pair>
    BodySlot slotOf(const Pair& pair) const {
        return world_.solverSlots[pair.dynamicBody()];
    }

    /// What is fixed is all one; of what is not dynamic only kinematic bodies have slots. So of two different grounds
    /// one is kinematic. @pre the other one is not
    template <class Pair>
    BodySlot groundOf(const Pair& pair) const {
        return world_.solverSlots[pair.dynamicA ? pair.bodyB : pair.bodyA];
    }

    template <class Pair>
    SWEPT_FORCE_INLINE void noteGround(const Pair& pair) {
        if (pair.dynamicA == pair.dynamicB) { return; }
        std::uint32_t& noted = grounds_[slotOf(pair)];
        const std::uint32_t ground = std::uint32_t{groundOf(pair)} + 1;
        if (noted == ground) { return; }
        haveSeveral_ = haveSeveral_ || noted != 0;
        noted = noted == 0 ? ground : kSeveral;
    }

    /// Of the ground on the dynamic body.
    Vec2 pushOf(const Contact& contact) const {
        const Vec2 onB = rotate(world_.motions[contact.bodyA].pose.rotation, contact.manifold.normal);
        return contact.dynamicB ? onB : -onB;
    }

    template <class Pair>
    SWEPT_FORCE_INLINE void notePush(const Pair& pair, std::span<const Contact> contacts, std::uint32_t place) {
        if (pair.dynamicA == pair.dynamicB) { return; }
        const std::uint32_t noted = grounds_[slotOf(pair)];
        if (noted < kSeveral || noted == kStrained) { return; }
        if (presses(contacts[place])) { comparePush(contacts, place, noted - kSeveral); }
    }

    void comparePush(std::span<const Contact> contacts, std::uint32_t place, std::uint32_t last) {
        const Contact& contact = contacts[place];
        const Vec2 push = pushOf(contact);
        const bool isTurned = mayBeTurned(contact);
        for (std::size_t entry = last; entry != 0; entry = grounds_[entry + 1]) {
            const Contact& other = contacts[grounds_[entry]];
            const Real cosine = dot(push, pushOf(other));
            const bool isOtherTurned = mayBeTurned(other);
            if (groundOf(other) != groundOf(contact)) {
                if (cosine < kOpposed || isTurned || isOtherTurned) { return noteStrained(slotOf(contact)); }
            } else if (cosine > kAlike && (isOtherTurned || !isTurned)) {
                return;
            }
        }
        grounds_[slotOf(contact)] = kSeveral + static_cast<std::uint32_t>(grounds_.size());
        grounds_.push_back(place);
        grounds_.push_back(last);
    }

    void noteStrained(BodySlot slot) {
        grounds_[slot] = kStrained;
        any_ = true;
    }

    bool isTorn(const Joint& joint) const {
        const JointErrors held = errorsOf(world_, joint);
        const JointErrors limits = limitErrorsOf(world_, joint);
        return pullOf(world_, joint, {std::max(held.length, limits.length), std::max(held.angle, limits.angle)}) < 1;
    }

    void notePulled(const Joint& joint) {
        for (const std::uint32_t body : joint.allBodies()) {
            const BodySlot slot = world_.solverSlots[body];
            if (!world_.bodies[body].isDynamic() || slot == kFixedSlot) { continue; }
            noteStrained(slot);
        }
    }

    const WorldState& world_;
    const TiedGroup& group_;
    std::vector<std::uint32_t>& grounds_;
    bool haveSeveral_ = false;  ///< some body may have several grounds
    bool any_ = false;          ///< is strained
};

}  // namespace

void findStrained(const WorldState& world, const TiedGroup& group) {
    group.desk.grounds.clear();
    if (world.kinematicBodies == 0 || groundCyclesOf(world.settings) == kContactCycles) { return; }
    StrainFinder(world, group).find();
}

}  // namespace swept::inline SWEPT_PRECISION
