#pragma once

#include <cstddef>
#include <span>

#include "../body_state.h"
#include "../graph/block_layout.h"
#include "../joints/freedom_parts.h"
#include "../wide/wide_line.h"

namespace swept::inline SWEPT_PRECISION {

/// What sliders and wheels have in common, for `JointBlocks`.
struct LineSort {
    /// @param along  what the joint has along its axis
    template <class Joint>
    static BlockLayout::Kind kindOf(const Joint& joint, const FreedomParts& along,
                                    std::span<const BodyInertia> inertias) {
        const bool turns = inertias[joint.slotA].inverseInertia + inertias[joint.slotB].inverseInertia > 0;
        if (joint.isHeld || along.isGliding || !turns) { return BlockLayout::kAlone; }
        return static_cast<BlockLayout::Kind>((joint.hasMotor ? 4U : 0U) + (along.hasSpring ? 2U : 0U) +
                                              (along.hasLimits ? 1U : 0U));
    }
    static void empty(WideLine& block, BlockLayout::Kind kind) {
        block.parts = {(kind & 4U) != 0, (kind & 2U) != 0, (kind & 1U) != 0};
        block.totalX = block.totalY = block.totalTwist = {};
    }
    template <class Joint>
    static void fill(WideLine& block, std::size_t lane, const Joint& joint, const FreedomParts& along) {
        block.axisX[lane] = joint.axis.x;
        block.axisY[lane] = joint.axis.y;
        block.lower[lane] = along.lower;
        block.upper[lane] = along.upper;
        block.motorSpeed[lane] = joint.motorSpeed;
        block.maxMotorImpulse[lane] = joint.maxMotorImpulse;
        block.springPush[lane] = along.spring.push;
        block.springDrag[lane] = along.spring.drag;
        block.springLag[lane] = along.spring.lag;
        block.heldImpulse[lane] = joint.heldImpulse.x;
        block.motorImpulse[lane] = joint.motorImpulse;
        block.springImpulse[lane] = along.springImpulse;
        block.lowerImpulse[lane] = along.lowerImpulse;
        block.upperImpulse[lane] = along.upperImpulse;
    }
    template <class Joint>
    static void take(const WideLine& block, std::size_t lane, Joint& joint, FreedomParts& along) {
        joint.axisNow = {block.axisNowX[lane], block.axisNowY[lane]};
        joint.heldImpulse.x = block.heldImpulse[lane];
        joint.motorImpulse = block.motorImpulse[lane];
        along.springImpulse = block.springImpulse[lane];
        along.lowerImpulse = block.lowerImpulse[lane];
        along.upperImpulse = block.upperImpulse[lane];
        joint.total = {{block.totalX[lane], block.totalY[lane]}, block.totalTwist[lane]};
    }
};

}  // namespace swept::inline SWEPT_PRECISION
