#include "toi_answer.h"

namespace swept::inline SWEPT_PRECISION {

Toi answerFrom(const PairPose& pose, const Sweep& sweepA, ToiState state, int iterations) {
    const DVec2 origin = centerAt(sweepA, pose.fraction);
    const auto toWorld = [&pose](Vec2 v) { return toDouble(rotate(pose.rotationA, v)); };
    Toi toi;
    toi.state = state;
    toi.fraction = pose.fraction;
    toi.separation = pose.distance.distance;
    toi.normal = toWorld(pose.distance.normal);
    toi.pointA = origin + toWorld(pose.distance.pointA);
    toi.pointB = origin + toWorld(pose.distance.pointB);
    toi.iterations = iterations;
    return toi;
}

std::optional<Toi> answerAtStart(const PairPose& pose, const Sweep& sweepA, const ToiSettings& settings) {
    if (pose.distance.coreDistance <= 0) { return answerFrom(pose, sweepA, ToiState::overlapped, 1); }
    if (pose.distance.distance <= settings.target) { return answerFrom(pose, sweepA, ToiState::hit, 1); }
    return std::nullopt;
}

}  // namespace swept::inline SWEPT_PRECISION
