#include "remainder_loads.h"

#include "joint_growth.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Up to twice as long, impulses of joints follow steps (step_change.h).
constexpr double kMuchShorter = 1.0 / 2;

void rememberContacts(WorldState& world) {
    for (const ContactProbe& probe : world.probes) {
        const Contact& contact = world.contacts[probe.contact];
        if (!contact.pressed || !contact.isSolid()) { continue; }
        world.remainderLoads.contacts.push_back({.contact = probe.contact,
                                                 .points = contact.manifold.count,
                                                 .normalImpulse = contact.normalImpulse,
                                                 .tangentImpulse = contact.tangentImpulse,
                                                 .pressedOn = contact.pressedOn});
    }
}

/// Whether the energies of what it belongs to were put right, and it begins anew (energy_calm.cpp).
bool isCalmed(const Contact& contact) { return contact.pressed && contact.normalImpulse == std::array<Real, 2>{}; }

void goOn(Contact& contact, const ContactStart& start) {
    if (contact.manifold.count != start.points) { return; }
    contact.pressedOn = start.pressedOn;  // what began in such steps may be a blow
    if (!start.pressedOn || isCalmed(contact)) { return; }
    contact.normalImpulse = start.normalImpulse;
    contact.tangentImpulse = start.tangentImpulse;
    contact.pressed = true;  // a moment without is less than it takes to lift off
}

/// Unless it was calmed, likewise.
void goOn(Joint& joint, std::uint32_t index, const JointStart& before) {
    const JointStart now = startOf(joint, index);
    if (now.impulses != std::array<Real, JointStart::kMost>{}) { setStart(joint, before); }
}

}  // namespace

void noteStepLength(WorldState& world, double dt) {
    RemainderSteps& steps = world.remainder;
    steps.time += dt;
    steps.isOne = dt < kMuchShorter * steps.whole && steps.time <= steps.whole;
    if (!steps.isOne) { steps = {.whole = dt}; }
}

void rememberLoads(WorldState& world) {
    world.remainderLoads.contacts.clear();
    world.remainderLoads.joints.clear();
    rememberContacts(world);
    for (const std::uint32_t i : world.activeJoints) {
        world.remainderLoads.joints.push_back(startOf(world.joints[i], i));
    }
}

void goOnWithLoads(WorldState& world) {
    for (const ContactStart& start : world.remainderLoads.contacts) { goOn(world.contacts[start.contact], start); }
    for (const JointStart& start : world.remainderLoads.joints) {
        if (world.joints.isAlive(start.joint)) { goOn(world.joints[start.joint], start.joint, start); }
    }
}

}  // namespace swept::inline SWEPT_PRECISION
