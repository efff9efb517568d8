#include "levers.h"

#include <algorithm>
#include <limits>

#include "../state/number_range.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Of m·L².
constexpr double kLeastShare = sizeof(Real) == sizeof(float) ? 1.0 / (1 << 17) : 1.0 / (1 << 20);

Real ownInverseInertia(const Body& body) {
    const bool turns = hasInverse(body.inertia) && !body.def.fixedRotation;
    return turns ? static_cast<Real>(1 / body.inertia) : Real(0);
}

/// With all levers so far.
void lengthenLever(std::uint32_t slot, Body& body, const Joint& joint) {
    const bool isA = joint.bodyA == slot;
    if (!(body.inverseInertia > 0) || !joint.holds() || (!isA && joint.bodyB != slot)) { return; }
    const Vec2 anchor = isA ? joint.localAnchorA : joint.localAnchorB;
    const DVec2 lever = toDouble(anchor) - toDouble(body.localCenter);
    const double least = kLeastShare * body.mass * dot(lever, lever);
    if (!(least > body.inertia)) { return; }
    const Real inverse = std::max(static_cast<Real>(1 / least), std::numeric_limits<Real>::min());  // it still turns
    body.inverseInertia = std::min(body.inverseInertia, inverse);
}

}  // namespace

void resistTurns(WorldState& world, std::uint32_t slot) {
    Body& body = world.bodies[slot];
    body.inverseInertia = ownInverseInertia(body);
    for (const std::uint32_t joint : body.joints) { lengthenLever(slot, body, world.joints[joint]); }
}

void resistTurns(WorldState& world, std::uint32_t slot, const Joint& joint) {
    lengthenLever(slot, world.bodies[slot], joint);
}

bool isAtLever(const Body& body) { return body.inverseInertia < ownInverseInertia(body); }

}  // namespace swept::inline SWEPT_PRECISION
