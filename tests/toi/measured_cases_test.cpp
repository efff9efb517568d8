#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

#include "oracle.h"

/// 300 queries of 15 families with certified brackets of the truth (data/toi_cases.jsonl, data/toi_truth.jsonl), among
/// them those on which root finding along one axis loses hits. A truth row brackets the first time at which the
/// separation falls to a level: 0 (`contact`), or `target` (`atTarget`). Rows with status "graze" are undecidable.

namespace swept::test {
namespace {

using Json = nlohmann::json;

struct MeasuredCase {
    Query query;
    Json truth;
    std::string id;
    std::string family;
};

DVec2 vectorFrom(const Json& json) { return {json.at(0).get<double>(), json.at(1).get<double>()}; }

void readBody(const Json& json, ToiPolygon& polygon, Sweep& sweep) {
    for (const Json& vertex : json.at("vertices")) {
        polygon.vertices[static_cast<std::size_t>(polygon.count++)] = vectorFrom(vertex);
    }
    polygon.radius = json.at("radius").get<double>();
    const Json& s = json.at("sweep");
    sweep.localCenter = vectorFrom(s.at("localCenter"));
    sweep.c0 = vectorFrom(s.at("c0"));
    sweep.c1 = vectorFrom(s.at("c1"));
    sweep.a0 = s.at("a0").get<double>();
    sweep.a1 = s.at("a1").get<double>();
}

std::vector<MeasuredCase> readCases() {
    std::ifstream cases(SWEPT_TOI_DATA "/toi_cases.jsonl");
    std::ifstream truths(SWEPT_TOI_DATA "/toi_truth.jsonl");
    std::vector<MeasuredCase> result;
    std::string line;
    std::string truthLine;
    while (std::getline(cases, line) && std::getline(truths, truthLine)) {
        const Json json = Json::parse(line);
        MeasuredCase measured;
        readBody(json.at("a"), measured.query.a, measured.query.sweepA);
        readBody(json.at("b"), measured.query.b, measured.query.sweepB);
        measured.truth = Json::parse(truthLine);
        measured.id = json.at("id").get<std::string>();
        measured.family = json.at("family").get<std::string>();
        result.push_back(std::move(measured));
    }
    return result;
}

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
    const std::vector<MeasuredCase> cases = readCases();
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
    for (const MeasuredCase& measured : readCases()) {
        Query query = measured.query;
        query.settings.target = measured.truth.at("target").get<double>();
        query.settings.tolerance = 0.00125;
        const Toi toi = ask(query);
        ASSERT_TRUE(keepsItsPromise(query, toi)) << measured.id << query;
    }
}

}  // namespace
}  // namespace swept::test
