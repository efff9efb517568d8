#include "moving_limits.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

void moveLimits(FreedomParts& parts, Real h) {
    if (!parts.isGliding) { return; }
    parts.lower += h * parts.motion.glide.lower;
    parts.upper += h * parts.motion.glide.upper;
}
void moveLimits(WheelConstraint& joint, Real h) { moveLimits(joint.suspension, h); }
void moveLimits(DistanceConstraint& joint, Real h) {
    if (!joint.isGliding) { return; }
    if (joint.isRigid) { joint.length += h * joint.motion.glide.lower; }  // that of a spring rests
    joint.minLength += h * joint.motion.glide.lower;
    joint.maxLength += h * joint.motion.glide.upper;
}

}  // namespace

void moveLimits(SolverBatch& batch, Real h) {
    for (RevoluteConstraint& joint : batch.revolutes) { moveLimits(joint, h); }
    for (DistanceConstraint& joint : batch.distances) { moveLimits(joint, h); }
    for (PrismaticConstraint& joint : batch.prismatics) { moveLimits(joint, h); }
    for (WheelConstraint& joint : batch.wheels) { moveLimits(joint, h); }
}

}  // namespace swept::inline SWEPT_PRECISION
