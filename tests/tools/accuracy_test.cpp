#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>

#include <swept/samples/scene_reader.h>
#include <swept/tools/accuracy/accuracy_bench.h>

namespace swept::accuracy {
namespace {

Case caseNamed(const std::string& name) {
    for (Case& c : allCases()) {
        if (c.name == name) { return c; }
    }
    ADD_FAILURE() << "no case " << name;
    return {};
}

/// The frames of a run in which every body stands still where it begins.
Frames stillFrames(const Case& c) {
    Frames frames(static_cast<std::size_t>(c.steps) + 1);
    for (std::size_t i = 0; i < frames.size(); ++i) {
        frames[i].step = static_cast<std::int64_t>(i);
        frames[i].time = static_cast<double>(i) * c.scene.settings.dt;
        for (const BodyDescription& body : c.scene.bodies) {
            frames[i].bodies.push_back({body.position, body.angle, {}, 0, true});
        }
    }
    return frames;
}

double valueOf(const Case& c, const std::string& measure, const Frames& frames) {
    for (const Measure& m : c.measures) {
        if (m.name == measure) { return m.of(frames); }
    }
    ADD_FAILURE() << c.name << " does not measure " << measure;
    return 0;
}

TEST(Accuracy, CasesAreScenesOfTheirOwn) {
    std::set<std::string> names;
    for (const Case& c : allCases()) {
        EXPECT_TRUE(names.insert(c.name).second) << c.name << " is there twice";
        const auto error = validateScene(c.scene);
        EXPECT_FALSE(error) << c.name << ": " << error->text();
        EXPECT_FALSE(c.measures.empty()) << c.name;
        EXPECT_GT(c.steps, 0) << c.name;
    }
    EXPECT_EQ(tradeCases().size(), 7u);
}

TEST(Accuracy, WhatStandsStillIsPerfectWhereNothingShouldMove) {
    for (const Case& c : stackCases()) {
        const Frames frames = stillFrames(c);
        for (const Measure& m : c.measures) { EXPECT_EQ(m.of(frames), 0) << c.name << ", " << m.name; }
        EXPECT_EQ(c.verdict(frames), "") << c.name;
    }
}

TEST(Accuracy, LandingsTellReboundAndDepth) {
    const Case flat = caseNamed("tiles-flat");
    Frames frames = stillFrames(flat);
    frames[10].bodies[3].velocity.y = -8;
    for (std::size_t i = 1; i < frames[9].bodies.size(); ++i) { frames[9].bodies[i].velocity.y = -7; }
    EXPECT_EQ(valueOf(flat, "rebound", frames), 0);
    frames[20].bodies[3].velocity.y = 0.5;
    EXPECT_EQ(valueOf(flat, "rebound", frames), 0.5 / 8);
    const Case tilted = caseNamed("tiles-tilted");
    frames = stillFrames(tilted);
    EXPECT_EQ(valueOf(tilted, "depth", frames), 0);
    frames.back().bodies[1].position.y = 0.19;  // of half a side of 0.2 m
    frames.back().bodies[1].angle = 0;
    EXPECT_NEAR(valueOf(tilted, "depth", frames), 0.01, 1e-12);
}

TEST(Accuracy, StacksThatFallAreSaidToHaveCollapsed) {
    const Case c = caseNamed("stack-10");
    Frames frames = stillFrames(c);
    frames.back().bodies.back().position.y -= 1.1;
    EXPECT_EQ(c.verdict(frames), "collapsed");
    EXPECT_NEAR(valueOf(c, "sag of a box", frames), 0.11, 1e-12);
    frames = stillFrames(c);
    frames.back().bodies.back().position.x = 0.25;
    EXPECT_EQ(c.verdict(frames), "");
    EXPECT_EQ(valueOf(c, "drift", frames), 0.25);
    frames.back().bodies[3].velocity.x = 0.1;
    EXPECT_EQ(c.verdict(frames), "moving");
}

TEST(Accuracy, MeasuresKnowTheClosedForms) {
    Case c = caseNamed("projectile");
    Frames frames = stillFrames(c);
    EXPECT_NEAR(valueOf(c, "place", frames), std::hypot(14, 2), 1e-9);  // 7·2 and 11·2 − 5·2²
    c = caseNamed("drop-3.1");
    frames = stillFrames(c);
    const double height = 0.5 * 3.1 * 3.1 / 10;
    for (Frame& frame : frames) {  // the exact motion
        const double phase = std::remainder(frame.time, 0.62);
        frame.bodies[1].position.y = 0.1 + height - 5 * phase * phase;
        frame.bodies[1].velocity.y = -10 * phase;
    }
    EXPECT_LT(valueOf(c, "height", frames), 1e-12);
    EXPECT_LT(valueOf(c, "time of a bounce", frames), 1e-12);
}

TEST(Accuracy, RefinedRunsCoverTheSameTime) {
    const Case c = refined(caseNamed("stack-50"), 240, 8);
    EXPECT_EQ(c.steps, 2400);
    EXPECT_EQ(c.scene.settings.subSteps, 8);
    EXPECT_DOUBLE_EQ(c.scene.settings.dt, 1.0 / 240);
}

/// A contact keeps its arms for a step: what rolls from corner to corner is too slow, in proportion to the step.
TEST(Accuracy, RollingPolygonsComeNearTheClosedFormAsStepsShorten) {
    for (const char* const name : {"hexagon-0.1", "hexagon-0.5", "octagon-2"}) {
        for (const Contestant& contestant : allContestants()) {
            if (!contestant.name.starts_with("accurate")) { continue; }
            const double coarse = measure(refined(caseNamed(name), 60, 16), contestant).values.at(0).value;
            const double fine = measure(refined(caseNamed(name), 960, 16), contestant).values.at(0).value;
            EXPECT_LT(coarse, 0.15) << name << ", " << contestant.name;
            EXPECT_LT(fine, 0.01) << name << ", " << contestant.name;
            EXPECT_LT(fine, coarse / 6) << name << ", " << contestant.name;
        }
    }
}

TEST(Accuracy, OursIsNearTheClosedForms) {
    const std::vector<Contestant> contestants = allContestants();
    for (const char* const name : {"projectile", "spin-500", "ping-pong-300", "cradle"}) {
        for (const Contestant& contestant : contestants) {
            if (contestant.name.starts_with("accurate")) {
                const Row row = measure(caseNamed(name), contestant);
                EXPECT_EQ(row.verdict, "") << name;
                ASSERT_FALSE(row.values.empty()) << name;
                EXPECT_LT(row.values[0].value, 1e-4) << name << ", " << contestant.name;
            }
        }
    }
}

}  // namespace
}  // namespace swept::accuracy
