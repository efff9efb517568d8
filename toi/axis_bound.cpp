#include "axis_bound.h"

#include <algorithm>

#include "parabola.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Lower bounds of the projections of one body's vertices on the axis, relative to the body's centre.
struct Projections {
    std::array<Parabola, 8> vertices{};
    int count = 0;

    /// The bound that is lowest at `s`.
    const Parabola& lowestAt(double s) const {
        int lowest = 0;
        for (int i = 1; i < count; ++i) {
            if (vertices[static_cast<std::size_t>(i)].at(s) < vertices[static_cast<std::size_t>(lowest)].at(s)) {
                lowest = i;
            }
        }
        return vertices[static_cast<std::size_t>(lowest)];
    }
};

/// @param body      the vertices, turned by `rotation` into the frame of the axis.
/// @param relative  rate at which the body turns relative to the axis.
Projections project(const CenteredPolygon& body, Rotation rotation, Vec2 axis, double relative) {
    Projections result;
    result.count = body.polygon.count;
    for (std::size_t i = 0; i < static_cast<std::size_t>(result.count); ++i) {
        const Vec2 r = rotate(rotation, body.polygon.vertices[i]);
        result.vertices[i] = {dot(axis, r), relative * cross(r, axis), relative * relative * body.reach[i]};
    }
    return result;
}

/// Bound of the centres' difference along an axis that turns at `spin`, good for [0, window] from the pose.
Parabola projectCenters(const MovingPair& pair, const PairPose& pose, Vec2 axis, double spin, double window) {
    const Vec2 offset = pose.bInA.translation;
    Parabola result{dot(axis, offset), spin * dot(leftPerp(axis), offset) + dot(axis, pose.velocity), 0};
    if (spin == 0) {
        result.bend = -2 * dot(axis, pose.curvature);
        return result;
    }
    const double end = pose.fraction + window;
    result.bend = spin * spin * pair.motion.farthestWithin(pose.fraction, end) +
                  2 * std::fabs(spin) * pair.motion.fastestWithin(pose.fraction, end) + 2 * length(pose.curvature);
    return result;
}

/// First time in [0, limit] at which the lowest sum of one bound of each body and the centres' is down to 0.
double firstRootOfEnvelope(const Projections& a, const Projections& b, const Parabola& centers, double limit) {
    // Take the pair that is lowest at the end of the interval and go back to its root, until nothing is below 0 at the
    // end. Bounds that differ bend downward, so being above 0 at both ends they are above it between. Each pair has its
    // turn at most once.
    double s = limit;
    for (int turn = 0; turn < a.count * b.count; ++turn) {
        const double root = firstRoot(centers + a.lowestAt(s) + b.lowestAt(s), s);
        if (!(root < s)) { break; }
        s = root;
    }
    return s;
}

/// Safe advance along one axis that turns at `spin`.
double advanceAlong(const MovingPair& pair, const PairPose& pose, double spin, double level, double limit) {
    const Vec2 axis = pose.distance.normal;
    const double relativeA = pair.motion.spinA - spin;
    const double relativeB = pair.motion.spinB - spin;
    const Projections a = project(pair.a, {}, -axis, relativeA);
    const Projections b = project(pair.b, pose.bInA.rotation, axis, relativeB);

    // A short window has a smaller bound, so narrow it while the step fills only a small part of it. Quartering bounds
    // the loop: a few rounds gain what there is to gain.
    constexpr int kWindows = 4;
    double window = limit;
    double step = 0;
    for (int round = 0; round < kWindows; ++round) {
        Parabola centers = projectCenters(pair, pose, axis, spin, window);
        centers.value -= level + pair.radii();
        const bool turning = relativeA != 0 || relativeB != 0;
        if (turning) { centers.bend = std::max(centers.bend, 0.0); }  // firstRootOfEnvelope relies on it
        step = std::max(step, firstRootOfEnvelope(a, b, centers, window));
        if (spin == 0 || 4 * step >= window) { break; }
        window = 4 * step;
    }
    return step;
}

/// Safe advance if the bodies were the circles about their centres that hold them, along the line of the centres.
double advanceOfCircles(const MovingPair& pair, const PairPose& pose, double level, double limit) {
    const UnitAndLength line = normalized(pose.bInA.translation);
    Parabola centers = projectCenters(pair, pose, line.unit, 0, limit);
    const auto reachOf = [](const CenteredPolygon& body) {
        return *std::max_element(body.reach.begin(), body.reach.begin() + body.polygon.count);
    };
    centers.value -= level + pair.radii() + reachOf(pair.a) + reachOf(pair.b);
    return firstRoot(centers, limit);
}

}  // namespace

double safeAdvance(const MovingPair& pair, const PairPose& pose, double level, double limit) {
    const double spinA = pair.motion.spinA;
    const double spinB = pair.motion.spinB;
    double best = advanceAlong(pair, pose, 0, level, limit);
    if (spinA == 0 && spinB == 0) { return best; }  // then that was exact
    if (best < limit) { best = std::max(best, advanceOfCircles(pair, pose, level, limit)); }
    if (best < limit && spinA != 0) { best = std::max(best, advanceAlong(pair, pose, spinA, level, limit)); }
    if (best < limit && spinB != 0 && spinB != spinA) {
        best = std::max(best, advanceAlong(pair, pose, spinB, level, limit));
    }
    return best;
}

}  // namespace swept::inline SWEPT_PRECISION
