#include <algorithm>
#include <atomic>
#include <cmath>
#include <span>
#include <vector>

#include "../bodies/body_mass.h"
#include "../contacts/parked_contacts.h"
#include "../solve/joint_results.h"
#include "../state/number_range.h"
#include "step.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Bodies per block of a parallel loop.
constexpr std::size_t kGuardGrain = 256;

/// Impulses to start from, and points, that belong to a state that is gone. @pre no contact of the body is parked:
/// those with points are counted
void forgetContactsOf(WorldState& world, std::uint32_t slot) {
    for (Contact& contact : world.contacts) {
        if (contact.bodyA != slot && contact.bodyB != slot) { continue; }
        contact.normalImpulse = contact.tangentImpulse = contact.totalImpulse = {};
        contact.manifold.count = 0;
        contact.isKept = false;
    }
    for (const std::uint32_t index : world.bodies[slot].joints) { forgetImpulses(world.joints[index]); }
}

/// No part of it is larger than `kLargestNumber` unless the sum is.
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
    forgetContactsOf(world, slot);
}

/// By slot: those whose state overflowed, and what joints tie to them. Of these some have a state that is a number and
/// nothing else: which, no two instruction sets agree on. Nor would joints to what is put back hold them.
std::vector<bool> findOverflown(const WorldState& world) {
    std::vector<bool> isOverflown(world.bodies.slotCount());
    std::vector<std::uint32_t> reached;
    for (const std::uint32_t slot : world.awake) {
        isOverflown[slot] = !isSound(world.motions[slot]);
        if (isOverflown[slot]) { reached.push_back(slot); }
    }
    for (std::size_t i = 0; i < reached.size(); ++i) {  // grows as it goes
        for (const std::uint32_t index : world.bodies[reached[i]].joints) {
            if (!std::binary_search(world.activeJoints.begin(), world.activeJoints.end(), index)) { continue; }
            for (const std::uint32_t slot : world.joints[index].allBodies()) {
                if (isOverflown[slot] || !world.bodies[slot].isDynamic()) { continue; }
                isOverflown[slot] = true;
                reached.push_back(slot);
            }
        }
    }
    return isOverflown;
}

}  // namespace

bool isSound(const BodyMotion& motion) {
    return isInRange(motion.center) && isInRange(motion.angle) && isInRange(motion.velocity) &&
           isInRange(static_cast<double>(motion.angularVelocity));
}

void putBackOverflown(WorldState& world) {
    if (areSound(world)) { return; }
    const std::vector<bool> isOverflown = findOverflown(world);
    if (!world.parked.woken.empty()) { unparkContacts(world); }  // of what a bullet woke in this step
    // What was put back after the solve may be so again, with what a joint ties it to: it is told once.
    std::vector<bool> isTold(isOverflown.size());
    for (const BodyId id : world.bodiesPutBack) { isTold[id.index] = true; }
    for (const std::uint32_t slot : world.awake) {
        if (!isOverflown[slot]) { continue; }
        putBack(world, slot);
        if (isTold[slot]) { continue; }
        ++world.counters.putBack;
        world.bodiesPutBack.push_back(world.bodies.idOf(slot));
    }
    std::erase_if(world.contactEvents, [](const ContactEvent& event) {
        return !isInRange(event.point) || !isInRange(event.normal) || !isInRange(event.fraction) ||
               !isInRange(static_cast<double>(event.approachSpeed)) || !isInRange(static_cast<double>(event.impulse));
    });
    std::erase_if(world.impactPoses, [](const ImpactPose& pose) {
        return !isInRange(pose.position) || !isInRange(pose.angle) || !isInRange(pose.fraction);
    });
}

}  // namespace swept::inline SWEPT_PRECISION
