#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "shape_families.h"

namespace swept::test {
namespace {

constexpr int kMinExponent = std::numeric_limits<Real>::min_exponent;
constexpr int kMaxExponent = std::numeric_limits<Real>::max_exponent;

TEST(Normalized, HasFullPrecisionForAnySize) {
    Random random(1);
    for (int i = 0; i < 50'000; ++i) {
        const Real scale = std::ldexp(Real(1), random.integer(kMinExponent + 60, kMaxExponent - 2));
        const Vec2 v{scale * real(random.range(-1, 1)), scale * real(random.range(-1, 1))};
        const long double size = length(exact(v));
        const UnitAndLength got = normalized(v);
        ASSERT_LE(std::fabs(exact(got.length) - size), 1.5L * kEps * size) << "case " << i << ": " << v;
        ASSERT_LE(std::fabs(exact(got.unit.x) - exact(v.x) / size), 1.5L * kEps) << "case " << i << ": " << v;
        ASSERT_LE(std::fabs(exact(got.unit.y) - exact(v.y) / size), 1.5L * kEps) << "case " << i << ": " << v;
    }
}

TEST(Normalized, TakesTheExtremes) {
    constexpr Real kTiny = std::numeric_limits<Real>::denorm_min();
    constexpr Real kHuge = std::numeric_limits<Real>::max();
    EXPECT_EQ(normalized({kTiny, 0}).unit, (Vec2{1, 0}));
    EXPECT_EQ(normalized({0, -kTiny}).length, kTiny);
    EXPECT_EQ(normalized({-kHuge, 0}).unit, (Vec2{-1, 0}));
    const Vec2 diagonal = normalized({kHuge, kHuge}).unit;
    EXPECT_EQ(diagonal.x, diagonal.y);
    EXPECT_NEAR(static_cast<double>(diagonal.x), std::sqrt(0.5), static_cast<double>(kEpsilon));
    EXPECT_EQ(normalized({0, 0}).unit, (Vec2{0, 0}));
    EXPECT_EQ(normalized({0, 0}).length, 0);
}

TEST(Normalized, ScalesExactlyByPowersOfTwo) {
    Random random(2);
    for (int i = 0; i < 10'000; ++i) {
        const Vec2 v = randomVec(random, -1, 1);
        const Real scale = std::ldexp(Real(1), random.integer(kMinExponent / 2, kMaxExponent / 2));
        const UnitAndLength one = normalized(v);
        const UnitAndLength other = normalized(scale * v);
        ASSERT_EQ(one.unit, other.unit) << v;
        ASSERT_EQ(scale * one.length, other.length) << v;
    }
}

}  // namespace
}  // namespace swept::test
