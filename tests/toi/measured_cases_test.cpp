#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>

#include "measured_cases.h"

/// The measured cases, among them those on which root finding along one axis loses hits.

namespace swept::test {
namespace {

using Json = nlohmann::json;

Toi askAt(const MeasuredCase& measured, double target, double tolerance) {
    Query query = measured.query;
    query.settings.target = target;
    query.settings.tolerance = tolerance;
    const Status status = validateToi(query.a, query.sweepA, query.b, query.sweepB, query.settings);
    EXPECT_TRUE(status.ok()) << measured.id << ' ' << status.field << ' ' << describe(status.code);
    return ask(query);
}

/// The certificate at target = level + tolerance: up to the answer's fraction the level itself is not reached. So a hit
/// of the truth is neither missed nor found late.
void expectNotLate(const MeasuredCase& measured, const Json& first, const Toi& toi) {
    const std::string status = first.at("status").get<std::string>();
    ASSERT_NE(toi.state, ToiState::failed) << measured.id;
    if (status == "miss") { ASSERT_NE(toi.state, ToiState::overlapped) << measured.id; }
    if (status == "overlap") {
        ASSERT_EQ(toi.fraction, 0) << measured.id;
        ASSERT_NE(toi.state, ToiState::separated) << measured.id;
    }
    if (status == "hit") {
        ASSERT_NE(toi.state, ToiState::separated) << measured.id << " missed";
        ASSERT_LE(toi.fraction, first.at("tHi").get<double>()) << measured.id << " late";
    }
}

/// At target = level − tolerance a hit has passed the level: it is neither early nor invented.
void expectNotEarly(const MeasuredCase& measured, const Json& first, const Toi& toi) {
    const std::string status = first.at("status").get<std::string>();
    ASSERT_NE(toi.state, ToiState::failed) << measured.id;
    if (status == "miss") { ASSERT_EQ(toi.state, ToiState::separated) << measured.id << " invented"; }
    if (status == "hit" && toi.state == ToiState::hit) {
        ASSERT_GE(toi.fraction, first.at("tLo").get<double>()) << measured.id << " early";
    }
}

/// Judges both sides at one level; returns the iterations of the first query.
int judge(const MeasuredCase& measured, const Json& first, double level, double tolerance) {
    const Toi upper = askAt(measured, level + tolerance, tolerance);
    expectNotLate(measured, first, upper);
    if (level - tolerance + measured.query.a.radius + measured.query.b.radius >= 0) {
        expectNotEarly(measured, first, askAt(measured, level - tolerance, tolerance));
    }
    return upper.iterations;
}

class MeasuredCases : public ::testing::TestWithParam<double> {};

TEST_P(MeasuredCases, AreAnsweredRight) {
    const std::vector<MeasuredCase> cases = readMeasuredCases();
    ASSERT_EQ(cases.size(), 300U);
    std::map<std::string, int> scored;
    int mostIterations = 0;
    for (const MeasuredCase& measured : cases) {
        const double tolerance = GetParam() * measured.truth.at("size").get<double>();
        for (const char* level : {"contact", "atTarget"}) {
            const Json& first = measured.truth.at(level);
            const std::string status = first.at("status").get<std::string>();
            if (status == "graze") { continue; }
            const double height = std::string(level) == "contact" ? 0 : measured.truth.at("target").get<double>();
            mostIterations = std::max(mostIterations, judge(measured, first, height, tolerance));
            if (HasFatalFailure()) { return; }
            ++scored[status];
        }
    }
    RecordProperty("mostIterations", mostIterations);
    EXPECT_LE(mostIterations, 16);
    EXPECT_GT(scored["hit"], 400);
    EXPECT_GT(scored["miss"], 100);
    EXPECT_GT(scored["overlap"], 50);
}

// In sizes of the smaller body. The finest is near what double resolves for bodies a factor of 10⁶ apart.
INSTANTIATE_TEST_SUITE_P(Tolerances, MeasuredCases, ::testing::Values(1e-2, 1e-4, 1e-6));

TEST(MeasuredCasesAsIs, AtTheirTargetTheHitIsWithinTheBand) {
    for (const MeasuredCase& measured : readMeasuredCases()) {
        Query query = measured.query;
        query.settings.target = measured.truth.at("target").get<double>();
        query.settings.tolerance = 0.00125;
        const Toi toi = ask(query);
        ASSERT_TRUE(keepsItsPromise(query, toi)) << measured.id << query;
    }
}

}  // namespace
}  // namespace swept::test
