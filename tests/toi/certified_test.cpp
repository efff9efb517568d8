#include <gtest/gtest.h>

#include <string>

#include <swept/tools/toi_families.h>
#include <swept/tools/toi_judge.h>

/// The certificate of `timeOfImpact`: a hundred thousand answers and more, each judged by interval arithmetic.

namespace swept::test {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr int kCases = 300;
#else
constexpr int kCases = 6000;  // of each of the families
#endif
constexpr std::uint64_t kSeed = 20260;

struct Tally {
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

class ToiCertificate : public ::testing::TestWithParam<ToiFamily> {};

TEST_P(ToiCertificate, IsKept) {
    Tally tally;
    for (int index = 0; index < kCases; ++index) {
        const ToiQuery q = makeToiCase(GetParam(), kSeed, static_cast<std::uint64_t>(index));
        const Toi toi = timeOfImpact(q.a, q.sweepA, q.b, q.sweepB, q.settings);
        const ToiJudgement judgement = judgeToi(q, toi);
        tally.add(q, toi);
        tally.undecided += judgement.verdict == ToiVerdict::undecided ? 1 : 0;
        ASSERT_TRUE(judgement.verdict == ToiVerdict::right || judgement.verdict == ToiVerdict::undecided)
            << nameOf(judgement.verdict) << " by " << judgement.depth << " at " << judgement.fraction << "; "
            << nameOf(GetParam()) << " seed " << kSeed << " index " << index << '\n'
            << q;
    }
    RecordProperty("hits", tally.hits);
    RecordProperty("separated", tally.separated);
    RecordProperty("undecided", tally.undecided);
    EXPECT_LE(tally.undecided, kCases / 1000);
    // Enough of everything to prove something.
    EXPECT_GT(tally.hits, 0.03 * kCases);
    EXPECT_GT(tally.separated, 0.03 * kCases);
    if (GetParam() == ToiFamily::overlap) {
        EXPECT_GT(tally.overlapped, 0.5 * kCases);
    }
    if (GetParam() == ToiFamily::touch) {
        EXPECT_GT(tally.atStart, 0.2 * kCases);
    }
    if (GetParam() == ToiFamily::atTarget) {
        EXPECT_GT(tally.atStart, 0.3 * kCases);
    }
    if (GetParam() == ToiFamily::dip) {
        EXPECT_GT(tally.gone, 0.3 * kCases);
    }
}

INSTANTIATE_TEST_SUITE_P(All, ToiCertificate, ::testing::ValuesIn(kToiFamilies),
                         [](const auto& tested) { return std::string(nameOf(tested.param)); });

}  // namespace
}  // namespace swept::test
