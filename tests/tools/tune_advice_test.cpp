#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>
#include <string>
#include <vector>

#include <swept/samples/scene_builder.h>
#include <swept/tools/tune/config.h>
#include <swept/tools/tune/limits.h>
#include <swept/tools/tune/search.h>
#include <swept/tools/tune/verdict.h>

/// What the search tells of costs and of errors that are missed.

namespace swept::tune {
namespace {

using measures::Measure;

TEST(TuneVerdict, TellsWhatAdviceCosts) {
    EXPECT_EQ(costText(0.4, 1, true), ": 0.4 of what the scene costs now");
    EXPECT_EQ(costText(0.95, 1, true), ": no saving that could be measured");
    EXPECT_EQ(costText(0, 1, true), "");
    // What keeps the errors may well cost more than what does not.
    EXPECT_EQ(costText(1.24, 1, false),
              ": 1.24 times what the scene costs now (as it is, the scene does not keep these errors)");
    EXPECT_EQ(costText(0.95, 1, false),
              ": about what the scene costs now (as it is, the scene does not keep these errors)");
    EXPECT_EQ(costText(0.4, 1, false),
              ": 0.4 of what the scene costs now (as it is, the scene does not keep these errors)");
}

/// A row that keeps every error.
Row rowOf(SceneContinuous mode, double cost, double work) {
    Row row;
    row.config = ownConfig(build::scene("empty", {0, 0}, 10));
    row.config.continuous = mode;
    row.cost = cost;
    row.work = work;
    row.errors[Measure::penetration] = 0;
    return row;
}

SceneContinuous advisedMode(const std::vector<Row>& rows, SceneContinuous own = SceneContinuous::subStep) {
    Subject subject{build::scene("empty", {0, 0}, 10), 16};
    subject.scene.settings.continuous = own;
    Knowledge known;
    known.rows = rows;
    const Verdict verdict = judge(subject, known, {{Measure::penetration, 0.01, false}});
    EXPECT_GE(verdict.recommended, 0);
    return known.rows[static_cast<std::size_t>(verdict.recommended)].config.continuous;
}

TEST(TuneVerdict, WhatAClockCannotTellWeakensNoMode) {
    const auto off = [](double cost, double work) { return rowOf(SceneContinuous::off, cost, work); };
    const auto stop = [](double cost, double work) { return rowOf(SceneContinuous::stop, cost, work); };
    const auto subStep = [](double cost, double work) { return rowOf(SceneContinuous::subStep, cost, work); };
    // Times that repeats differ by, whoever is ahead.
    EXPECT_EQ(advisedMode({subStep(1.1, 3), off(1, 1), stop(1.05, 2)}), SceneContinuous::subStep);
    EXPECT_EQ(advisedMode({off(1, 1), stop(1.05, 2), subStep(1.3, 3)}), SceneContinuous::stop);
    EXPECT_EQ(advisedMode({off(1, 1), subStep(1.1, 2)}, SceneContinuous::off), SceneContinuous::subStep);
    // Equal work, however far a clock is off.
    EXPECT_EQ(advisedMode({off(1, 1), stop(1.2, 1), subStep(1.4, 1.01)}), SceneContinuous::subStep);
    // A saving that both tell of is one.
    EXPECT_EQ(advisedMode({off(1, 1), subStep(1.4, 1.4)}), SceneContinuous::off);
    // What the scene has now, where nothing is gained.
    Row fewer = subStep(1, 0.9);
    fewer.config.subSteps /= 2;
    EXPECT_EQ(advisedMode({fewer, subStep(1.1, 1)}), SceneContinuous::subStep);
    Knowledge known;
    known.rows = {fewer, subStep(1.1, 1)};
    const Subject subject{build::scene("empty", {0, 0}, 10), 16};
    EXPECT_EQ(judge(subject, known, {{Measure::penetration, 0.01, false}}).recommended, 1);
    // The work of another precision, or of other boxes, is not comparable.
    Row wide = subStep(2, 1);
    wide.config.engine = Engine::f64;
    Row pairs = subStep(2, 1);
    pairs.config.broadphase = SceneBroadphase::allPairs;
    EXPECT_EQ(advisedMode({off(1, 1), wide, pairs}), SceneContinuous::off);
}

TEST(TuneSearch, WhatSavesNextToNothingIsNotPutTogether) {
    const Subject subject{build::scene("empty", {0, 0}, 10), 16};
    const Config own = ownConfig(subject.scene);
    const SearchSpace space{{SceneContinuous::off}, {}, {SceneBroadphase::grid}};
    const std::vector<Limit> limits{{Measure::penetration, 0.01, false}};
    // Each step of a track tells what it wants next; passes matter, sub-steps and the mode next to nothing.
    Knowledge known;
    const auto run = [&](double modeWork) {
        known.rows.clear();
        for (int round = 0; round < 20; ++round) {
            const std::vector<Config> wanted = nextOf({own.engine, 0}, subject, space, limits, known);
            if (wanted.empty()) { return; }
            for (const Config& config : wanted) {
                Row row = rowOf(config.continuous, 1, 1 + config.relaxPasses);
                row.config = config;
                if (config.continuous != SceneContinuous::off) { row.work *= modeWork; }
                known.rows.push_back(row);
            }
        }
        FAIL() << "no end in sight";
    };
    const auto hasLeanest = [&](SceneContinuous mode) {
        return std::any_of(known.rows.begin(), known.rows.end(), [mode](const Row& row) {
            return row.config.continuous == mode && row.config.relaxPasses == 0;
        });
    };
    run(1.02);
    EXPECT_FALSE(hasLeanest(SceneContinuous::off));
    EXPECT_EQ(lastOf(subject, space, limits, known).at(0).continuous, SceneContinuous::subStep);
    run(1.5);
    EXPECT_TRUE(hasLeanest(SceneContinuous::off));
    EXPECT_EQ(lastOf(subject, space, limits, known).at(0).continuous, SceneContinuous::off);
}

TEST(TuneLimits, OfNothingThereAreNoParts) {
    const Subject subject{build::scene("empty", {0, 0}, 10), 16};
    const measures::Values certain;
    const std::vector<Limit> nothing{{Measure::penetration, 0, false}};
    Knowledge known;
    known.rows.resize(1);
    known.rows[0].config = ownConfig(subject.scene);
    known.rows[0].cost = 1;
    const auto rowUnder = [&](const std::vector<Limit>& limits) {
        std::ostringstream out;
        writeTable(out, subject, limits, known, judge(subject, known, limits));
        const std::string rows = out.str().substr(0, out.str().find("\n> recommended"));
        return rows.substr(rows.find_last_of("\n") + 1);
    };
    for (const double error : {1e-30, 0.002}) {  // the first one is lost beside 1
        known.rows[0].errors[Measure::penetration] = error;
        EXPECT_FALSE(holds(strain(known.rows[0], nothing, certain))) << error;
        EXPECT_TRUE(rowUnder(nothing).ends_with("over")) << rowUnder(nothing);
    }
    // In one form, however large.
    const std::vector<Limit> some{{Measure::penetration, 0.001, false}};
    for (const auto& [error, text] :
         {std::pair(0.000123456, " 12.3 %"), std::pair(0.0051, " 510 %"), std::pair(0.0234567, " 2346 %")}) {
        known.rows[0].errors[Measure::penetration] = error;
        EXPECT_TRUE(rowUnder(some).ends_with(text)) << rowUnder(some);
    }
    known.rows[0].errors[Measure::penetration] = 0;
    EXPECT_TRUE(rowUnder(nothing).ends_with(" 0 %")) << rowUnder(nothing);
}

TEST(TuneLimits, ThoseThatAreMissedAreTold) {
    Row row;
    row.errors[Measure::penetration] = 0.0123;
    row.errors[Measure::missedHits] = 2;
    const std::vector<Limit> limits{{Measure::penetration, 0.002, false}, {Measure::missedHits, 0, true}};
    EXPECT_EQ(missedText(row, limits, {}), "penetration 0.0123 instead of 0.002 m, missed-hits 2 instead of 0");
    EXPECT_EQ(missedText(row, {{Measure::penetration, 0.02, false}}, {}), "");
}

}  // namespace
}  // namespace swept::tune
