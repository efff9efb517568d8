#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <swept/shapes/trig.h>

#include "../support/random.h"

/// Bounds stated in trig.h, against the long double functions of the C library (64 bits of significand).

namespace swept::test {
namespace {

const long double kExactPi = std::acos(-1.0L);

long double worstOf(SinCos got, double angle) {
    const long double x = angle;
    return std::fmax(std::fabs(static_cast<long double>(got.sin) - std::sin(x)),
                     std::fabs(static_cast<long double>(got.cos) - std::cos(x)));
}

TEST(SinCos, HasItsErrorBoundUpTo2To20) {
    Random random(1);
    long double worst = 0;
    for (int i = 0; i < 400'000; ++i) {
        const double scale = std::ldexp(1.0, random.integer(-30, 20));
        const double angle = random.range(-scale, scale);
        worst = std::fmax(worst, worstOf(sinCos(angle), angle));
    }
    EXPECT_LT(worst, 0x1p-53L);
    EXPECT_GT(worst, 0x1p-55L) << "rounding alone makes errors of this size: nothing was measured";
}

TEST(SinCos, HasItsErrorBoundNextToEveryKindOfQuadrantBoundary) {
    Random random(2);
    long double worst = 0;
    for (int i = 0; i < 200'000; ++i) {
        const int eighths = random.integer(-1'300'000, 1'300'000);
        const double boundary = static_cast<double>(static_cast<long double>(eighths) * kExactPi / 4);
        double angle = boundary;
        const double target = random.sign() * 1e30;
        for (int step = random.integer(0, 3); step > 0; --step) { angle = std::nextafter(angle, target); }
        ASSERT_LE(std::fabs(angle), 0x1p20);
        const SinCos got = sinCos(angle);
        worst = std::fmax(worst, worstOf(got, angle));
        if (eighths % 4 == 0) {  // near a multiple of π the sine is small and keeps its own digits
            const long double truth = std::sin(static_cast<long double>(angle));
            ASSERT_LE(std::fabs(got.sin - truth), 0x1p-52L * std::fabs(truth) + 0x1p-97L) << "angle " << angle;
        }
    }
    EXPECT_LT(worst, 0x1p-53L);
}

TEST(SinCos, LosesNoMoreThanTheUncertaintyOfHugeAngles) {
    Random random(3);
    for (int i = 0; i < 100'000; ++i) {
        const double angle = random.sign() * std::ldexp(random.range(1, 2), random.integer(20, 62));
        ASSERT_LE(worstOf(sinCos(angle), angle), 0x1p-53L + std::fabs(static_cast<long double>(angle)) * 0x1p-53L)
            << "angle " << angle;
    }
    for (const double angle : {0x1p62, 1e100, -1e300, std::numeric_limits<double>::max()}) {
        const SinCos got = sinCos(angle);
        EXPECT_NEAR(got.sin * got.sin + got.cos * got.cos, 1.0, 1e-15) << "angle " << angle;
    }
}

TEST(SinCos, KnowsTheSimpleAngles) {
    EXPECT_EQ(sinCos(0.0).sin, 0.0);
    EXPECT_EQ(sinCos(0.0).cos, 1.0);
    EXPECT_FALSE(std::signbit(sinCos(0.0).sin));
    EXPECT_TRUE(std::signbit(sinCos(-0.0).sin));
    EXPECT_EQ(sinCos(-0.0).cos, 1.0);
    EXPECT_EQ(sinCos(std::numeric_limits<double>::denorm_min()).sin, std::numeric_limits<double>::denorm_min());
    for (const double bad : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
        EXPECT_EQ(sinCos(bad).sin, 0.0);
        EXPECT_EQ(sinCos(bad).cos, 1.0);
    }
}

TEST(SinCos, IsOddAndEven) {
    Random random(4);
    for (int i = 0; i < 50'000; ++i) {
        const double angle = random.range(0, 1e4);
        const SinCos plus = sinCos(angle);
        const SinCos minus = sinCos(-angle);
        ASSERT_EQ(plus.sin, -minus.sin) << "angle " << angle;
        ASSERT_EQ(plus.cos, minus.cos) << "angle " << angle;
    }
}

TEST(ArcTangent2, HasItsErrorBound) {
    Random random(5);
    long double worst = 0;
    for (int i = 0; i < 400'000; ++i) {
        const double y = random.sign() * std::ldexp(random.range(0.5, 1), random.integer(-12, 12));
        const double x = random.sign() * std::ldexp(random.range(0.5, 1), random.integer(-12, 12));
        const double got = arcTangent2(y, x);
        worst = std::fmax(worst, std::fabs(got - std::atan2(static_cast<long double>(y), static_cast<long double>(x))));
    }
    EXPECT_LT(worst, 0x1p-51L);
    EXPECT_GT(worst, 0x1p-54L);
}

TEST(ArcTangent2, TakesTheWholeRangeOfNumbers) {
    constexpr double kTiny = std::numeric_limits<double>::denorm_min();
    constexpr double kHuge = std::numeric_limits<double>::max();
    const double values[] = {0.0, kTiny, 1e-300, 1.0, 1e300, kHuge, HUGE_VAL};
    for (const double width : values) {
        for (const double height : values) {
            if (width == 0 && height == 0) { continue; }
            for (const double x : {width, -width}) {
                for (const double y : {height, -height}) {
                    // A zero has no sign here: the range is (−π, π].
                    const long double truth =
                        std::atan2(static_cast<long double>(y + 0.0), static_cast<long double>(x));
                    EXPECT_NEAR(arcTangent2(y, x), static_cast<double>(truth), 0x1p-51) << y << ' ' << x;
                }
            }
        }
    }
    EXPECT_EQ(arcTangent2(0.0, 0.0), 0.0);
    EXPECT_EQ(arcTangent2(-0.0, -0.0), 0.0);
    EXPECT_GT(arcTangent2(-0.0, -1.0), 3.0) << "π, not −π";
    EXPECT_EQ(arcTangent2(std::nan(""), 1.0), 0.0);
}

TEST(ExpOfMinus, HasItsRelativeErrorBound) {
    Random random(6);
    long double worst = 0;
    for (int i = 0; i < 400'000; ++i) {
        const double x = i % 2 == 0 ? random.range(0, 708) : std::ldexp(random.range(0.5, 1), random.integer(-40, 9));
        const long double truth = std::exp(-static_cast<long double>(x));
        worst = std::fmax(worst, std::fabs(expOfMinus(x) - truth) / truth);
    }
    EXPECT_LT(worst, 0x1p-52L);
    EXPECT_GT(worst, 0x1p-54L);
}

TEST(ExpOfMinus, EndsAtZero) {
    EXPECT_EQ(expOfMinus(0.0), 1.0);
    EXPECT_GE(expOfMinus(708.3), std::numeric_limits<double>::min());
    EXPECT_EQ(expOfMinus(708.5), 0.0);
    EXPECT_EQ(expOfMinus(HUGE_VAL), 0.0);
}

/// Σ (−x)ⁿ/(n + first)! for small x, the closed form for others.
long double phi(int first, long double x) {
    if (x > 0.25L) {
        const long double decay = std::exp(-x);
        return first == 1 ? -std::expm1(-x) / x : (x - 1 + decay) / (x * x);
    }
    long double term = first == 1 ? 1.0L : 0.5L;
    long double sum = 0;
    for (int n = 1; n < 40; ++n) {
        sum += term;
        term *= -x / static_cast<long double>(n + first);
    }
    return sum;
}

TEST(DampedMotion, HasItsRelativeErrorBound) {
    Random random(7);
    long double worst = 0;
    for (int i = 0; i < 400'000; ++i) {
        const double x = std::ldexp(random.range(0.5, 1), random.integer(-60, 12));
        const DampedMotion got = dampedMotion(x);
        const long double decay = std::exp(-static_cast<long double>(x));
        if (x < 700) { worst = std::fmax(worst, std::fabs(got.decay - decay) / decay); }
        worst = std::fmax(worst, std::fabs(got.phi1 - phi(1, x)) / phi(1, x));
        worst = std::fmax(worst, std::fabs(got.phi2 - phi(2, x)) / phi(2, x));
    }
    EXPECT_LT(worst, 0x1p-50L);
    EXPECT_GT(worst, 0x1p-54L);
}

TEST(DampedMotion, HasItsLimits) {
    const DampedMotion still = dampedMotion(0.0);
    EXPECT_EQ(still.decay, 1.0);
    EXPECT_EQ(still.phi1, 1.0);
    EXPECT_EQ(still.phi2, 0.5);
    const DampedMotion stopped = dampedMotion(1e300);
    EXPECT_EQ(stopped.decay, 0.0);
    EXPECT_DOUBLE_EQ(stopped.phi1, 1e-300);
    EXPECT_DOUBLE_EQ(stopped.phi2, 1e-300);
}

TEST(DampedMotion, ComposesOverHalfSteps) {
    // v and c after two half steps equal those after one whole step: a law that no single value shows.
    Random random(8);
    for (int i = 0; i < 50'000; ++i) {
        const double x = std::ldexp(random.range(0.5, 1), random.integer(-20, 4));
        const DampedMotion whole = dampedMotion(2 * x);
        const DampedMotion half = dampedMotion(x);
        const double coasted = 0.5 * half.phi1 * (1 + half.decay);  // of v₀ = 1, in units of the whole time
        ASSERT_NEAR(whole.phi1, coasted, 0x1p-50 * coasted) << "x " << x;
        const double accelerated = 0.25 * (2 * half.phi2 + half.phi1 * half.phi1);
        ASSERT_NEAR(whole.phi2, accelerated, 0x1p-50 * accelerated) << "x " << x;
    }
}

}  // namespace
}  // namespace swept::test
