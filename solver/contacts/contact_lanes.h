#pragma once

#include <algorithm>
#include <cstring>
#include <limits>
#include <span>
#include <type_traits>

#include "../wide/wide_contacts.h"

/// How a contact is laid into a lane of a block.

namespace swept::inline SWEPT_PRECISION {

template <std::size_t kPoints>
inline void setSoftness(WideContact<kPoints>& block, std::size_t lane, const Softness& softness) {
    block.biasRate[lane] = softness.biasRate;
    block.massScale[lane] = softness.massScale;
    block.impulseScale[lane] = softness.impulseScale;
}

inline void fillPoint(WideContactPoint& lanes, std::size_t lane, const ContactConstraintPoint& point) {
    lanes.normalArmA[lane] = point.anchorA.x;  // turned into arms later, of all lanes at once
    lanes.tangentArmA[lane] = point.anchorA.y;
    lanes.normalArmB[lane] = point.anchorB.x;
    lanes.tangentArmB[lane] = point.anchorB.y;
    lanes.baseSeparation[lane] = point.baseSeparation;
    lanes.normalImpulse[lane] = point.normalImpulse;
    lanes.tangentImpulse[lane] = point.tangentImpulse;
    lanes.totalNormalImpulse[lane] = point.totalNormalImpulse;
    lanes.separation[lane] = point.separation;
}

/// Touches nothing but the lane. @pre the contact has `kPoints` points
template <std::size_t kPoints>
inline void fillLane(WideContact<kPoints>& block, std::size_t lane, const ContactConstraint& contact,
                     const BodyInertia& a, const BodyInertia& b) {
    block.stateA[lane] = offsetOf(contact.slotA);
    block.stateB[lane] = offsetOf(contact.slotB);
    block.normalX[lane] = contact.normal.x;
    block.normalY[lane] = contact.normal.y;
    block.friction[lane] = contact.friction;
    block.maxPushSpeed[lane] = contact.maxPushSpeed;
    if (contact.radiusA != 0) { block.radiusA[lane] = contact.radiusA; }
    if (contact.radiusB != 0) { block.radiusB[lane] = contact.radiusB; }
    if (contact.bounceSpeed < std::numeric_limits<Real>::infinity()) { block.bounceSpeed[lane] = contact.bounceSpeed; }
    if (contact.restitution > 0) { block.restitution[lane] = contact.restitution; }
    block.inverseMassA[lane] = a.inverseMass;
    block.inverseMassB[lane] = b.inverseMass;
    block.inverseInertiaA[lane] = a.inverseInertia;
    block.inverseInertiaB[lane] = b.inverseInertia;
    setSoftness(block, lane, contact.softness);
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

/// @param lanes  of the block that will be; the others hold the fixed world to itself, which is all zeros
template <std::size_t kPoints>
inline void emptyBlock(WideContact<kPoints>& block, std::uint32_t lanes) {
    static_assert(std::is_trivially_copyable_v<WideContact<kPoints>> && kFixedSlot == 0);
    if (lanes < kBlockLanes) { std::memset(static_cast<void*>(&block), 0, sizeof(block)); }
    block.lanes = lanes;
}

/// What no contact has written yet, and most never do. @pre the block was emptied
template <std::size_t kPoints>
inline void clearExceptions(WideContact<kPoints>& block) {
    block.bounceSpeed.fill(std::numeric_limits<Real>::infinity());
    block.restitution = {};
    block.radiusA = {};
    block.radiusB = {};
    for (WideContactPoint& point : block.points) { point.totalNormalImpulse = {}; }
}

/// @pre the block was emptied
/// @param contactAt  by lane in use
template <std::size_t kPoints, class ContactAt>
inline void fillBlock(WideContact<kPoints>& block, std::span<const BodyInertia> inertias, const ContactAt& contactAt) {
    clearExceptions(block);
    for (std::size_t lane = 0; lane < block.lanes; ++lane) {
        const ContactConstraint& contact = contactAt(lane);
        fillLane(block, lane, contact, inertias[contact.slotA], inertias[contact.slotB]);
    }
    closeBlock(block);
}

}  // namespace swept::inline SWEPT_PRECISION
