#include "turning_ground.h"

#include <cmath>

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Rad in a solve. What turns by less slips by x/131072 in each; what turns farther has no chord to speak of.
constexpr Real kLeastTurn = Real(1) / 256;
constexpr Real kMostTurn = Real(1) / 2;

/// @return whether there is any
bool listTurns(const WorldState& world, SolveDesk& desk, Real time) {
    desk.groundTurns.clear();
    for (const BodySlot slot : desk.standing) {
        const Real turn = time * world.motions[desk.bodies[slot - 1]].angularVelocity;
        if (!(std::fabs(turn) >= kLeastTurn) || std::fabs(turn) > kMostTurn) { continue; }
        const double half = 0.5 * static_cast<double>(turn);
        const SinCos sc = sinCos(half);
        desk.groundTurns.resize(desk.bodies.size() + 1);
        desk.groundTurns[slot] = {.half = {static_cast<Real>(sc.cos), static_cast<Real>(sc.sin)},
                                  .shortening = static_cast<Real>(1 - sc.sin / half)};
    }
    return !desk.groundTurns.empty();
}

void noteTouched(const WorldState& world, SolveDesk& desk, std::uint32_t bodyA, std::uint32_t bodyB) {
    GroundTurn& a = desk.groundTurns[world.solverSlots[bodyA]];
    GroundTurn& b = desk.groundTurns[world.solverSlots[bodyB]];
    a.isTouched = a.isTouched || b.isAny();
    b.isTouched = b.isTouched || a.isAny();
}

}  // namespace

void findTurningGround(const WorldState& world, const TiedGroup& group, Real time) {
    if (!listTurns(world, group.desk, time)) { return; }
    for (const TouchingPair& pair : group.touching) {
        if (!(pair.dynamicA && pair.dynamicB)) { noteTouched(world, group.desk, pair.bodyA, pair.bodyB); }
    }
    if (group.role == BodyRole::solved) { return; }
    for (const Contact& contact : group.contacts) {
        if (contact.isSolid()) { noteTouched(world, group.desk, contact.bodyA, contact.bodyB); }
    }
}

ContactRadii radiiOnTurning(const WorldState& world, const TiedGroup& group, const ContactLink& link, Vec2 normal,
                            Real armA, Real armB) {
    const Contact& contact = group.contacts[link.source];
    const BodyMotion& a = world.motions[contact.bodyA];
    const BodyMotion& b = world.motions[contact.bodyB];
    const Real across = dot(b.velocity - a.velocity, rightPerp(normal));
    if (isTurning(group.desk, link.slotA)) {
        const Real own = contact.radiusB - armB;
        return {(across - 2 * b.angularVelocity * own) / a.angularVelocity - 2 * armA, contact.radiusB};
    }
    const Real own = armA + contact.radiusA;
    return {contact.radiusA, (across - 2 * a.angularVelocity * own) / b.angularVelocity + 2 * armB};
}

void setTurningRadii(const WorldState& world, const TiedGroup& group, const ContactLink& link,
                     ContactConstraint& constraint) {
    const Vec2 tangent = rightPerp(constraint.normal);
    const ContactConstraintPoint& point = constraint.points[0];
    const ContactRadii radii = radiiOnTurning(world, group, link, constraint.normal, cross(point.anchorA, tangent),
                                              cross(point.anchorB, tangent));
    constraint.radiusA = radii.a;
    constraint.radiusB = radii.b;
}

}  // namespace swept::inline SWEPT_PRECISION
