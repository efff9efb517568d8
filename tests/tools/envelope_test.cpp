#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <sstream>

#include <swept/samples/scene_reader.h>
#include <swept/tools/envelope/map.h>
#include <swept/tools/inspect/envelope.h>

namespace swept::envelope {
namespace {

/// The state in which a scene begins.
Frame startOf(const SceneDescription& scene) {
    Frame frame;
    for (const BodyDescription& body : scene.bodies) {
        frame.bodies.push_back({body.position, body.angle, body.velocity, body.angularVelocity, true});
    }
    return frame;
}

double gravityNumberOf(const SceneDescription& scene, double size) {
    return -scene.gravity.y * scene.settings.dt * scene.settings.dt / size;
}

TEST(Envelope, CellsAreScenesThatBeginWithoutAnError) {
    for (const Slice& slice : allSlices(Grain::full)) {
        const std::vector<double>& xs = slice.x.values;
        EXPECT_TRUE(std::is_sorted(xs.begin(), xs.end())) << slice.name;
        for (const double x : {xs.front(), xs[xs.size() / 2], xs.back()}) {
            for (const double y : slice.y.values) {
                for (const Trial& trial : slice.trials(x, y)) {
                    const auto error = validateScene(trial.scene);
                    EXPECT_FALSE(error) << slice.name << ' ' << x << ' ' << y << ": " << error->text();
                    EXPECT_GT(trial.steps, 0);
                    // Far out the start itself is rounded; a wall of kilometres is not where a millimetre is.
                    EXPECT_LE(trial.error(startOf(trial.scene)), 1e-9) << slice.name << ' ' << x << ' ' << y;
                    EXPECT_FALSE(trial.hasArrived && x > 1 && trial.hasArrived(startOf(trial.scene)));
                }
            }
        }
    }
}

TEST(Envelope, CoarseCellsAreCellsOfTheFullMap) {
    const std::vector<Slice> full = allSlices(Grain::full);
    const std::vector<Slice> coarse = allSlices(Grain::coarse);
    ASSERT_EQ(full.size(), coarse.size());
    const auto holds = [](const Axis& all, const Axis& some) {
        return std::all_of(some.values.begin(), some.values.end(), [&](double value) {
            return std::find(all.values.begin(), all.values.end(), value) != all.values.end();
        });
    };
    for (std::size_t i = 0; i < full.size(); ++i) {
        EXPECT_TRUE(holds(full[i].x, coarse[i].x) && holds(full[i].y, coarse[i].y)) << full[i].name;
    }
}

TEST(Envelope, ScenesHaveTheNumbersOfTheirCells) {
    const SceneDescription stack = stackSlice(Grain::full).trials(0.25, 1000).front().scene;
    EXPECT_NEAR(gravityNumberOf(stack, 1), 0.25, 1e-12);
    EXPECT_EQ(stack.bodies.size(), 7u);
    EXPECT_EQ(stack.bodies.back().shapes[0].density, 1000 * stack.bodies[1].shapes[0].density);

    const SceneDescription chain = chainSlice(Grain::full).trials(100, 16).front().scene;
    EXPECT_EQ(chain.joints.size(), 17u);
    EXPECT_EQ(*chain.bodies.back().mass, 100 * *chain.bodies[1].mass);

    for (const Trial& trial : bulletSlice(Grain::full).trials(64, 10)) {
        const BoxGeometry wall = std::get<BoxGeometry>(trial.scene.bodies[0].shapes[0].geometry);
        const BoxGeometry bullet = std::get<BoxGeometry>(trial.scene.bodies[1].shapes[0].geometry);
        EXPECT_EQ(trial.scene.bodies[1].velocity.x * trial.scene.settings.dt / (2 * bullet.half.x), 64);
        EXPECT_EQ(bullet.half.y, 10 * bullet.half.x);
        EXPECT_EQ(wall.half.x, bullet.half.x);
        EXPECT_GT(wall.half.y, 4 * bullet.half.y);
    }

    const SceneDescription rest = restSlice(Grain::full).trials(std::ldexp(1.0, -22), 0.5).front().scene;
    EXPECT_EQ(rest.bodies[1].position.x, std::ldexp(1.0, 30));
    EXPECT_NEAR(gravityNumberOf(rest, 1), 0.5, 1e-12);
}

TEST(Envelope, ErrorsAreThoseOfPosesThatAreKnown) {
    const Trial stack = stackSlice(Grain::full).trials(0.25, 1).front();
    Frame frame = startOf(stack.scene);
    frame.bodies[3].position.x += 0.3;
    frame.bodies[3].position.y -= 0.4;
    EXPECT_NEAR(stack.error(frame), 0.5, 1e-12);

    const Trial chain = chainSlice(Grain::full).trials(1, 4).front();
    frame = startOf(chain.scene);
    for (std::size_t i = 3; i < frame.bodies.size(); ++i) {  // the second joint comes apart by a quarter of a link
        frame.bodies[i].position.x += 0.125;
    }
    EXPECT_NEAR(chain.error(frame), 0.25, 1e-12);

    const Trial bullet = bulletSlice(Grain::full).trials(16, 1).front();
    frame = startOf(bullet.scene);
    frame.bodies[1].position.x = frame.bodies[0].position.x;  // as deep as the wall is thick
    EXPECT_NEAR(bullet.error(frame), 1, 1e-12);
    EXPECT_TRUE(bullet.hasArrived(frame));

    const Trial rest = restSlice(Grain::full).trials(std::ldexp(1.0, -52), 0.5).front();
    frame = startOf(rest.scene);
    frame.step = rest.steps;
    EXPECT_NEAR(rest.error(frame), 0.25, 1e-12) << "it begins a quarter above its place";
}

TEST(Envelope, WhatIsNotSweptLeavesTheMap) {
    Slice slice = bulletSlice(Grain::coarse);
    const Row swept = runCell(slice, 16, 1, tune::Engine::f32);
    EXPECT_TRUE(swept.isInside(slice)) << swept.value << swept.verdict;
    slice.trials = [trials = slice.trials](double x, double y) {
        std::vector<Trial> blind = trials(x, y);
        for (Trial& trial : blind) {
            trial.scene.settings.continuous = SceneContinuous::off;
            trial.scene.bodies[1].bullet = false;
        }
        return blind;
    };
    const Row blind = runCell(slice, 16, 1, tune::Engine::f32);
    EXPECT_GT(blind.value, 1) << "through the wall";
    EXPECT_FALSE(blind.isInside(slice));
}

// With 16 sub-steps, light links that whip round past the load tore these chains apart by many links.
TEST(Envelope, TwentyLinksSwingAThousandTimesTheirMass) {
    const Slice slice = chainSlice(Grain::coarse);
    for (const tune::Engine engine : {tune::Engine::f32, tune::Engine::f64}) {
        const Row row = runCell(slice, 1000, 20, engine);
        EXPECT_TRUE(row.isInside(slice)) << tune::nameOf(engine) << ' ' << row.value << row.verdict;
    }
}

TEST(Envelope, RowsAreReadAsTheyWereWritten) {
    const Slice slice = stackSlice(Grain::coarse);
    const Row good{std::sqrt(0.1), 10, tune::Engine::f64, slice.bound, ""};
    const Row bad{1, 10, tune::Engine::box2d, std::numeric_limits<double>::infinity(), "not finite"};
    EXPECT_EQ(csvLine(slice, bad), "1,10,Box2D 2.4.1,inf,0.1,no,not finite\n");
    const std::string text = csvHeader(slice) + csvLine(slice, good) + csvLine(slice, bad);
    Rows rows;
    std::string error;
    ASSERT_TRUE(rows.parse(slice, text + "1,100,f32,0.0", "stack.csv", error)) << error;
    ASSERT_EQ(rows.size(), 2u) << "without the line that was cut off";
    const Row* const found = rows.find(good.x, good.y, good.engine);
    ASSERT_NE(found, nullptr);
    EXPECT_EQ(found->value, good.value);
    EXPECT_TRUE(found->isInside(slice)) << "the bound is inside";
    EXPECT_EQ(rows.find(1, 10, tune::Engine::box2d)->verdict, "not finite");
    EXPECT_FALSE(rows.find(1, 10, tune::Engine::box2d)->isInside(slice));

    EXPECT_TRUE(rows.parse(slice, csvHeader(slice).substr(0, 20), "stack.csv", error)) << "stopped within its header";
    EXPECT_FALSE(rows.parse(restSlice(Grain::coarse), text, "stack.csv", error));
    EXPECT_NE(error.find("stack.csv"), std::string::npos) << error;
    for (const char* const line : {"1,10,f32,zero,0.1,yes,\n", "1,10,f16,0,0.1,yes,\n", "1,10\n", "\n"}) {
        EXPECT_FALSE(rows.parse(slice, csvHeader(slice) + line, "stack.csv", error)) << line;
        EXPECT_NE(error.find("stack.csv:3"), std::string::npos) << error;
    }
}

TEST(Envelope, LimitsEndBeforeTheFirstHole) {
    Slice slice = stackSlice(Grain::coarse);
    slice.x.values = {1, 2, 3, 4};
    slice.y.values = {10, 100};
    Rows rows;
    for (const double x : slice.x.values) { rows.add({x, 10, tune::Engine::f32, x == 3 ? 2 * slice.bound : 0, ""}); }
    rows.add({2, 100, tune::Engine::f32, 0, ""});
    EXPECT_EQ(limitOf(slice, rows, 10, tune::Engine::f32), 2);
    EXPECT_EQ(limitOf(slice, rows, 100, tune::Engine::f32), std::nullopt);
    EXPECT_EQ(limitLines(slice, rows, {tune::Engine::f32}), "stack,f32,10,##.#\nstack,f32,100,?#??\n");
    std::ostringstream summary;
    writeSummary(summary, slice, rows, {tune::Engine::f32});
    // √(9.81/(0.01·2)) = 22.1, and up
    EXPECT_NE(summary.str().find("of 1 cm 23 Hz"), std::string::npos) << summary.str();
    EXPECT_NE(summary.str().find("nowhere on this map"), std::string::npos) << summary.str();
}

TEST(Envelope, CountsInWords) {
    const auto told = [](const Slice& slice, double y) { return slice.told(1, y); };
    EXPECT_EQ(told(chainSlice(Grain::coarse), 1).substr(0, 23), "a chain of 1 link of 1 ");
    EXPECT_EQ(told(chainSlice(Grain::coarse), 4).substr(0, 24), "a chain of 4 links of 1 ");
    EXPECT_EQ(told(wallSlice(Grain::coarse), 1).substr(0, 16), "with 1 sub-step ");
    EXPECT_EQ(told(wallSlice(Grain::coarse), 4).substr(0, 17), "with 4 sub-steps ");
}

/// The lines of the committed coarse map of a slice, by engine and y: a '#' for each x that is inside.
std::vector<std::string> committedLines(const std::string& slice) {
    std::ifstream file(SWEPT_ENVELOPE_LIMITS);
    std::vector<std::string> lines;
    for (std::string line; std::getline(file, line);) {
        if (line.starts_with(slice + ',')) { lines.push_back(line.substr(line.rfind(',') + 1)); }
    }
    return lines;
}

/// @return whether every cell of the map up to that x is inside
bool isInsideUpTo(const Slice& slice, double x) {
    const std::vector<std::string> lines = committedLines(slice.name);
    EXPECT_EQ(lines.size(), 2 * slice.y.values.size()) << slice.name << ": f32 and f64";
    for (const std::string& line : lines) {
        for (std::size_t i = 0; i < slice.x.values.size() && slice.x.values[i] <= x; ++i) {
            if (line.at(i) != '#') { return false; }
        }
    }
    return true;
}

/// What the scene doctor calls safe lies inside the maps that are committed and held by envelope_limits_test.
TEST(Envelope, LimitsOfTheDoctorLieInsideTheMaps) {
    const Slice chains = chainSlice(Grain::coarse);
    EXPECT_GE(chains.x.values.back(), kDirectMassRatio) << "loads are tried up to there";
    EXPECT_TRUE(isInsideUpTo(chains, chains.x.values.back())) << "since trees of joints bear any load";
    const Slice stacks = stackSlice(Grain::coarse);
    EXPECT_TRUE(isInsideUpTo(stacks, 1 / (kStepsPerNaturalTime * kStepsPerNaturalTime)));
    EXPECT_GE(stacks.y.values.back(), kDirectMassRatio) << "so are heavy tops";
    const Slice bullets = bulletSlice(Grain::coarse);
    EXPECT_TRUE(isInsideUpTo(bullets, bullets.x.values.back()));
    EXPECT_GE(bullets.y.values.back(), kAspectRatio) << "slender bodies are tried up to there";
}

}  // namespace
}  // namespace swept::envelope
