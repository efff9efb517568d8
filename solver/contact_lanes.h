#pragma once

#include <algorithm>
#include <cstring>
#include <limits>
#include <type_traits>

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
};

/// Touches nothing but the lane: others of the block may be filled at the same time.
/// @pre the block was emptied
template <std::size_t kPoints>
inline void fillHead(WideContact<kPoints>& block, std::size_t lane, const ContactHead& head, const BodyInertia& a,
                     const BodyInertia& b) {
    block.slotA[lane] = head.slotA;
    block.slotB[lane] = head.slotB;
    block.normalX[lane] = head.normal.x;
    block.normalY[lane] = head.normal.y;
    block.friction[lane] = head.friction;
    block.maxPushSpeed[lane] = head.maxPushSpeed;
    if (head.radiusA > 0) { block.radiusA[lane] = head.radiusA; }
    if (head.radiusB > 0) { block.radiusB[lane] = head.radiusB; }
    if (head.bounceSpeed < std::numeric_limits<Real>::infinity()) { block.bounceSpeed[lane] = head.bounceSpeed; }
    if (head.restitution > 0) { block.restitution[lane] = head.restitution; }
    block.inverseMassA[lane] = a.inverseMass;
    block.inverseMassB[lane] = b.inverseMass;
    block.inverseInertiaA[lane] = a.inverseInertia;
    block.inverseInertiaB[lane] = b.inverseInertia;
}

/// Of all contacts of a block.
template <std::size_t kPoints>
inline void setSoftness(WideContact<kPoints>& block, const Softness& softness) {
    block.biasRate.fill(softness.biasRate);
    block.massScale.fill(softness.massScale);
    block.impulseScale.fill(softness.impulseScale);
}

/// A point of which arms, masses and separation are found in the block, and nothing is added up yet.
inline void fillNewPoint(WideContactPoint& lanes, std::size_t lane, const ContactConstraintPoint& point) {
    lanes.normalArmA[lane] = point.anchorA.x;  // turned into arms later, of all lanes at once
    lanes.tangentArmA[lane] = point.anchorA.y;
    lanes.normalArmB[lane] = point.anchorB.x;
    lanes.tangentArmB[lane] = point.anchorB.y;
    lanes.baseSeparation[lane] = point.baseSeparation;
    lanes.normalImpulse[lane] = point.normalImpulse;
    lanes.tangentImpulse[lane] = point.tangentImpulse;
}

inline void fillPoint(WideContactPoint& lanes, std::size_t lane, const ContactConstraintPoint& point) {
    fillNewPoint(lanes, lane, point);
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
              .restitution = contact.restitution},
             a, b);
    block.biasRate[lane] = contact.softness.biasRate;
    block.massScale[lane] = contact.softness.massScale;
    block.impulseScale[lane] = contact.softness.impulseScale;
    for (std::size_t i = 0; i < kPoints; ++i) { fillPoint(block.points[i], lane, contact.points[i]); }
}

/// What all lanes together tell. @pre they were filled
template <std::size_t kPoints>
inline void closeBlock(WideContact<kPoints>& block) {
    std::uint32_t movableA = 0;
    std::uint32_t movableB = 0;
    Real mostRestitution = 0;
    for (std::size_t lane = 0; lane < kBlockLanes; ++lane) {
        const BodyInertia a{block.inverseMassA[lane], block.inverseInertiaA[lane]};
        const BodyInertia b{block.inverseMassB[lane], block.inverseInertiaB[lane]};
        movableA |= (isMovable(a) ? 1U : 0U) << lane;
        movableB |= (isMovable(b) ? 1U : 0U) << lane;
        mostRestitution = std::max(mostRestitution, block.restitution[lane]);
    }
    block.movableA = movableA;
    block.movableB = movableB;
    block.mostRestitution = mostRestitution;
}

/// What no contact has written yet, and most never do. @param lanes  of the block that will be; the others hold the
/// fixed world to itself, which is all zeros
template <std::size_t kPoints>
inline void emptyBlock(WideContact<kPoints>& block, std::uint32_t lanes) {
    static_assert(std::is_trivially_copyable_v<WideContact<kPoints>> && kFixedSlot == 0);
    if (lanes < kBlockLanes) { std::memset(static_cast<void*>(&block), 0, sizeof(block)); }
    block.lanes = lanes;
    block.bounceSpeed.fill(std::numeric_limits<Real>::infinity());
    block.restitution = {};
    block.radiusA = {};
    block.radiusB = {};
    for (WideContactPoint& point : block.points) { point.totalNormalImpulse = {}; }
}

}  // namespace swept::inline SWEPT_PRECISION
