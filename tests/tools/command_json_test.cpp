#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "refused_runs.h"
#include "run_program.h"
#include "small_scenes.h"

// What commands tell other programs: --json.

namespace swept {
namespace {

using Json = nlohmann::json;
using Words = std::vector<std::string>;

class CommandJson : public RefusedRuns {
protected:
    /// What a command writes to a file; it must be the same on standard output, where nothing else is then.
    Json jsonOf(const Words& command, int exitCode = 0) {
        Words toFile = command;
        toFile.insert(toFile.end(), {"--json", out_.path("file.json")});
        const ProgramResult filed = runSwept(toFile);
        EXPECT_EQ(filed.exitCode, exitCode) << filed.err;
        Words piped = command;
        piped.insert(piped.end(), {"--json", "-"});
        const ProgramResult result = runSwept(piped);
        EXPECT_EQ(result.exitCode, exitCode) << result.err;
        const Json json = Json::parse(result.out, nullptr, false);
        EXPECT_EQ(keysOf(Json::parse(out_.read("file.json"))), keysOf(json)) << command.front();
        EXPECT_FALSE(result.err.empty()) << "people are told beside it";
        EXPECT_FALSE(filed.out.empty());
        return json;
    }
    static Words keysOf(const Json& json) {
        Words keys;
        for (const auto& [key, value] : json.items()) { keys.push_back(key); }
        return keys;
    }
    void expectHead(const Json& json, int steps) {
        EXPECT_EQ(json.at("scene"), "ball");
        EXPECT_EQ(json.at("source"), scene_);
        EXPECT_EQ(json.at("engine").get<std::string>().substr(0, 8), "swept2d ");
        EXPECT_EQ(json.at("steps"), steps);
        EXPECT_EQ(json.at("time"), steps * 0.015625);
    }
};

TEST_F(CommandJson, OfARunIsTheReport) {
    const Json json = jsonOf({"run", scene_, "--steps", "80"});
    EXPECT_EQ(json.dump(), Json::parse(runSwept({"run", scene_, "--steps", "80", "--report", "-"}).out).dump());
    expectHead(json, 80);
    EXPECT_EQ(json.at("precision"), "f32");
    EXPECT_FALSE(json.contains("from"));
    const Json later = jsonOf({"run", scene_, "--steps", "80", "--from", "0.25"});
    EXPECT_EQ(later.at("from"), 0.25);
    // One ball, which does not sleep: its sum is the number of steps.
    for (const Json& report : {json, later}) {
        EXPECT_EQ(report.at("counters").at("awakeBodies"), report.at("countersSummedOverSteps")) << report;
    }
    EXPECT_EQ(later.at("countersSummedOverSteps"), 64);
    EXPECT_EQ(jsonOf({"run", "pyramid", "--steps", "1"}).at("source"), "pyramid");
}

TEST_F(CommandJson, OfTheDoctor) {
    const Json json = jsonOf({"inspect", scene_, "--set", "/bodies/ball/bullet=true", "/settings/continuous=\"off\""});
    EXPECT_EQ(json.at("scene"), "ball");
    EXPECT_EQ(json.at("source"), scene_);
    EXPECT_FALSE(json.contains("steps")) << "nothing is run";
    ASSERT_FALSE(json.at("findings").empty());
    for (const char* const key : {"severity", "kind", "where", "text", "remedy"}) {
        EXPECT_TRUE(json["findings"][0].contains(key)) << key;
    }
    EXPECT_EQ(json.at("needs").size(), 12u);
    const Json strict = jsonOf({"inspect", scene_, "--strict", "--set", "/bodies/ball/position=[0, 0.1]"}, 1);
    EXPECT_EQ(strict.at("findings").at(0).at("kind"), "overlap");
}

/// Each mode has the totals of its run.
TEST_F(CommandJson, OfModes) {
    const Json json = jsonOf({"modes", scene_, "--steps", "80"});
    expectHead(json, 80);
    EXPECT_EQ(json.at("precision"), "f32");
    ASSERT_EQ(json.at("modes").size(), 5u);
    EXPECT_EQ(json["modes"][0].at("continuous"), "off");
    EXPECT_EQ(json["modes"][0].at("counters").at("impacts"), 0);
    EXPECT_GT(json["modes"][0].at("cost"), 0);
    const Json& subStep = json["modes"][4];
    const Json report = Json::parse(runSwept({"run", scene_, "--steps", "80", "--report", "-"}).out);
    for (const char* const same : {"finite", "counters", "countersSummedOverSteps", "lostTime", "deepestPenetration",
                                   "energy", "momentum", "angularMomentum", "stateHash", "largestJointError"}) {
        EXPECT_EQ(subStep.at(same), report.at(same)) << same;
    }
    EXPECT_FALSE(jsonOf({"modes", scene_, "--steps", "0"}).at("modes").at(0).contains("cost"));
}

TEST_F(CommandJson, OfComparisons) {
    const Json json = jsonOf({"compare", scene_, "--steps", "80", "--scale", "0.001"});
    expectHead(json, 80);
    EXPECT_EQ(json.at("scale"), 0.001);
    EXPECT_GT(json.at("firstBeyond").at("step"), 0);
    EXPECT_EQ(json.at("deviations").size(), 21u);
    EXPECT_EQ(json["deviations"][20].at("step"), 80);
    EXPECT_EQ(json["deviations"][20].at("body"), "ball");
    EXPECT_EQ(json["deviations"][20].at("energy").at("ours"), json.at("ours").at("energy").at("end"));
    EXPECT_EQ(json.at("box2d").at("engine"), "Box2D 2.4.1");
    EXPECT_TRUE(json["box2d"].contains("deepestPenetration"));
    EXPECT_EQ(json["ours"].at("countersSummedOverSteps"), 80);
    EXPECT_FALSE(json["box2d"].contains("lostTime")) << "it keeps no book";
    EXPECT_GT(json["box2d"].at("differences").size(), 3u);
    EXPECT_FALSE(jsonOf({"compare", scene_, "--steps", "4", "--scale", "9"}).contains("firstBeyond"));
}

TEST_F(CommandJson, OfTune) {
    const Json json = jsonOf({"tune", scene_, "--steps", "64", "--max-error", "penetration=0.01", "--max-error",
                              "position=0.3", "--out", out_.path("tune")});
    expectHead(json, 64);
    ASSERT_GE(json.at("accepted").size(), 2u);
    EXPECT_EQ(json["accepted"][0].at("measure"), "penetration");
    EXPECT_EQ(json["accepted"][0].at("limit"), 0.01);
    EXPECT_FALSE(json["accepted"][0].at("implied"));
    EXPECT_TRUE(json["accepted"][1].contains("uncertainty"));
    EXPECT_EQ(json.at("tuned"), out_.path("tune") + "/tuned.json");
    const Json tuned = Json::parse(out_.read("tune/tuned.json"));
    const Json& best = json.at("recommended");
    EXPECT_EQ(best.at("settings").at("dt"), tuned.at("settings").at("dt")) << "with the keys of the format";
    EXPECT_LE(best.at("errors").at("penetration"), 0.01);
    EXPECT_LE(best.at("ofAccepted"), 1);
    EXPECT_GT(json.at("rows").size(), 20u);
    int own = 0;
    double cost = 0;
    for (const Json& row : json.at("rows")) {
        own += row.at("own").get<bool>() ? 1 : 0;
        if (row.contains("failed")) { continue; }
        EXPECT_GE(row.at("cost"), cost) << "the cheapest first";
        cost = row.at("cost");
        EXPECT_EQ(row.contains("precision"), row.at("settings").contains("continuous")) << row;
    }
    EXPECT_EQ(own, 1);
    const Json none = jsonOf({"tune", scene_, "--steps", "64", "--max-error", "penetration=0.01", "--out",
                              out_.path("none"), "--set", "/bodies/ball/position=[0, 0.25]"},
                             1);
    EXPECT_TRUE(none.at("recommended").is_null());
    EXPECT_TRUE(none.at("nearest").contains("settings"));
    EXPECT_FALSE(none.contains("tuned"));
}

TEST_F(CommandJson, OfWhatCanGo) {
    const Json json = jsonOf(
        {"tune", scene_, "--steps", "96", "--ablate", "--max-error", "penetration=0.1", "--out", out_.path("lean")});
    expectHead(json, 96);
    EXPECT_EQ(json.at("lean"), out_.path("lean") + "/lean.json");
    EXPECT_GT(json.at("whole").at("cost"), 0);
    bool foundJoints = false;
    for (const Json& feature : json.at("features")) {
        if (feature.at("feature") == "restitution") { EXPECT_TRUE(feature.at("needed")); }
        if (feature.at("feature") != "joints") { continue; }
        foundJoints = true;
        EXPECT_FALSE(feature.at("present"));
        EXPECT_FALSE(feature.contains("needed")) << "nothing else is said of it";
    }
    EXPECT_TRUE(foundJoints);
    EXPECT_TRUE(json.at("leanest").at("without").is_array());
}

TEST_F(CommandJson, PlacesThatAreNone) {
    for (const Words& command :
         {Words{"inspect", scene_}, Words{"modes", scene_, "--steps", "1"}, Words{"compare", scene_, "--steps", "1"},
          Words{"run", scene_, "--steps", "1"},
          Words{"tune", scene_, "--steps", "8", "--max-error", "penetration=1", "--out", out_.path("tune")}}) {
        Words input = command;
        input.insert(input.end(), {"--json", scene_});
        expectNothingWritten(input, ": would overwrite the input");
        EXPECT_EQ(in_.read("ball.json"), kBallScene);
        Words missing = command;
        missing.insert(missing.end(), {"--json", out_.path("missing/file")});
        expectNothingWritten(missing, out_.path("missing/file") + ": cannot be written");
    }
    expectNothingWritten({"tune", scene_, "--max-error", "penetration=1", "--shard", "1/2", "--json", "-"},
                         "swept: --json: is the advice of the whole search; a shard has none");
    for (const char* const file : {"tune/tune.csv", "tune/tune.dat", "tune/tune.gp", "tune/tune.png", "tune/tune.svg",
                                   "tune/tuned.json", "tune/lean.json", "tune/ablation.csv"}) {
        expectNothingWritten(
            {"tune", scene_, "--max-error", "penetration=1", "--out", out_.path("tune"), "--json", out_.path(file)},
            "is already the file of --out");
    }
    expectNothingWritten({"run", scene_, "--steps", "1", "--report", out_.path("a"), "--json", out_.path("b")},
                         "swept: --report and --json are the same: give one of them, not both");
    expectNothingWritten({"modes", scene_, "--json", out_.path("a.png"), "--png", out_.path("a.png")},
                         "already the file");
}

}  // namespace
}  // namespace swept
