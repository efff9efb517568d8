#include "number_range.h"
#include "step.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

bool isSound(const BodyMotion& motion) {
    return isInRange(motion.center) && isInRange(motion.angle) && isInRange(motion.velocity) &&
           isInRange(static_cast<double>(motion.angularVelocity));
}

/// Impulses to start from that belong to a state that is gone.
void forgetImpulses(WorldState& world, std::uint32_t slot) {
    for (Contact& contact : world.contacts) {
        if (contact.bodyA != slot && contact.bodyB != slot) { continue; }
        contact.normalImpulse = contact.tangentImpulse = contact.totalImpulse = {};
    }
    for (const std::uint32_t index : world.bodies[slot].joints) {
        Joint& joint = world.joints[index];
        std::visit(
            [](auto& part) {
                if constexpr (requires { part.memory; }) { part.memory = {}; }
            },
            joint.parts);
        joint.hinge = {};
        joint.reactionForce = {};
        joint.reactionTorque = 0;
    }
}

void putBack(WorldState& world, std::uint32_t slot) {
    const Body& body = world.bodies[slot];
    BodyMotion& motion = world.motions[slot];
    motion.center = body.startCenter;
    motion.angle = body.startAngle;
    motion.velocity = {};
    motion.angularVelocity = 0;
    updatePose(world, slot);
    forgetImpulses(world, slot);
    ++world.counters.putBack;
}

}  // namespace

void putBackOverflown(WorldState& world) {
    const std::uint64_t before = world.counters.putBack;
    for (const std::uint32_t slot : world.awake) {
        if (!isSound(world.motions[slot])) { putBack(world, slot); }
    }
    if (world.counters.putBack == before) { return; }
    std::erase_if(world.contactEvents, [](const ContactEvent& event) {
        return !isInRange(event.point) || !isInRange(event.normal) || !isInRange(event.fraction) ||
               !isInRange(static_cast<double>(event.approachSpeed)) || !isInRange(static_cast<double>(event.impulse));
    });
}

}  // namespace swept::inline SWEPT_PRECISION
