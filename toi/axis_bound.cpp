#include "axis_bound.h"

#include <algorithm>

#include "parabola.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// A narrower window is tried again only if its bound is smaller by this factor.
constexpr double kWorthwhile = 0.75;
/// A step of this part of what is left is good enough not to look at further axes. Looking at all of them always saves 2 %
/// of the steps on generic pairs and 5 % on spinning bars, and costs a fifth more time.
constexpr double kGoodStep = 1.0 / 1024;

/// Projections of one body's vertices on the axis, relative to the body's centre, and how fast they change when the body
/// turns by one radian against the axis. The same for every rate at which the axis may turn.
struct Projections {
    // Without initial values: the first `count` are written at once.
    std::array<double, kMaxPolygonVertices> values;
    std::array<double, kMaxPolygonVertices> turns;
    int count;
    double reach;  ///< of the body: bounds the second derivative per squared radian

    /// Index of the lowest projection after `angle` radians, to first order.
    int lowestAfter(double angle) const {
        int lowest = 0;
        double least = values[0] + angle * turns[0];
        for (int i = 1; i < count; ++i) {
            const double value = values[static_cast<std::size_t>(i)] + angle * turns[static_cast<std::size_t>(i)];
            lowest = value < least ? i : lowest;
            least = value < least ? value : least;
        }
        return lowest;
    }
    double value(int i) const { return values[static_cast<std::size_t>(i)]; }
    double turn(int i) const { return turns[static_cast<std::size_t>(i)]; }
};

void project(const Polygon& body, double reach, Vec2 axis, Projections& result) {
    result.count = body.count;
    result.reach = reach;
    for (std::size_t i = 0; i < static_cast<std::size_t>(body.count); ++i) {
        result.values[i] = dot(axis, body.vertices[i]);
        result.turns[i] = cross(body.vertices[i], axis);
    }
}

/// What the bounds of one pose have in common.
struct AxisProblem {
    const MovingPair& pair;
    const PairPose& pose;
    double level;
    double limit;
    Projections a;  ///< against the axis
    Projections b;

    AxisProblem(const MovingPair& movingPair, const PairPose& pairPose, double atLevel, double upTo)
        : pair(movingPair), pose(pairPose), level(atLevel), limit(upTo) {
        const Vec2 axis = pose.distance.normal;
        project(pair.a.polygon, pair.a.reach, -axis, a);
        project(pose.turnedB, pair.b.reach, axis, b);
    }
};

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

/// First time in [0, window] at which the lowest sum of one projection of each body and the centres' bound is down to 0.
double firstRootOfEnvelope(const AxisProblem& problem, double relativeA, double relativeB, const Parabola& centers,
                           double window) {
    // All bounds bend alike, so their envelope is concave: above 0 at both ends of an interval it is above 0 between. Take
    // the pair that is lowest at the end and go back to its root, until nothing is below 0 at the end. Each pair has its
    // turn at most once.
    double s = window;
    int i = problem.a.lowestAfter(relativeA * s);
    int j = problem.b.lowestAfter(relativeB * s);
    for (int turn = 0; turn < problem.a.count * problem.b.count; ++turn) {
        const Parabola lowest{centers.value + (problem.a.value(i) + problem.b.value(j)),
                              centers.rate + (relativeA * problem.a.turn(i) + relativeB * problem.b.turn(j)),
                              centers.bend};
        const double root = firstRoot(lowest, s);
        if (!(root < s)) { break; }
        s = root;
        // A body that turns with the axis keeps its lowest vertex.
        if (relativeA != 0) { i = problem.a.lowestAfter(relativeA * s); }
        if (relativeB != 0) { j = problem.b.lowestAfter(relativeB * s); }
    }
    return s;
}

/// Safe advance along one axis that turns at `spin`.
double advanceAlong(const AxisProblem& problem, double spin) {
    const MovingPair& pair = problem.pair;
    const double relativeA = pair.motion.spinA - spin;
    const double relativeB = pair.motion.spinB - spin;
    const double turning = relativeA * relativeA * problem.a.reach + relativeB * relativeB * problem.b.reach;

    // A short window has a smaller bound, so narrow it while the step fills only a small part of it. Quartering bounds
    // the loop: a few rounds gain what there is to gain.
    constexpr int kWindows = 4;
    double window = problem.limit;
    double step = 0;
    double bend = std::numeric_limits<double>::infinity();
    for (int round = 0; round < kWindows; ++round) {
        Parabola centers = projectCenters(pair, problem.pose, problem.pose.distance.normal, spin, window);
        centers.value -= problem.level + pair.radii();
        if (relativeA != 0 || relativeB != 0) { centers.bend = std::max(centers.bend, 0.0) + turning; }
        if (!(centers.bend < bend * kWorthwhile)) { break; }
        bend = centers.bend;
        step = std::max(step, firstRootOfEnvelope(problem, relativeA, relativeB, centers, window));
        if (spin == 0 || 4 * step >= window) { break; }
        window = 4 * step;
    }
    return step;
}

/// The rate at which the axis is held best: a face normal turns with its body, the line between two vertices with neither.
double preferredSpin(const MovingPair& pair, const PairPose& pose) {
    switch (pose.axisOwner) {
        case AxisOwner::world: return 0;
        case AxisOwner::a: return pair.motion.spinA;
        case AxisOwner::b: return pair.motion.spinB;
    }
    return 0;  // unreachable, but GCC cannot know
}

}  // namespace

double advanceOfCircles(const MovingPair& pair, Vec2 offset, Vec2 velocity, Vec2 curvature, double level, double limit) {
    const UnitAndLength line = normalized(offset);
    const double reach = level + pair.radii() + pair.a.reach + pair.b.reach;
    return firstRoot({line.length - reach, dot(line.unit, velocity), -2 * dot(line.unit, curvature)}, limit);
}

double safeAdvance(const MovingPair& pair, const PairPose& pose, double level, double limit) {
    const double spinA = pair.motion.spinA;
    const double spinB = pair.motion.spinB;
    const AxisProblem problem(pair, pose, level, limit);
    const double preferred = preferredSpin(pair, pose);
    double best = advanceAlong(problem, preferred);
    // A good step is taken at once; only a short one is worth looking at the other axes.
    if (best >= limit || (spinA == 0 && spinB == 0) || best >= kGoodStep * limit) { return best; }
    for (const double spin : {0.0, spinA, spinB}) {
        if (best < limit && spin != preferred) { best = std::max(best, advanceAlong(problem, spin)); }
    }
    if (best < limit) {
        best = std::max(best, advanceOfCircles(pair, pose.bInA.translation, pose.velocity, pose.curvature, level, limit));
    }
    return best;
}

}  // namespace swept::inline SWEPT_PRECISION
