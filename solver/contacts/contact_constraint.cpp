#include "contact_constraint.h"

#include <algorithm>
#include <cmath>

#include "contact_demand.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// How two bodies move in the directions of a contact.
struct PairMotion {
    Real along = 0;   ///< of the centre of B in the view of that of A: along the normal, m/s
    Real across = 0;  ///< along the tangent
    Real spinA = 0;   ///< rad/s
    Real spinB = 0;
};

PairMotion motionOf(Vec2 normal, const BodyState& a, const BodyState& b) {
    const Vec2 velocity = b.velocity - a.velocity;
    return {dot(velocity, normal), dot(velocity, rightPerp(normal)), a.angularVelocity, b.angularVelocity};
}

Real closingAt(const ContactConstraintPoint& point, const PairMotion& motion) {
    return -(motion.along + (motion.spinB * point.normalArmB - motion.spinA * point.normalArmA));
}

/// Of each point.
template <std::size_t kPoints>
using Impulses = std::array<Real, kPoints>;

template <std::size_t kPoints>
Real sumOf(const Impulses<kPoints>& impulses) {
    if constexpr (kPoints == 2) {
        return impulses[0] + impulses[1];
    } else {
        return impulses[0];
    }
}

/// The bodies of a contact with `kPoints` points, and what is done to them: turned at once, for the points ask for it,
/// pushed by all impulses together.
template <std::size_t kPoints>
class ContactPair {
public:
    ContactPair(const ContactConstraint& contact, const SolverBodies& bodies)
        : contact_(contact),
          bodies_(bodies),
          inertiaA_(bodies.inertias[contact.slotA]),
          inertiaB_(bodies.inertias[contact.slotB]),
          motion_(motionOf(contact.normal, bodies.states[contact.slotA], bodies.states[contact.slotB])) {}

    const PairMotion& motion() const { return motion_; }
    /// Of the surfaces on each other, m/s.
    Real slipAt(const ContactConstraintPoint& point) const {
        const Real speed = motion_.across + (motion_.spinB * point.tangentArmB - motion_.spinA * point.tangentArmA);
        return speed - contact_.surfaceSpeed;
    }
    void turn(Real twistA, Real twistB) {
        motion_.spinA -= inertiaA_.inverseInertia * twistA;
        motion_.spinB += inertiaB_.inverseInertia * twistB;
    }
    void turnByNormals(const Impulses<kPoints>& impulses) {
        Impulses<kPoints> ofA;
        Impulses<kPoints> ofB;
        for (std::size_t i = 0; i < kPoints; ++i) {
            ofA[i] = impulses[i] * contact_.points[i].normalArmA;
            ofB[i] = impulses[i] * contact_.points[i].normalArmB;
        }
        turn(sumOf(ofA), sumOf(ofB));
    }
    /// By friction at a point.
    void slow(const ContactConstraintPoint& point, Real impulse) {
        motion_.across += (inertiaA_.inverseMass + inertiaB_.inverseMass) * impulse;
        turn(impulse * point.tangentArmA, impulse * point.tangentArmB);
    }
    /// @param most  that a torque may have done in all; it works against the turn of the bodies on each other
    void resistRolling(ContactConstraint& contact, Real most) {
        const Real turning = motion_.spinB - motion_.spinA;
        const Real total = std::clamp(contact.rollingImpulse - contact.rollingMass * turning, -most, most);
        const Real impulse = total - contact.rollingImpulse;
        turn(impulse, impulse);
        contact.rollingImpulse = total;
    }
    /// Ends it. @param normals, tangents  all that was done
    void push(const Impulses<kPoints>& normals, const Impulses<kPoints>& tangents) const {
        const Vec2 impulse = sumOf(normals) * contact_.normal + sumOf(tangents) * rightPerp(contact_.normal);
        if (isMovable(inertiaA_)) {
            BodyState& a = bodies_.states[contact_.slotA];
            a.velocity -= inertiaA_.inverseMass * impulse;
            a.angularVelocity = motion_.spinA;
        }
        if (isMovable(inertiaB_)) {
            BodyState& b = bodies_.states[contact_.slotB];
            b.velocity += inertiaB_.inverseMass * impulse;
            b.angularVelocity = motion_.spinB;
        }
    }

private:
    const ContactConstraint& contact_;
    const SolverBodies& bodies_;
    const BodyInertia& inertiaA_;
    const BodyInertia& inertiaB_;
    PairMotion motion_;
};

/// What a rigid point gains where it shares with another one: `ContactConstraint::pairGain`.
Real gainOf(Real oneByTwo, Real twoByOne) {
    const Real rest = 1 - oneByTwo * twoByOne;
    return rest > kTwoPointsRatio ? 1 / rest : Real(0);
}

/// Both points at once: the two rows, each as firm as its point asks, solved exactly, and if one of them would pull,
/// the other one alone. One after the other, the first would take all of a blow and turn the body: a box that slides
/// into a wall climbed it, and high stacks leaned, and swayed for seconds.
/// @return the impulses that they will have
std::array<Real, 2> totalsOf(const ContactConstraint& contact, const PairMotion& motion, Real inverseH, bool useBias) {
    const ContactConstraintPoint& one = contact.points[0];
    const ContactConstraintPoint& two = contact.points[1];
    const bool carriesOne = one.normalImpulse > 0;
    const bool carriesTwo = two.normalImpulse > 0;
    const NormalDemand ofOne = demandOf(contact, one, one.normalMass, closingAt(one, motion), inverseH, useBias,
                                        carriesOne || (contact.begins && carriesTwo));
    const NormalDemand ofTwo = demandOf(contact, two, two.normalMass, closingAt(two, motion), inverseH, useBias,
                                        carriesTwo || (contact.begins && carriesOne));
    // What an impulse at the one takes from that at the other.
    const bool both = ofOne.any && ofTwo.any;
    const Real oneByTwo = both ? contact.sharedResponse * one.normalMass * ofOne.massScale : Real(0);
    const Real twoByOne = both ? contact.sharedResponse * two.normalMass * ofTwo.massScale : Real(0);
    const Real ofRigid = both ? contact.pairGain : Real(1);
    const Real gain = useBias ? gainOf(oneByTwo, twoByOne) : ofRigid;
    // What asks for nothing is pushed with nothing, as in the lanes of a block.
    const Real aloneOne = ofOne.any ? ofOne.changeAt(one, one.normalMass) : Real(0);
    const Real aloneTwo = ofTwo.any ? ofTwo.changeAt(two, two.normalMass) : Real(0);
    // Totals where the other one carries nothing.
    const Real onlyOne = one.normalImpulse + aloneOne + oneByTwo * two.normalImpulse;
    const Real onlyTwo = two.normalImpulse + aloneTwo + twoByOne * one.normalImpulse;
    const Real totalOne = (onlyOne - oneByTwo * onlyTwo) * gain;
    const Real totalTwo = (onlyTwo - twoByOne * onlyOne) * gain;
    if (gain > 0 && !(totalOne < 0) && !(totalTwo < 0)) { return {totalOne, totalTwo}; }
    const Real mostTwo = std::max(onlyTwo, Real(0));
    if (onlyOne - oneByTwo * mostTwo > 0) { return {std::max(onlyOne, Real(0)), 0}; }
    return {0, mostTwo};
}

/// Of one point.
Real totalOf(const ContactConstraint& contact, const PairMotion& motion, Real inverseH, bool useBias) {
    const ContactConstraintPoint& point = contact.points[0];
    const NormalDemand demand = demandOf(contact, point, point.normalMass, closingAt(point, motion), inverseH, useBias,
                                         point.normalImpulse > 0);
    if (!demand.any) { return point.normalImpulse; }
    return std::max(point.normalImpulse + demand.changeAt(point, point.normalMass), Real(0));
}

/// By how much the relative velocity of a point along the normal has to change; 0 where it does not bounce.
Real bounceAt(const ContactConstraint& contact, const ContactConstraintPoint& point, const PairMotion& motion,
              const ContactPass& pass) {
    const Real closing = closingAt(point, motion);
    const bool meets = closing > pass.bounceSpeed && point.separation <= pass.h * closing;
    return meets ? (1 + contact.restitution) * closing : Real(0);
}

/// Of the points, both at once unless one of them would pull.
std::array<Real, 2> bounceImpulses(const ContactConstraint& contact, const PairMotion& motion,
                                   const ContactPass& pass) {
    const ContactConstraintPoint& one = contact.points[0];
    const Real ofOne = bounceAt(contact, one, motion, pass);
    const Real aloneOne = one.normalMass * ofOne;
    if (contact.count < 2) { return {aloneOne, 0}; }
    const ContactConstraintPoint& two = contact.points[1];
    const Real ofTwo = bounceAt(contact, two, motion, pass);
    const Real aloneTwo = two.normalMass * ofTwo;
    const Real shared = ofOne > 0 && ofTwo > 0 ? contact.sharedResponse : Real(0);
    const Real oneByTwo = shared * one.normalMass;
    const Real twoByOne = shared * two.normalMass;
    const Real rest = 1 - oneByTwo * twoByOne;
    const Real leftOfOne = aloneOne - oneByTwo * aloneTwo;
    const Real leftOfTwo = aloneTwo - twoByOne * aloneOne;
    if (rest > kTwoPointsRatio && !(leftOfOne < 0) && !(leftOfTwo < 0)) { return {leftOfOne / rest, leftOfTwo / rest}; }
    return leftOfOne > 0 ? std::array<Real, 2>{aloneOne, 0} : std::array<Real, 2>{0, aloneTwo};
}

void findSeparations(ContactConstraint& contact, const SolverBodies& bodies) {
    for (int i = 0; i < contact.count; ++i) {
        ContactConstraintPoint& point = contact.points[static_cast<std::size_t>(i)];
        point.separation =
            currentSeparation(contact, point, bodies.states[contact.slotA], bodies.states[contact.slotB]);
    }
}

template <std::size_t kPoints>
void warmStart(const ContactConstraint& contact, const SolverBodies& bodies) {
    ContactPair<kPoints> pair(contact, bodies);
    Impulses<kPoints> normals;
    Impulses<kPoints> tangents;
    Impulses<kPoints> ofA;
    Impulses<kPoints> ofB;
    for (std::size_t i = 0; i < kPoints; ++i) {
        const ContactConstraintPoint& point = contact.points[i];
        normals[i] = point.normalImpulse;
        tangents[i] = point.tangentImpulse;
        ofA[i] = normals[i] * point.normalArmA + tangents[i] * point.tangentArmA;
        ofB[i] = normals[i] * point.normalArmB + tangents[i] * point.tangentArmB;
    }
    pair.turn(sumOf(ofA), sumOf(ofB));
    if constexpr (kPoints == 1) {
        if (contact.rolling > 0) { pair.turn(contact.rollingImpulse, contact.rollingImpulse); }
    }
    pair.push(normals, tangents);
}

template <std::size_t kPoints>
void bounce(ContactConstraint& contact, const SolverBodies& bodies, const ContactPass& pass) {
    ContactPair<kPoints> pair(contact, bodies);
    const std::array<Real, 2> both = bounceImpulses(contact, pair.motion(), pass);
    if (!(both[0] > 0) && !(both[1] > 0)) { return; }
    Impulses<kPoints> impulses;
    std::copy_n(both.begin(), kPoints, impulses.begin());
    pair.turnByNormals(impulses);
    Impulses<kPoints> frictions;
    for (std::size_t i = 0; i < kPoints; ++i) {
        ContactConstraintPoint& point = contact.points[i];
        point.totalNormalImpulse += impulses[i];
        const Real limit = contact.friction * impulses[i];
        frictions[i] = std::clamp(-(point.tangentMass * pair.slipAt(point)), -limit, limit);
        pair.slow(point, frictions[i]);
    }
    pair.push(impulses, frictions);
}

template <std::size_t kPoints>
void solve(ContactConstraint& contact, const SolverBodies& bodies, const ContactPass& pass) {
    const Real inverseH = 1 / pass.h;
    ContactPair<kPoints> pair(contact, bodies);
    Impulses<kPoints> totals;
    if constexpr (kPoints == 2) {
        totals = totalsOf(contact, pair.motion(), inverseH, pass.useBias);
    } else {
        totals[0] = totalOf(contact, pair.motion(), inverseH, pass.useBias);
    }
    Impulses<kPoints> normals;
    for (std::size_t i = 0; i < kPoints; ++i) {
        ContactConstraintPoint& point = contact.points[i];
        normals[i] = totals[i] - point.normalImpulse;
        point.normalImpulse = totals[i];
        if (pass.isLast) { point.totalNormalImpulse += totals[i]; }
    }
    pair.turnByNormals(normals);
    // Friction after the normals: the limit it is held to is that of this pass.
    Impulses<kPoints> tangents;
    for (std::size_t i = 0; i < kPoints; ++i) {
        ContactConstraintPoint& point = contact.points[i];
        const Real limit = contact.friction * totals[i];
        const Real slip = pair.slipAt(point);
        const Real total = std::clamp(point.tangentImpulse - point.tangentMass * slip, -limit, limit);
        tangents[i] = total - point.tangentImpulse;
        pair.slow(point, tangents[i]);
        point.tangentImpulse = total;
    }
    if constexpr (kPoints == 1) {  // two points hold what would roll over them
        if (contact.rolling > 0) { pair.resistRolling(contact, contact.rolling * totals[0]); }
    }
    pair.push(normals, tangents);
}

Real inverseOrZero(Real x) { return x > 0 ? 1 / x : Real(0); }

}  // namespace

void prepareContact(ContactConstraint& contact, std::span<const BodyInertia> inertias) {
    const BodyInertia a = inertias[contact.slotA];
    const BodyInertia b = inertias[contact.slotB];
    const Vec2 tangent = rightPerp(contact.normal);
    const Real inverseMass = a.inverseMass + b.inverseMass;
    for (int i = 0; i < contact.count; ++i) {
        ContactConstraintPoint& point = contact.points[static_cast<std::size_t>(i)];
        point.normalArmA = cross(point.anchorA, contact.normal);
        point.normalArmB = cross(point.anchorB, contact.normal);
        point.tangentArmA = cross(point.anchorA, tangent);
        point.tangentArmB = cross(point.anchorB, tangent);
        const Real kNormal =
            inverseMass + a.inverseInertia * square(point.normalArmA) + b.inverseInertia * square(point.normalArmB);
        const Real kTangent =
            inverseMass + a.inverseInertia * square(point.tangentArmA) + b.inverseInertia * square(point.tangentArmB);
        point.normalMass = inverseOrZero(kNormal);
        point.tangentMass = inverseOrZero(kTangent);
    }
    if (contact.rolling > 0) { contact.rollingMass = inverseOrZero(a.inverseInertia + b.inverseInertia); }
    if (contact.count > 1) {
        const ContactConstraintPoint& one = contact.points[0];
        const ContactConstraintPoint& two = contact.points[1];
        contact.begins = !(one.normalImpulse > 0) && !(two.normalImpulse > 0);
        contact.sharedResponse = inverseMass + a.inverseInertia * one.normalArmA * two.normalArmA +
                                 b.inverseInertia * one.normalArmB * two.normalArmB;
        contact.pairGain = gainOf(contact.sharedResponse * one.normalMass, contact.sharedResponse * two.normalMass);
    }
}

Real currentSeparation(const ContactConstraint& contact, const ContactConstraintPoint& point, const BodyState& a,
                       const BodyState& b) {
    const Real moved = dot(b.deltaPosition - a.deltaPosition, contact.normal);
    // What the arms of a body do along the normal as it turns. They take the last stretch to the surface, of the length
    // of a radius, with them; but what is round stays as high above its core as it was: or a ball that rolls would sink
    // by r·(1 − cos) of its turn in every step.
    const Real ofA =
        a.deltaRotation.s * point.normalArmA + (1 - a.deltaRotation.c) * (point.tangentArmA + contact.radiusA);
    const Real ofB =
        b.deltaRotation.s * point.normalArmB + (1 - b.deltaRotation.c) * (point.tangentArmB - contact.radiusB);
    return point.baseSeparation + (moved + (ofB - ofA));
}

void warmStartContacts(std::span<ContactConstraint> contacts, std::span<const std::uint32_t> places,
                       const SolverBodies& bodies) {
    for (const std::uint32_t place : places) {
        const ContactConstraint& contact = contacts[place];
        if (contact.count > 1) {
            warmStart<2>(contact, bodies);
        } else if (contact.count > 0) {
            warmStart<1>(contact, bodies);
        }
    }
}

void bounceContacts(std::span<ContactConstraint> contacts, std::span<const std::uint32_t> places,
                    const SolverBodies& bodies, const ContactPass& pass) {
    for (const std::uint32_t place : places) {
        ContactConstraint& contact = contacts[place];
        if (!(contact.restitution > pass.leastRestitution)) { continue; }
        if (pass.hasMoved) { findSeparations(contact, bodies); }
        if (contact.count > 1) {
            bounce<2>(contact, bodies, pass);
        } else if (contact.count > 0) {
            bounce<1>(contact, bodies, pass);
        }
    }
}

void solveContacts(std::span<ContactConstraint> contacts, std::span<const std::uint32_t> places,
                   const SolverBodies& bodies, const ContactPass& pass) {
    for (const std::uint32_t place : places) {
        ContactConstraint& contact = contacts[place];
        if (pass.hasMoved) { findSeparations(contact, bodies); }
        if (contact.count > 1) {
            solve<2>(contact, bodies, pass);
        } else if (contact.count > 0) {
            solve<1>(contact, bodies, pass);
        }
    }
}

}  // namespace swept::inline SWEPT_PRECISION
