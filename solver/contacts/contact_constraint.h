#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>

#include "../body_state.h"
#include "../softness.h"

namespace swept::inline SWEPT_PRECISION {

/// Where less than this share of a point's response is its own, two points act as one.
inline constexpr Real kTwoPointsRatio = 16 * kEpsilon;

/// One contact point in a solve. Anchors are relative to the centres of mass, world orientation, at the start of the
/// step.
struct ContactConstraintPoint {
    Vec2 anchorA{};
    Vec2 anchorB{};
    Real baseSeparation = 0;  ///< at the start of the step
    /// Arms of impulses along the normal and along the tangent (`rightPerp`) about the centres: what turns a body, and
    /// what its turning does to the point. Of the anchors themselves a solve needs no more.
    Real normalArmA = 0;
    Real normalArmB = 0;
    Real tangentArmA = 0;
    Real tangentArmB = 0;
    Real normalMass = 0;     ///< kg
    Real tangentMass = 0;    ///< kg
    Real normalImpulse = 0;  ///< accumulated over a sub-step, N·s; warm start in, result out
    Real tangentImpulse = 0;
    Real totalNormalImpulse = 0;  ///< over the whole step, bounces included
    Real separation = 0;          ///< now: changes only when bodies move, so one pass finds it and the others read it
    Real bounceApproach = 0;      ///< largest approach speed at which the point bounced, m/s
};

/// How a body answers to an impulse: where joints hold it to the ground as they let it, at once.
struct BlowAnswer {
    bool isHeld = false;  ///< else it answers freely, and what follows is not looked at
    // How it moves by an impulse along x, along y, and by a twist: a symmetric matrix, 1/kg, 1/(kg·m), 1/(kg·m²).
    Real xx = 0;
    Real xy = 0;
    Real yy = 0;
    Real xt = 0;
    Real yt = 0;
    Real tt = 0;

    Vec2 velocity(Vec2 impulse, Real twist) const {
        return {xx * impulse.x + xy * impulse.y + xt * twist, xy * impulse.x + yy * impulse.y + yt * twist};
    }
    Real spin(Vec2 impulse, Real twist) const { return xt * impulse.x + yt * impulse.y + tt * twist; }
    /// Speed along one direction, with a lever, by a unit impulse along another.
    Real along(Vec2 direction, Real lever, Vec2 impulse, Real twist) const {
        return dot(direction, velocity(impulse, twist)) + lever * spin(impulse, twist);
    }
};

/// The constraint that two shapes do not approach at up to two points, with Coulomb friction.
struct ContactConstraint {
    BodySlot slotA = kFixedSlot;
    BodySlot slotB = kFixedSlot;
    Vec2 normal{};  ///< unit, world, from A to B, held for the whole step
    Real friction = 0;
    Real restitution = 0;
    Real surfaceSpeed = 0;    ///< friction works towards this speed of B beside A, along the tangent, m/s
    Real rolling = 0;         ///< of one point: a torque that resists rolling is up to this times what presses, metres
    Real rollingMass = 0;     ///< kg·m²
    Real rollingImpulse = 0;  ///< accumulated like those of points, on B, N·m·s
    bool isHeld = false;      ///< a direct solve takes care of overlaps and gaps: what presses just does not move
    Real maxPushSpeed = 0;    ///< fastest push out of an overlap, m/s
    /// Of the rounded parts that touch, metres: those have no points that turn away from the contact as the body turns.
    /// Of ground that turns what the engine makes of it (turning_ground.h), of either sign.
    Real radiusA = 0;
    Real radiusB = 0;
    BlowAnswer answerA;  ///< asked by impacts alone
    BlowAnswer answerB;
    /// Relaxation leaves faster approaches to the bounce of the next sub-step, m/s; infinity: the contact never
    /// bounces.
    Real bounceSpeed = std::numeric_limits<Real>::infinity();
    Softness softness{};
    std::int32_t count = 0;  ///< points
    bool begins =
        false;  ///< with two points that carried nothing before this solve: relaxation ends their blow together
    Real sharedResponse = 0;  ///< of one point, along the normal, to an impulse at the other, 1/kg
    Real pairGain = 0;  ///< 1 / (share of its response that two rigid points leave to each one); 0: they are as good
                        ///< as one
    std::uint32_t source = 0;  ///< the engine's name for the contact
    std::array<ContactConstraintPoint, 2> points{};
};

/// Fills what follows from anchors and inertia: arms and effective masses.
void prepareContact(ContactConstraint& contact, std::span<const BodyInertia> inertias);

/// Separation of a point now, from the motion since the start of the step. @pre prepared
Real currentSeparation(const ContactConstraint& contact, const ContactConstraintPoint& point, const BodyState& a,
                       const BodyState& b);

/// What has more restitution than this bounces several times over where it bounces in turn, and relaxation leaves its
/// approaches to the next sub-step (`ContactConstraint::bounceSpeed`). Of others one turn is as near to what thousands
/// of steps a second make of 400 disks that jostle, or of a ball that breaks a triangle of 78: with restitution 0.5 a
/// ball leaves 0.061 of the energy (0.058), with four turns 0.069; with 1 it is 0.77 in four turns, 0.20 in one.
inline constexpr Real kLivelyRestitution = Real(3) / 4;

/// One pass over contacts.
struct ContactPass {
    Real h = 0;            ///< sub-step, s
    bool useBias = false;  ///< push out of overlap (soft); else only stop approaching (relaxation, rigid)
    bool hasMoved = true;  ///< bodies have moved since the pass before: separations are found anew
    bool isLast = false;   ///< of the sub-step: impulses are added to the totals
    // Of a turn of bounces:
    Real bounceSpeed = 0;       ///< faster approaches bounce, m/s
    Real leastRestitution = 0;  ///< of contacts with more than that
};

/// As many as its block has; 0: it stands in none, for blocks know neither surface speed nor what resists rolling.
inline std::size_t pointsInBlock(const ContactConstraint& contact) {
    return contact.surfaceSpeed != 0 || contact.rolling > 0 ? 0 : static_cast<std::size_t>(contact.count);
}

/// Kernels over contacts that share no movable body (one colour) or are solved one after the other. The wide ones
/// (wide_contacts.h) do the same to the bit.
/// @param places  in `contacts`, of those that are meant
void warmStartContacts(std::span<ContactConstraint> contacts, std::span<const std::uint32_t> places,
                       const SolverBodies& bodies);
/// Newton's impact law, once and in turn: a contact of which points meet within the sub-step faster than the
/// `bounceSpeed` of the pass leaves with its restitution, both points at once, and friction within the cone of these
/// impulses. None of that makes energy but what belts give, whatever the order. What still approaches when all had
/// their turn is plastic: the pass with bias stops it.
void bounceContacts(std::span<ContactConstraint> contacts, std::span<const std::uint32_t> places,
                    const SolverBodies& bodies, const ContactPass& pass);
void solveContacts(std::span<ContactConstraint> contacts, std::span<const std::uint32_t> places,
                   const SolverBodies& bodies, const ContactPass& pass);

}  // namespace swept::inline SWEPT_PRECISION
