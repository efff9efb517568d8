#include "axis_bound.h"

#include <algorithm>

#include "parabola.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Bodies turn by no more than this against the axis within one window, radians. Up to √2 the walk of the deepest
/// vertex is contained in the walk up to the direction (1 − θ²/2, θ), which is past θ; and beyond, the third derivative
/// rules.
constexpr double kWidestTurn = 1.25;
/// A window is narrowed when the step fills less than this part of it.
constexpr double kFilled = 0.25;
constexpr int kWindows = 3;

double cube(double x) { return x * x * x; }

/// Which vertices can become the farthest along `axis` (frame of the body) while the body turns by `angle` against it.
/// @param from  the farthest one now.
VertexRun walk(const CenteredPolygon& body, int from, Vec2 axis, double angle) {
    VertexRun run{from, 1, angle > 0 ? -1 : 1};
    if (angle == 0 || body.count() == 1) {
        return run;
    }
    const Vec2 end = (1 - 0.5 * angle * angle) * axis + angle * rightPerp(axis);
    // What rounding may make of a level edge: when in doubt the walk goes on.
    const double margin = 16 * kEpsilon * body.reach();
    const Polygon& polygon = body.polygon();
    int i = from;
    Vec2 here = body.vertex(i);
    while (run.count < polygon.count) {
        i = angle > 0 ? polygon.previous(i) : polygon.next(i);
        const Vec2 there = body.vertex(i);
        if (dot(end, there - here) < -margin) {
            break;
        }
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

/// What the bounds of one axis at one pose have in common.
struct AxisProblem {
    const MovingPair& pair;
    const HeldAxis& axis;
    double turnA;  ///< rates of the bodies against the axis, radians per unit of fraction
    double turnB;
    double centers;      ///< separation of the centres along the axis less radii and level
    double centersRate;  ///< and its derivatives now
    double centersCurve;
    double distance;  ///< of the centres
    double curvature;

    AxisProblem(const MovingPair& movingPair, const PairPose& pose, const HeldAxis& held, double level)
        : pair(movingPair), axis(held), turnA(pair.motion.spinA - held.spin), turnB(pair.motion.spinB - held.spin) {
        const RelativeMotion& motion = pair.motion;
        const DVec2 v = motion.velocityAt(pose.fraction);
        const Vec2 velocity{v.x, v.y};
        const Vec2 bend{motion.curvature.x, motion.curvature.y};
        const double along = dot(axis.normal, pose.offset);
        centers = along - (level + pair.radii);
        centersRate = dot(axis.normal, velocity) + axis.spin * cross(axis.normal, pose.offset);
        centersCurve = 2 * dot(axis.normal, bend) + axis.spin * (2 * cross(axis.normal, velocity) - axis.spin * along);
        distance = axis.spin != 0 ? length(pose.offset) : 0;
        curvature = axis.spin != 0 ? length(bend) : 0;
    }

    /// Lower bound for a pair of vertices; `bend` is what both orders allow.
    Parabola of(Vec2 a, Vec2 b, double second, double third) const {
        const double highA = dot(axis.inA, a);
        const double lowB = dot(axis.inB, b);
        const double rate = turnB * cross(b, axis.inB) - turnA * cross(a, axis.inA);
        const double bend = turnB * turnB * lowB - turnA * turnA * highA - centersCurve + third;
        return {centers + (lowB - highA), centersRate + rate, bend < second ? bend : second};
    }
    double secondOrder(double window) const {
        const double turning = turnA * turnA * pair.a.reach() + turnB * turnB * pair.b.reach();
        if (axis.spin == 0) {
            return turning - centersCurve;
        }
        const double w = std::fabs(axis.spin);
        return turning + w * w * (distance + window * pair.fastest) + 2 * w * pair.fastest + 2 * curvature;
    }
    /// A third of the window times the bound of the third derivative.
    double thirdOrder(double window) const {
        double third = cube(std::fabs(turnA)) * pair.a.reach() + cube(std::fabs(turnB)) * pair.b.reach();
        if (axis.spin != 0) {
            const double w = std::fabs(axis.spin);
            third += w * (w * (w * (distance + window * pair.fastest) + 3 * pair.fastest) + 6 * curvature);
        }
        return (1.0 / 3) * window * third;
    }
    /// First root of the lowest of all parabolas of a window.
    double firstRootWithin(double window, const VertexRun& runA, const VertexRun& runB) const {
        const double second = secondOrder(window);
        const double third = thirdOrder(window);
        double step = window;
        int i = runA.first;
        for (int k = 0; k < runA.count; ++k, i = after(pair.a, i, runA.step)) {
            const Vec2 a = pair.a.vertex(i);
            int j = runB.first;
            for (int l = 0; l < runB.count; ++l, j = after(pair.b, j, runB.step)) {
                step = firstRoot(of(a, pair.b.vertex(j), second, third), step);
            }
        }
        return step;
    }
};

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
    if (!closest.isApart()) {
        return hold(pair, pose, rotate(pose.rotationA, closest.normal), holder);
    }
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

SafeAdvance safeAdvance(const MovingPair& pair, const PairPose& pose, const HeldAxis& axis, double level,
                        double limit) {
    const AxisProblem problem(pair, pose, axis, level);
    const Parabola now =
        problem.of(pair.a.vertex(axis.a), pair.b.vertex(axis.b), std::numeric_limits<double>::infinity(), 0);
    SafeAdvance best{0, {axis.a, 1, 1}, {axis.b, 1, 1}, false};
    best.approaches = now.rate < 0;
    double window = std::min(limit, 1.125 * firstRoot(now, limit));
    const double turn = std::max(std::fabs(problem.turnA), std::fabs(problem.turnB));
    if (turn * window > kWidestTurn) {
        window = kWidestTurn / turn;
    }
    for (int round = 0; round < kWindows; ++round) {
        const VertexRun runA = walk(pair.a, axis.a, axis.inA, problem.turnA * window);
        const VertexRun runB = walk(pair.b, axis.b, -axis.inB, problem.turnB * window);
        const double step = problem.firstRootWithin(window, runA, runB);
        if (step > best.step) {
            best.step = step;
            best.a = runA;
            best.b = runB;
        }
        if (!(step < kFilled * window)) {
            break;
        }
        window = 2 * best.step;
    }
    return best;
}

void follow(const MovingPair& pair, const PairPose& pose, const SafeAdvance& advance, HeldAxis& axis) {
    axis.normal = directionAt(pose, axis);
    if (axis.holder != AxisOwner::a) {
        axis.inA = unrotate(pose.rotationA, axis.normal);
    }
    if (axis.holder != AxisOwner::b) {
        axis.inB = unrotate(pose.rotationB, axis.normal);
    }
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
    if (!(distance > reach)) {
        return 0;
    }
    if (motion.curvature != DVec2{} || pair.isExtreme()) {
        const Vec2 unit = normalized(Vec2{offset.x, offset.y}).unit;
        const DVec2 line{unit.x, unit.y};
        return firstRoot({distance - reach, dot(line, velocity), -2 * dot(line, motion.curvature)}, limit);
    }
    const double approach = -dot(offset, velocity);
    if (!(approach > 0)) {
        return limit;
    }
    // |offset + s·velocity| = reach. The distance at which the centres pass each other comes from the cross product,
    // whose error is a rounding of the distance; the usual discriminant would lose twice the digits.
    const double aside = cross(offset, velocity);
    const double discriminant = dot(velocity, velocity) * (reach * reach) - aside * aside;
    if (discriminant < 0) {
        return limit;
    }
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
