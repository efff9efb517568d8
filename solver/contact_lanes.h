#pragma once

#include "wide_contacts.h"

/// How a contact is laid into a lane of a block.

namespace swept::inline SWEPT_PRECISION {

/// A contact without its points.
struct ContactHead {
    BodySlot slotA = kFixedSlot;
    BodySlot slotB = kFixedSlot;
    Vec2 normal{};
    Real friction = 0;
    Real maxPushSpeed = 0;
    Real radiusA = 0;
    Real radiusB = 0;
    Real bounceSpeed = std::numeric_limits<Real>::infinity();
    Real restitution = 0;
    Softness softness{};
};

/// @pre the block was emptied
template <std::size_t kPoints>
inline void fillHead(WideContact<kPoints>& block, std::size_t lane, const ContactHead& head, const BodyInertia& a,
                     const BodyInertia& b) {
    block.slotA[lane] = head.slotA;
    block.slotB[lane] = head.slotB;
    block.movableA |= (isMovable(a) ? 1U : 0U) << lane;
    block.movableB |= (isMovable(b) ? 1U : 0U) << lane;
    block.anyBounces = block.anyBounces || head.restitution > 0;
    block.normalX[lane] = head.normal.x;
    block.normalY[lane] = head.normal.y;
    block.friction[lane] = head.friction;
    block.maxPushSpeed[lane] = head.maxPushSpeed;
    block.radiusA[lane] = head.radiusA;
    block.radiusB[lane] = head.radiusB;
    block.bounceSpeed[lane] = head.bounceSpeed;
    block.restitution[lane] = head.restitution;
    block.biasRate[lane] = head.softness.biasRate;
    block.massScale[lane] = head.softness.massScale;
    block.impulseScale[lane] = head.softness.impulseScale;
    block.inverseMassA[lane] = a.inverseMass;
    block.inverseMassB[lane] = b.inverseMass;
    block.inverseInertiaA[lane] = a.inverseInertia;
    block.inverseInertiaB[lane] = b.inverseInertia;
}

inline void fillPoint(WideContactPoint& lanes, std::size_t lane, const ContactConstraintPoint& point) {
    lanes.anchorAX[lane] = point.anchorA.x;
    lanes.anchorAY[lane] = point.anchorA.y;
    lanes.anchorBX[lane] = point.anchorB.x;
    lanes.anchorBY[lane] = point.anchorB.y;
    lanes.baseSeparation[lane] = point.baseSeparation;
    lanes.normalMass[lane] = point.normalMass;
    lanes.tangentMass[lane] = point.tangentMass;
    lanes.normalImpulse[lane] = point.normalImpulse;
    lanes.tangentImpulse[lane] = point.tangentImpulse;
    lanes.totalNormalImpulse[lane] = point.totalNormalImpulse;
    lanes.separation[lane] = point.separation;
}

/// @pre the block was emptied, and the contact has `kPoints` points
template <std::size_t kPoints>
inline void fillLane(WideContact<kPoints>& block, std::size_t lane, const ContactConstraint& contact,
                     const BodyInertia& a, const BodyInertia& b) {
    fillHead(block, lane,
             {.slotA = contact.slotA,
              .slotB = contact.slotB,
              .normal = contact.normal,
              .friction = contact.friction,
              .maxPushSpeed = contact.maxPushSpeed,
              .radiusA = contact.radiusA,
              .radiusB = contact.radiusB,
              .bounceSpeed = contact.bounceSpeed,
              .restitution = contact.restitution,
              .softness = contact.softness},
             a, b);
    block.sharedResponse[lane] = contact.sharedResponse;
    block.begins[lane] = contact.begins ? Real(1) : Real(0);
    for (std::size_t i = 0; i < kPoints; ++i) { fillPoint(block.points[i], lane, contact.points[i]); }
}

}  // namespace swept::inline SWEPT_PRECISION
