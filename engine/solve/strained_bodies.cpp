#include "strained_bodies.h"

#include <algorithm>
#include <vector>

#include "../../shapes/compiler.h"
#include "../state/profile.h"
#include "joint_builder.h"
#include "torn_joints.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

class StrainFinder {
public:
    StrainFinder(const WorldState& world, const TiedGroup& group)
        : world_(world), group_(group), grounds_(group.desk.grounds) {}

    void find() {
        grounds_.assign(group_.desk.bodies.size() + 1, 0);
        if (!group_.desk.standing.empty()) { noteGrounds(); }
        grounds_[kFixedSlot] = 0;
        for (const std::uint32_t i : group_.joints) {
            const Joint& joint = world_.joints[i];
            if (isTouching(world_, joint) && isTorn(joint)) { notePulled(joint); }
        }
        if (!any_) { grounds_.clear(); }
    }

private:
    void noteGrounds() {
        if (group_.role == BodyRole::solved) {
            for (const TouchingPair& pair : world_.touching) { noteGround(pair); }
            return;
        }
        for (const Contact& contact : group_.contacts) {
            if (contact.isSolid()) { noteGround(contact); }
        }
    }

    /// What is fixed is all one; of what is not dynamic only kinematic bodies have slots. So of two different grounds
    /// one is kinematic.
    template <class Pair>
    SWEPT_FORCE_INLINE void noteGround(const Pair& pair) {
        if (pair.dynamicA == pair.dynamicB) { return; }
        const BodySlot slotA = world_.solverSlots[pair.bodyA];
        const BodySlot slotB = world_.solverSlots[pair.bodyB];
        std::uint32_t& noted = grounds_[pair.dynamicA ? slotA : slotB];
        const std::uint32_t ground = std::uint32_t{pair.dynamicA ? slotB : slotA} + 1;
        if (noted == ground) { return; }
        any_ = any_ || noted != 0;
        noted = noted == 0 ? ground : kStrained;
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
            grounds_[slot] = kStrained;
            any_ = true;
        }
    }

    const WorldState& world_;
    const TiedGroup& group_;
    std::vector<std::uint32_t>& grounds_;
    bool any_ = false;
};

}  // namespace

void findStrained(const WorldState& world, const TiedGroup& group) {
    group.desk.grounds.clear();
    if (!mayTear(world) || groundCyclesOf(world.settings) == kContactCycles) { return; }
    StrainFinder(world, group).find();
}

}  // namespace swept::inline SWEPT_PRECISION
