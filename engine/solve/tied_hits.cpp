#include "tied_hits.h"

#include <algorithm>

#include "../contacts/hit_event.h"
#include "../state/tolerances.h"

namespace swept::inline SWEPT_PRECISION {

Real TiedPair::approachAt(const ContactConstraintPoint& point, Vec2 normal) const {
    return -dot(velocityAt(b, point.anchorB) - velocityAt(a, point.anchorA), normal);
}

TiedHits::TiedHits(const WorldState& world, const StepPart& part, std::vector<ContactEvent>& events)
    : world_(world),
      part_(part),
      events_(events),
      dt_(static_cast<Real>(part.dt)),
      threshold_(length(world.settings.gravity) * dt_) {}

TiedPair TiedHits::pairOf(const Contact& contact, BodySlot slotA, BodySlot slotB) const {
    const auto stateOf = [this](std::uint32_t body, BodySlot slot) -> BodyState {
        if (slot == kFixedSlot) { return {}; }
        const BodyMotion& motion = world_.motions[body];
        return {.velocity = motion.velocity, .angularVelocity = motion.angularVelocity};
    };
    return {.a = stateOf(contact.bodyA, slotA), .b = stateOf(contact.bodyB, slotB)};
}

/// What forces make of the velocity of a body in a step, m/s.
Vec2 TiedHits::gainOf(std::uint32_t body) const {
    const Body& of = world_.bodies[body];
    return of.isDynamic() ? dt_ * accelerationOf(world_, of) : Vec2{};
}

/// What pressed before may be pushed together in each step, by whatever pushes it, and its points take turns to carry
/// that: these come no faster than forces make them. Without any they come as fast as rounding has it, of a way that is
/// no gap yet.
Real TiedHits::leastAgain(const Contact& contact) const {
    const Real ofForces = length(gainOf(contact.bodyB) - gainOf(contact.bodyA));
    const Real ofGaps = kToleranceRatio * contact.extent / static_cast<Real>(world_.closingTime);
    return std::max({threshold_, ofForces, ofGaps});
}

void TiedHits::note(const Contact& contact, Vec2 normal, const std::array<Real, 2>& speeds, bool began) {
    const Real speed = std::max(speeds[0], speeds[1]);
    if (!(speed > threshold_) || (!began && !(speed > leastAgain(contact)))) { return; }
    const Real second = contact.manifold.count == 2 ? contact.totalImpulse[1] : Real(0);
    const bool isSecond = speeds[1] > 0 && (!(speeds[0] > 0) || second > contact.totalImpulse[0]);
    const std::size_t k = isSecond ? 1 : 0;
    const BodyMotion& a = world_.motions[contact.bodyA];
    // The gap closes at the approach speed: a first-order estimate of when in the step.
    const auto gap = static_cast<double>(std::max(contact.manifold.points[k].separation, Real(0)));
    const double wait = std::min(gap / static_cast<double>(speed), part_.length);
    ContactEvent hit = hitBetween(world_, contact.shapeA, contact.shapeB);
    hit.fraction = std::min((part_.begin + wait) / part_.dt, 1.0);
    hit.point = apply(a.pose, contact.manifold.points[k].point);
    hit.normal = normal;
    hit.approachSpeed = speed;
    hit.impulse = contact.totalImpulse[0] + second;
    const HeldLock lock(hitting_);
    events_.push_back(hit);
}

}  // namespace swept::inline SWEPT_PRECISION
