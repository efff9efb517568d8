#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include <swept/shapes/aabb.h>

#include "shape_families.h"

namespace swept::test {
namespace {

constexpr Real kMax = std::numeric_limits<Real>::max();
constexpr Real kInfinity = std::numeric_limits<Real>::infinity();

/// A number of any size between about 1e−3 and 1e12, of either sign.
double anySize(Random& random) { return random.sign() * std::pow(10.0, random.range(-3, 12)); }

TEST(RoundedOutward, IsTheSmallestBoxThatContains) {
    Random random(1);
    int rounded = 0;
    for (int i = 0; i < 50'000; ++i) {
        const double low = anySize(random);
        const double high = low + std::fabs(anySize(random));
        const Aabb box = roundedOutward({low, low}, {high, high});
        ASSERT_LE(static_cast<double>(box.lower.x), low) << "case " << i;
        ASSERT_GE(static_cast<double>(box.upper.y), high) << "case " << i;
        ASSERT_GT(static_cast<double>(std::nextafter(box.lower.x, kInfinity)), low) << "case " << i;
        ASSERT_LT(static_cast<double>(std::nextafter(box.upper.y, -kInfinity)), high) << "case " << i;
        ASSERT_EQ(box.lower.x, box.lower.y);
        ASSERT_EQ(box.upper.x, box.upper.y);
        rounded += static_cast<double>(box.lower.x) < low ? 1 : 0;
    }
    EXPECT_EQ(rounded > 40'000, (std::is_same_v<Real, float>)) << "f32 rounds nearly every bound, f64 none";
}

TEST(RoundedOutward, StaysFinite) {
    const double beyond = std::numeric_limits<double>::infinity();
    const Aabb box = roundedOutward({-beyond, -beyond}, {beyond, beyond});
    EXPECT_EQ(box.lower, (Vec2{-kMax, -kMax}));
    EXPECT_EQ(box.upper, (Vec2{kMax, kMax}));
    const Aabb tiny = roundedOutward({-1e-310, 0.0}, {1e-310, 0.0});
    EXPECT_LT(tiny.lower.x, 0);
    EXPECT_GT(tiny.upper.x, 0);
    EXPECT_EQ(tiny.lower.y, 0);
}

TEST(Grown, ContainsTheExactBoxHoweverFarAndSmall) {
    Random random(2);
    int inexact = 0;
    for (int i = 0; i < 50'000; ++i) {
        const Real low = real(anySize(random));
        const Real margin = real(std::pow(10.0, random.range(-12, 6)));
        const Aabb box = grown({{low, low}, {low, low}}, margin);
        // The difference of the rounded bound to the box is exact, or so large that the comparison is clear anyway.
        ASSERT_GE(exact(low) - exact(box.lower.x), exact(margin)) << "case " << i << ": " << low << " - " << margin;
        ASSERT_GE(exact(box.upper.y) - exact(low), exact(margin)) << "case " << i << ": " << low << " + " << margin;
        const Real inward = std::nextafter(box.lower.x, kInfinity);
        ASSERT_LE(exact(low) - exact(inward), exact(margin)) << "case " << i << ": grown by more than needed";
        inexact += low - margin == low ? 1 : 0;
    }
    EXPECT_GT(inexact, 1'000) << "margins below the last digit are the interesting ones";
    EXPECT_EQ(grown({{-kMax, 0}, {kMax, 0}}, kMax).lower.x, -kMax);
    const Aabb same = grown({{1, 2}, {3, 4}}, 0);
    EXPECT_EQ(same, (Aabb{{1, 2}, {3, 4}}));
}

/// Whether the exact ray meets the box, in long double, with `slack` metres in its favour (negative: against it).
bool meets(const Aabb& box, Point origin, Point direction, long double maxFraction, long double slack) {
    long double from = 0;
    long double to = maxFraction;
    const Point low = exact(box.lower) - Point{slack, slack};
    const Point high = exact(box.upper) + Point{slack, slack};
    const auto clip = [&](long double lower, long double upper, long double start, long double rate) {
        if (rate == 0) { return lower <= start && start <= upper; }
        const long double a = (lower - start) / rate;
        const long double b = (upper - start) / rate;
        from = std::max(from, std::min(a, b));
        to = std::min(to, std::max(a, b));
        return true;
    };
    const bool inX = clip(low.x, high.x, origin.x, direction.x);
    return clip(low.y, high.y, origin.y, direction.y) && inX && from <= to;
}

TEST(BoxRayCast, NeverLosesARayThroughTheBox) {
    Random random(3);
    int throughCorners = 0;
    for (int i = 0; i < 50'000; ++i) {
        const double offset = std::pow(10.0, random.range(0, 9));
        const Vec2 center = randomVec(random, -offset, offset);
        const Vec2 half = randomVec(random, 0, 1);
        const Aabb box{center - half, center + half};
        // Aimed at a corner, or anywhere near.
        const bool aimed = random.chance(0.5);
        const DVec2 corner{static_cast<double>(random.chance(0.5) ? box.lower.x : box.upper.x),
                           static_cast<double>(random.chance(0.5) ? box.lower.y : box.upper.y)};
        const DVec2 target = aimed ? corner : corner + DVec2{random.range(-2, 2), random.range(-2, 2)};
        const DVec2 origin = target + DVec2{random.range(-9, 9), random.range(-9, 9)};
        const DVec2 direction = random.range(0.1, 2) * (target - origin);
        const Real maxFraction = real(random.range(0, 12));
        const RayHit got = rayCast(box, origin, direction, maxFraction);
        const bool wanted = meets(box, exact(origin), exact(direction), exact(maxFraction), 0);
        if (wanted) { ASSERT_TRUE(got.hit) << "case " << i; }
        const long double slack = 8 * 0x1p-53L * (static_cast<long double>(offset) + 20);
        if (got.hit) {
            ASSERT_TRUE(meets(box, exact(origin), exact(direction), exact(maxFraction) * (1 + 0x1p-50L), slack));
            ASSERT_GE(got.fraction, 0);
            ASSERT_LE(got.fraction, maxFraction);
        }
        throughCorners += aimed && got.hit && !wanted ? 1 : 0;
    }
    EXPECT_GT(throughCorners, 10) << "grazing rays decide whether rounding can lose one";
}

TEST(BoxRayCast, KeepsRaysThatTouchExactlyOneCorner) {
    // From −e·(a, b) along (a, b), exactly through the corner (k·a, k·b); the differences k·a + e·a need more than 53
    // bits, so the two axes round the common fraction k + e differently.
    Random random(4);
    for (int i = 0; i < 20'000; ++i) {
        const int a = random.integer(1, 200);
        const int b = random.integer(1, 200);
        const int k = random.integer(1, 200);
        const double e = std::ldexp(random.integer(1, 1'000'000), -60);
        const Vec2 corner{real(k * a), real(k * b)};
        const Aabb box{{corner.x, corner.y - 1}, {corner.x + 1, corner.y}};
        const Aabb mirrored{{corner.x - 1, corner.y}, {corner.x, corner.y + 1}};
        const DVec2 direction{static_cast<double>(a), static_cast<double>(b)};
        ASSERT_TRUE(rayCast(box, -e * direction, direction, 1'000).hit) << "case " << i;
        ASSERT_TRUE(rayCast(mirrored, -e * direction, direction, 1'000).hit) << "case " << i;
    }
}

TEST(BoxRayCast, KnowsTheSimpleCases) {
    const Aabb box{{1, -1}, {3, 1}};
    const RayHit hit = rayCast(box, {0, 0}, {2, 0}, 1);
    EXPECT_TRUE(hit.hit);
    EXPECT_NEAR(static_cast<double>(hit.fraction), 0.5, static_cast<double>(kEpsilon));
    EXPECT_FALSE(rayCast(box, {0, 0}, {0.5, 0}, 1).hit);
    EXPECT_FALSE(rayCast(box, {0, 0}, {-1, 0}, 100).hit);
    EXPECT_FALSE(rayCast(box, {0, 2}, {1, 0}, 100).hit);
    EXPECT_TRUE(rayCast(box, {0, 1}, {1, 0}, 100).hit) << "along the side";
    EXPECT_TRUE(rayCast(box, {2, 0}, {1, 0}, 0).hit);
    EXPECT_EQ(rayCast(box, {2, 0}, {1, 0}, 5).fraction, 0);
    EXPECT_TRUE(rayCast(box, {2, 0}, {0, 0}, 1).hit);
    EXPECT_FALSE(rayCast(box, {4, 0}, {0, 0}, 1).hit);
}

TEST(Boxes, OverlapWhenTheyTouch) {
    const Aabb a{{0, 0}, {1, 1}};
    EXPECT_TRUE(overlaps(a, {{1, 1}, {2, 2}}));
    EXPECT_FALSE(overlaps(a, {{std::nextafter(Real(1), Real(2)), 0}, {2, 2}}));
    EXPECT_TRUE(contains(a, a));
    EXPECT_FALSE(contains(a, {{0, 0}, {1, 2}}));
    EXPECT_EQ(hullOf(a, {{-1, 0}, {0, 3}}), (Aabb{{-1, 0}, {1, 3}}));
    EXPECT_EQ(perimeter(a), 4);
    EXPECT_TRUE(isValid(a));
    EXPECT_FALSE(isValid({{1, 0}, {0, 1}}));
    EXPECT_FALSE(isValid({{0, 0}, {kInfinity, 1}}));
}

}  // namespace
}  // namespace swept::test
