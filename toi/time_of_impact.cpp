#include "time_of_impact.h"

#include "axis_bound.h"
#include "moving_pair.h"
#include "toi_observer.h"

namespace swept {
namespace {

/// Each step is certified and gains time. 3 to 5 steps are typical; suite toi_tests holds bodies that turn once to 40
/// steps and such that turn four times each, within each other's reach, to 120, at the finest tolerance that double
/// allows. So this is enough for some thirty turns between two frames. Beyond it the answer is `failed`.
constexpr int kMaxSteps = 1024;

DVec2 toWorld(Rotation rotation, Vec2 v) {
    const Vec2 world = rotate(rotation, v);
    return {world.x, world.y};
}

Toi answerFrom(const MovingPair& pair, const PairPose& pose, const Sweep& sweepA, ToiState state, int iterations) {
    const DVec2 origin = centerAt(sweepA, pose.fraction);
    const CorePoints witnesses = pair.witnessesOf(pose);
    Toi toi;
    toi.state = state;
    toi.fraction = pose.fraction;
    toi.separation = pose.distance.separation;
    toi.normal = toWorld(pose.rotationA, pose.distance.normal);
    toi.pointA = origin + toWorld(pose.rotationA, {witnesses.a.x, witnesses.a.y});
    toi.pointB = origin + toWorld(pose.rotationA, {witnesses.b.x, witnesses.b.y});
    toi.iterations = iterations;
    return toi;
}

bool coresIntersect(const PairPose& pose) { return pose.distance.coreSeparation <= 0; }

/// Out of line: the search is shorter without it.
[[gnu::noinline, gnu::cold]] void tell(const MovingPair& pair, const PairPose& pose, const Sweep& sweepA,
                                       const ToiSettings& settings, double next) {
    const Toi here = answerFrom(pair, pose, sweepA, ToiState::separated, 0);
    settings.observer->onStep({here.fraction, here.separation, here.normal, here.pointA, here.pointB, next});
}

/// Up to here the circles that hold the bodies stay apart: the search begins there.
double firstFraction(const MovingPair& pair, double level, double tMax) {
    const auto real = [](DVec2 v) { return Vec2{v.x, v.y}; };
    return advanceOfCircles(pair, real(pair.motion.start), real(pair.motion.velocityAt(0)),
                            real(pair.motion.curvature), level, tMax);
}

Sweep withoutRotation(const Sweep& sweep) {
    Sweep result = sweep;
    result.a1 = result.a0;
    return result;
}

}  // namespace

Toi timeOfImpact(const ToiPolygon& a, const Sweep& sweepA, const ToiPolygon& b, const Sweep& sweepB,
                 const ToiSettings& settings) {
    const MovingPair pair(a, sweepA, b, sweepB);
    // Steps aim half a tolerance below the target and end half a tolerance above it: the band between is wide enough for
    // the last step to land in, and what is left on either side is for rounding.
    const double level = settings.target - 0.5 * settings.tolerance;
    const double closeEnough = settings.target + 0.5 * settings.tolerance;
    SimplexCache cache;
    PairPose pose = pair.emptyPose();
    pair.moveTo(firstFraction(pair, settings.target, settings.tMax), pose, cache);
    if (coresIntersect(pose) && pose.fraction <= 0) { return answerFrom(pair, pose, sweepA, ToiState::overlapped, 1); }

    for (int steps = 1; steps <= kMaxSteps; ++steps) {
        const double separation = pose.distance.separation;
        if (separation <= settings.target) { return answerFrom(pair, pose, sweepA, ToiState::hit, steps); }
        const double rest = settings.tMax - pose.fraction;
        if (!(rest > 0)) { return answerFrom(pair, pose, sweepA, ToiState::separated, steps); }

        const double advance = safeAdvance(pair, pose, level, rest);
        const bool free = advance >= rest;  // nothing more can happen, even from within the band
        if (!free && separation <= closeEnough) { return answerFrom(pair, pose, sweepA, ToiState::hit, steps); }
        const double next = free ? settings.tMax : pose.fraction + advance;
        if (settings.observer != nullptr) { tell(pair, pose, sweepA, settings, next); }
        if (!(next > pose.fraction)) { return answerFrom(pair, pose, sweepA, ToiState::failed, steps); }
        pair.moveTo(next, pose, cache);
    }
    return answerFrom(pair, pose, sweepA, ToiState::failed, kMaxSteps + 1);
}

Toi shapeCast(const ToiPolygon& a, const Sweep& sweepA, const ToiPolygon& b, const Sweep& sweepB,
              const ToiSettings& settings) {
    // Without spin the bound along the closest direction is the exact motion: each step is the ray cast of the relative
    // path against the supporting line, as in van den Bergen's GJK ray cast (2004), with parabolas for paths.
    return timeOfImpact(a, withoutRotation(sweepA), b, withoutRotation(sweepB), settings);
}

double certainUntil(const ToiPolygon& a, const Sweep& sweepA, const ToiPolygon& b, const Sweep& sweepB,
                    const ToiSettings& settings, double fraction, double level) {
    const MovingPair pair(a, sweepA, b, sweepB);
    SimplexCache cache;
    return fraction + safeAdvance(pair, pair.poseAt(fraction, cache), level, settings.tMax - fraction);
}

Toi separationAt(const ToiPolygon& a, const Sweep& sweepA, const ToiPolygon& b, const Sweep& sweepB, double fraction) {
    const MovingPair pair(a, sweepA, b, sweepB);
    SimplexCache cache;
    const PairPose pose = pair.poseAt(fraction, cache);
    return answerFrom(pair, pose, sweepA, coresIntersect(pose) ? ToiState::overlapped : ToiState::separated, 1);
}

}  // namespace swept
