#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <sstream>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include <swept/samples/scene_builder.h>
#include <swept/samples/scene_reader.h>
#include <swept/tools/measures/measure_run.h>
#include <swept/tools/tune/ablation.h>

/// What a scene needs of the features of the engine, by taking them away.

namespace swept::tune {
namespace {

using measures::Measure;

/// A crate that slides on a floor and stops, a ball that bounces far off, an eye that sees nothing.
Subject slidingCrate() {
    SceneDescription scene = build::scene("sliding", {0, 0}, 10);
    build::addFixed(scene, "floor", {0, -0.5}, {build::box({50, 0.5})});
    build::addDynamic(scene, "crate", {0, 0.5}, {build::box({0.5, 0.5})}).velocity = {3, 0};
    ShapeDescription ball = build::withRestitution(build::circle(0.5), 0.5);
    build::addDynamic(scene, "ball", {20, 1}, {ball});
    ShapeDescription eye = build::circle(1);
    eye.sensor = true;
    build::addFixed(scene, "eye", {-20, 5}, {eye});
    return {scene, 64};
}

const Ablated& without(const Ablation& ablation, const std::string& feature) {
    for (const Ablated& one : ablation.single) {
        if (one.features.front() == feature) { return one; }
    }
    ADD_FAILURE() << "no feature " << feature;
    return ablation.lean;
}

TEST(TuneAblation, FeaturesAreGoneWhenTheyAreTakenAway) {
    for (const Feature& feature : allFeatures()) {
        SceneDescription scene = slidingCrate().scene;
        build::hinge(scene, "crate", "ball", {10, 1});
        scene.bodies[1].bullet = true;
        scene.bodies[2].angularVelocity = 3;  // which a body of fixed rotation may not have
        scene.bodies[0].shapes[0].rollingResistance = 0.1;
        scene.bodies[0].shapes[0].surfaceSpeed = 1;
        scene.bodies[0].shapes[0].frictionMixing = MixingRule::average;
        Config config = ownConfig(scene);
        EXPECT_TRUE(feature.isPresent(scene, config)) << feature.name;
        feature.remove(scene, config);
        const bool isSensors = std::string(feature.name) == "sensors";  // they stay as weights
        EXPECT_EQ(feature.isPresent(scene, config), isSensors) << feature.name;
        EXPECT_FALSE(validateScene(withConfig(scene, config))) << feature.name;
    }
}

/// What only a segment of a chain has counts, and is taken away.
TEST(TuneAblation, FeaturesOfSegmentsAreGoneWhenTheyAreTakenAway) {
    int ofSurfaces = 0;
    for (const Feature& feature : allFeatures()) {
        const std::string name = feature.name;
        SceneDescription scene = build::scene("slope", {0, 0}, 10);
        ShapeDescription ground = build::withFriction(build::chain({{9, 0}, {0, 0}, {-9, 0}}), 0);
        build::addFixed(scene, "ground", {0, 0}, {ground});
        Config config = ownConfig(scene);
        if (feature.isPresent(scene, config)) { continue; }
        auto& chain = std::get<ChainGeometry>(scene.bodies[0].shapes[0].geometry);
        chain.surfaces = {{}, {0.5, 0.5, 0.1, 1, MixingRule::average, std::nullopt}};
        if (!feature.isPresent(scene, config)) { continue; }
        ++ofSurfaces;
        feature.remove(scene, config);
        EXPECT_FALSE(feature.isPresent(scene, config)) << name;
        EXPECT_FALSE(validateScene(withConfig(scene, config))) << name;
    }
    EXPECT_EQ(ofSurfaces, 5) << "restitution, friction, surface speed, mixing rules, rolling resistance";
}

TEST(TuneAblation, TellsWhatTheOutcomeNeeds) {
    const Subject subject = slidingCrate();
    const measures::Reference reference = measures::makeReference(subject.scene, subject.ticks);
    const std::vector<Limit> limits{{Measure::penetration, 0.05, false}};
    const Ablation ablation = ablate(subject, limits, reference, 2, [](std::size_t, std::size_t) {});
    const Ablated& friction = without(ablation, "friction");
    EXPECT_TRUE(friction.isNeeded);
    // Without it the crate goes 3 m/s · 64/60 s; with it v²/(2·0.6·g) at most.
    EXPECT_NEAR(friction.change, 3.2 - 9 / (2 * 0.6 * 9.81), 0.05);
    EXPECT_TRUE(without(ablation, "restitution").isNeeded);
    EXPECT_FALSE(without(ablation, "sensors").isNeeded) << "nobody comes near";
    EXPECT_FALSE(without(ablation, "joints").isPresent);
    EXPECT_FALSE(without(ablation, "bullets").isPresent);
    EXPECT_FALSE(without(ablation, "relaxation").isNeeded);
    EXPECT_FALSE(ablation.lean.features.empty());
    EXPECT_LT(ablation.lean.row.work, ablation.whole.work);
    EXPECT_LE(strain(ablation.lean.row, limits, reference.uncertainty), 1);
    for (const char* const kept : {"friction", "restitution"}) {
        EXPECT_EQ(std::count(ablation.lean.features.begin(), ablation.lean.features.end(), kept), 0) << kept;
    }
}

TEST(TuneAblation, DecidesNothingWhereTheSceneMissesTheErrors) {
    Subject subject = slidingCrate();
    const measures::Reference reference = measures::makeReference(subject.scene, subject.ticks);
    const std::vector<Limit> limits{{Measure::penetration, 0, false}};
    const Ablation ablation = ablate(subject, limits, reference, 2, [](std::size_t, std::size_t) { FAIL(); });
    EXPECT_FALSE(ablation.isDecided);
    EXPECT_TRUE(ablation.single.empty());
    EXPECT_TRUE(ablation.lean.features.empty());
    EXPECT_GT(ablation.whole.errors[Measure::penetration], 0);
}

TEST(TuneAblation, SensorsThatTellSomethingAreNeeded) {
    Subject subject = slidingCrate();
    subject.scene.bodies[3].position = {1, 0.5};
    const measures::Reference reference = measures::makeReference(subject.scene, subject.ticks);
    const Ablation ablation =
        ablate(subject, {{Measure::penetration, 0.05, false}}, reference, 2, [](std::size_t, std::size_t) {});
    EXPECT_TRUE(without(ablation, "sensors").isNeeded);
    EXPECT_EQ(without(ablation, "sensors").change, 0);
}

/// A report of one feature.
std::string reportOf(const Ablated& one) {
    Ablation ablation;
    ablation.whole.cost = 1;
    ablation.single = {one};
    ablation.lean.isNeeded = false;
    std::ostringstream out;
    writeAblation(out, {}, ablation);
    writeAblationCsv(out, ablation);
    return out.str();
}

TEST(TuneAblation, WhatTheEngineRefusesIsNotCalledNeeded) {
    Ablated one;
    one.features = {"rotation"};
    one.row.verdict = "refused";
    one.refusal = "/bodies/1: spins";
    const std::string report = reportOf(one);
    EXPECT_NE(report.find("\nrotation could not be tried: /bodies/1: spins\n"), std::string::npos) << report;
    EXPECT_NE(report.find("\nrotation,could not be tried,"), std::string::npos) << report;
    EXPECT_NE(report.find(",refused: /bodies/1: spins,"), std::string::npos) << report;
    EXPECT_EQ(report.find("needed"), std::string::npos) << report;
}

TEST(TuneAblation, TellsChangesOfCostInWholePerCent) {
    const std::vector<std::pair<double, std::string>> cases{{0.904, " -10 %"}, {0.906, " -9 %"},  {1.004, " +0.4 %"},
                                                            {1.096, " +10 %"}, {2.25, " +125 %"}, {1, " 0 %"}};
    for (const auto& [cost, text] : cases) {
        Ablated one;
        one.features = {"sleep"};
        one.row.cost = cost;
        EXPECT_NE(reportOf(one).find(text), std::string::npos) << cost << '\n' << reportOf(one);
    }
}

}  // namespace
}  // namespace swept::tune
