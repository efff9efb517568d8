#include <gtest/gtest.h>

#include <swept/tools/toi/toi_families.h>
#include <swept/tools/toi/toi_judge.h>

/// The judge finds what is wrong with wrong answers.

namespace swept::test {
namespace {

constexpr std::uint64_t kCases = 200;

Toi askAt(const ToiQuery& q, double target) {
    ToiSettings settings = q.settings;
    settings.target = target;
    return timeOfImpact(q.a, q.sweepA, q.b, q.sweepB, settings);
}

/// Runs `check` on hits after the start, over all families. @return their number
template <class Check>
int overAllHits(Check check) {
    int hits = 0;
    for (const ToiFamily family : kToiFamilies) {
        for (std::uint64_t index = 0; index < kCases; ++index) {
            const ToiQuery query = makeToiCase(family, 4242, index);
            const Toi toi = askAt(query, query.settings.target);
            if (toi.state != ToiState::hit || !(toi.fraction > 0)) { continue; }
            ++hits;
            SCOPED_TRACE(::testing::Message() << nameOf(family) << ' ' << index << ' ' << query);
            check(query, toi);
            if (::testing::Test::HasFatalFailure()) { return 0; }
        }
    }
    return hits;
}

TEST(ToiJudge, HitsThatComeTooLateAreFound) {
    int late = 0;
    int missed = 0;
    overAllHits([&](const ToiQuery& query, const Toi&) {
        const double target = query.settings.target - 3 * query.settings.tolerance;
        if (target + query.a.radius + query.b.radius < 0) { return; }
        const Toi toi = askAt(query, target);
        const ToiJudgement judgement = judgeToi(query, toi);
        if (toi.state == ToiState::hit) {
            ++late;
            ASSERT_EQ(judgement.verdict, ToiVerdict::late);
            ASSERT_GE(judgement.depth, 0.5 * query.settings.tolerance);
            ASSERT_LE(judgement.fraction, toi.fraction);
        } else if (judgement.verdict != ToiVerdict::right) {  // only if it stays within the band
            ++missed;
            ASSERT_EQ(judgement.verdict, ToiVerdict::missed);
        }
    });
    EXPECT_GT(late, 500);
    EXPECT_GT(missed, 20);
}

TEST(ToiJudge, HitsThatComeTooEarlyAreFound) {
    const int hits = overAllHits([](const ToiQuery& query, const Toi&) {
        const Toi toi = askAt(query, query.settings.target + 3 * query.settings.tolerance);
        ASSERT_EQ(toi.state, ToiState::hit);
        const ToiJudgement judgement = judgeToi(query, toi);
        const bool early = toi.separation > query.settings.target + 1.5 * query.settings.tolerance;
        if (early) { ASSERT_EQ(judgement.verdict, ToiVerdict::early); }
        if (early) { ASSERT_GE(judgement.depth, 0.25 * query.settings.tolerance); }
        ASSERT_TRUE(early || toi.fraction == 0);
    });
    EXPECT_GT(hits, 1000);
}

TEST(ToiJudge, OtherStatesThanTheTrueOneAreFound) {
    int missed = 0;
    const int hits = overAllHits([&missed](const ToiQuery& query, const Toi& toi) {
        Toi wrong = toi;
        wrong.state = ToiState::separated;
        wrong.fraction = query.settings.tMax;
        // Right only where the pair stays within the band.
        missed += judgeToiEvent(query, wrong).verdict == ToiVerdict::missed ? 1 : 0;
        wrong.state = ToiState::overlapped;
        wrong.fraction = 0;
        ASSERT_EQ(judgeToiEvent(query, wrong).verdict, ToiVerdict::falseOverlap);
        wrong.state = ToiState::failed;
        ASSERT_EQ(judgeToiEvent(query, wrong).verdict, ToiVerdict::failed);
    });
    EXPECT_GT(hits, 1000);
    EXPECT_GT(missed, 0.9 * hits);
}

TEST(ToiJudge, FalseReportsAreFound) {
    overAllHits([](const ToiQuery& query, const Toi& toi) {
        Toi wrong = toi;
        wrong.separation += 0.6 * query.settings.tolerance;
        ASSERT_EQ(judgeToi(query, wrong).verdict, ToiVerdict::wrongReport);
        wrong = toi;
        wrong.normal = -toi.normal;
        ASSERT_EQ(judgeToi(query, wrong).verdict, ToiVerdict::wrongReport);
        wrong = toi;
        wrong.pointB += (2 * query.settings.tolerance) * toi.normal;
        ASSERT_EQ(judgeToi(query, wrong).verdict, ToiVerdict::wrongReport);
        ASSERT_EQ(judgeToiEvent(query, wrong).verdict, ToiVerdict::right);
    });
}

TEST(ToiJudge, OverlapsThatAreNotSaidAreFound) {
    int overlaps = 0;
    for (std::uint64_t index = 0; index < kCases; ++index) {
        const ToiQuery query = makeToiCase(ToiFamily::overlap, 1, index);
        Toi toi = askAt(query, query.settings.target);
        if (toi.state != ToiState::overlapped || toi.separation > -1e-2) { continue; }
        ++overlaps;
        toi.state = ToiState::hit;
        ASSERT_EQ(judgeToiEvent(query, toi).verdict, ToiVerdict::falseOverlap) << index << query;
    }
    EXPECT_GT(overlaps, 100);
}

}  // namespace
}  // namespace swept::test
