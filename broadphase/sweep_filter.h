#pragma once

#include <cmath>
#include <limits>

#include "box_sweep.h"

namespace swept::inline SWEPT_PRECISION {

/// What lets a box be told from those that a sweep meets (`BoxSweep::firstTouch`) by a few products and no division, so
/// that eight boxes can be asked at once. Never leaves out what is met; what it lets through is asked again, exactly.
/// (In f64 where fractions are normal numbers: what is 2⁻¹⁰²² of the way apart may touch for `firstTouch` alone.)
///
/// Two tests: against the box around the sweep up to the limit, and, on the axis across the motion, against the strip
/// that the swept box covers (separating axes of a box and a segment). The second one is in units of four metres: so no
/// sum in it leaves the range of `Real`, wherever the two boxes are.
struct SweepFilter {
    Aabb around;  ///< metres; the sweep up to the limit, rounded outward
    // The strip |across · (center − middle)| ≤ reach, where `across` is at most 1 in each coordinate.
    Vec2 across;
    Vec2 middle;     ///< of the box at the start
    Real reach = 0;  ///< half the strip's width times the length of `across`, what rounding may amount to included

    /// From metres to halves of coordinates in the units of the strip.
    static constexpr Real kHalf = Real(0.125);

    /// Rounding in the test of a box, as part of its coordinates: a dozen operations, each off by half an ulp at most.
    static constexpr Real kRounding = 16 * std::numeric_limits<Real>::epsilon();

    static SweepFilter of(const BoxSweep& sweep, double limit) {
        SweepFilter filter;
        const DVec2 by = sweep.translation();
        filter.around = aroundUpTo(sweep, limit);
        const double longest = std::fmax(std::fabs(by.x), std::fabs(by.y));
        if (longest > 0) { filter.across = {static_cast<Real>(-by.y / longest), static_cast<Real>(by.x / longest)}; }
        const DVec2 lower = static_cast<double>(kHalf) * sweep.lower();
        const DVec2 upper = static_cast<double>(kHalf) * sweep.upper();
        const Vec2 half = toReal(upper - lower);
        filter.middle = toReal(lower + upper);
        // What a dozen operations may each be off by where their results are subnormal.
        constexpr Real kLeast = (std::numeric_limits<Real>::min)();
        filter.reach = std::fabs(filter.across.x) * half.x + std::fabs(filter.across.y) * half.y +
                       kRounding * (std::fabs(filter.middle.x) + std::fabs(filter.middle.y) + half.x + half.y) + kLeast;
        return filter;
    }

    /// The first test alone, for a limit that has become smaller.
    static Aabb aroundUpTo(const BoxSweep& sweep, double limit) {
        // firstTouch() takes an interval that is wider than the exact one by a few ulps: so does this.
        constexpr double kWider = 1 + 8 * std::numeric_limits<double>::epsilon();
        const DVec2 way = (limit * kWider) * sweep.translation();
        const DVec2 lower = sweep.lower();
        const DVec2 upper = sweep.upper();
        return roundedOutward({lower.x + std::fmin(way.x, 0.0), lower.y + std::fmin(way.y, 0.0)},
                              {upper.x + std::fmax(way.x, 0.0), upper.y + std::fmax(way.y, 0.0)});
    }
};

}  // namespace swept::inline SWEPT_PRECISION
