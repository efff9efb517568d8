#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "../graph/block_layout.h"
#include "../solver_batch.h"
#include "../wide/wide_drives.h"

namespace swept::inline SWEPT_PRECISION {

/// Motor joints, for `JointBlocks`: those beside a hinge, and those that drive nothing, stand alone.
struct DriveSort {
    using Constraint = MotorConstraint;
    using Block = WideDrive;
    using Kernels = DriveKernels;

    static std::vector<MotorConstraint>& constraintsOf(SolverBatch& batch) { return batch.motors; }
    static const std::vector<MotorConstraint>& constraintsOf(const SolverBatch& batch) { return batch.motors; }
    static const DriveKernels* kernels() { return driveKernels(); }

    static BlockLayout::Kind kindOf(const MotorConstraint& joint, std::span<const BodyInertia> inertias) {
        const bool turns = inertias[joint.slotA].inverseInertia + inertias[joint.slotB].inverseInertia > 0;
        if (joint.isDriveHeld || (joint.drivesAngle && (joint.hinge.isThere || !turns))) { return BlockLayout::kAlone; }
        const unsigned ofBoth =
            3 * wayOf(joint.drivesLine, joint.seeksPlace) + wayOf(joint.drivesAngle, joint.seeksAngle);
        return ofBoth > 0 ? static_cast<BlockLayout::Kind>(ofBoth - 1) : BlockLayout::kAlone;
    }
    static void empty(WideDrive& block, BlockLayout::Kind kind) {
        const unsigned line = (kind + 1U) / 3;
        const unsigned angle = (kind + 1U) % 3;
        block.parts = {line != 0, angle != 0, line == 2, angle == 2};
        block.totalX = block.totalY = block.totalTwist = {};
    }
    static void fill(WideDrive& block, std::size_t lane, const MotorConstraint& joint) {
        block.baseAngle[lane] = joint.baseAngle;
        block.approachRate[lane] = joint.approachRate;
        block.ease[lane] = joint.ease;
        block.maxLinearImpulse[lane] = joint.maxLinearImpulse;
        block.maxAngularImpulse[lane] = joint.maxAngularImpulse;
        block.velocityX[lane] = joint.velocity.x;
        block.velocityY[lane] = joint.velocity.y;
        block.spin[lane] = joint.spin;
        block.impulseX[lane] = joint.linearImpulse.x;
        block.impulseY[lane] = joint.linearImpulse.y;
        block.angularImpulse[lane] = joint.angularImpulse;
    }
    static void take(const WideDrive& block, std::size_t lane, MotorConstraint& joint) {
        joint.velocity = {block.velocityX[lane], block.velocityY[lane]};
        joint.spin = block.spin[lane];
        joint.linearImpulse = {block.impulseX[lane], block.impulseY[lane]};
        joint.angularImpulse = block.angularImpulse[lane];
        joint.total = {{block.totalX[lane], block.totalY[lane]}, block.totalTwist[lane]};
    }

private:
    /// 0: not at all, 1: with a velocity, 2: to a pose.
    static unsigned wayOf(bool drives, bool seeks) { return !drives ? 0U : seeks ? 2U : 1U; }
};

}  // namespace swept::inline SWEPT_PRECISION
