#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "families.h"
#include "query_parts.h"

/// Laws that need no oracle: swap, scale, shift, split, stop early.

namespace swept::test {
namespace {

constexpr std::uint64_t kLawCases = 150;

/// Runs `check` on queries of all families and returns how many of them were hits after the start.
template <class Check>
int overAllFamilies(Check check) {
    int hits = 0;
    for (const Family family : kFamilies) {
        for (std::uint64_t seed = 1000; seed < 1000 + kLawCases; ++seed) {
            const Query query = randomQuery(family, seed);
            const Toi toi = ask(query);
            hits += toi.state == ToiState::hit && toi.fraction > 0 ? 1 : 0;
            SCOPED_TRACE(::testing::Message() << nameOf(family) << " seed " << seed << query);
            check(query, toi);
            if (::testing::Test::HasFatalFailure()) { return 0; }
        }
    }
    return hits;
}

/// Coordinates on a grid, so that a shift by a multiple of it is exact.
Query onGrid(Query q, double grid, DVec2 shift) {
    for (Sweep* sweep : {&q.sweepA, &q.sweepB}) {
        for (DVec2* v : {&sweep->c0, &sweep->c1}) {
            *v = DVec2{std::nearbyint(v->x / grid) * grid, std::nearbyint(v->y / grid) * grid} + shift;
        }
    }
    return q;
}

TEST(ToiLaws, SwappingTheBodiesMirrorsTheAnswer) {
    int sameState = 0;
    const int hits = overAllFamilies([&sameState](const Query& q, const Toi& toi) {
        const Query swapped{q.b, q.sweepB, q.a, q.sweepA, q.settings};
        const Toi other = ask(swapped);
        ASSERT_TRUE(keepsItsPromise(swapped, other));
        if (other.state != toi.state) { return; }
        ++sameState;
        // Two hits of one pair lie within the tolerance of the same level.
        ASSERT_NEAR(other.separation, toi.separation, q.settings.tolerance);
    });
    EXPECT_GT(hits, 500);
    EXPECT_GE(sameState, static_cast<int>(0.99 * static_cast<double>(kFamilies.size() * kLawCases)));
}

TEST(ToiLaws, PowersOfTwoScaleExactly) {
    for (const int exponent : {-80, -3, 1, 90}) {
        const double factor = std::ldexp(1.0, exponent);
        const int hits = overAllFamilies([factor](const Query& q, const Toi& toi) {
            const Query big = scaled(q, factor);
            ASSERT_TRUE(validateToi(big.a, big.sweepA, big.b, big.sweepB, big.settings).ok());
            const Toi other = ask(big);
            ASSERT_EQ(other.state, toi.state);
            ASSERT_EQ(other.fraction, toi.fraction);
            ASSERT_EQ(other.separation, factor * toi.separation);
            ASSERT_EQ(other.normal, toi.normal);
            ASSERT_EQ(other.pointA, factor * toi.pointA);
            ASSERT_EQ(other.pointB, factor * toi.pointB);
            ASSERT_EQ(other.iterations, toi.iterations);
            const ToiSettings defaults = defaultToiSettings(q.a, q.b);
            ASSERT_EQ(defaultToiSettings(big.a, big.b).target, factor * defaults.target);
        });
        EXPECT_GT(hits, 500);
    }
}

TEST(ToiLaws, TheOriginDoesNotMatter) {
    int hits = 0;
    for (std::uint64_t seed = 0; seed < 10 * kLawCases; ++seed) {
        constexpr double kGrid = 0x1p-20;
        const Query near = onGrid(randomQuery(Family::generic, seed), kGrid, {});
        const Query far = onGrid(near, kGrid, {0x1p30, -0x1.8p31});
        const Toi toi = ask(near);
        const Toi other = ask(far);
        ASSERT_EQ(other.state, toi.state) << "seed " << seed;
        ASSERT_EQ(other.fraction, toi.fraction) << "seed " << seed;
        ASSERT_EQ(other.separation, toi.separation) << "seed " << seed;
        ASSERT_EQ(other.normal, toi.normal) << "seed " << seed;
        ASSERT_EQ(other.iterations, toi.iterations) << "seed " << seed;
        hits += toi.state == ToiState::hit ? 1 : 0;
    }
    EXPECT_GT(hits, 400);
}

TEST(ToiLaws, SplittingTheIntervalFindsTheSameImpact) {
    const int hits = overAllFamilies([](const Query& q, const Toi& toi) {
        if (toi.state != ToiState::hit || toi.fraction < 1e-3) { return; }
        const double cut = 0.5 * toi.fraction;
        Query first = q;
        first.sweepA = part(q.sweepA, 0, cut);
        first.sweepB = part(q.sweepB, 0, cut);
        first.settings.tMax = 1;
        const Toi before = ask(first);
        ASSERT_TRUE(keepsItsPromise(first, before));
        if (before.state != ToiState::separated) {  // only where it stays in the band for long
            ASSERT_LE(std::fabs(before.separation - q.settings.target), q.settings.tolerance);
            return;
        }
        Query second = q;
        second.sweepA = part(q.sweepA, cut, q.settings.tMax);
        second.sweepB = part(q.sweepB, cut, q.settings.tMax);
        second.settings.tMax = 1;
        const Toi after = ask(second);
        ASSERT_TRUE(keepsItsPromise(second, after));
        if (after.state == ToiState::hit) {
            const double whole = cut + after.fraction * (q.settings.tMax - cut);
            ASSERT_NEAR(static_cast<double>(trueSeparation(q, whole)), toi.separation, 1.5 * q.settings.tolerance);
        }
    });
    EXPECT_GT(hits, 500);
}

TEST(ToiLaws, TheSearchStopsAtTMax) {
    const int hits = overAllFamilies([](const Query& q, const Toi& toi) {
        if (toi.state != ToiState::hit || !(toi.fraction > 0)) { return; }
        Query shorter = q;
        shorter.settings.tMax = 0.75 * toi.fraction;
        const Toi other = ask(shorter);
        ASSERT_TRUE(keepsItsPromise(shorter, other));
        ASSERT_LE(other.fraction, shorter.settings.tMax);
    });
    EXPECT_GT(hits, 500);
}

TEST(ToiLaws, APartIsThePieceOfItsSweep) {
    const Query q = randomQuery(Family::parabola, 7);
    const Sweep piece = part(q.sweepA, 0.25, 0.75);
    for (const double t : {0.0, 0.1, 0.5, 1.0}) {
        const DVec2 difference = centerAt(piece, t) - centerAt(q.sweepA, 0.25 + 0.5 * t);
        EXPECT_LT(length(difference), 1e-14 * (1 + length(q.sweepA.k) + length(q.sweepA.c1)));
        EXPECT_NEAR(angleAt(piece, t), angleAt(q.sweepA, 0.25 + 0.5 * t), 1e-14);
    }
    EXPECT_EQ(part(q.sweepA, 0, 1).c0, q.sweepA.c0);
    EXPECT_EQ(part(q.sweepA, 0, 1).c1, q.sweepA.c1);
    EXPECT_EQ(part(q.sweepA, 0, 1).k, q.sweepA.k);
    EXPECT_EQ(part(q.sweepA, 0, 1).a1, q.sweepA.a1);
}

TEST(ToiLaws, LeavingTheBandIsNoHit) {
    // Starts half a tolerance above the target and moves away: nothing will happen, and the answer says so.
    Query q;
    q.a = {{DVec2{}}, 1, 1};
    q.b = {{DVec2{}}, 1, 1};
    q.settings.target = 0.01;
    q.settings.tolerance = 0.001;
    q.sweepB.c0 = {2.0103, 0};
    q.sweepB.c1 = {3, 0};
    EXPECT_EQ(ask(q).state, ToiState::separated);
    q.sweepB.c1 = {1, 0};  // the same start, but approaching
    EXPECT_EQ(ask(q).state, ToiState::hit);
    q.sweepB.c0 = {2.009, 0};  // within the target: a hit at 0 whatever the motion
    q.sweepB.c1 = {3, 0};
    EXPECT_EQ(ask(q).state, ToiState::hit);
    EXPECT_EQ(ask(q).fraction, 0);
}

}  // namespace
}  // namespace swept::test
