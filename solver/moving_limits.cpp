#include "moving_limits.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

void moveLimits(FreedomParts& parts, Real h) {
    parts.lower += h * parts.pace.lower;
    parts.upper += h * parts.pace.upper;
}
void moveLimits(WheelConstraint& joint, Real h) { moveLimits(joint.suspension, h); }
void moveLimits(DistanceConstraint& joint, Real h) {
    joint.length += h * joint.pace.lower;
    joint.minLength += h * joint.pace.lower;
    joint.maxLength += h * joint.pace.upper;
}

}  // namespace

void moveLimits(SolverBatch& batch, Real h) {
    const auto moveThose = [h](auto& joints) {
        for (auto& joint : joints) {
            if (joint.isPaced) { moveLimits(joint, h); }
        }
    };
    moveThose(batch.revolutes);
    moveThose(batch.distances);
    moveThose(batch.prismatics);
    moveThose(batch.wheels);
}

}  // namespace swept::inline SWEPT_PRECISION
