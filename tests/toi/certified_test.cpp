#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include <swept/tools/toi/toi_families.h>
#include <swept/tools/toi/toi_judge.h>

#include "../oracle/first_crossing.h"

/// The certificate of `timeOfImpact`: a hundred thousand answers and more, each judged by interval arithmetic.

namespace swept::test {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr int kCertifiedCases = 300;
#else
constexpr int kCertifiedCases = 6000;  // of each of the families
#endif
constexpr int kBracketed = 6;  // every so many answers have their bracket and features looked at
constexpr std::uint64_t kSeed = 20260;

struct CertifiedTally {
    int hits = 0;  ///< after the start
    int atStart = 0;
    int separated = 0;
    int overlapped = 0;
    int undecided = 0;
    int gone = 0;  ///< hits of pairs that are apart again at the end of the sweep

    void add(const ToiQuery& q, const Toi& toi) {
        const bool hit = toi.state == ToiState::hit;
        hits += hit && toi.fraction > 0 ? 1 : 0;
        atStart += hit && toi.fraction == 0 ? 1 : 0;
        separated += toi.state == ToiState::separated ? 1 : 0;
        overlapped += toi.state == ToiState::overlapped ? 1 : 0;
        const Toi end = separationAt(q.a, q.sweepA, q.b, q.sweepB, q.settings.tMax);
        gone += hit && toi.fraction > 0 && end.separation > q.settings.target ? 1 : 0;
    }
};

/// The bracket of an answer, by interval arithmetic: the separation at its lower end is at least what is said, and that
/// is above the target.
::testing::AssertionResult isBracket(const ToiQuery& q, const Toi& toi) {
    if (toi.target != q.settings.target) { return ::testing::AssertionFailure() << "another target"; }
    if (toi.state != ToiState::hit || toi.fraction <= 0) {
        return toi.fractionLower == toi.fraction && toi.separationLower == toi.separation
                   ? ::testing::AssertionSuccess()
                   : ::testing::AssertionFailure() << "no bracket is needed, but there is one";
    }
    if (!(toi.fractionLower >= 0 && toi.fractionLower < toi.fraction)) {
        return ::testing::AssertionFailure() << "from " << toi.fractionLower;
    }
    if (!(toi.separationLower > q.settings.target && toi.separation <= q.settings.target + q.settings.tolerance)) {
        return ::testing::AssertionFailure() << "separation from " << toi.separationLower << " to " << toi.separation;
    }
    const oracle::MovingPair pair(q.a, q.sweepA, q.b, q.sweepB);
    const oracle::Interval there = pair.separationAt(toi.fractionLower);
    if (!(there.hi >= toi.separationLower - 0.25 * q.settings.tolerance)) {
        return ::testing::AssertionFailure() << there.hi << " at the lower end, said " << toi.separationLower;
    }
    return ::testing::AssertionSuccess();
}

/// Farthest that a witness point may lie from the surface of the feature it is said to lie on.
double distanceToFeature(const ToiPolygon& polygon, const Sweep& sweep, double t, const ToiFeature& feature,
                         DVec2 point) {
    const double angle = angleAt(sweep, t);
    const DVec2 relative = point - centerAt(sweep, t);
    const DVec2 local = DVec2{std::cos(angle) * relative.x + std::sin(angle) * relative.y,
                              std::cos(angle) * relative.y - std::sin(angle) * relative.x} +
                        sweep.localCenter;
    const DVec2 from = polygon.vertices[static_cast<std::size_t>(feature.first)];
    DVec2 closest = from;
    if (feature.second >= 0) {
        const DVec2 edge = polygon.vertices[static_cast<std::size_t>(feature.second)] - from;
        closest = from + std::clamp(dot(local - from, edge) / dot(edge, edge), 0.0, 1.0) * edge;
    }
    return std::fabs(length(local - closest) - polygon.radius);
}

bool isIndexOf(const ToiPolygon& polygon, int i) { return i >= 0 && i < polygon.count; }

/// The witness points lie on the features that are named.
::testing::AssertionResult featuresAreTrue(const ToiQuery& q, const Toi& toi) {
    if (toi.featureA.first < 0) {
        return toi.featureB.first < 0 ? ::testing::AssertionSuccess() : ::testing::AssertionFailure() << "half a pair";
    }
    const double size = length(toi.pointA) + length(toi.pointB) + length(q.sweepA.c0) + length(q.sweepB.c0) +
                        length(q.sweepA.c1) + length(q.sweepB.c1);
    const double room = q.settings.tolerance + 1e-14 * size;
    for (const bool ofA : {true, false}) {
        const ToiPolygon& polygon = ofA ? q.a : q.b;
        const ToiFeature& feature = ofA ? toi.featureA : toi.featureB;
        if (!isIndexOf(polygon, feature.first) || (feature.second != -1 && !isIndexOf(polygon, feature.second))) {
            return ::testing::AssertionFailure() << "no such vertex";
        }
        const double off =
            distanceToFeature(polygon, ofA ? q.sweepA : q.sweepB, toi.fraction, feature, ofA ? toi.pointA : toi.pointB);
        if (!(off <= room)) { return ::testing::AssertionFailure() << "off by " << off << (ofA ? " on a" : " on b"); }
    }
    return ::testing::AssertionSuccess();
}

class ToiCertificate : public ::testing::TestWithParam<ToiFamily> {};

TEST_P(ToiCertificate, IsKept) {
    CertifiedTally tally;
    for (int index = 0; index < kCertifiedCases; ++index) {
        const ToiQuery q = makeToiCase(GetParam(), kSeed, static_cast<std::uint64_t>(index));
        const Toi toi = timeOfImpact(q.a, q.sweepA, q.b, q.sweepB, q.settings);
        const ToiJudgement judgement = judgeToi(q, toi);
        tally.add(q, toi);
        tally.undecided += judgement.verdict == ToiVerdict::undecided ? 1 : 0;
        ASSERT_TRUE(judgement.verdict == ToiVerdict::right || judgement.verdict == ToiVerdict::undecided)
            << nameOf(judgement.verdict) << " by " << judgement.depth << " at " << judgement.fraction << "; "
            << nameOf(GetParam()) << " seed " << kSeed << " index " << index << '\n'
            << q;
        if (index % kBracketed == 0) {
            ASSERT_TRUE(isBracket(q, toi)) << nameOf(GetParam()) << " seed " << kSeed << " index " << index << '\n'
                                           << q;
            ASSERT_TRUE(featuresAreTrue(q, toi))
                << nameOf(GetParam()) << " seed " << kSeed << " index " << index << '\n'
                << q;
        }
    }
    RecordProperty("hits", tally.hits);
    RecordProperty("separated", tally.separated);
    RecordProperty("undecided", tally.undecided);
    EXPECT_LE(tally.undecided, kCertifiedCases / 1000);
    // Enough of everything to prove something.
    EXPECT_GT(tally.hits, 0.03 * kCertifiedCases);
    EXPECT_GT(tally.separated, 0.03 * kCertifiedCases);
    if (GetParam() == ToiFamily::overlap) { EXPECT_GT(tally.overlapped, 0.5 * kCertifiedCases); }
    if (GetParam() == ToiFamily::touch) { EXPECT_GT(tally.atStart, 0.2 * kCertifiedCases); }
    if (GetParam() == ToiFamily::atTarget) { EXPECT_GT(tally.atStart, 0.3 * kCertifiedCases); }
    if (GetParam() == ToiFamily::dip) { EXPECT_GT(tally.gone, 0.3 * kCertifiedCases); }
}

/// How much is told changes nothing in what is found.
TEST_P(ToiCertificate, IsTheSameInEveryDetail) {
    for (int index = 0; index < kCertifiedCases / 20; ++index) {
        ToiQuery q = makeToiCase(GetParam(), kSeed, static_cast<std::uint64_t>(index));
        const Toi all = timeOfImpact(q.a, q.sweepA, q.b, q.sweepB, q.settings);
        for (const ToiDetail detail : {ToiDetail::event, ToiDetail::contact}) {
            q.settings.detail = detail;
            const Toi toi = timeOfImpact(q.a, q.sweepA, q.b, q.sweepB, q.settings);
            ASSERT_EQ(toi.state, all.state) << q;
            ASSERT_EQ(toi.fraction, all.fraction) << q;
            ASSERT_EQ(toi.target, all.target) << q;
            ASSERT_LE(std::abs(toi.iterations - all.iterations), all.state == ToiState::separated ? 1 : 0) << q;
            ASSERT_EQ(toi.fractionLower, all.fractionLower) << q;
            ASSERT_EQ(toi.rootIterations, all.rootIterations) << q;
            const bool told =
                all.state == ToiState::hit || (detail == ToiDetail::contact && all.state == ToiState::separated);
            if (told) {
                ASSERT_EQ(toi.separation, all.separation) << q;
                ASSERT_EQ(toi.pointA, all.pointA) << q;
                ASSERT_EQ(toi.featureB, all.featureB) << q;
            }
        }
    }
}

/// Pairs that touch or overlap at the start, one level deeper.
class ToiInContact : public ::testing::TestWithParam<ToiFamily> {};

TEST_P(ToiInContact, KeepsItsLevel) {
    int deeper = 0;
    int overlapping = 0;
    for (int index = 0; index < kCertifiedCases / 4; ++index) {
        const ToiQuery q = makeToiCase(GetParam(), kSeed, static_cast<std::uint64_t>(index));
        SCOPED_TRACE(::testing::Message() << nameOf(GetParam()) << " seed " << kSeed << " index " << index << '\n'
                                          << q);
        const Toi start = separationAt(q.a, q.sweepA, q.b, q.sweepB, 0);
        const Toi toi = timeOfImpactInContact(q.a, q.sweepA, q.b, q.sweepB, q.settings, start.normal);
        const double tolerance = q.settings.tolerance;
        ASSERT_NEAR(toi.target, std::min(q.settings.target, start.separation - 2 * tolerance), 0.5 * tolerance);
        ASSERT_TRUE(toi.state == ToiState::hit || toi.state == ToiState::separated);
        ASSERT_TRUE(toi.state == ToiState::separated ? toi.fraction == q.settings.tMax : toi.fraction > 0);
        const oracle::MovingPair pair(q.a, q.sweepA, q.b, q.sweepB);
        const oracle::Crossing crossing = firstCrossing(pair, toi.target - tolerance, 0, toi.fraction, {1, 20'000});
        ASSERT_NE(crossing.state, oracle::CrossingState::found) << "at " << crossing.hi;
        if (toi.state == ToiState::hit) {
            // Along the reported direction, whatever others say: the true separation may be larger inside.
            ASSERT_NEAR(toi.separation, toi.target, tolerance);
            ASSERT_NEAR(pair.gapAt(toi.fraction, {toi.normal.x, toi.normal.y}), toi.separation, 0.25 * tolerance);
            ++deeper;
        }
        overlapping += start.state == ToiState::overlapped ? 1 : 0;
    }
    EXPECT_GT(deeper, kCertifiedCases / 40);
    if (GetParam() == ToiFamily::overlap) { EXPECT_GT(overlapping, kCertifiedCases / 8); }
}

INSTANTIATE_TEST_SUITE_P(All, ToiInContact,
                         ::testing::Values(ToiFamily::overlap, ToiFamily::touch, ToiFamily::atTarget,
                                           ToiFamily::generic),
                         [](const auto& tested) { return std::string(nameOf(tested.param)); });

/// A box of half width 1 lies 0.1 deep in the ground: it may go on sliding, rising and sinking by two tolerances.
/// Pressed right through, it is stopped at once, though on the other side there would be room.
TEST(ToiInContactClosedForm, SinkingBox) {
    ToiQuery q;
    q.a = {{DVec2{-5, -1}, {5, -1}, {5, 0}, {-5, 0}}, 4, 0};
    q.b = {{DVec2{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}, 4, 0};
    q.settings = {.target = 0.01, .tolerance = 0.002};
    const auto ask = [&q](DVec2 axis) { return timeOfImpactInContact(q.a, q.sweepA, q.b, q.sweepB, q.settings, axis); };
    q.sweepB.c0 = {0, 0.9};
    q.sweepB.c1 = {3, 1.5};
    EXPECT_EQ(ask({0, 1}).state, ToiState::separated);
    for (const double depth : {0.2, 1.0, 10.0}) {
        q.sweepB.c1 = {0, 0.9 - depth};
        const Toi toi = ask({0, 1});
        EXPECT_EQ(toi.state, ToiState::hit);
        EXPECT_NEAR(toi.target, -0.104, 1e-15);
        EXPECT_NEAR(toi.fraction, 0.004 / depth, 0.001001 / depth);
        EXPECT_NEAR(toi.normal.y, 1, 1e-15);
    }
    // Without the axis the deepest box would leave downward.
    q.sweepB.c0 = {0, -1.2};
    q.sweepB.c1 = {0, -3};
    EXPECT_EQ(ask({0, 1}).state, ToiState::hit);
    EXPECT_EQ(ask({0, -1}).state, ToiState::separated);
}

INSTANTIATE_TEST_SUITE_P(All, ToiCertificate, ::testing::ValuesIn(kToiFamilies),
                         [](const auto& tested) { return std::string(nameOf(tested.param)); });

}  // namespace
}  // namespace swept::test
