#pragma once

#include <cstddef>
#include <cstring>
#include <type_traits>

#include "../contacts/contact_constraint.h"
#include "../wide/wide_joint.h"

/// What the blocks of all sorts of joints have in common.

namespace swept::inline SWEPT_PRECISION {

/// Before lanes are filled. @param lanes  of the block that will be; the others hold the fixed world to itself, which
/// is all zeros
template <class Block>
void emptyJoints(Block& block, std::uint32_t lanes) {
    static_assert(std::is_trivially_copyable_v<Block> && kFixedSlot == 0);
    if (lanes < kBlockLanes) { std::memset(static_cast<void*>(&block), 0, sizeof(block)); }
    block.movableA = block.movableB = 0;
    block.lanes = lanes;
}

/// What any joint has. Lanes of one block may be filled at the same time. @pre the block was emptied
template <class Joint>
void fillJoint(WideJoint& block, std::size_t lane, const Joint& joint, const BodyInertia& a, const BodyInertia& b) {
    block.stateA[lane] = offsetOf(joint.slotA);
    block.stateB[lane] = offsetOf(joint.slotB);
    block.anchorAX[lane] = joint.anchorA.x;
    block.anchorAY[lane] = joint.anchorA.y;
    block.anchorBX[lane] = joint.anchorB.x;
    block.anchorBY[lane] = joint.anchorB.y;
    block.offsetX[lane] = joint.centerOffset.x;
    block.offsetY[lane] = joint.centerOffset.y;
    block.biasRate[lane] = joint.softness.biasRate;
    block.massScale[lane] = joint.softness.massScale;
    block.impulseScale[lane] = joint.softness.impulseScale;
    block.inverseMassA[lane] = a.inverseMass;
    block.inverseMassB[lane] = b.inverseMass;
    block.inverseInertiaA[lane] = a.inverseInertia;
    block.inverseInertiaB[lane] = b.inverseInertia;
}

/// Ends what the joints of the lanes began.
inline void closeBlock(WideJoint& block) {
    block.movableA = block.movableB = 0;
    for (std::size_t lane = 0; lane < block.lanes; ++lane) {
        const BodyInertia a{.inverseMass = block.inverseMassA[lane], .inverseInertia = block.inverseInertiaA[lane]};
        const BodyInertia b{.inverseMass = block.inverseMassB[lane], .inverseInertia = block.inverseInertiaB[lane]};
        block.movableA |= (isMovable(a) ? 1U : 0U) << lane;
        block.movableB |= (isMovable(b) ? 1U : 0U) << lane;
    }
}

/// Of joints in blocks: what a pass with bias would have to find, warm starting has found.
inline ContactPass ofJoints(const ContactPass& pass) {
    ContactPass of = pass;
    of.hasMoved = pass.hasMoved && !pass.useBias;
    return of;
}

}  // namespace swept::inline SWEPT_PRECISION
