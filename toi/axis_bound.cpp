#include "axis_bound.h"

#include <algorithm>

#include "../shapes/compiler.h"
#include "parabola.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Bodies turn by no more than this against the axis within one window,
/// radians. Up to √2 the walk of the deepest vertex is contained in the walk up
/// to the direction (1 − θ²/2, θ), which is past θ; and beyond, the third
/// derivative rules.
constexpr double kWidestTurn = 1.25;
/// A window is narrowed when the step fills less than this part of it.
constexpr double kFilled = 0.25;
constexpr int kWindows = 3;
/// The window reaches so far past the guess, as a factor of it.
constexpr double kAhead = 1.125;

/// Which vertices can become the farthest along `axis` (frame of the body)
/// while the body turns by `angle` against it.
/// @param from  the farthest one now.
SWEPT_FORCE_INLINE VertexRun walk(const CenteredPolygon& body, int from, Vec2 axis, double angle) {
    VertexRun run{from, 1, angle > 0 ? -1 : 1};
    if (angle == 0 || body.count() == 1) { return run; }
    const Vec2 end = (1 - 0.5 * angle * angle) * axis + angle * rightPerp(axis);
    // What rounding may make of a level edge: when in doubt the walk goes on.
    const double margin = 16 * kEpsilon * body.reach();
    const Polygon& polygon = body.polygon();
    int i = from;
    Vec2 here = body.vertex(i);
    while (run.count < polygon.count) {
        i = angle > 0 ? polygon.previous(i) : polygon.next(i);
        const Vec2 there = body.vertex(i);
        if (dot(end, there - here) < -margin) { break; }
        ++run.count;
        here = there;
    }
    return run;
}

int after(const CenteredPolygon& body, int i, int step) {
    return step > 0 ? body.polygon().next(i) : body.polygon().previous(i);
}

/// Of the vertices of a run, the farthest along the axis.
int farthestOf(const CenteredPolygon& body, const VertexRun& run, Vec2 axis, double& projection) {
    int best = run.first;
    projection = dot(axis, body.vertex(best));
    int i = best;
    for (int k = 1; k < run.count; ++k) {
        i = after(body, i, run.step);
        const double value = dot(axis, body.vertex(i));
        best = value > projection ? i : best;
        projection = value > projection ? value : projection;
    }
    return best;
}

/// Value, rate and bend of one body's part of a pair's parabola.
struct Part {
    double value;
    double rate;
    double bend;
};

Part partOfA(const HeldAxis& axis, Vec2 vertex, double turn) {
    const double high = dot(axis.inA, vertex);
    return {-high, -turn * cross(vertex, axis.inA), -turn * turn * high};
}

Part partOfB(const HeldAxis& axis, Vec2 vertex, double turn) {
    const double low = dot(axis.inB, vertex);
    return {low, turn * cross(vertex, axis.inB), turn * turn * low};
}

Parabola sum(const Part& centers, const Part& a, const Part& b) {
    return {centers.value + (a.value + b.value), centers.rate + (a.rate + b.rate), centers.bend + (a.bend + b.bend)};
}

/// How fast each body turns against the axis, radians.
struct Turns {
    double a;
    double b;
};

/// Bounds of the second derivative and of the third, as they grow with the
/// window.
struct Bounds {
    double second;
    double secondPerWindow;
    double third;
    double thirdPerWindow;
};

/// What the motion of the centres allows.
Bounds boundsOfCenters(const MovingPair& pair, const PairPose& pose, double spin, double bend) {
    if (spin == 0) { return {bend, 0, 0, 0}; }
    const double w = std::fabs(spin);
    const double distance = length(pose.offset);
    const double curvature = length(pair.motion.curvature);
    return {w * (w * distance + 2 * pair.fastest) + 2 * curvature, w * w * pair.fastest,
            w * (w * (w * distance + 3 * pair.fastest) + 6 * curvature), w * w * w * pair.fastest};
}

/// With a vertex of each body that turns, at the given distances from their centres or nearer.
Bounds withTurns(Bounds bounds, const Turns& turns, double reachA, double reachB) {
    const double squareA = turns.a * turns.a * reachA;
    const double squareB = turns.b * turns.b * reachB;
    bounds.second = squareA + squareB + bounds.second;
    bounds.third = std::fabs(turns.a) * squareA + std::fabs(turns.b) * squareB + bounds.third;
    return bounds;
}

double thirdWithin(const Bounds& bounds, double window) {
    return (1.0 / 3) * window * (bounds.third + window * bounds.thirdPerWindow);
}

/// First root of the lowest of all parabolas of two runs.
/// @param bendOf  of the parabola of a vertex of each, by that which they have by themselves
template <class BendOf>
SWEPT_FORCE_INLINE double firstRootOfPairs(const MovingPair& pair, const HeldAxis& axis, const Part& centers,
                                           const Turns& turns, const SafeAdvance& runs, double window,
                                           const BendOf& bendOf) {
    double step = window;
    int i = runs.a.first;
    for (int k = 0; k < runs.a.count; ++k, i = after(pair.a, i, runs.a.step)) {
        const Part a = partOfA(axis, pair.a.vertex(i), turns.a);
        int j = runs.b.first;
        for (int l = 0; l < runs.b.count; ++l, j = after(pair.b, j, runs.b.step)) {
            Parabola bound = sum(centers, a, partOfB(axis, pair.b.vertex(j), turns.b));
            bound.bend = bendOf(pair.a.vertex(i), pair.b.vertex(j), bound.bend);
            step = firstRoot(bound, step);
        }
    }
    return step;
}

/// With one bound for all vertices.
/// @param second, third  what both orders allow as bend, the third on top of a pair's own.
double firstRootOfRuns(const MovingPair& pair, const HeldAxis& axis, const Part& centers, const Turns& turns,
                       const SafeAdvance& runs, double second, double third, double window) {
    return firstRootOfPairs(pair, axis, centers, turns, runs, window,
                            [&](Vec2 /*a*/, Vec2 /*b*/, double bend) { return std::min(bend + third, second); });
}

/// With the bounds of each vertex by its own distance from the centre, not by the farthest one's.
/// @param ofCenters  what the motion of the centres allows.
SWEPT_COLD double firstRootOfEach(const MovingPair& pair, const HeldAxis& axis, const Part& centers,
                                  const Bounds& ofCenters, const Turns& turns, const SafeAdvance& runs, double window) {
    return firstRootOfPairs(pair, axis, centers, turns, runs, window, [&](Vec2 a, Vec2 b, double bend) {
        const Bounds bounds = withTurns(ofCenters, turns, length(a), length(b));
        return std::min(bend + thirdWithin(bounds, window), bounds.second + window * bounds.secondPerWindow);
    });
}

void setHolder(const MovingPair& pair, HeldAxis& axis, AxisOwner holder) {
    axis.holder = holder;
    axis.spin = holder == AxisOwner::a ? pair.motion.spinA : (holder == AxisOwner::b ? pair.motion.spinB : 0);
}

}  // namespace

Vec2 directionAt(const PairPose& pose, const HeldAxis& axis) {
    switch (axis.holder) {
        case AxisOwner::a:
            return rotate(pose.rotationA, axis.inA);
        case AxisOwner::b:
            return rotate(pose.rotationB, axis.inB);
        case AxisOwner::world:
            break;
    }
    return axis.normal;
}

HeldAxis hold(const MovingPair& pair, const PairPose& pose, const Closest& closest, AxisOwner holder) {
    if (!closest.isApart()) { return hold(pair, pose, rotate(pose.rotationA, closest.normal), holder); }
    HeldAxis axis;
    setHolder(pair, axis, holder);
    axis.inA = closest.normal;
    axis.normal = rotate(pose.rotationA, axis.inA);
    axis.inB = unrotate(pose.rotationB, axis.normal);
    axis.a = closest.gjk.simplex[0].a;
    axis.b = closest.gjk.simplex[0].b;
    axis.gap = closest.gjk.distance;
    return axis;
}

HeldAxis hold(const MovingPair& pair, const PairPose& pose, Vec2 normal, AxisOwner holder) {
    HeldAxis axis;
    setHolder(pair, axis, holder);
    axis.normal = normal;
    axis.inA = unrotate(pose.rotationA, normal);
    axis.inB = unrotate(pose.rotationB, normal);
    double highA = 0;
    double lowB = 0;
    axis.a = farthestOf(pair.a, {0, pair.a.count(), 1}, axis.inA, highA);
    axis.b = farthestOf(pair.b, {0, pair.b.count(), 1}, -axis.inB, lowB);
    axis.gap = dot(normal, pose.offset) - (lowB + highA);
    return axis;
}

SafeAdvance safeAdvance(const MovingPair& pair, const PairPose& pose, const HeldAxis& axis, double level, double limit,
                        VertexReach reach) {
    const RelativeMotion& motion = pair.motion;
    const Turns turns{motion.spinA - axis.spin, motion.spinB - axis.spin};
    const DVec2 velocity = motion.velocityAt(pose.fraction);
    const double along = dot(axis.normal, pose.offset);
    const double across = cross(axis.normal, Vec2{velocity.x, velocity.y});
    const Part centers{along - (level + pair.radii),
                       dot(axis.normal, Vec2{velocity.x, velocity.y}) + axis.spin * cross(axis.normal, pose.offset),
                       axis.spin * (axis.spin * along - 2 * across) -
                           2 * dot(axis.normal, Vec2{motion.curvature.x, motion.curvature.y})};
    const Parabola now =
        sum(centers, partOfA(axis, pair.a.vertex(axis.a), turns.a), partOfB(axis, pair.b.vertex(axis.b), turns.b));
    const Bounds ofCenters = boundsOfCenters(pair, pose, axis.spin, centers.bend);
    const Bounds bounds = withTurns(ofCenters, turns, pair.a.reach(), pair.b.reach());

    SafeAdvance best{0, {axis.a, 1, 1}, {axis.b, 1, 1}, now.rate < 0};
    double window = std::min(limit, kAhead * firstRoot(now, limit));
    const double turn = std::max(std::fabs(turns.a), std::fabs(turns.b));
    if (turn * window > kWidestTurn) { window = kWidestTurn / turn; }
    for (int round = 0; round < kWindows; ++round) {
        SafeAdvance next{0, walk(pair.a, axis.a, axis.inA, turns.a * window),
                         walk(pair.b, axis.b, -axis.inB, turns.b * window), best.approaches};
        const double second = bounds.second + window * bounds.secondPerWindow;
        const double third = thirdWithin(bounds, window);
        if (reach == VertexReach::own) {
            next.step = firstRootOfEach(pair, axis, centers, ofCenters, turns, next, window);
        } else if (next.a.count + next.b.count == 2) {
            next.step = firstRoot({now.value, now.rate, std::min(now.bend + third, second)}, window);
        } else {
            next.step = firstRootOfRuns(pair, axis, centers, turns, next, second, third, window);
        }
        if (next.step > best.step) { best = next; }
        if (!(next.step < kFilled * window)) { break; }
        window = 2 * best.step;
    }
    return best;
}

void follow(const MovingPair& pair, const PairPose& pose, const SafeAdvance& advance, HeldAxis& axis) {
    axis.normal = directionAt(pose, axis);
    if (axis.holder != AxisOwner::a) { axis.inA = unrotate(pose.rotationA, axis.normal); }
    if (axis.holder != AxisOwner::b) { axis.inB = unrotate(pose.rotationB, axis.normal); }
    double highA = 0;
    double lowB = 0;
    axis.a = farthestOf(pair.a, advance.a, axis.inA, highA);
    axis.b = farthestOf(pair.b, advance.b, -axis.inB, lowB);
    axis.gap = dot(axis.normal, pose.offset) - (lowB + highA);
}

double advanceOfCircles(const MovingPair& pair, double fraction, double level, double limit) {
    const RelativeMotion& motion = pair.motion;
    const DVec2 offset = motion.offsetAt(fraction);
    const DVec2 velocity = motion.velocityAt(fraction);
    const double reach = level + pair.radii + pair.a.reach() + pair.b.reach();
    const double distance = length(offset);
    if (!(distance > reach)) { return 0; }
    if (motion.curvature != DVec2{} || pair.isExtreme()) {
        const Vec2 unit = normalized(Vec2{offset.x, offset.y}).unit;
        const DVec2 line{unit.x, unit.y};
        return firstRoot({distance - reach, dot(line, velocity), -2 * dot(line, motion.curvature)}, limit);
    }
    const double approach = -dot(offset, velocity);
    if (!(approach > 0)) { return limit; }
    // |offset + s·velocity| = reach. The distance at which the centres pass each
    // other comes from the cross product, whose error is a rounding of the
    // distance; the usual discriminant would lose twice the digits.
    const double aside = cross(offset, velocity);
    const double discriminant = dot(velocity, velocity) * (reach * reach) - aside * aside;
    if (discriminant < 0) { return limit; }
    const double step = (distance - reach) * (distance + reach) / (approach + std::sqrt(discriminant));
    return step < limit ? step : limit;
}

double bestAdvance(const MovingPair& pair, const PairPose& pose, const Closest& closest, double level, double limit) {
    double best = advanceOfCircles(pair, pose.fraction, level, limit);
    for (const AxisOwner holder : {AxisOwner::a, AxisOwner::b, AxisOwner::world}) {
        best = std::max(best, safeAdvance(pair, pose, hold(pair, pose, closest, holder), level, limit).step);
    }
    return best;
}

}  // namespace swept::inline SWEPT_PRECISION
