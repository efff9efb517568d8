#include <algorithm>
#include <atomic>
#include <cmath>
#include <span>

#include "joint_builder.h"
#include "number_range.h"
#include "step.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Bodies per block of a parallel loop.
constexpr std::size_t kGuardGrain = 256;

bool isSound(const BodyMotion& motion) {
    return isInRange(motion.center) && isInRange(motion.angle) && isInRange(motion.velocity) &&
           isInRange(static_cast<double>(motion.angularVelocity));
}

/// Impulses to start from that belong to a state that is gone.
void forgetImpulsesOf(WorldState& world, std::uint32_t slot) {
    for (Contact& contact : world.contacts) {
        if (contact.bodyA != slot && contact.bodyB != slot) { continue; }
        contact.normalImpulse = contact.tangentImpulse = contact.totalImpulse = {};
    }
    for (const std::uint32_t index : world.bodies[slot].joints) { forgetImpulses(world.joints[index]); }
}

/// What is no larger than `kLargestNumber` has no part that is.
double sumOfParts(const BodyMotion& motion) {
    return (std::fabs(motion.center.x) + std::fabs(motion.center.y) + std::fabs(motion.angle)) +
           static_cast<double>(std::fabs(motion.velocity.x)) + static_cast<double>(std::fabs(motion.velocity.y)) +
           static_cast<double>(std::fabs(motion.angularVelocity));
}

/// As always, but for input at the ends of what can be written: a sum over all of them tells it.
bool areSound(const WorldState& world) {
    std::atomic<bool> isAnyUnsound = false;
    world.loops->run(world.awake.size(), kGuardGrain, [&](std::size_t begin, std::size_t end, int) {
        const std::span<const std::uint32_t> slots = std::span(world.awake).subspan(begin, end - begin);
        double sum = 0;
        for (const std::uint32_t slot : slots) { sum += sumOfParts(world.motions[slot]); }
        const auto isOneSound = [&world](std::uint32_t slot) { return isSound(world.motions[slot]); };
        if (isInRange(sum) || std::all_of(slots.begin(), slots.end(), isOneSound)) { return; }
        isAnyUnsound.store(true, std::memory_order_relaxed);
    });
    return !isAnyUnsound;
}

void putBack(WorldState& world, std::uint32_t slot) {
    const Body& body = world.bodies[slot];
    BodyMotion& motion = world.motions[slot];
    motion.center = body.startCenter;
    motion.angle = body.startAngle;
    motion.velocity = {};
    motion.angularVelocity = 0;
    updatePose(world, slot);
    forgetImpulsesOf(world, slot);
    ++world.counters.putBack;
    world.bodiesPutBack.push_back(world.bodies.idOf(slot));
}

}  // namespace

void putBackOverflown(WorldState& world) {
    if (areSound(world)) { return; }
    for (const std::uint32_t slot : world.awake) {
        if (!isSound(world.motions[slot])) { putBack(world, slot); }
    }
    std::erase_if(world.contactEvents, [](const ContactEvent& event) {
        return !isInRange(event.point) || !isInRange(event.normal) || !isInRange(event.fraction) ||
               !isInRange(static_cast<double>(event.approachSpeed)) || !isInRange(static_cast<double>(event.impulse));
    });
}

}  // namespace swept::inline SWEPT_PRECISION
