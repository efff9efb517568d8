#include "conservative_advancement.h"

#include <algorithm>

#include "method_pair.h"
#include "toi_observer.h"

namespace swept {
namespace {

/// Greatest speed by which turning brings the bodies together, whatever the direction. Metres per unit of fraction.
double turningApproach(const MethodPair& pair) {
    return std::fabs(pair.motion.spinA) * pair.a.farthest() + std::fabs(pair.motion.spinB) * pair.b.farthest();
}

/// Greatest approach speed of the centres along the closest direction, from the pose on to `tMax`. Their velocity is
/// linear in the fraction, so it is greatest at an end.
double centersApproach(const MethodPair& pair, const MethodPose& pose, double tMax) {
    const DVec2 normal = toDouble(rotate(pose.rotationA, pose.distance.normal));
    const double now = -dot(normal, pair.motion.velocityAt(pose.fraction));
    const double end = -dot(normal, pair.motion.velocityAt(tMax));
    return std::max(now, end);
}

}  // namespace

Toi conservativeAdvancement(const ToiPolygon& a, const Sweep& sweepA, const ToiPolygon& b, const Sweep& sweepB,
                            const ToiSettings& settings) {
    const MethodPair pair(a, sweepA, b, sweepB);
    SimplexCache cache;
    MethodPose pose = pair.poseAt(0, cache);
    if (const auto atStart = answerAtStart(pose, sweepA, settings)) { return *atStart; }

    const double turning = turningApproach(pair);
    // Half of the tolerance ends the search, the other half is for rounding, as in `timeOfImpact`.
    const double closeEnough = settings.target + 0.5 * settings.tolerance;
    MethodLook before{pose.fraction, pose.distance.distance};
    for (int steps = 1; steps <= kMaxAdvancementSteps; ++steps) {
        const double separation = pose.distance.distance;
        if (separation <= settings.target) { return hitAfter(before, pose, sweepA, settings, steps); }
        const double rest = settings.tMax - pose.fraction;
        if (!(rest > 0)) { return answerFrom(pose, sweepA, settings, ToiState::separated, steps); }

        const double gap = separation - settings.target;
        const double speed = turning + centersApproach(pair, pose, settings.tMax);
        const bool free = speed * rest <= gap;  // nothing more can happen, even from within the band
        if (!free && separation <= closeEnough) { return hitAfter(before, pose, sweepA, settings, steps); }
        const double next = free ? settings.tMax : std::min(pose.fraction + gap / speed, settings.tMax);
        if (settings.observer != nullptr) {
            const Toi here = answerFrom(pose, sweepA, settings, ToiState::separated, 0);
            settings.observer->onStep({here.fraction, here.separation, here.normal, here.pointA, here.pointB, next});
        }
        if (!(next > pose.fraction)) { return answerFrom(pose, sweepA, settings, ToiState::failed, steps); }
        before = {pose.fraction, separation};
        pose = pair.poseAt(next, cache);
    }
    return answerFrom(pose, sweepA, settings, ToiState::failed, kMaxAdvancementSteps + 1);
}

}  // namespace swept
