#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <sstream>
#include <string>

#include <swept/toi/time_of_impact.h>
#include <swept/tools/bench/engine_query.h>
#include <swept/tools/bench/toi_bench.h>
#include <swept/tools/bench/toi_bench_table.h>
#include <swept/tools/bench/toi_certify.h>

namespace swept::bench {
namespace {

Toi truth(const ToiQuery& q) { return timeOfImpact(q.a, q.sweepA, q.b, q.sweepB, q.settings); }

/// Always gives the same answer.
class Stubborn : public ToiContestant {
public:
    Stubborn(std::string name, Toi answer) : name_(std::move(name)), answer_(answer) {}
    std::string name() const override { return name_; }
    std::optional<ToiQuery> understood(const ToiQuery& query) const override { return query; }
    void load(std::span<const ToiQuery> queries) override { count_ = queries.size(); }
    void answerAll(std::span<Toi> answers) override {
        EXPECT_EQ(answers.size(), count_);
        for (Toi& answer : answers) { answer = answer_; }
    }

private:
    std::string name_;
    Toi answer_;
    std::size_t count_ = 0;
};

/// Knows of nothing.
class Mute final : public ToiContestant {
public:
    std::string name() const override { return "mute"; }
    std::optional<ToiQuery> understood(const ToiQuery&) const override { return std::nullopt; }
    void load(std::span<const ToiQuery> queries) override { EXPECT_TRUE(queries.empty()); }
    void answerAll(std::span<Toi> answers) override { EXPECT_TRUE(answers.empty()); }
};

std::unique_ptr<ToiContestant> hitAt(std::string name, double fraction) {
    Toi answer;
    answer.state = ToiState::hit;
    answer.fraction = fraction;
    answer.iterations = 7;
    return std::make_unique<Stubborn>(std::move(name), answer);
}

TEST(ToiBench, TellsMistakesApart) {
    ToiContestants contestants;
    contestants.push_back(hitAt("hasty", 0));
    contestants.push_back(hitAt("beyond", 2));
    contestants.push_back(std::make_unique<Stubborn>("helpless", Toi{}));
    contestants.push_back(std::make_unique<Mute>());
    const auto rows = benchToi(contestants, {.count = 10, .seed = 4}, [](int, int) {});
    ASSERT_EQ(rows.size(), 4 * kToiFamilies.size());
    int early = 0;
    for (const ToiBenchRow& row : rows) {
        EXPECT_EQ(row.tally.queries, row.method == "mute" ? 0 : 10);
        EXPECT_EQ(row.tally.failed, row.method == "helpless" ? 10 : 0);
        EXPECT_EQ(row.tally.wrongReport, row.method == "beyond" ? 10 : 0);
        EXPECT_EQ(row.tally.missed + row.tally.late, 0);
        EXPECT_EQ(row.iterationsOf(0.5), row.method == "hasty" || row.method == "beyond" ? 7 : 0);
        EXPECT_EQ(row.tally.early > 0, row.tally.widestGap > 0);
        early += row.tally.early;
    }
    EXPECT_GT(early, 60) << "most queries start apart";
    std::ostringstream table;
    writeToiTable(table, rows);
    EXPECT_NE(table.str().find("mute: not asked"), std::string::npos);
}

TEST(ToiBench, IterationsThatAreNotToldAreNoZeros) {
    class Silent final : public Stubborn {
    public:
        using Stubborn::Stubborn;
        bool tellsIterations() const override { return false; }
    };
    ToiContestants contestants;
    contestants.push_back(std::make_unique<Silent>("silent", Toi{}));
    const auto rows = benchToi(contestants, {.count = 3, .seed = 4}, [](int, int) {});
    EXPECT_TRUE(rows.front().iterations.empty());
    std::ostringstream table;
    writeToiTable(table, rows);
    EXPECT_NE(table.str().find("       -       - "), std::string::npos) << table.str();
    std::ostringstream csv;
    writeToiCsv(csv, rows, {.count = 3, .seed = 4});
    EXPECT_NE(csv.str().find(",-,-,"), std::string::npos) << csv.str();
}

TEST(ToiBench, PercentilesAreOfTheSortedSample) {
    ToiBenchRow row;
    for (int i = 1; i <= 1000; ++i) { row.iterations.push_back(i); }
    EXPECT_EQ(row.iterationsOf(0.5), 500);
    EXPECT_EQ(row.iterationsOf(0.999), 999);
    EXPECT_EQ(row.iterationsOf(1), 1000);
    EXPECT_EQ(ToiBenchRow{}.iterationsOf(0.5), 0);
}

TEST(ToiBench, TurnsCountWhatTheyAsk) {
    ToiContestants contestants;
    contestants.push_back(hitAt("hasty", 0));
    const auto points = benchTurns(contestants, {.count = 5, .seed = 4}, [](int, int) {});
    ASSERT_EQ(points.size(), 10U);
    EXPECT_LT(points.front().turn, points.back().turn);
    for (const TurnPoint& point : points) { EXPECT_EQ(point.tally.queries, 5); }
}

TEST(ToiCertify, FindsAWrongAnswerAndNamesTheQuery) {
    const auto nothing = [](std::int64_t) {};
    EXPECT_EQ(certifyToi(truth, 100, 5, nothing).wrong(), 0);
    const auto liar = [](const ToiQuery& query) {
        Toi answer = truth(query);
        if (answer.state == ToiState::hit) {
            answer.state = ToiState::separated;
            answer.fraction = query.settings.tMax;
        }
        return answer;
    };
    const CertifyResult result = certifyToi(liar, 100, 5, nothing);
    EXPECT_GT(result.countOf(ToiVerdict::missed), 20);
    ASSERT_FALSE(result.violations.empty());
    const CertifyViolation& first = result.violations.front();
    const ToiQuery query = makeToiCase(first.family, 5, first.index);
    EXPECT_EQ(judgeToi(query, liar(query)).verdict, first.verdict) << "the name leads back to the query";
}

/// A bar turns by 2.5 rad and meets a small disk on the way. At a constant rate it is there at `angle`/2.5; mixed and
/// normalised at ½ + ½ tan(angle − 1.25)/tan(1.25). Each engine keeps max(slop, R − n slop) away from the middle of the
/// disk, R its radius, so `angle` is where that distance is left.
double barFraction(double pin, double distance, double kept, bool mixed) {
    const double angle = pin - std::asin(kept / distance);
    return mixed ? 0.5 + 0.5 * std::tan(angle - 1.25) / std::tan(1.25) : angle / 2.5;
}

TEST(Engines, TurnAsTheirOwnSweepsDo) {
    int asked = 0;
    for (const auto& engine : allToiContestants()) {
        const bool mixed = engine->name() == "Box2D 3";
        if (!mixed && engine->name() != "Box2D 2.4.1") { continue; }
        const double inside = mixed ? 0.005 : 0.015;
        for (const double pin : {0.3, 0.6, 1.1, 1.9, 2.4}) {
            ToiQuery query;
            query.a = {{DVec2{0, 0}, DVec2{1, 0}}, 2, 0};
            query.sweepA.a1 = 2.5;
            query.b.count = 1;
            query.b.radius = 0.05;
            query.sweepB.c0 = query.sweepB.c1 = 0.8 * DVec2{std::cos(pin), std::sin(pin)};
            query.settings = defaultToiSettings(query.a, query.b);
            const std::optional<ToiQuery> understood = engine->understood(query);
            ASSERT_TRUE(understood.has_value());
            const std::array<ToiQuery, 1> queries{*understood};
            std::array<Toi, 1> answers;
            engine->load(queries);
            engine->answerAll(answers);
            ASSERT_EQ(answers[0].state, ToiState::hit) << engine->name() << ' ' << pin;
            EXPECT_NEAR(answers[0].fraction, barFraction(pin, 0.8, 0.05 - inside, mixed), 2e-3) << engine->name();
            // By its own motion it is right; the other's is elsewhere by more than the tolerance, but in the middle.
            const std::optional<MixedTurns> turns = engine->turnsOf(queries[0]);
            ASSERT_EQ(turns.has_value(), mixed);
            const ToiVerdict own = turns ? judgeToiEvent(queries[0], answers[0], *turns).verdict
                                         : judgeToiEvent(queries[0], answers[0]).verdict;
            EXPECT_EQ(own, ToiVerdict::right) << engine->name() << ' ' << pin;
            if (mixed) { EXPECT_NE(judgeToiEvent(queries[0], answers[0]).verdict, ToiVerdict::right) << pin; }
            ++asked;
        }
    }
    EXPECT_GE(asked, 5);
}

TEST(EngineQuery, IsWhatTheEngineSees) {
    int asked = 0;
    for (const ToiFamily family : kToiFamilies) {
        for (std::uint64_t index = 0; index < 20; ++index) {
            const std::optional<ToiQuery> q = engineQuery(makeToiCase(family, 1, index), {});
            if (!q) { continue; }
            ++asked;
            EXPECT_NE(family, ToiFamily::parabola);
            EXPECT_NE(family, ToiFamily::small);
            EXPECT_NE(family, ToiFamily::large);
            const double radii = q->a.radius + q->b.radius;
            EXPECT_NEAR(q->settings.target + radii, std::max(0.005, radii - 0.015), 1e-12 * (1 + radii));
            EXPECT_EQ(q->sweepA.c1.x, static_cast<double>(static_cast<float>(q->sweepA.c1.x)));
            EXPECT_EQ(q->sweepB.a1, static_cast<double>(static_cast<float>(q->sweepB.a1)));
        }
    }
    EXPECT_GT(asked, 250);
}

}  // namespace
}  // namespace swept::bench
