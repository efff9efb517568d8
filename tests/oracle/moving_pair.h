#pragma once

#include <array>

#include <swept/toi/time_of_impact.h>

#include "interval.h"
#include "plain_separation.h"
#include "turning.h"

namespace swept::oracle {

/// Two moving polygons in interval arithmetic, and what can be proved of their separation. Separation is the largest
/// gap along any unit vector: the distance of the cores when they are apart, minus the smallest translation that parts
/// them when they overlap; less both radii.
///
/// Lower bounds come from gaps along a single axis, over a time [from, to] at once. The axis is u at the middle m and
/// turns at a constant rate σ (0, or that of a body). Each vertex r of a body that turns at ω projects to f(s) = w(s)·r
/// at m + s, where w is u as the body sees it: it turns at −ρ, ρ = ω − σ. By Taylor's theorem
///     f(s) ∈ f(0) + s f′(0) + ½ s² f″([−h, h]),   f″ = −ρ² w·r − ω′ (Jw)·r,   J a quarter turn,
/// with f″ enclosed over the whole time (ω′ = 0 where bodies turn at a constant rate); the projection of the centres'
/// difference likewise. As every f is bounded from below by a function whose graph bends downward, so is the smallest
/// of them, and a sum of such functions is smallest at an end: s = −h or s = h.
class MovingPair {
public:
    MovingPair(const ToiPolygon& a, const Sweep& sweepA, const ToiPolygon& b, const Sweep& sweepB);
    /// The same with bodies that turn otherwise than the angles of their sweeps say.
    MovingPair(const ToiPolygon& a, const Sweep& sweepA, const Turning& turningA, const ToiPolygon& b,
               const Sweep& sweepB, const Turning& turningB);

    double radii() const { return radii_; }

    /// Separation in plain double; a guess.
    PlainSeparation guess(double fraction) const;
    double guessSeparation(double fraction) const { return guess(fraction).core - radii_; }

    /// Everything about one fraction that does not depend on an axis.
    struct Moment {
        double fraction = 0;
        SinCos rotationA;
        SinCos rotationB;
        IntervalVec centers;   // of B minus of A
        IntervalVec velocity;  // per unit of fraction
    };
    Moment momentAt(double fraction) const;

    /// Whether the gap along an axis proves separation > level throughout [middle − half, middle + half].
    /// @param axis  at the middle; any length.
    /// @param spin  at which it turns, radians per unit of fraction.
    bool staysAbove(double level, const Moment& middle, double half, PlainVec axis, double spin) const;

    /// An enclosure of the separation at one fraction.
    Interval separationAt(double fraction) const { return separationAt(fraction, guess(fraction)); }
    Interval separationAt(double fraction, const PlainSeparation& guess) const;

    /// Without radii.
    Interval coreSeparationAt(double fraction) const { return coreSeparationAt(fraction, guess(fraction)); }
    Interval coreSeparationAt(double fraction, const PlainSeparation& guess) const;

    /// Lower bound of the separation at one fraction by the gap along an axis of any length.
    double gapAt(double fraction, PlainVec axis) const;

    /// How fast they turn at a fraction; a guess, but exactly 0 for one that does not turn at all.
    double spinA(double fraction) const { return a_.turning.rateOver(fraction).middle(); }
    double spinB(double fraction) const { return b_.turning.rateOver(fraction).middle(); }

private:
    struct Body {
        std::array<IntervalVec, 8> vertices{};  // relative to the centre of mass, body frame
        int count = 0;
        double reach = 0;  // no vertex is farther from the centre
        Turning turning;
    };
    /// How fast a body turns relative to an axis, over a time span.
    struct Rates {
        Interval atMiddle;
        Interval throughout;
        Interval change;  // throughout
    };
    /// Bounds at both ends of a time span.
    struct Ends {
        double atStart = 0;
        double atEnd = 0;
    };

    const ToiPolygon& polygonA_;
    const ToiPolygon& polygonB_;
    const Sweep& sweepA_;
    const Sweep& sweepB_;
    Body a_;
    Body b_;
    IntervalVec start_;      // centre of B minus centre of A at fraction 0
    IntervalVec change_;     // what the straight part adds until fraction 1
    IntervalVec curvature_;  // k of B minus k of A
    double radii_ = 0;       // rounded to nearest; the interval below holds the sum
    Interval radiiInterval_;

    static Body bodyOf(const ToiPolygon& polygon, const Sweep& sweep, const Turning& turning);
    static SinCos rotationAt(const Body& body, double t) { return body.turning.at(t); }
    static Rates ratesOf(const Body& body, double middle, double spin, double half);
    static IntervalVec bendOf(const Rates& rates, IntervalVec w, Interval longest, double half);
    static Ends lowestProjection(const Body& body, SinCos rotation, double middle, PlainVec axis, double spin,
                                 double half);
    Ends lowestOfCenters(const Moment& middle, PlainVec axis, double spin, double half) const;
    IntervalVec centersAt(Interval t) const;
    IntervalVec velocityAt(Interval t) const;
    double largestEdgeGap(double fraction) const;
    double upperDistance(double fraction, const PlainSeparation& guess) const;
};

}  // namespace swept::oracle
