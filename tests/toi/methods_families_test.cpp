#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include <swept/toi/brute_force.h>
#include <swept/toi/conservative_advancement.h>
#include <swept/toi/toi_method.h>

#include "families.h"
#include "query_parts.h"

/// The methods on random pairs of every kind: those that must agree, those that must not, scaling and budgets.

namespace swept::test {
namespace {

constexpr std::uint64_t kMethodCases = 200;
constexpr std::uint64_t kFirstSeed = 5000;

template <class Check>
void inAllFamilies(Check check) {
    for (const Family family : kFamilies) {
        for (std::uint64_t seed = kFirstSeed; seed < kFirstSeed + kMethodCases; ++seed) {
            const Query query = randomQuery(family, seed);
            SCOPED_TRACE(::testing::Message() << nameOf(family) << " seed " << seed << query);
            check(query);
            if (::testing::Test::HasFatalFailure()) { return; }
        }
    }
}

bool isLaterHit(const Toi& toi) { return toi.state == ToiState::hit && toi.fraction > 0; }

/// The same question at another level.
Query shifted(Query q, double tolerances) {
    q.settings.target += tolerances * q.settings.tolerance;
    return q;
}

/// What a method gets wrong, beyond what its tolerance excuses, in the eyes of another.
struct Verdict {
    bool missed = false;  ///< separated, though it comes to the target minus the tolerance
    bool late = false;    ///< hit, though it came there before
    bool early = false;   ///< hit, though it has not come to the target plus the tolerance
    bool isRight() const { return !missed && !late && !early; }
};

Verdict judge(const Query& q, const Toi& toi, ToiMethod by_) {
    const Toi below = by(by_, shifted(q, -2));  // a hit there lies at or below the target minus the tolerance
    const Toi above = by(by_, shifted(q, 2));  // before a hit there, all lies at or above the target plus the tolerance
    const bool comesBelow = below.state == ToiState::hit;
    const bool claimsHit = toi.state == ToiState::hit;
    Verdict verdict;
    verdict.missed = toi.state == ToiState::separated && comesBelow;
    verdict.late = claimsHit && comesBelow && below.fraction < toi.fraction;
    verdict.early = claimsHit && (above.state == ToiState::separated || above.fraction > toi.fraction);
    return verdict;
}

class ToiMethodFamilies : public ::testing::TestWithParam<ToiMethod> {};

TEST_P(ToiMethodFamilies, KeepTheCertificate) {
    int hits = 0;
    int separated = 0;
    inAllFamilies([&](const Query& q) {
        const Toi toi = by(GetParam(), q);
        ASSERT_TRUE(keepsItsPromise(q, toi));
        ASSERT_TRUE(judge(q, toi, ToiMethod::certified).isRight());
        ASSERT_TRUE(judge(q, ask(q), GetParam()).isRight());
        hits += isLaterHit(toi) ? 1 : 0;
        separated += toi.state == ToiState::separated ? 1 : 0;
    });
    EXPECT_GT(hits, 800);
    EXPECT_GT(separated, 400);
}

INSTANTIATE_TEST_SUITE_P(Certified, ToiMethodFamilies,
                         ::testing::Values(ToiMethod::conservativeAdvancement, ToiMethod::bruteForce),
                         [](const auto& tested) { return std::string(nameOf(tested.param)); });

TEST(ToiMethodLaws, BruteForceStopsAtTheRootItself) {
    int hits = 0;
    int exact = 0;
    inAllFamilies([&](const Query& q) {
        const Toi toi = by(ToiMethod::bruteForce, q);
        if (!isLaterHit(toi)) { return; }
        const double error = std::fabs(toi.separation - q.settings.target);
        ASSERT_LE(error, q.settings.tolerance / 8);
        ++hits;
        exact += error <= 1e-5 * q.settings.tolerance ? 1 : 0;
    });
    EXPECT_GT(hits, 800);
    EXPECT_GT(exact, 0.99 * hits);
}

TEST(ToiMethodLaws, BruteForceSeesWhatStartsARoundingAboveTheTarget) {
    int hits = 0;
    inAllFamilies([&](Query q) {
        const double start = separationAt(q.a, q.sweepA, q.b, q.sweepB, 0).separation;
        if (!(start > 0)) { return; }
        q.settings.target = std::nextafter(start, 0);
        const Toi toi = by(ToiMethod::bruteForce, q);
        ASSERT_TRUE(judge(q, toi, ToiMethod::certified).isRight());
        hits += toi.state == ToiState::hit ? 1 : 0;
    });
    EXPECT_GT(hits, 800);
}

TEST(ToiMethodLaws, ShapeCastIsRightWithoutRotation) {
    int hits = 0;
    inAllFamilies([&](const Query& q) {
        const Query still = withoutRotation(q);
        const Toi toi = by(ToiMethod::shapeCast, q);
        ASSERT_TRUE(judge(still, toi, ToiMethod::bruteForce).isRight());
        hits += isLaterHit(toi) ? 1 : 0;
    });
    EXPECT_GT(hits, 800);
}

TEST(ToiMethodLaws, RayCastIsRightForDisks) {
    int hits = 0;
    inAllFamilies([&](Query q) {
        for (ToiPolygon* polygon : {&q.a, &q.b}) {
            polygon->count = 1;
            polygon->radius += length(polygon->vertices[0]);
        }
        q.sweepA.k = q.sweepB.k = {};
        q = withoutRotation(q);
        const Toi toi = by(ToiMethod::rayCast, q);
        ASSERT_TRUE(judge(q, toi, ToiMethod::bruteForce).isRight());
        hits += isLaterHit(toi) ? 1 : 0;
    });
    EXPECT_GT(hits, 800);
}

TEST(ToiMethodLaws, TheOthersFailAsTheirPagesSay) {
    struct Tally {
        int missed = 0;
        int late = 0;
        int early = 0;
    };
    std::array<Tally, kToiMethods.size()> tallies{};
    inAllFamilies([&](const Query& q) {
        if (ask(q).state == ToiState::overlapped) { return; }
        for (const ToiMethodInfo& info : kToiMethods) {
            const Verdict verdict = judge(q, by(info.method, q), ToiMethod::certified);
            Tally& tally = tallies[static_cast<std::size_t>(info.method)];
            tally.missed += verdict.missed ? 1 : 0;
            tally.late += verdict.late ? 1 : 0;
            tally.early += verdict.early ? 1 : 0;
        }
    });
    const auto of = [&tallies](ToiMethod method) { return tallies[static_cast<std::size_t>(method)]; };
    EXPECT_GT(of(ToiMethod::discrete).missed, 200);
    EXPECT_GT(of(ToiMethod::discrete).late, 500);
    EXPECT_EQ(of(ToiMethod::discrete).early, 0);
    EXPECT_GT(of(ToiMethod::rayCast).missed, 200);
    EXPECT_GT(of(ToiMethod::rayCast).late, 300);
    EXPECT_GT(of(ToiMethod::shapeCast).missed, 100);
    EXPECT_GT(of(ToiMethod::shapeCast).early, 200);
    EXPECT_GT(of(ToiMethod::separatingAxisRoot).missed, 50);
    EXPECT_GT(of(ToiMethod::separatingAxisRoot).late, 10);
    EXPECT_EQ(of(ToiMethod::separatingAxisRoot).early, 0);
    EXPECT_GT(of(ToiMethod::speculative).missed, 50);
    EXPECT_GT(of(ToiMethod::speculative).early, 300);
    for (const ToiMethod exact : {ToiMethod::conservativeAdvancement, ToiMethod::bruteForce, ToiMethod::certified}) {
        EXPECT_EQ(of(exact).missed + of(exact).late + of(exact).early, 0) << nameOf(exact);
    }
}

TEST(ToiMethodLaws, PowersOfTwoScaleExactly) {
    inAllFamilies([](const Query& q) {
        for (const ToiMethodInfo& info : kToiMethods) {
            const Toi toi = by(info.method, q);
            for (const int exponent : {-80, 90}) {
                const double factor = std::ldexp(1.0, exponent);
                const Toi other = by(info.method, scaled(q, factor));
                ASSERT_EQ(other.state, toi.state) << info.name;
                ASSERT_EQ(other.fraction, toi.fraction) << info.name;
                ASSERT_EQ(other.separation, factor * toi.separation) << info.name;
                ASSERT_EQ(other.normal, toi.normal) << info.name;
                ASSERT_EQ(other.iterations, toi.iterations) << info.name;
            }
        }
    });
}

TEST(ToiMethodLaws, AnswersDescribeThePoseTheyReport) {
    inAllFamilies([](const Query& q) {
        for (const ToiMethodInfo& info : kToiMethods) {
            if (info.method == ToiMethod::shapeCast) { continue; }  // reports its own motion
            const Toi toi = by(info.method, q);
            const Toi there = separationAt(q.a, q.sweepA, q.b, q.sweepB, toi.fraction);
            ASSERT_NEAR(toi.separation, there.separation, q.settings.tolerance / 8) << info.name;
            ASSERT_GE(toi.fraction, 0) << info.name;
            ASSERT_LE(toi.fraction, q.settings.tMax) << info.name;
            ASSERT_NEAR(length(toi.normal), 1, 1e-12) << info.name;
        }
    });
}

/// A bar that whirls above the ground without reaching it.
Query whirlingBar(double turns) {
    Query q;
    q.a = {{DVec2{-5, -1}, DVec2{5, -1}, DVec2{5, 0}, DVec2{-5, 0}}, 4, 0};
    q.b = {{DVec2{-1, 0}, DVec2{1, 0}}, 2, 0};
    q.sweepB.c0 = q.sweepB.c1 = {0, 1.1};
    q.sweepB.a1 = 2 * std::numbers::pi * turns;
    q.settings = defaultToiSettings(q.a, q.b);
    return q;
}

TEST(ToiMethodBudgets, AreKeptAndSaidWhenSpent) {
    const Toi advanced = by(ToiMethod::conservativeAdvancement, whirlingBar(1e7));
    EXPECT_EQ(advanced.state, ToiState::failed);
    EXPECT_EQ(advanced.iterations, kMaxAdvancementSteps + 1);
    EXPECT_GT(advanced.fraction, 0);
    EXPECT_LT(advanced.fraction, 1);

    const Toi searched = by(ToiMethod::bruteForce, whirlingBar(1e7));
    EXPECT_EQ(searched.state, ToiState::failed);
    EXPECT_EQ(searched.fraction, 0);
    EXPECT_LT(searched.iterations, kMaxBruteForceEvaluations + 1000);
}

TEST(ToiMethodBudgets, AllowForMoreTurnsThanAnyGameHas) {
    for (const ToiMethod method : {ToiMethod::conservativeAdvancement, ToiMethod::bruteForce}) {
        EXPECT_EQ(by(method, whirlingBar(100)).state, ToiState::separated) << nameOf(method);
    }
    EXPECT_LT(by(ToiMethod::bruteForce, whirlingBar(100)).iterations, kMaxBruteForceEvaluations / 4);
}

TEST(ToiMethodBudgets, OfTheAxisRootsAreSmall) {
    int most = 0;
    int failed = 0;
    inAllFamilies([&](const Query& q) {
        const Toi toi = by(ToiMethod::separatingAxisRoot, q);
        most = std::max(most, toi.iterations);
        failed += toi.state == ToiState::failed ? 1 : 0;
    });
    EXPECT_LT(most, 1000);
    EXPECT_LE(failed, static_cast<int>(kFamilies.size() * kMethodCases / 100));
}

}  // namespace
}  // namespace swept::test
