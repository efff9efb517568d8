#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "refused_runs.h"
#include "run_program.h"
#include "small_scenes.h"

// What `swept run --from` leaves out.

namespace swept {
namespace {

using Words = std::vector<std::string>;

class CommandFrom : public RefusedRuns {
protected:
    /// Standard output of a run of 96 steps, 1.5 s, in which the ball bounces once, and of which one output is piped.
    std::string run(Words options) {
        options.insert(options.begin(), {"run", scene_, "--steps", "96"});
        const ProgramResult result = runSwept(options);
        EXPECT_EQ(result.exitCode, 0) << result.err;
        return result.out;
    }
    nlohmann::json report(const Words& options) {
        Words all{"--report", "-"};
        all.insert(all.end(), options.begin(), options.end());
        return nlohmann::json::parse(run(all));
    }
};

/// The lines whose number before the first comma, colon after `"step"` left out, is at least so large.
std::string linesFrom(const std::string& text, int least) {
    std::istringstream lines(text);
    std::string kept;
    for (std::string line; std::getline(lines, line);) {
        const std::size_t digit = line.find_first_of("0123456789");
        if (digit == std::string::npos || std::stoi(line.substr(digit)) >= least) { kept += line + '\n'; }
    }
    return kept;
}

TEST_F(CommandFrom, StatesAndEventsBeginThere) {
    const std::string states = run({"--csv", "-"});
    EXPECT_EQ(run({"--csv", "-", "--from", "0"}), states);
    EXPECT_EQ(run({"--csv", "-", "--from", "0.75"}), linesFrom(states, 48));
    EXPECT_EQ(run({"--csv", "-", "--from", "0.757"}), linesFrom(states, 48)) << "rounded to a step";
    EXPECT_EQ(run({"--csv", "-", "--from", "1.5"}), linesFrom(states, 96)) << "the last state alone";
    EXPECT_EQ(run({"--csv", "-", "--from", "1.4375", "--csv-every", "2"}),
              linesFrom(run({"--csv", "-", "--csv-every", "2"}), 92));
    EXPECT_NE(run({"--csv", "-", "--from", "1.453125", "--csv-every", "2"}).find("\n93,"), std::string::npos)
        << "counted from there";
    const std::string events = run({"--events", "-"});
    const int hit = nlohmann::json::parse(events.substr(0, events.find('\n'))).at("step");
    ASSERT_GT(hit, 60);
    const auto timeOf = [](int step) { return std::to_string(step * 0.015625); };
    EXPECT_EQ(run({"--events", "-", "--from", timeOf(hit - 1)}), events) << "what happens after that state";
    EXPECT_EQ(run({"--events", "-", "--from", timeOf(hit)}), linesFrom(events, hit + 1));
}

TEST_F(CommandFrom, TotalsBeginThere) {
    const nlohmann::json whole = report({});
    const nlohmann::json late = report({"--from", "1.25"});
    EXPECT_FALSE(whole.contains("from"));
    EXPECT_EQ(late.at("from"), 1.25);
    EXPECT_EQ(late.at("steps"), 96) << "how far it ran";
    EXPECT_EQ(late.at("stateHash"), whole.at("stateHash"));
    EXPECT_EQ(whole.at("counters").at("awakeBodies"), 96);
    EXPECT_EQ(late.at("counters").at("awakeBodies"), 16);
    EXPECT_EQ(whole.at("counters").at("impacts"), 1);
    EXPECT_EQ(late.at("counters").at("impacts"), 0);
    EXPECT_EQ(late.at("energy").at("end"), whole.at("energy").at("end"));
    EXPECT_LT(late.at("energy").at("start"), 0.9 * whole.at("energy").at("start").get<double>()) << "after the bounce";
    EXPECT_NE(runSwept({"run", scene_, "--from", "1.25"}).out.find("\nfrom 1.25 s on:\ndeepest penetration"),
              std::string::npos);
}

/// A box that begins in the floor is out of it after a while.
TEST_F(CommandFrom, WhatWasWorseBeforeIsNotTold) {
    scene_ = in_.write("deep.json", R"({"settings": {"dt": 0.015625}, "bodies": [
      {"name": "floor", "shapes": [{"box": {"half": [5, 1]}}]},
      {"name": "box", "type": "dynamic", "position": [0, 1.75], "shapes": [{"box": {"half": [1, 1]}}]}]})");
    EXPECT_NEAR(report({}).at("deepestPenetration").get<double>(), 0.25, 1e-6);
    const nlohmann::json late = report({"--from", "1.25"});
    EXPECT_LT(late.at("deepestPenetration"), 0.01);
    if (late.contains("deepestPenetrationAt")) { EXPECT_GE(late["deepestPenetrationAt"].at("time"), 1.25); }
}

/// What it is deepest in when it begins counts, too: nothing moves then.
TEST_F(CommandFrom, WhatIsThereAlreadyIsTold) {
    scene_ = in_.write("deep.json", R"({"gravity": [0, 0], "settings": {"dt": 0.015625}, "bodies": [
      {"name": "lift", "type": "kinematic", "shapes": [{"box": {"half": [5, 1]}}]},
      {"name": "box", "type": "dynamic", "fixedRotation": true, "awake": false, "position": [0, 1.75],
       "shapes": [{"box": {"half": [1, 1]}}]}]})");
    EXPECT_NEAR(report({"--from", "1.25"}).at("deepestPenetration").get<double>(), 0.25, 1e-6);
}

std::size_t picturesIn(const std::string& directory) {
    std::size_t count = 0;
    for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator(directory)) { ++count; }
    return count;
}

TEST_F(CommandFrom, PicturesBeginThere) {
    const auto draw = [&](const std::string& name, Words options) {
        options.insert(options.end(),
                       {"--size", "64x48", "--png", out_.path(name), "--webp", out_.path(name + ".webp")});
        (void)run(options);
    };
    draw("whole", {"--every", "8", "--sheet", "3"});
    draw("late", {"--every", "8", "--sheet", "3", "--from", "1.125"});
    EXPECT_EQ(picturesIn(out_.path("late")), 1u + 4u) << "steps 72, 80, 88, 96, and the sheet";
    for (const char* const picture : {"/frame_000072.png", "/frame_000096.png"}) {
        EXPECT_EQ(out_.read("late" + std::string(picture)), out_.read("whole" + std::string(picture)));
    }
    EXPECT_NE(out_.read("late/sheet.png"), out_.read("whole/sheet.png"));
    EXPECT_LT(out_.read("late.webp").size(), out_.read("whole.webp").size());
    draw("trail", {"--every", "96", "--trails", "--from", "1.5"});
    draw("plain", {"--every", "96", "--from", "1.5"});
    EXPECT_EQ(out_.read("trail/frame_000096.png"), out_.read("plain/frame_000096.png")) << "it begins there, too";
    draw("odd", {"--every", "8", "--from", "1.453125"});
    EXPECT_TRUE(out_.has("odd/frame_000093.png")) << "counted from there";
    EXPECT_EQ(picturesIn(out_.path("odd")), 1u);
}

/// The weld breaks in the first steps; from then on it must not be drawn.
TEST_F(CommandFrom, PicturesKnowWhatBrokeBefore) {
    const std::string bodies = R"({"view": {"center": [0, 0], "height": 2}, "bodies": [
      {"name": "hook", "position": [0, 9], "shapes": [{"circle": {"radius": 0.1}}]},
      {"name": "ball", "type": "dynamic", "position": [0, -9], "shapes": [{"circle": {"radius": 0.1}}]}], "joints": [)";
    const std::string rope = R"({"type": "distance", "bodyA": "hook", "bodyB": "ball", "anchorA": [0, 9],
      "anchorB": [0, -9], "breakForce": 1e-3})";
    const auto pictureOf = [&](const std::string& name, const std::string& joints) {
        scene_ = in_.write(name + ".json", bodies + joints + "]}");
        (void)run({"--from", "1.6", "--every", "96", "--size", "90x90", "--png", out_.path(name)});
        return out_.read(name + "/frame_000096.png");
    };
    EXPECT_EQ(pictureOf("broken", rope), pictureOf("none", ""));
}

TEST_F(CommandFrom, TimesThatMakeNoSense) {
    const auto expectFromRefused = [&](const std::string& from, const std::string& reason) {
        expectNothingWritten({"run", scene_, "--duration", "2", "--csv", out_.path("a.csv"), "--from=" + from}, reason);
    };
    expectFromRefused("-1", "swept: --from: must be a finite number of seconds, at least 0");
    expectFromRefused("nan", "swept: --from: must be a finite number of seconds, at least 0");
    expectFromRefused("inf", "swept: --from: must be a finite number of seconds, at least 0");
    expectFromRefused("1e300", "the run ends at 2 s (--duration)");
    expectFromRefused("2.5", "swept: --from 2.5: the run ends at 2 s (--duration)");
    expectFromRefused("1s", "swept: --from: 1s is not a number");
    expectNothingWritten({"run", scene_, "--from", "11", "--csv", out_.path("a.csv")}, "the run ends at 10 s");
}

}  // namespace
}  // namespace swept
