#include "speculative.h"

#include <algorithm>

#include "method_pair.h"

namespace swept {
namespace {

/// Rate at which the closest points of the start approach along their normal, metres per unit of fraction.
double approachOf(const MethodPair& pair, const MethodPose& start, double tMax) {
    // (offset(tMax) − offset(0)) / tMax
    const DVec2 mean = pair.motion.change + (tMax - 1) * pair.motion.curvature;
    const Vec2 centers = unrotate(start.rotationA, Vec2{mean.x, mean.y});
    const Vec2 pointOfA = cross(pair.motion.spinA, start.distance.pointA);
    const Vec2 pointOfB = cross(pair.motion.spinB, start.distance.pointB - start.bInA.translation);
    return -dot(start.distance.normal, centers + pointOfB - pointOfA);
}

}  // namespace

Toi speculativeContact(const ToiPolygon& a, const Sweep& sweepA, const ToiPolygon& b, const Sweep& sweepB,
                       const ToiSettings& settings) {
    const MethodPair pair(a, sweepA, b, sweepB);
    SimplexCache cache;
    const MethodPose start = pair.poseAt(0, cache);
    if (const auto atStart = answerAtStart(start, sweepA, settings)) { return *atStart; }

    const double gap = start.distance.distance - settings.target;
    const double approach = approachOf(pair, start, settings.tMax);
    const bool stops = approach * settings.tMax > gap;
    const double fraction = stops ? std::min(gap / approach, settings.tMax) : settings.tMax;
    return answerFrom(pair.poseAt(fraction, cache), sweepA, settings, stops ? ToiState::hit : ToiState::separated, 2);
}

}  // namespace swept
