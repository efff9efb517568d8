#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "../oracle/interval.h"
#include "../support/random.h"

/// The intervals hold what long double computes. That is a proof up to long double's own rounding for free: a double
/// bound is a long double, so rounding the exact result to the nearest long double cannot move it across the bound.

namespace swept::oracle {
namespace {

using Long = long double;
using test::Random;

constexpr int kIntervalCases = 200'000;

double wideDouble(Random& random) { return random.sign() * std::ldexp(random.range(0.5, 1), random.integer(-40, 40)); }

struct Sample {
    Interval interval;
    double inside = 0;
};

/// Thin, some roundings wide, or as wide as it comes; the point is often an end.
Sample sample(Random& random) {
    const double x = wideDouble(random);
    double y = x;
    if (random.chance(0.3)) { y = x * (1 + random.range(0, 1e-14)); }
    if (random.chance(0.3)) { y = wideDouble(random); }
    const Interval interval{std::min(x, y), std::max(x, y)};
    const double ends[] = {interval.lo, interval.hi,
                           std::min(interval.hi, interval.lo + random.uniform() * (interval.hi - interval.lo))};
    return {interval, ends[random.integer(0, 2)]};
}

::testing::AssertionResult holds(Interval interval, Long value) {
    if (interval.lo <= value && value <= interval.hi) { return ::testing::AssertionSuccess(); }
    return ::testing::AssertionFailure() << value << " is not in [" << interval.lo << ", " << interval.hi << ']';
}

TEST(Interval, NeighboursAreThoseOfTheLibrary) {
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    Random random(1);
    for (int i = 0; i < kIntervalCases; ++i) {
        const double x = wideDouble(random);
        ASSERT_EQ(nextUp(x), std::nextafter(x, kInfinity));
        ASSERT_EQ(nextDown(x), std::nextafter(x, -kInfinity));
    }
    constexpr double kTiny = std::numeric_limits<double>::denorm_min();
    constexpr double kLargest = std::numeric_limits<double>::max();
    for (const double x : {0.0, -0.0, kTiny, -kTiny, kLargest, -kLargest, kInfinity, -kInfinity,
                           std::numeric_limits<double>::min(), -std::numeric_limits<double>::min()}) {
        EXPECT_EQ(nextUp(x), std::nextafter(x, kInfinity)) << x;
        EXPECT_EQ(nextDown(x), std::nextafter(x, -kInfinity)) << x;
    }
}

TEST(Interval, OperationsHoldTheExactResult) {
    Random random(2);
    for (int i = 0; i < kIntervalCases; ++i) {
        const Sample a = sample(random);
        const Sample b = sample(random);
        const Long x = a.inside;
        const Long y = b.inside;
        ASSERT_TRUE(holds(a.interval + b.interval, x + y)) << i;
        ASSERT_TRUE(holds(a.interval - b.interval, x - y)) << i;
        ASSERT_TRUE(holds(a.interval * b.interval, x * y)) << i;
        ASSERT_TRUE(holds(a.interval / b.interval, x / y)) << i;
        ASSERT_TRUE(holds(-a.interval, -x)) << i;
        ASSERT_TRUE(holds(square(a.interval), x * x)) << i;
        if (x >= 0) { ASSERT_TRUE(holds(sqrt(a.interval), std::sqrt(x))) << i; }
        ASSERT_TRUE(holds(join(a.interval, b.interval), x));
        ASSERT_GE(a.interval.magnitude(), a.inside);
        ASSERT_LE(std::fabs(x - a.interval.middle()), a.interval.radius());
    }
}

TEST(Interval, ThinOperandsGiveThinResults) {
    Random random(3);
    for (int i = 0; i < kIntervalCases; ++i) {
        const double x = wideDouble(random);
        const double y = wideDouble(random);
        for (const Interval result : {Interval(x) + Interval(y), Interval(x) * Interval(y), Interval(x) / Interval(y),
                                      sqrt(Interval(std::fabs(x))), square(Interval(x))}) {
            ASSERT_LE(result.hi - result.lo, 5e-16 * result.magnitude()) << x << ' ' << y;
        }
    }
}

TEST(Interval, WhatHasNoAnswerProvesNothing) {
    const Interval everything = Interval(1) / Interval(-1, 1);
    EXPECT_TRUE(everything.contains(1e300));
    EXPECT_TRUE(everything.contains(-1e300));
    const Interval huge{1e300, 1e301};
    EXPECT_FALSE((huge * huge).below(std::numeric_limits<double>::max()));
    const Interval undefined = huge * huge - huge * huge;
    EXPECT_FALSE(undefined.above(0));
    EXPECT_FALSE(undefined.below(0));
}

TEST(Interval, SineAndCosineHoldThoseOfLongDouble) {
    // The library's functions are good to a few 1e-20 on these angles.
    constexpr Long kLibrary = 1e-18L;
    Random random(4);
    for (int i = 0; i < kIntervalCases; ++i) {
        const double scale = random.chance(0.5) ? 10 : random.chance(0.5) ? 1e-8 : 1e5;
        double x = random.range(-scale, scale);
        if (random.chance(0.2)) { x = 1.5707963267948966 * random.integer(-1000, 1000); }  // where quadrants change
        const SinCos thin = sinCos(x);
        const Long s = std::sin(static_cast<Long>(x));
        const Long c = std::cos(static_cast<Long>(x));
        ASSERT_TRUE(thin.sin.lo - kLibrary <= s && s <= thin.sin.hi + kLibrary) << x;
        ASSERT_TRUE(thin.cos.lo - kLibrary <= c && c <= thin.cos.hi + kLibrary) << x;
        ASSERT_LE(thin.sin.hi - thin.sin.lo, 4e-15) << x;
        ASSERT_LE(thin.cos.hi - thin.cos.lo, 4e-15) << x;

        const double end = x + (random.chance(0.5) ? random.range(0, 4) : 1e-6);
        const double width = end - x;
        const SinCos wide = sinCos(Interval(x, end));
        const Long inside = static_cast<Long>(x) + random.uniform() * static_cast<Long>(width);
        ASSERT_TRUE(wide.sin.lo <= std::sin(inside) && std::sin(inside) <= wide.sin.hi) << x << ' ' << width;
        ASSERT_TRUE(wide.cos.lo <= std::cos(inside) && std::cos(inside) <= wide.cos.hi) << x << ' ' << width;
        ASSERT_LE(wide.sin.hi - wide.sin.lo, width + 1e-14 + 1e-15 * std::fabs(x));
    }
}

TEST(Interval, AnglesBeyondAllReasonGiveTheWholeRange) {
    for (const double angle : {1e10, -1e300, std::numeric_limits<double>::infinity()}) {
        const SinCos result = sinCos(angle);
        EXPECT_EQ(result.sin.lo, -1);
        EXPECT_EQ(result.sin.hi, 1);
        EXPECT_EQ(result.cos.lo, -1);
        EXPECT_EQ(result.cos.hi, 1);
    }
}

}  // namespace
}  // namespace swept::oracle
