#include "slides.h"

#include <algorithm>

#include "../state/tolerances.h"
#include "ghosts.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// A point of a contact, and where it presses: along the ground, from the origin of the body.
struct Foot {
    Contact* contact = nullptr;
    std::size_t point = 0;
    Real lever = 0;
};

Real leverOf(Vec2 pointInA, const Transform& bInA, Vec2 normal) {
    return dot(pointInA - bInA.translation, rightPerp(normal));
}

Vec2 toWorld(const WorldState& world, const Contact& contact, Vec2 inA) {
    return rotate(world.motions[contact.bodyA].pose.rotation, inA);
}

/// All that slid on one plane.
struct Load {
    Vec2 normal{};  ///< world
    Real impulse = 0;
    Real tangentImpulse = 0;
    Real moment = 0;

    bool isAlong(Vec2 other) const { return dot(normal, other) > kSameNormal; }
};

Load loadOf(const WorldState& world, const GroundContacts& contacts) {
    Load load;
    for (std::uint32_t i = contacts.first; i != kNoIndex; i = contacts.next[i]) {
        const Contact& contact = contacts.all[i];
        const Slide& slide = contacts.slides[i];
        if (!(slide.impulse > 0)) {
            const std::array<Real, 2>& stays = contact.normalImpulse;
            if (contact.isSolid() && (stays[0] > 0 || stays[1] > 0)) { return {}; }
            continue;
        }
        const Vec2 normal = toWorld(world, contact, slide.normal);
        if (!(load.impulse > 0)) { load.normal = normal; }
        if (!load.isAlong(normal)) { continue; }
        load.impulse += slide.impulse;
        load.tangentImpulse += slide.tangentImpulse;
        load.moment += slide.moment;
    }
    return load;
}

/// The outermost of the points that may carry it; all of them give up what they have.
struct Feet {
    Foot left;
    Foot right;
};

Feet findFeet(const WorldState& world, const GroundContacts& contacts, const Load& load) {
    Feet feet;
    for (std::uint32_t i = contacts.first; i != kNoIndex; i = contacts.next[i]) {
        Contact& contact = contacts.all[i];
        const Manifold& manifold = contact.manifold;
        if (manifold.count == 0 || !load.isAlong(toWorld(world, contact, manifold.normal))) { continue; }
        const Transform bInA = relativeTransform(world.motions[contact.bodyA].pose, world.motions[contact.bodyB].pose);
        for (std::size_t k = 0; k < static_cast<std::size_t>(manifold.count); ++k) {
            contact.normalImpulse[k] = contact.tangentImpulse[k] = 0;
            if (manifold.points[k].separation > kEndRatio * contact.extent) { continue; }
            const Foot foot{&contact, k, leverOf(manifold.points[k].point, bInA, manifold.normal)};
            if (feet.left.contact == nullptr || foot.lever < feet.left.lever) { feet.left = foot; }
            if (feet.right.contact == nullptr || foot.lever > feet.right.lever) { feet.right = foot; }
        }
    }
    return feet;
}

void press(const Foot& foot, Real share, const Load& load) {
    foot.contact->normalImpulse[foot.point] += share * load.impulse;
    foot.contact->tangentImpulse[foot.point] += share * load.tangentImpulse;
    foot.contact->pressed = true;  // though by another name
}

}  // namespace

void noteSlide(Slide& slide, const Contact& contact, const Transform& bInA) {
    slide = {};
    if (contact.dynamicA || !contact.dynamicB || contact.manifold.count == 0 || !contact.pressedOn) { return; }
    const Vec2 normal = contact.manifold.normal;
    const Transform& before = contact.kept.bInA;
    const Vec2 moved = bInA.translation - before.translation;
    if (!(lengthSquared(moved) > square(kSamePlaceRatio * contact.extent))) { return; }
    slide.normal = normal;
    for (std::size_t k = 0; k < static_cast<std::size_t>(contact.manifold.count); ++k) {
        slide.impulse += contact.normalImpulse[k];
        slide.tangentImpulse += contact.tangentImpulse[k];
        slide.moment += contact.normalImpulse[k] * leverOf(contact.manifold.points[k].point, before, normal);
    }
}

void carryAlong(const WorldState& world, const GroundContacts& contacts) {
    const Load load = loadOf(world, contacts);
    if (!(load.impulse > 0)) { return; }
    const Feet feet = findFeet(world, contacts, load);
    if (feet.left.contact == nullptr) { return; }
    const Real apart = feet.right.lever - feet.left.lever;
    const Real right =
        apart > 0 ? std::clamp((load.moment / load.impulse - feet.left.lever) / apart, Real(0), Real(1)) : Real(0);
    press(feet.left, 1 - right, load);
    press(feet.right, right, load);
}

}  // namespace swept::inline SWEPT_PRECISION
