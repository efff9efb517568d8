#include "moving_pair.h"

#include <limits>

namespace swept::oracle {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

IntervalVec exactly(PlainVec v) { return {v.x, v.y}; }
IntervalVec exactly(DVec2 v) { return {v.x, v.y}; }
bool isFinite(Interval i) { return std::isfinite(i.lo) && std::isfinite(i.hi); }

/// What turns by any angle of [−angle, angle] from `v`, whose length is at most `longest`: no component moves faster
/// than the length.
IntervalVec blurred(IntervalVec v, double angle, double longest) {
    const Interval width = Interval::around(nextUp(angle * longest));
    const Interval all = Interval::around(longest);
    return {meet(v.x + width, all), meet(v.y + width, all)};
}

/// s = −half and s = half, with an upper bound of ½ s².
struct Span {
    double half = 0;
    double halfSquare = 0;

    explicit Span(double h) : half(h), halfSquare(nextUp(0.5 * nextUp(h * h))) {}

    /// Lower bound of value + s·slope + ½ s²·bend, with the bend made to go downward.
    double below(Interval value, Interval slope, double bend, double s) const {
        const double linear = nextDown(std::min(s * slope.lo, s * slope.hi));
        const double quadratic = nextDown(halfSquare * std::min(0.0, bend));
        return nextDown(nextDown(value.lo + linear) + quadratic);
    }
};

}  // namespace

MovingPair::Body MovingPair::bodyOf(const ToiPolygon& polygon, const Sweep& s, const Turning& turning) {
    Body body;
    body.count = polygon.count;
    for (std::size_t i = 0; i < static_cast<std::size_t>(polygon.count); ++i) {
        body.vertices[i] = exactly(polygon.vertices[i]) - exactly(s.localCenter);
        body.reach = std::max(body.reach, length(body.vertices[i]).hi);
    }
    body.turning = turning;
    return body;
}

MovingPair::MovingPair(const ToiPolygon& a, const Sweep& sweepA, const ToiPolygon& b, const Sweep& sweepB)
    : MovingPair(a, sweepA, Turning::steady(sweepA.a0, sweepA.a1), b, sweepB, Turning::steady(sweepB.a0, sweepB.a1)) {}

MovingPair::MovingPair(const ToiPolygon& a, const Sweep& sweepA, const Turning& turningA, const ToiPolygon& b,
                       const Sweep& sweepB, const Turning& turningB)
    : polygonA_(a),
      polygonB_(b),
      sweepA_(sweepA),
      sweepB_(sweepB),
      a_(bodyOf(a, sweepA, turningA)),
      b_(bodyOf(b, sweepB, turningB)),
      start_(exactly(sweepB.c0) - exactly(sweepA.c0)),
      change_((exactly(sweepB.c1) - exactly(sweepA.c1)) - start_),
      curvature_(exactly(sweepB.k) - exactly(sweepA.k)),
      radii_(a.radius + b.radius),
      radiiInterval_(Interval(a.radius) + Interval(b.radius)) {}

PlainSeparation MovingPair::guess(double fraction) const {
    return plainSeparation(polygonA_, sweepA_, a_.turning.guess(fraction), polygonB_, sweepB_,
                           b_.turning.guess(fraction), fraction);
}

IntervalVec MovingPair::centersAt(Interval t) const { return start_ + t * change_ + (t * (t - 1.0)) * curvature_; }

IntervalVec MovingPair::velocityAt(Interval t) const { return change_ + (2.0 * t - 1.0) * curvature_; }

MovingPair::Moment MovingPair::momentAt(double fraction) const {
    return {fraction, rotationAt(a_, fraction), rotationAt(b_, fraction), centersAt(fraction), velocityAt(fraction)};
}

/// Encloses w″ over the whole time, where w is the axis as the body sees it.
IntervalVec MovingPair::bendOf(const Rates& rates, IntervalVec w, Interval longest, double half) {
    const IntervalVec turning = blurred(w, nextUp(rates.throughout.magnitude() * half), longest.hi);
    const IntervalVec inward = -square(rates.throughout) * turning;
    const bool isSteady = rates.change.lo == 0 && rates.change.hi == 0;
    return isSteady ? inward : inward - rates.change * leftOf(turning);
}

MovingPair::Rates MovingPair::ratesOf(const Body& body, double middle, double spin, double half) {
    if (body.turning.isSteady()) {
        const Interval rate = body.turning.rateOver(middle) - spin;
        return {rate, rate, 0};
    }
    const Interval whole = Interval(middle) + Interval::around(half);
    return {body.turning.rateOver(middle) - spin, body.turning.rateOver(whole) - spin,
            body.turning.rateChangeOver(whole)};
}

MovingPair::Ends MovingPair::lowestProjection(const Body& body, SinCos rotation, double middle, PlainVec axis,
                                              double spin, double half) {
    const IntervalVec u = exactly(axis);
    const Interval longest = length(u);
    const Span span(half);
    const IntervalVec w = turnedBack(rotation, u);
    const Rates rates = ratesOf(body, middle, spin, half);
    // Over many turns the circle about the centre is the better bound, and where the turning is unknown the only one.
    const double ofCircle = -(Interval(body.reach) * longest).hi;
    if (!isFinite(rates.throughout) || !isFinite(rates.change)) { return {ofCircle, ofCircle}; }
    const IntervalVec slope = -rates.atMiddle * leftOf(w);
    const IntervalVec bend = bendOf(rates, w, longest, half);
    Ends lowest{kInfinity, kInfinity};
    for (std::size_t i = 0; i < static_cast<std::size_t>(body.count); ++i) {
        const IntervalVec r = body.vertices[i];
        const Interval value = dot(w, r);
        const Interval gain = dot(slope, r);
        const double bendLow = dot(bend, r).lo;
        lowest.atStart = std::min(lowest.atStart, span.below(value, gain, bendLow, -half));
        lowest.atEnd = std::min(lowest.atEnd, span.below(value, gain, bendLow, half));
    }
    if (std::min(lowest.atStart, lowest.atEnd) < ofCircle) { return {ofCircle, ofCircle}; }
    return lowest;
}

MovingPair::Ends MovingPair::lowestOfCenters(const Moment& middle, PlainVec axis, double spin, double half) const {
    const IntervalVec u = exactly(axis);
    const Span span(half);
    const Interval value = dot(u, middle.centers);
    Interval slope = dot(u, middle.velocity);
    Interval bend = 2.0 * dot(u, curvature_);
    if (spin != 0) {  // u·d with u′ = σ leftOf(u), u″ = −σ² u
        const Interval sigma = spin;
        const Interval whole = Interval(middle.fraction) + Interval::around(half);
        const IntervalVec turning = blurred(u, nextUp(std::fabs(spin) * half), length(u).hi);
        slope = slope + sigma * dot(leftOf(u), middle.centers);
        bend = 2.0 * dot(turning, curvature_) + 2.0 * sigma * dot(leftOf(turning), velocityAt(whole)) -
               square(sigma) * dot(turning, centersAt(whole));
    }
    return {span.below(value, slope, bend.lo, -half), span.below(value, slope, bend.lo, half)};
}

bool MovingPair::staysAbove(double level, const Moment& middle, double half, PlainVec axis, double spin) const {
    const double needed = ((Interval(level) + radiiInterval_) * length(exactly(axis))).hi;
    const Ends centers = lowestOfCenters(middle, axis, spin, half);
    const Ends ofB = lowestProjection(b_, middle.rotationB, middle.fraction, axis, spin, half);
    const Ends ofA = lowestProjection(a_, middle.rotationA, middle.fraction, -axis, spin, half);
    const Interval atStart = Interval(centers.atStart) + Interval(ofB.atStart) + Interval(ofA.atStart);
    const Interval atEnd = Interval(centers.atEnd) + Interval(ofB.atEnd) + Interval(ofA.atEnd);
    return atStart.above(needed) && atEnd.above(needed);
}

double MovingPair::gapAt(double fraction, PlainVec axis) const {
    const Moment moment = momentAt(fraction);
    const Interval gap = Interval(lowestOfCenters(moment, axis, 0, 0).atStart) +
                         Interval(lowestProjection(b_, moment.rotationB, fraction, axis, 0, 0).atStart) +
                         Interval(lowestProjection(a_, moment.rotationA, fraction, -axis, 0, 0).atStart);
    return (Interval(gap.lo) / length(exactly(axis)) - radiiInterval_).lo;
}

/// Upper bound of the largest gap along the normals of all edges: when it is negative the cores overlap, and minus the
/// penetration depth is the largest of these gaps. (The difference of two convex polygons has the edges of both; so
/// also for segments, with both sides, unless they are parallel, but then some gap is not negative.)
double MovingPair::largestEdgeGap(double fraction) const {
    std::array<IntervalVec, 8> placedA;
    std::array<IntervalVec, 8> placedB;
    const auto countA = static_cast<std::size_t>(a_.count);
    const auto countB = static_cast<std::size_t>(b_.count);
    const SinCos rotationA = rotationAt(a_, fraction);
    const SinCos rotationB = rotationAt(b_, fraction);
    for (std::size_t i = 0; i < countA; ++i) { placedA[i] = turned(rotationA, a_.vertices[i]); }
    for (std::size_t i = 0; i < countB; ++i) { placedB[i] = centersAt(fraction) + turned(rotationB, b_.vertices[i]); }
    double largest = -kInfinity;
    const auto tryEdges = [&largest](const auto& p, std::size_t countP, const auto& q, std::size_t countQ) {
        for (std::size_t i = 0; countP > 1 && i < countP; ++i) {
            const IntervalVec edge = p[i + 1 < countP ? i + 1 : 0] - p[i];
            const IntervalVec outward{edge.y, -edge.x};
            Interval gap{kInfinity};
            for (std::size_t j = 0; j < countQ; ++j) {
                const Interval projection = dot(outward, q[j] - p[i]);
                gap = {std::min(gap.lo, projection.lo), std::min(gap.hi, projection.hi)};
            }
            const Interval size = length(edge);
            largest = std::max(largest, size.lo > 0 ? (gap / size).hi : kInfinity);
        }
    };
    tryEdges(placedA, countA, placedB, countB);
    tryEdges(placedB, countB, placedA, countA);
    return largest == -kInfinity ? kInfinity : largest;
}

/// Upper bound by two points of the cores.
double MovingPair::upperDistance(double fraction, const PlainSeparation& guess) const {
    const auto place = [fraction](const Body& body, PointOnEdge point) {
        const IntervalVec from = body.vertices[point.from];
        return turned(rotationAt(body, fraction), from + Interval(point.part) * (body.vertices[point.to] - from));
    };
    return length(centersAt(fraction) + place(b_, guess.onB) - place(a_, guess.onA)).hi;
}

Interval MovingPair::coreSeparationAt(double fraction, const PlainSeparation& guess) const {
    const double low = (Interval(gapAt(fraction, guess.axis)) + radiiInterval_).lo;
    double high = upperDistance(fraction, guess);
    if (low <= 0) {
        const double byEdges = largestEdgeGap(fraction);
        if (byEdges < 0) { high = byEdges; }
    }
    return {low, high};
}

Interval MovingPair::separationAt(double fraction, const PlainSeparation& guess) const {
    return coreSeparationAt(fraction, guess) - radiiInterval_;
}

}  // namespace swept::oracle
