#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>

#include "families.h"

/// Random pairs of every kind against dense sampling in long double.

namespace swept::test {
namespace {

constexpr std::uint64_t kCases = 1000;

struct FamilyTally {
    int hits = 0;
    int late = 0;  ///< hits after the start
    int separated = 0;
    int overlapped = 0;
    int mostIterations = 0;
    int iterations = 0;

    void add(const Toi& toi) {
        hits += toi.state == ToiState::hit ? 1 : 0;
        late += toi.state == ToiState::hit && toi.fraction > 0 ? 1 : 0;
        separated += toi.state == ToiState::separated ? 1 : 0;
        overlapped += toi.state == ToiState::overlapped ? 1 : 0;
        mostIterations = std::max(mostIterations, toi.iterations);
        iterations += toi.iterations;
    }
};

void record(const char* what, const FamilyTally& tally) {
    ::testing::Test::RecordProperty(std::string(what) + "Hits", tally.late);
    ::testing::Test::RecordProperty(std::string(what) + "MostIterations", tally.mostIterations);
    ::testing::Test::RecordProperty(std::string(what) + "MeanIterations",
                                    std::to_string(tally.iterations / static_cast<double>(kCases)));
}

class ToiFamilies : public ::testing::TestWithParam<Family> {};

TEST_P(ToiFamilies, KeepTheirPromises) {
    FamilyTally tally;
    for (std::uint64_t seed = 0; seed < kCases; ++seed) {
        const Query query = randomQuery(GetParam(), seed);
        const Status valid = validateToi(query.a, query.sweepA, query.b, query.sweepB, query.settings);
        ASSERT_TRUE(valid.ok()) << valid.field << ' ' << describe(valid.code) << " seed " << seed << query;
        const Toi toi = ask(query);
        ASSERT_TRUE(keepsItsPromise(query, toi)) << nameOf(GetParam()) << " seed " << seed << query;
        tally.add(toi);
    }
    record("toi", tally);
    EXPECT_GT(tally.late, 150) << "too few impacts to prove anything";
    EXPECT_GT(tally.separated, 40) << "too few misses to prove anything";
    EXPECT_LE(tally.mostIterations, GetParam() == Family::manyTurns ? 120 : 40);
}

/// The finest tolerance that is accepted, and targets down to where the polygons themselves just touch: whatever
/// precision is lost on the way would show here.
Query atTheLimit(Query q, std::uint64_t seed) {
    const auto accepted = [&q](double tolerance) {
        ToiSettings settings = q.settings;
        settings.tolerance = tolerance;
        return validateToi(q.a, q.sweepA, q.b, q.sweepB, settings).ok();
    };
    while (accepted(q.settings.tolerance / 2)) { q.settings.tolerance /= 2; }
    if (seed % 2 == 0) { q.settings.target = -(q.a.radius + q.b.radius); }
    return q;
}

TEST_P(ToiFamilies, KeepTheirPromisesAtTheFinestTolerance) {
    FamilyTally tally;
    for (std::uint64_t seed = 0; seed < kCases; ++seed) {
        const Query query = atTheLimit(randomQuery(GetParam(), seed), seed);
        const Toi toi = ask(query);
        ASSERT_TRUE(keepsItsPromise(query, toi)) << nameOf(GetParam()) << " seed " << seed << query;
        tally.add(toi);
    }
    record("finest", tally);
    EXPECT_GT(tally.late, 150) << "too few impacts to prove anything";
    EXPECT_LE(tally.mostIterations, GetParam() == Family::manyTurns ? 120 : 40);
}

TEST_P(ToiFamilies, KeepTheirPromisesWithoutRotation) {
    FamilyTally tally;
    for (std::uint64_t seed = 0; seed < kCases; ++seed) {
        const Query query = randomQuery(GetParam(), seed);
        const Toi toi = askCast(query);
        ASSERT_TRUE(keepsItsPromise(withoutRotation(query), toi)) << nameOf(GetParam()) << " seed " << seed << query;
        tally.add(toi);
    }
    record("cast", tally);
    EXPECT_GT(tally.late, 80) << "too few impacts to prove anything";
    EXPECT_LE(tally.mostIterations, 40);
}

TEST_P(ToiFamilies, SeparationAtAgreesWithTheOracle) {
    for (std::uint64_t seed = 0; seed < kCases; ++seed) {
        const Query query = randomQuery(GetParam(), seed);
        for (const double t : {0.0, 0.3125, 1.0}) {
            const Toi toi = separationAt(query.a, query.sweepA, query.b, query.sweepB, t);
            const double core = static_cast<double>(trueCoreSeparation(query, t));
            const double slack = query.settings.tolerance / 4;
            ASSERT_NEAR(toi.separation, core - query.a.radius - query.b.radius, slack)
                << nameOf(GetParam()) << " seed " << seed << " at " << t << query;
            if (core > slack) { ASSERT_EQ(toi.state, ToiState::separated) << "seed " << seed << query; }
            if (core < -slack) { ASSERT_EQ(toi.state, ToiState::overlapped) << "seed " << seed << query; }
        }
    }
}

/// Along the normal it is the separation, along any other direction less.
TEST_P(ToiFamilies, SeparationAlongTheNormalIsTheLargest) {
    constexpr int kDirections = 16;
    for (std::uint64_t seed = 0; seed < kCases; ++seed) {
        const Query query = randomQuery(GetParam(), seed);
        for (const double t : {0.0, 0.3125, 1.0}) {
            const Toi toi = separationAt(query.a, query.sweepA, query.b, query.sweepB, t);
            const double slack = query.settings.tolerance / 4;
            const auto along = [&](DVec2 normal) {
                return separationAlong(query.a, query.sweepA, query.b, query.sweepB, t, normal);
            };
            ASSERT_NEAR(along(toi.normal), toi.separation, slack)
                << nameOf(GetParam()) << " seed " << seed << " at " << t << query;
            for (int i = 0; i < kDirections; ++i) {
                const double angle = 2 * std::numbers::pi * i / kDirections;
                ASSERT_LE(along({std::cos(angle), std::sin(angle)}), toi.separation + slack)
                    << nameOf(GetParam()) << " seed " << seed << " at " << t << query;
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(All, ToiFamilies, ::testing::ValuesIn(kFamilies),
                         [](const auto& tested) { return std::string(nameOf(tested.param)); });

TEST(ToiBudget, RunsOutHonestly) {
    // Two bars turn against each other thirty thousand times, as an egg beater does: within each other's reach, never
    // touching. Every turn needs some steps.
    Query q;
    q.a = {{DVec2{-1, -0.01}, DVec2{1, -0.01}, DVec2{1, 0.01}, DVec2{-1, 0.01}}, 4, 0};
    q.b = {{DVec2{-0.01, -1}, DVec2{0.01, -1}, DVec2{0.01, 1}, DVec2{-0.01, 1}}, 4, 0};
    q.sweepB.c0 = q.sweepB.c1 = {1.5, 0};
    q.sweepA.a1 = 2e5;
    q.sweepB.a1 = -2e5;
    q.settings.target = 0.001;
    q.settings.tolerance = 1e-6;
    ASSERT_TRUE(validateToi(q.a, q.sweepA, q.b, q.sweepB, q.settings).ok());
    const Toi toi = ask(q);
    ASSERT_EQ(toi.state, ToiState::failed);
    EXPECT_GT(toi.fraction, 0);
    EXPECT_LT(toi.fraction, 1);
    EXPECT_GT(toi.separation, q.settings.target);
    EXPECT_GE(toi.iterations, 1000);
    for (int i = 0; i <= 20'000; ++i) {
        const double t = toi.fraction * i / 20'000;
        ASSERT_GT(static_cast<double>(trueSeparation(q, t)), q.settings.target - q.settings.tolerance) << t;
    }
}

TEST(ToiBudget, IsSpentOnTheVerticesThatCanTouch) {
    // Two needles, 10⁸ and 10¹¹ m long, turn about points at their blunt ends; these are what touches. How their far
    // vertices swing does not matter, and bounding the near ones by it takes thousands of steps where a few dozen do.
    Query q;
    q.a = {{DVec2{-61.09375, 0}, DVec2{59.03125, 52.69140625}, DVec2{-41.22265625, 125599744}}, 3, 75.29296875};
    q.b = {{DVec2{75.29296875, 75.29296875}, DVec2{31.20703125, 192803766272}, DVec2{-102.24609375, -59.15625}},
           3,
           0.1484375};
    q.sweepA.localCenter = {17.17578125, 84.453125};
    q.sweepA.c0 = {-114.83984375, 10.09375};
    q.sweepA.c1 = {-108.92578125, -117.4609375};
    q.sweepA.a0 = -117.4609375;
    q.sweepA.a1 = -167.4609375;
    q.sweepB.localCenter = {-101.4609375, -117.33984375};
    q.sweepB.c0 = {23.83984375, 4};
    q.sweepB.a0 = 29.26953125;
    q.sweepB.a1 = 28.8046875;
    q.settings = defaultToiSettings(q.a, q.b);
    ASSERT_TRUE(validateToi(q.a, q.sweepA, q.b, q.sweepB, q.settings).ok());
    const Toi toi = ask(q);
    ASSERT_EQ(toi.state, ToiState::hit);
    // Where interval arithmetic proves the separation to pass target ± tolerance.
    EXPECT_GT(toi.fraction, 0.05961630437);
    EXPECT_LT(toi.fraction, 0.05962797627);
    EXPECT_LT(toi.iterations, 100);
    EXPECT_TRUE(keepsItsPromise(q, toi)) << q;
}

}  // namespace
}  // namespace swept::test
