#include "moving_limits.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

void moveLimits(FreedomParts& parts, Real h) {
    parts.lower += h * parts.motion.glide.lower;
    parts.upper += h * parts.motion.glide.upper;
}
void moveLimits(WheelConstraint& joint, Real h) { moveLimits(joint.suspension, h); }
void moveLimits(DistanceConstraint& joint, Real h) {
    joint.length += h * joint.motion.glide.lower;
    joint.minLength += h * joint.motion.glide.lower;
    joint.maxLength += h * joint.motion.glide.upper;
}

}  // namespace

void moveLimits(SolverBatch& batch, Real h) {
    const auto moveThose = [h](auto& joints) {
        for (auto& joint : joints) {
            if (joint.isGliding) { moveLimits(joint, h); }
        }
    };
    moveThose(batch.revolutes);
    moveThose(batch.distances);
    moveThose(batch.prismatics);
    moveThose(batch.wheels);
}

}  // namespace swept::inline SWEPT_PRECISION
