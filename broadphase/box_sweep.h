#pragma once

#include <limits>

#include "../shapes/aabb.h"
#include "../shapes/dvec2.h"

namespace swept::inline SWEPT_PRECISION {

/// A box carried along a straight line, asked against many others; a ray is the case of a box without extent.
/// Slab method in double: the boxes overlap in one axis from (other.lower − upper) / d to (other.upper − lower) / d.
///
/// A difference and a quotient are off by half an ulp each, so widening the interval by two ulps never loses a meeting
/// of the exact boxes. Every operation is monotone in the other box: if a box is met, so is every box that contains it,
/// and a tree finds just what a loop over all boxes finds.
class BoxSweep {
public:
    BoxSweep(DVec2 lower, DVec2 upper, DVec2 translation)
        : x_{lower.x, upper.x, translation.x}, y_{lower.y, upper.y, translation.y} {}

    static BoxSweep ofRay(DVec2 origin, DVec2 direction) { return {origin, origin, direction}; }
    static BoxSweep ofBox(const Aabb& box, DVec2 translation) {
        return {toDouble(box.lower), toDouble(box.upper), translation};
    }

    DVec2 lower() const { return {x_.lower, y_.lower}; }
    DVec2 upper() const { return {x_.upper, y_.upper}; }
    DVec2 translation() const { return {x_.speed, y_.speed}; }

    /// Fraction, 0 … limit, at or shortly before which the boxes first touch; `kNever` when they do not touch by then,
    /// and when a number of the sweep is NaN.
    double firstTouch(const Aabb& other, double limit) const {
        const Interval x = x_.overlap(static_cast<double>(other.lower.x), static_cast<double>(other.upper.x));
        const Interval y = y_.overlap(static_cast<double>(other.lower.y), static_cast<double>(other.upper.y));
        if (!(x.enter <= x.exit && y.enter <= y.exit)) { return kNever; }  // also when one is NaN
        double enter = x.enter > y.enter ? x.enter : y.enter;
        if (enter < 0) { enter = 0; }
        return enter <= limit && enter <= x.exit && enter <= y.exit ? enter : kNever;
    }

    static constexpr double kNever = std::numeric_limits<double>::infinity();

private:
    struct Interval {
        double enter;
        double exit;
    };

    struct Axis {
        double lower;
        double upper;
        double speed;

        Interval overlap(double otherLower, double otherUpper) const {
            if (speed == 0) {
                const bool always = otherLower <= upper && lower <= otherUpper;
                return always ? Interval{-kNever, kNever} : Interval{kNever, -kNever};
            }
            const double ahead = (otherLower - upper) / speed;
            const double behind = (otherUpper - lower) / speed;
            return speed > 0 ? Interval{earlier(ahead), later(behind)} : Interval{earlier(behind), later(ahead)};
        }
    };

    static constexpr double kWidening = 2 * std::numeric_limits<double>::epsilon();
    // As one product each, so that rounding keeps them monotone.
    static double earlier(double t) { return t * (t > 0 ? 1 - kWidening : 1 + kWidening); }
    static double later(double t) { return t * (t > 0 ? 1 + kWidening : 1 - kWidening); }

    Axis x_;
    Axis y_;
};

}  // namespace swept::inline SWEPT_PRECISION
