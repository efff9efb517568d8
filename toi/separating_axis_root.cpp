#include "separating_axis_root.h"

#include "method_pair.h"

namespace swept {
namespace {

constexpr int kMaxAxes = 64;       // three are typical; each axis makes the pair's next approach shorter
constexpr int kMaxPushBacks = 16;  // every vertex of both bodies may be the deepest once
constexpr int kMaxRootSteps = 64;  // every other one halves the bracket

/// Two vertices, one of each body.
struct Deepest {
    int a = 0;
    int b = 0;
};

/// The closest direction of one pose as a function of time.
class HeldAxis {
public:
    HeldAxis(const MethodPair& pair, const MethodPose& pose, const SimplexCache& cache) : pair_(pair) {
        const Vec2 normal = pose.distance.normal;  // in the frame of A
        if (cache.count < 2) {
            holder_ = Holder::world;
            axis_ = rotate(pose.rotationA, normal);
        } else if (cache.indexA[0] == cache.indexA[1]) {
            holder_ = Holder::bodyB;
            axis_ = unrotate(pose.bInA.rotation, normal);
        } else {  // an edge of A; also where an edge of B lies parallel to it
            holder_ = Holder::bodyA;
            axis_ = normal;
        }
    }

    Deepest deepestAt(double t) const {
        const Vec2 axis = axisAt(t);
        return {supportIndex(pair_.a.polygon, unrotate(pair_.motion.rotationA(t), axis)),
                supportIndex(pair_.b.polygon, unrotate(pair_.motion.rotationB(t), -axis))};
    }

    /// Separation of two vertices along the axis, radii subtracted.
    double separationOf(Deepest pair, double t) const {
        const Vec2 a = rotate(pair_.motion.rotationA(t), pair_.a.polygon.vertices[static_cast<std::size_t>(pair.a)]);
        const Vec2 b = rotate(pair_.motion.rotationB(t), pair_.b.polygon.vertices[static_cast<std::size_t>(pair.b)]);
        return dot(axisAt(t), toReal(pair_.motion.offsetAt(t)) + b - a) - pair_.radii();
    }

private:
    enum class Holder : std::uint8_t { world, bodyA, bodyB };

    Vec2 axisAt(double t) const {
        switch (holder_) {
            case Holder::world:
                return axis_;
            case Holder::bodyA:
                return rotate(pair_.motion.rotationA(t), axis_);
            case Holder::bodyB:
                return rotate(pair_.motion.rotationB(t), axis_);
        }
        return axis_;
    }

    const MethodPair& pair_;
    Holder holder_ = Holder::world;
    Vec2 axis_;
};

enum class AxisVerdict : std::uint8_t {
    separated,  ///< to the end of the sweep
    advanced,   ///< nothing deeper at the new fraction
    reached,    ///< the vertices are at the target already where the search started
    failed,
};

struct AxisStep {
    AxisVerdict verdict = AxisVerdict::failed;
    double fraction = 0;
};

/// Some fraction in [from, to] at which two vertices are at the target; `to` when the budget ran out.
double rootBetween(const HeldAxis& axis, Deepest vertices, double from, double to, const ToiSettings& settings,
                   int& iterations) {
    double low = from;  // above the target
    double high = to;
    double aboveAtLow = axis.separationOf(vertices, low) - settings.target;
    double aboveAtHigh = axis.separationOf(vertices, high) - settings.target;
    iterations += 2;
    for (int step = 0; step < kMaxRootSteps; ++step) {
        const bool secant = step % 2 == 0;
        const double part = secant ? aboveAtLow / (aboveAtLow - aboveAtHigh) : 0.5;
        const double t = low + part * (high - low);
        const double above = axis.separationOf(vertices, t) - settings.target;
        ++iterations;
        if (std::fabs(above) < settings.tolerance) { return t; }
        (above > 0 ? low : high) = t;
        (above > 0 ? aboveAtLow : aboveAtHigh) = above;
    }
    return high;
}

/// How far one axis allows to go from the fraction at which it was taken.
AxisStep advanceAlong(const HeldAxis& axis, double from, const ToiSettings& settings, int& iterations) {
    const double top = settings.target + settings.tolerance;
    const double bottom = settings.target - settings.tolerance;
    double end = settings.tMax;
    for (int push = 0; push < kMaxPushBacks; ++push) {
        const Deepest deepest = axis.deepestAt(end);
        const double atEnd = axis.separationOf(deepest, end);
        ++iterations;
        if (atEnd > top) { return {AxisVerdict::separated, settings.tMax}; }
        if (atEnd > bottom) { return {AxisVerdict::advanced, end}; }

        const double atStart = axis.separationOf(deepest, from);
        ++iterations;
        if (atStart < bottom) { return {AxisVerdict::failed, from}; }
        if (atStart <= top) { return {AxisVerdict::reached, from}; }
        end = rootBetween(axis, deepest, from, end, settings, iterations);
    }
    return {AxisVerdict::failed, from};
}

}  // namespace

Toi separatingAxisRoot(const ToiPolygon& a, const Sweep& sweepA, const ToiPolygon& b, const Sweep& sweepB,
                       const ToiSettings& settings) {
    const MethodPair pair(a, sweepA, b, sweepB);
    SimplexCache cache;
    MethodPose pose = pair.poseAt(0, cache);
    if (const auto atStart = answerAtStart(pose, sweepA, settings)) { return *atStart; }

    MethodLook before{pose.fraction, pose.distance.distance};
    int iterations = 1;
    for (int axes = 0; axes < kMaxAxes; ++axes) {
        if (pose.distance.distance <= settings.target + settings.tolerance) {
            return hitAfter(before, pose, sweepA, settings, iterations);
        }
        const AxisStep step = advanceAlong(HeldAxis(pair, pose, cache), pose.fraction, settings, iterations);
        switch (step.verdict) {
            case AxisVerdict::advanced:
                if (!(step.fraction > pose.fraction)) {
                    return answerFrom(pose, sweepA, settings, ToiState::failed, iterations);
                }
                before = {pose.fraction, pose.distance.distance};
                pose = pair.poseAt(step.fraction, cache);
                ++iterations;
                break;
            case AxisVerdict::separated:
                return answerFrom(pair.poseAt(step.fraction, cache), sweepA, settings, ToiState::separated,
                                  iterations + 1);
            case AxisVerdict::reached:
                return hitAfter(before, pose, sweepA, settings, iterations);
            case AxisVerdict::failed:
                return answerFrom(pose, sweepA, settings, ToiState::failed, iterations);
        }
    }
    return answerFrom(pose, sweepA, settings, ToiState::failed, iterations);
}

}  // namespace swept
