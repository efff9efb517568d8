#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <set>
#include <sstream>

#include <swept/samples/scene_builder.h>
#include <swept/samples/scene_reader.h>
#include <swept/tools/measures/measure_run.h>
#include <swept/tools/tune/plot.h>
#include <swept/tools/tune/run_config.h>
#include <swept/tools/tune/search.h>
#include <swept/tools/tune/store.h>
#include <swept/tools/tune/team.h>
#include <swept/tools/tune/verdict.h>

#include "scratch_directory.h"

namespace swept::tune {
namespace {

using measures::Measure;

Subject crates() {
    SceneDescription scene = build::scene("crates", {0, 0}, 10);
    build::addFixed(scene, "floor", {0, -0.5}, {build::box({10, 0.5})});
    build::addDynamic(scene, "lower", {0, 0.5}, {build::box({0.5, 0.5})});
    build::addDynamic(scene, "upper", {0, 1.5}, {build::box({0.5, 0.5})});
    return {scene, 16};
}

/// A world in which the error is known: it falls with the square of the sub-steps in a second, and work and cost grow
/// with them. Clocks are noisy: `noise` is added to the cost.
class Model {
public:
    explicit Model(double noise) : noise_(noise) {}

    Row run(const Config& config) {
        Row row;
        row.config = config;
        const double rate = config.subSteps * std::ldexp(1.0, -config.dtPower);
        row.errors[Measure::penetration] = 1 / (rate * rate);
        row.errors[Measure::missedHits] = config.continuous == SceneContinuous::off ? 1 : 0;
        row.work = rate * (2 + config.relaxPasses);
        ++runs_;
        row.cost = row.work * (1 + noise_ * (runs_ % 7));
        return row;
    }

    /// Runs tracks until they ask for nothing more.
    void finish(const Subject& subject, const std::vector<Limit>& limits, const Shard& shard, Knowledge& known) {
        const SearchSpace space = searchSpaceOf(subject.scene);
        const std::vector<Track> tracks = allTracks();
        for (std::size_t i = 0; i < tracks.size(); ++i) {
            for (int round = 0; shard.has(i); ++round) {
                ASSERT_LT(round, 20) << "no end in sight";
                const std::vector<Config> wanted = nextOf(tracks[i], subject, space, limits, known);
                if (wanted.empty()) { break; }
                for (const Config& config : wanted) {
                    EXPECT_EQ(known.find(config), nullptr) << "asked for twice";
                    known.rows.push_back(run(config));
                }
            }
        }
    }

private:
    double noise_;
    int runs_ = 0;
};

std::set<std::string> linesOf(const Subject& subject, const Knowledge& known) {
    std::set<std::string> lines;
    for (const Row& row : known.rows) { lines.insert(fieldsOf(subject.scene, row.config)); }
    return lines;
}

const std::vector<Limit> kLimits{{Measure::penetration, 1.0 / 64, false}, {Measure::missedHits, 0, true}};

TEST(TuneSearch, FindsTheFewestSubSteps) {
    const Subject subject = crates();
    Knowledge known;
    Model(0).finish(subject, kLimits, {}, known);
    // 8 sub-steps at 60 Hz are what the limit asks for, or as many in other steps; no passes are needed.
    const Verdict verdict = judge(subject, known, kLimits);
    ASSERT_GE(verdict.recommended, 0);
    const Row& row = known.rows[static_cast<std::size_t>(verdict.recommended)];
    EXPECT_DOUBLE_EQ(row.errors[Measure::penetration], 1.0 / 64);
    EXPECT_EQ(row.config.relaxPasses, 0);
    EXPECT_NE(row.config.continuous, SceneContinuous::off) << "off misses a hit";
    EXPECT_EQ(row.config.dtPower, 0) << "of equal ones, the nearest to the scene";
    EXPECT_LT(known.rows.size(), 90U) << "not the whole grid";
}

TEST(TuneSearch, GoesByErrorsAndNotByClocks) {
    const Subject subject = crates();
    Knowledge quiet;
    Knowledge noisy;
    Model(0).finish(subject, kLimits, {}, quiet);
    Model(0.5).finish(subject, kLimits, {}, noisy);
    EXPECT_EQ(linesOf(subject, quiet), linesOf(subject, noisy));
}

TEST(TuneSearch, ShardsTogetherRunWhatOneProcessRuns) {
    const Subject subject = crates();
    Knowledge whole;
    Knowledge together;
    Model(0).finish(subject, kLimits, {}, whole);
    for (int i = 0; i < 5; ++i) {
        Knowledge part;
        Model(0.3).finish(subject, kLimits, {i, 5}, part);
        EXPECT_FALSE(part.rows.empty());
        together.add(part);
    }
    EXPECT_EQ(linesOf(subject, whole), linesOf(subject, together));
}

TEST(TuneSearch, GoesOnWhereItWasInterrupted) {
    const Subject subject = crates();
    Knowledge whole;
    Model(0).finish(subject, kLimits, {}, whole);
    Knowledge resumed;
    resumed.rows.assign(whole.rows.begin(), whole.rows.begin() + 17);
    Model(0).finish(subject, kLimits, {}, resumed);
    EXPECT_EQ(linesOf(subject, whole), linesOf(subject, resumed));
    EXPECT_EQ(whole.rows.size(), resumed.rows.size());
}

TEST(TuneVerdict, SaysWhenNothingKeepsTheErrors) {
    const Subject subject = crates();
    Knowledge known;
    const std::vector<Limit> impossible{{Measure::penetration, 1e-9, false}};
    Model(0).finish(subject, impossible, {}, known);
    const Verdict verdict = judge(subject, known, impossible);
    EXPECT_EQ(verdict.recommended, -1);
    ASSERT_GE(verdict.nearest, 0);
    for (const Row& row : known.rows) {
        EXPECT_GE(row.errors[Measure::penetration],
                  known.rows[static_cast<std::size_t>(verdict.nearest)].errors[Measure::penetration]);
    }
}

TEST(TuneVerdict, FrontIsWhatNothingBeats) {
    const Subject subject = crates();
    Knowledge known;
    for (const auto& [cost, error] : {std::pair(1.0, 8.0), {2.0, 9.0}, {3.0, 4.0}, {4.0, 0.5}, {5.0, 0.6}}) {
        Row row;
        row.config.subSteps = static_cast<int>(cost);
        row.cost = cost;
        row.errors[Measure::penetration] = error;
        known.rows.push_back(row);
    }
    known.rows.push_back(known.rows[3]);
    known.rows.back().config.engine = Engine::box2d;
    known.rows.back().cost = 0.1;  // another engine takes no place on our front
    const Verdict verdict = judge(subject, known, {{Measure::penetration, 5, false}});
    EXPECT_EQ(verdict.front, (std::vector<std::size_t>{0, 2, 3}));
    EXPECT_EQ(verdict.recommended, 2);
}

TEST(TuneLimits, AreReadAndRefused) {
    std::vector<Limit> limits;
    std::string error;
    EXPECT_TRUE(parseLimits({"penetration=0.01", "lost-time=0"}, limits, error)) << error;
    ASSERT_EQ(limits.size(), 2U);
    EXPECT_EQ(limits[0].value, 0.01);
    for (const char* const bad : {"penetratoin=1", "penetration", "penetration=", "penetration=-1", "penetration=1x",
                                  "penetration=inf", "penetration=nan", "=1", ""}) {
        std::vector<Limit> none;
        EXPECT_FALSE(parseLimits({bad}, none, error)) << bad;
        EXPECT_NE(error.find("--max-error"), std::string::npos);
    }
    std::vector<Limit> twice;
    EXPECT_FALSE(parseLimits({"penetration=1", "penetration=2"}, twice, error));
}

TEST(TuneLimits, UncertaintyOfTheReferenceCountsAsError) {
    Row row;
    row.errors[Measure::position] = 0.5;
    measures::Values uncertainty;
    uncertainty[Measure::position] = 0.25;
    EXPECT_DOUBLE_EQ(strain(row, {{Measure::position, 1, false}}, uncertainty), 0.75);
    EXPECT_TRUE(std::isinf(strain(row, {{Measure::eventTime, 1, false}}, uncertainty))) << "was not measured";
    EXPECT_DOUBLE_EQ(strain(row, {{Measure::position, 0, false}}, uncertainty), 1.75);
    row.verdict = "not finite";
    EXPECT_TRUE(std::isinf(strain(row, {{Measure::position, 1, false}}, uncertainty)));
}

TEST(TuneShards, AreReadAndRefused) {
    Shard shard;
    std::string error;
    EXPECT_TRUE(parseShard("2/4", shard, error));
    EXPECT_EQ(shard.index, 1);
    EXPECT_EQ(shard.count, 4);
    for (const char* const bad : {"0/4", "5/4", "2", "2/", "/4", "a/b", "2/4x", "-1/4", "1/0", ""}) {
        EXPECT_FALSE(parseShard(bad, shard, error)) << bad;
    }
}

TEST(TuneStore, RowsComeBackAsTheyWere) {
    const Subject subject = crates();
    const ScratchDirectory scratch;
    Row row = Model(0).run(ownConfig(subject.scene));
    row.config.toiTolerance = 0.1;
    row.config.dtPower = -2;
    Row failed;
    failed.config.engine = Engine::box2d;
    failed.verdict = "aborted";
    std::string error;
    {
        Store store(scratch.path("out"), {});
        ASSERT_TRUE(store.open(error)) << error;
        store.append(csvLine(subject, row));
        store.append(csvLine(subject, failed));
        store.append("0123456789abcdef,f32,0,0.01");  // cut off
    }
    Knowledge known;
    Store again(scratch.path("out"), {});
    ASSERT_TRUE(again.read(subject, false, known, error)) << error;
    ASSERT_EQ(known.rows.size(), 2U);
    ASSERT_NE(known.find(row.config), nullptr);
    EXPECT_EQ(known.find(row.config)->cost, row.cost);
    EXPECT_EQ(known.find(row.config)->errors[Measure::penetration], row.errors[Measure::penetration]);
    EXPECT_TRUE(std::isnan(known.find(row.config)->errors[Measure::position]));
    EXPECT_EQ(known.find(failed.config)->verdict, "aborted");
    ASSERT_TRUE(again.open(error)) << error;
    EXPECT_EQ(scratch.read("out/tune.csv").find("0123456789abcdef"), std::string::npos) << "what was cut off goes";
    // Another scene, another length, another file altogether.
    Subject other = subject;
    other.scene.bodies[1].position.x = 1;
    EXPECT_FALSE(again.read(other, false, known, error));
    EXPECT_NE(error.find("another scene"), std::string::npos) << error;
    other = subject;
    other.ticks += 2;
    EXPECT_FALSE(again.read(other, false, known, error));
    scratch.write("out/tune.csv", "time,x,y\n0,1,2\n");
    EXPECT_FALSE(again.read(subject, false, known, error));
}

TEST(TuneRuns, MeasureWhatTheSettingsDo) {
    Subject subject = crates();
    subject.scene.bodies[2].position.y += 0.1;  // it falls: what begins in balance has no error
    const measures::Reference reference = measures::makeReference(subject.scene, subject.ticks);
    Config coarse = ownConfig(subject.scene);
    coarse.subSteps = 1;
    coarse.dtPower = 1;
    const Row coarseRow = runConfig(subject, coarse, reference);
    const Row ownRow = runConfig(subject, ownConfig(subject.scene), reference);
    EXPECT_EQ(ownRow.verdict, "");
    EXPECT_GT(ownRow.cost, 0);
    EXPECT_GT(coarseRow.errors[Measure::penetration], ownRow.errors[Measure::penetration]);
    EXPECT_LT(coarseRow.work, ownRow.work);
    const Row again = runConfig(subject, ownConfig(subject.scene), reference);
    EXPECT_EQ(again.errors[Measure::penetration], ownRow.errors[Measure::penetration]);
    EXPECT_EQ(again.work, ownRow.work) << "no clock is in it";
}

/// Plots one row, of a scene of this name.
void plotNamed(const std::string& name, const ScratchDirectory& scratch) {
    Subject subject = crates();
    subject.scene.name = name;
    Knowledge known;
    Row row;
    row.cost = 1;
    row.errors[Measure::penetration] = 0.01;
    known.rows = {row};
    std::string error;
    (void)plotRows(scratch.path("."), subject, {{Measure::penetration, 0.05, false}}, known, {}, error);
    EXPECT_EQ(error, "");
}

TEST(TunePlot, IsCalledAsTheSceneIfThatHasAName) {
    for (const char* const name : {"", "crates"}) {
        const ScratchDirectory scratch;
        plotNamed(name, scratch);
        const std::string title = *name == '\0' ? "'what accuracy costs'" : "'crates: what accuracy costs'";
        EXPECT_NE(scratch.read("tune.gp").find("set title " + title), std::string::npos) << scratch.read("tune.gp");
    }
}

/// A line of gnuplot that begins with an exclamation mark is one for the shell.
TEST(TunePlot, RunsNothingThatANameHasInIt) {
    const ScratchDirectory scratch;
    plotNamed("crates'\n!touch made_by_shell\nset title 'x", scratch);
    EXPECT_FALSE(scratch.has("made_by_shell"));
    EXPECT_EQ(scratch.read("tune.gp").find("\n!"), std::string::npos) << scratch.read("tune.gp");
}

TEST(TuneTeam, EveryIndexRunsOnce) {
    std::vector<std::atomic<int>> counts(100);
    runParallel(counts.size(), 4, [&](std::size_t i) { ++counts[i]; });
    for (const auto& count : counts) { EXPECT_EQ(count, 1); }
    EXPECT_EQ(makeTeam()->gather("rows"), "rows");
}

}  // namespace
}  // namespace swept::tune
