#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "csv_records.h"
#include "run_program.h"
#include "small_scenes.h"

namespace swept {
namespace {

std::vector<std::string> linesOf(const std::string& text) {
    std::vector<std::string> lines;
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line);) { lines.push_back(line); }
    return lines;
}

TEST(CommandRun, WritesTheStateOfEveryBodyAfterEveryStep) {
    const ScratchDirectory scratch;
    const std::string scene = scratch.write("ball.json", kBallScene);
    const auto result = runSwept({"run", scene, "--steps", "3", "--csv", scratch.path("out.csv")});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    const auto lines = linesOf(scratch.read("out.csv"));
    ASSERT_EQ(lines.size(), 1u + 4u * 2u);
    EXPECT_EQ(lines[0], "step,time,body,x,y,angle,vx,vy,omega,awake");
    EXPECT_EQ(lines[1], "0,0,floor,0,-0.5,0,0,0,0,0");
    EXPECT_EQ(lines[2], "0,0,ball,0,5,0,1,0,0,1");
    EXPECT_EQ(lines[7], "3,0.046875,floor,0,-0.5,0,0,0,0,0");
    const auto ball = fieldsOf(lines[8]);
    ASSERT_EQ(ball.size(), 10u);
    EXPECT_NEAR(std::stod(ball[3]), 0.046875, 1e-6);
    EXPECT_NEAR(std::stod(ball[4]), 5 - 4 * 0.046875 * 0.046875, 1e-6) << "free flight is exact";
    EXPECT_EQ(ball[9], "1");
}

TEST(CommandRun, WritesOnlyTheStatesThatAreAskedFor) {
    const ScratchDirectory scratch;
    const std::string scene = scratch.write("ball.json", kBallScene);
    const auto statesOf = [&](std::vector<std::string> options) {
        options.insert(options.begin(), {"run", scene, "--steps", "5", "--csv", "-"});
        const auto result = runSwept(options);
        EXPECT_EQ(result.exitCode, 0) << result.err;
        return linesOf(result.out);
    };
    const auto all = statesOf({});
    const std::vector<std::string> everyOther{all[0], all[1], all[2], all[5], all[6], all[9], all[10]};
    EXPECT_EQ(statesOf({"--csv-every", "2"}), everyOther);
    EXPECT_EQ(statesOf({"--csv-every", "9"}), (std::vector<std::string>{all[0], all[1], all[2]}));
    EXPECT_EQ(statesOf({"--csv-bodies", "ball,floor"}), all) << "in the order of the scene";
    EXPECT_EQ(statesOf({"--csv-bodies", "ball", "--csv-every", "5"}),
              (std::vector<std::string>{all[0], all[2], all[12]}));
    EXPECT_EQ(statesOf({"--csv-bodies", "ball", "--csv-bodies", "floor"}), all);
}

/// A scene that was tried by --set, kept.
TEST(CommandRun, WritesTheSceneThatItRuns) {
    const ScratchDirectory scratch;
    const std::string scene = scratch.write("ball.json", kBallScene);
    const std::string kept = scratch.path("kept.json");
    const auto tried = runSwept({"run", scene, "--steps", "70", "--set", "/gravity=[0.1, -9]", "/bodies/1/angle=0.3",
                                 "--csv", scratch.path("tried.csv"), "--write-scene", kept});
    ASSERT_EQ(tried.exitCode, 0) << tried.err;
    EXPECT_NE(tried.out.find("scene     " + kept + '\n'), std::string::npos) << tried.out;
    const auto written = nlohmann::json::parse(scratch.read("kept.json"));
    EXPECT_EQ(written.at("gravity"), nlohmann::json({0.1, -9}));
    EXPECT_EQ(written.at("bodies").at(1).at("angle"), 0.3);
    ASSERT_EQ(runSwept({"run", kept, "--steps", "70", "--csv", scratch.path("again.csv")}).exitCode, 0);
    EXPECT_EQ(scratch.read("again.csv"), scratch.read("tried.csv"));
    const auto piped = runSwept({"run", "car", "--steps", "0", "--write-scene", "-"});
    EXPECT_EQ(piped.out, runSwept({"scenes", "--json", "car"}).out);
    EXPECT_NE(piped.err.find("car: 0 steps"), std::string::npos) << piped.err;
}

/// A run that is stopped half way goes on.
TEST(CommandRun, WritesWhereItEnds) {
    const ScratchDirectory scratch;
    const std::string end = scratch.path("end.json");
    const auto half = runSwept({"run", "car", "--steps", "40", "--csv", scratch.path("half.csv"), "--write-end", end});
    ASSERT_EQ(half.exitCode, 0) << half.err;
    EXPECT_NE(half.out.find("its end   " + end + '\n'), std::string::npos) << half.out;
    const auto before = nlohmann::json::parse(runSwept({"scenes", "--json", "car"}).out);
    const auto after = nlohmann::json::parse(scratch.read("end.json"));
    EXPECT_EQ(after.at("name"), before.at("name"));
    EXPECT_EQ(after.value("view", nlohmann::json()), before.value("view", nlohmann::json()));
    ASSERT_EQ(after.at("bodies").size(), before.at("bodies").size());
    for (std::size_t i = 0; i < before.at("bodies").size(); ++i) {
        EXPECT_EQ(after.at("bodies")[i].at("name"), before.at("bodies")[i].value("name", "body" + std::to_string(i)));
    }
    // The last states of the one are the first of the other.
    ASSERT_EQ(runSwept({"run", end, "--steps", "0", "--csv", scratch.path("on.csv")}).exitCode, 0);
    const auto placesAt = [](const std::string& csv, const std::string& step) {
        std::vector<std::array<double, 2>> places;
        std::istringstream lines(csv);
        for (std::string line; std::getline(lines, line);) {
            std::istringstream fields(line);
            std::vector<std::string> row;
            for (std::string field; std::getline(fields, field, ',');) { row.push_back(field); }
            if (row.at(0) == step) { places.push_back({std::stod(row.at(3)), std::stod(row.at(4))}); }
        }
        return places;
    };
    const auto wanted = placesAt(scratch.read("half.csv"), "40");
    const auto found = placesAt(scratch.read("on.csv"), "0");
    ASSERT_EQ(wanted.size(), before.at("bodies").size());
    ASSERT_EQ(found.size(), wanted.size());
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        EXPECT_NEAR(found[i][0], wanted[i][0], 1e-6) << i;
        EXPECT_NEAR(found[i][1], wanted[i][1], 1e-6) << i;
    }
    const auto piped = runSwept({"run", "car", "--steps", "40", "--write-end", "-"});
    EXPECT_EQ(piped.out, scratch.read("end.json"));
}

TEST(CommandRun, WritesTheViewThatItDraws) {
    const ScratchDirectory scratch;
    const std::string scene = scratch.write("ball.json", kBallScene);
    const auto sceneOf = [&](std::vector<std::string> options) {
        options.insert(options.begin(), {"run", scene, "--steps", "0", "--png", scratch.path("out"), "--size", "32x32",
                                         "--write-scene", "-"});
        return nlohmann::json::parse(runSwept(options).out);
    };
    EXPECT_EQ(sceneOf({"--view", "1,2,3"}).at("view"), nlohmann::json::parse(R"({"center": [1, 2], "height": 3})"));
    EXPECT_FALSE(sceneOf({}).contains("view"));
    EXPECT_FALSE(sceneOf({"--view", "1,2,3", "--follow", "ball"}).contains("view")) << "no scene follows a body";
}

/// One of the outputs may go to another program, which sees nothing but that.
TEST(CommandRun, WritesOneOutputToStandardOutput) {
    const ScratchDirectory scratch;
    const std::string scene = scratch.write("ball.json", kBallScene);
    for (const std::string flag : {"--csv", "--events", "--report"}) {
        const std::vector<std::string> run{"run", scene, "--steps", "80", flag};
        const auto with = [&](std::vector<std::string> more) {
            more.insert(more.begin(), run.begin(), run.end());
            return runSwept(more);
        };
        ASSERT_EQ(with({scratch.path("file")}).exitCode, 0);
        const auto piped = with({"-"});
        EXPECT_EQ(piped.exitCode, 0) << piped.err;
        EXPECT_EQ(piped.out, scratch.read("file")) << flag;
        EXPECT_NE(piped.err.find("ball: 80 steps"), std::string::npos) << piped.err;
        EXPECT_FALSE(std::filesystem::exists("-"));
        const auto both = with({"-", flag == "--csv" ? "--report" : "--csv", scratch.path("other")});
        EXPECT_EQ(both.out, piped.out);
        EXPECT_TRUE(scratch.has("other"));
    }
}

TEST(CommandRun, RunsTheDurationRoundedToSteps) {
    const ScratchDirectory scratch;
    const std::string scene = scratch.write("ball.json", kBallScene);
    struct Case {
        const char* duration;
        std::size_t steps;
    };
    for (const Case& c : {Case{"0.1", 6}, Case{"0.11", 7}, Case{"0", 0}, Case{"0.007", 0}, Case{"0.008", 1}}) {
        const auto result = runSwept({"run", scene, "--duration", c.duration, "--csv", scratch.path("out.csv")});
        ASSERT_EQ(result.exitCode, 0) << result.err;
        EXPECT_EQ(linesOf(scratch.read("out.csv")).size(), 1 + 2 * (c.steps + 1)) << c.duration;
    }
}

TEST(CommandRun, RunsTenSecondsByDefault) {
    const ScratchDirectory scratch;
    const std::string scene = scratch.write("ball.json", kBallScene);
    ASSERT_EQ(runSwept({"run", scene, "--csv", scratch.path("out.csv")}).exitCode, 0);
    EXPECT_EQ(linesOf(scratch.read("out.csv")).size(), 1u + 2u * 641u);
}

TEST(CommandRun, TellsOfTheBounce) {
    const ScratchDirectory scratch;
    const std::string scene = scratch.write("ball.json", kBallScene);
    const auto result = runSwept({"run", scene, "--duration", "1.5", "--events", scratch.path("out.jsonl")});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    const auto lines = linesOf(scratch.read("out.jsonl"));
    ASSERT_FALSE(lines.empty());
    double last = 0;
    int hits = 0;
    for (const std::string& line : lines) {
        const auto event = nlohmann::json::parse(line);
        EXPECT_GE(event.at("time"), last) << "sorted by time";
        last = event.at("time");
        EXPECT_EQ(event.at("time").get<double>(),
                  (event.at("step").get<double>() - 1 + event.at("fraction").get<double>()) * 0.015625);
        hits += event.at("type") == "hit" ? 1 : 0;
    }
    const auto first = nlohmann::json::parse(lines[0]);
    EXPECT_EQ(first.at("a"), "floor");
    EXPECT_EQ(first.at("b"), "ball");
    EXPECT_NEAR(first.at("time"), 1.06, 0.02) << "4.5 m at 8 m/s²";
    EXPECT_GE(hits, 1);
}

TEST(CommandRun, WritesAReport) {
    const ScratchDirectory scratch;
    const std::string scene = scratch.write("ball.json", kBallScene);
    const auto result =
        runSwept({"run", scene, "--steps", "10", "--precision", "f64", "--report", scratch.path("out.json")});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    const auto report = nlohmann::json::parse(scratch.read("out.json"));
    EXPECT_EQ(report.at("scene"), "ball");
    EXPECT_EQ(report.at("precision"), "f64");
    EXPECT_EQ(report.at("steps"), 10);
    EXPECT_EQ(report.at("finite"), true);
    EXPECT_FALSE(report.at("counters").empty());
    const double energy = report.at("energy").at("start");
    EXPECT_NEAR(energy, 3.14159265 * 0.25 * (0.5 + 8 * 5), 1e-3);
    EXPECT_NEAR(report.at("energy").at("end"), energy, 1e-9 * energy) << "free flight loses nothing";
    EXPECT_EQ(report.at("settings").at("dt"), 0.015625);
}

TEST(CommandRun, ReportsTheMostSubStepsOfAnyStep) {
    const ScratchDirectory scratch;
    ASSERT_EQ(runSwept({"run", "pyramid", "--steps", "8", "--report", scratch.path("out.json")}).exitCode, 0);
    const auto report = nlohmann::json::parse(scratch.read("out.json"));
    const double most = report.at("counters").at("mostSubSteps");
    EXPECT_GE(most, 1);
    EXPECT_LE(most, 64) << "not the sum of all steps";
    EXPECT_GT(report.at("counters").at("awakeBodies").get<double>(), 64) << "which other counters are";
}

TEST(CommandRun, OverridesMembersBeforeTheyAreChecked) {
    const ScratchDirectory scratch;
    const std::string scene = scratch.write("ball.json", kBallScene);
    const std::string csv = scratch.path("out.csv");
    const auto changed = runSwept({"run", scene, "--steps", "1", "--set", "/settings/dt=0.25", "--set",
                                   "/bodies/1/velocity=[2, 0]", "--csv", csv});
    ASSERT_EQ(changed.exitCode, 0) << changed.err;
    EXPECT_EQ(fieldsOf(linesOf(scratch.read("out.csv"))[4])[1], "0.25");
    EXPECT_EQ(fieldsOf(linesOf(scratch.read("out.csv"))[4])[3], "0.5");
    const auto severalAtOnce =
        runSwept({"run", "--set", "/settings/dt=0.5", "/gravity=[0, 0]", "--steps", "1", scene, "--csv", csv});
    ASSERT_EQ(severalAtOnce.exitCode, 0) << severalAtOnce.err;
    EXPECT_EQ(linesOf(scratch.read("out.csv"))[4], "1,0.5,ball,0.5,5,0,1,0,0,1");
}

TEST(CommandRun, GivesTheSameBytesTwiceAndWithAnyNumberOfThreads) {
    const ScratchDirectory scratch;
    for (const char* precision : {"f32", "f64"}) {
        ASSERT_EQ(runSwept({"run", "falling-shapes", "--duration", "2", "--precision", precision, "--csv",
                            scratch.path("a"), "--events", scratch.path("ea")})
                      .exitCode,
                  0);
        ASSERT_EQ(runSwept({"run", "falling-shapes", "--duration", "2", "--precision", precision, "--csv",
                            scratch.path("b"), "--events", scratch.path("eb"), "--threads", "2"})
                      .exitCode,
                  0);
        EXPECT_EQ(scratch.read("a"), scratch.read("b")) << precision;
        EXPECT_EQ(scratch.read("ea"), scratch.read("eb")) << precision;
        EXPECT_GT(scratch.read("ea").size(), 1000u) << "something must have happened";
    }
}

/// A run of ages must not go on for a file that is lost.
TEST(CommandRun, StopsWhereItCannotWrite) {
    const ScratchDirectory scratch;
    const std::string scene = scratch.write("ball.json", kBallScene);
    const std::string csv = scratch.path("states.csv");
    expectRefused({"run", scene, "--steps", "9007199254740992", "--csv", "/dev/full"},
                  "--csv /dev/full: could not be written to the end");
    expectRefused({"run", scene, "--steps", "9007199254740993"}, "--steps: must be at most 9007199254740992");
}

TEST(CommandRun, TakesNamesBetweenCommasWithTheirBlanks) {
    const ScratchDirectory scratch;
    const std::string scene = scratch.write("ball.json", kBallScene);
    const auto statesOf = [&](const std::string& bodies, const std::string& file) {
        return runSwept({"run", file, "--steps", "2", "--csv", "-", "--csv-bodies", bodies}).out;
    };
    EXPECT_EQ(statesOf("ball, floor", scene), statesOf("ball,floor", scene));
    EXPECT_EQ(statesOf(" ball ", scene), statesOf("ball", scene));
    std::string odd = kBallScene;
    odd.replace(odd.find("\"floor\""), 7, "\" floor\"");
    const std::string oddScene = scratch.write("odd.json", odd);
    EXPECT_NE(statesOf(" floor", oddScene).find("\n0,0, floor,"), std::string::npos) << "a name is a name";
    for (const char* const empty : {"", " ", "ball, "}) {
        expectRefused({"run", scene, "--csv", scratch.path("csv"), "--csv-bodies", empty},
                      "--csv-bodies: a name is empty");
    }
}

TEST(CommandRun, TellsWhereAndWhenTheLargestErrorsWere) {
    const ScratchDirectory scratch;
    const std::string scene = scratch.write("press.json", R"({"gravity": [0, 0], "settings": {"continuous": "stop"},
     "bodies": [{"name": "wall", "position": [0, -2], "shapes": [{"box": {"half": [10, 1]}}]},
      {"name": "in", "type": "dynamic", "position": [3, -0.75], "shapes": [{"box": {"half": [0.5, 0.5]}}]},
      {"name": "fast", "type": "dynamic", "position": [0, 1], "velocity": [0, -240],
       "shapes": [{"circle": {"radius": 0.1}}]}]})");
    const auto result = runSwept({"run", scene, "--steps", "1"});
    EXPECT_NE(result.out.find("deepest penetration 0.25 m (\"wall\" and \"in\" at 0 s)"), std::string::npos)
        << result.out;
    EXPECT_NE(result.out.find("s in all bodies, most by \"fast\": 0.0"), std::string::npos) << result.out;
    const auto jointed = runSwept({"run", "hanging-chain", "--duration", "1"});
    EXPECT_NE(jointed.out.find("largest joint error 0.0"), std::string::npos) << jointed.out;
    EXPECT_NE(jointed.out.find(" m (\"joint"), std::string::npos) << jointed.out;
}

TEST(CommandRun, SumsUpForAHuman) {
    const ScratchDirectory scratch;
    const std::string scene = scratch.write("ball.json", kBallScene);
    const auto result = runSwept({"run", scene, "--steps", "64", "--csv", scratch.path("out.csv")});
    EXPECT_NE(result.out.find("64 steps"), std::string::npos) << result.out;
    EXPECT_NE(result.out.find("= 1 s"), std::string::npos) << result.out;
    EXPECT_NE(result.out.find("deepest penetration"), std::string::npos) << result.out;
    EXPECT_NE(result.out.find(scratch.path("out.csv")), std::string::npos) << result.out;
    EXPECT_EQ(result.err, "") << "no progress where nobody watches";
    const auto one = runSwept({"run", scene, "--steps", "1"});
    EXPECT_NE(one.out.find(": 1 step of "), std::string::npos) << one.out;
}

TEST(CommandRun, ReadsStandardInputAsAllCommandsOfScenesDo) {
    const ScratchDirectory scratch;
    const std::string scene = scratch.write("ball.json", kBallScene);
    const std::vector<std::string> run{"run", "-", "--steps", "3", "--csv", scratch.path("in.csv")};
    ASSERT_EQ(runSwept(run, kBallScene).exitCode, 0);
    ASSERT_EQ(runSwept({"run", scene, "--steps", "3", "--csv", scratch.path("file.csv")}).exitCode, 0);
    EXPECT_EQ(scratch.read("in.csv"), scratch.read("file.csv"));
    for (const char* const command : {"inspect", "modes", "compare"}) {
        const auto result = runSwept({command, "-", "--steps", "1"}, kBallScene);
        EXPECT_EQ(result.exitCode, 0) << command << result.err;
    }
    expectRefused({"run", "-"}, "swept: standard input: /bodies: is missing", "{}");
    expectRefused({"run", "-"}, "swept: standard input: line 1", "");
}

TEST(CommandRun, AFileWinsOverABuiltinScene) {
    const ScratchDirectory scratch;
    // The name of a directory does not stand for a file.
    const auto result = runSwept({"run", "pyramid", "--steps", "0"});
    EXPECT_EQ(result.exitCode, 0) << result.err;
    const std::string file = scratch.write("pyramid", kBallScene);
    const auto fromFile = runSwept({"run", file, "--steps", "0"});
    EXPECT_EQ(fromFile.out.substr(0, 5), "ball:") << fromFile.out;
}

}  // namespace
}  // namespace swept
