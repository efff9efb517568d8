#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include <swept/tools/toi/toi_families.h>

#include "../oracle/first_crossing.h"

/// The families are what they are called.

namespace swept::test {
namespace {

constexpr std::uint64_t kFamilyCases = 300;

template <class Count>
int countCases(ToiFamily family, Count count) {
    int counted = 0;
    for (std::uint64_t index = 0; index < kFamilyCases; ++index) {
        counted += count(makeToiCase(family, 5, index)) ? 1 : 0;
    }
    return counted;
}

double shortestEdge(const ToiPolygon& p) {
    double shortest = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < static_cast<std::size_t>(p.count); ++i) {
        const std::size_t next = (i + 1) % static_cast<std::size_t>(p.count);
        shortest = std::min(shortest, length(p.vertices[next] - p.vertices[i]));
    }
    return shortest;
}

double turnOf(const Sweep& sweep) { return std::fabs(sweep.a1 - sweep.a0); }
double travelOf(const ToiQuery& q) { return length((q.sweepB.c1 - q.sweepB.c0) - (q.sweepA.c1 - q.sweepA.c0)); }

TEST(ToiFamilyCases, AreAcceptedAndReproducible) {
    for (const ToiFamily family : kToiFamilies) {
        std::set<std::string> lines;
        for (std::uint64_t index = 0; index < kFamilyCases; ++index) {
            const ToiQuery q = makeToiCase(family, 5, index);
            const Status status = validateToi(q.a, q.sweepA, q.b, q.sweepB, q.settings);
            ASSERT_TRUE(status.ok()) << nameOf(family) << ' ' << index << ' ' << status.field << q;
            ASSERT_EQ(queryLine(q, "x", "y"), queryLine(makeToiCase(family, 5, index), "x", "y"));
            lines.insert(queryLine(q, "x", "y"));
            lines.insert(queryLine(makeToiCase(family, 6, index), "x", "y"));
        }
        EXPECT_EQ(lines.size(), 2 * kFamilyCases) << nameOf(family);
    }
}

TEST(ToiFamilyCases, HaveNames) {
    std::set<std::string_view> names;
    for (const ToiFamily family : kToiFamilies) {
        names.insert(nameOf(family));
        EXPECT_EQ(toiFamilyFrom(nameOf(family)), family);
    }
    EXPECT_EQ(names.size(), kToiFamilies.size());
    EXPECT_FALSE(toiFamilyFrom("nonsense").has_value());
}

TEST(ToiFamilyCases, GrazeWithinAThousandthOfTheSize) {
    const int grazing = countCases(ToiFamily::graze, [](const ToiQuery& q) {
        const oracle::MovingPair pair(q.a, q.sweepA, q.b, q.sweepB);
        const double size = 1024 * defaultToiSettings(q.a, q.b).target;
        const auto stateAt = [&](double level) { return firstCrossing(pair, level, 0, 1, {1, 20'000}).state; };
        return stateAt(-1.1e-3 * size) == oracle::CrossingState::none &&
               stateAt(2.1e-3 * size) == oracle::CrossingState::found;
    });
    EXPECT_GT(grazing, 0.8 * kFamilyCases);
}

TEST(ToiFamilyCases, DipOutAgain) {
    const int dips = countCases(ToiFamily::dip, [](const ToiQuery& q) {
        const oracle::MovingPair pair(q.a, q.sweepA, q.b, q.sweepB);
        const double level = q.settings.target + q.settings.tolerance;
        return pair.guessSeparation(0) > level && pair.guessSeparation(1) > level &&
               firstCrossing(pair, level, 0, 1, {1, 20'000}).state == oracle::CrossingState::found;
    });
    EXPECT_GT(dips, 0.4 * kFamilyCases);
}

TEST(ToiFamilyCases, AreWhatTheyAreCalled) {
    EXPECT_GT(countCases(ToiFamily::spin, [](const ToiQuery& q) { return turnOf(q.sweepA) > 6.3; }), 40);
    EXPECT_GT(countCases(ToiFamily::far, [](const ToiQuery& q) { return length(q.sweepA.c0) > 1e5; }), 60);
    EXPECT_GT(countCases(ToiFamily::fast, [](const ToiQuery& q) { return travelOf(q) > 1e3; }), 100);
    const auto hasShortEdge = [](const ToiQuery& q) { return shortestEdge(q.a) < 1e-3; };
    EXPECT_GT(countCases(ToiFamily::shortEdge, hasShortEdge), 150);
    const auto bothTurn = [](const ToiQuery& q) { return turnOf(q.sweepA) > 0.5 && turnOf(q.sweepB) > 0.5; };
    EXPECT_EQ(countCases(ToiFamily::bothTurning, bothTurn), static_cast<int>(kFamilyCases));
    const auto fewVertices = [](const ToiQuery& q) { return q.a.count <= 2 && q.b.count <= 2 && q.a.radius > 0; };
    EXPECT_EQ(countCases(ToiFamily::circlesCapsules, fewVertices), static_cast<int>(kFamilyCases));
    const auto accelerates = [](const ToiQuery& q) { return length(q.sweepB.k - q.sweepA.k) > 0.5; };
    EXPECT_GT(countCases(ToiFamily::parabola, accelerates), 200);
    const auto startsAtTarget = [](const ToiQuery& q) {
        const oracle::MovingPair pair(q.a, q.sweepA, q.b, q.sweepB);
        const double aside = std::fabs(pair.guessSeparation(0) - q.settings.target);
        return aside <= 3.01 * defaultToiSettings(q.a, q.b).tolerance;
    };
    EXPECT_GT(countCases(ToiFamily::atTarget, startsAtTarget), 0.8 * kFamilyCases);
}

}  // namespace
}  // namespace swept::test
