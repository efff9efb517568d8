#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <set>

#include <swept/samples/scene_builder.h>
#include <swept/tools/measures/closed_forms.h>
#include <swept/tools/measures/hits.h>
#include <swept/tools/measures/measure_run.h>
#include <swept/tools/measures/reference.h>

namespace swept::measures {
namespace {

using build::addDynamic;
using build::addFixed;
using build::box;
using build::circle;

SceneDescription emptyScene(DVec2 gravity = {0, -10}) {
    SceneDescription scene = build::scene("test", {0, 0}, 10);
    scene.gravity = gravity;
    scene.settings.dt = 1.0 / 64;
    scene.settings.sleep = false;
    return scene;
}

/// Every body where the scene puts it, `count` times.
Recording stillRecording(const SceneDescription& scene, std::int64_t count) {
    Recording recording;
    recording.tickTime = scene.settings.dt;
    for (std::int64_t tick = 0; tick < count; ++tick) {
        Sample sample{tick, static_cast<double>(tick) * scene.settings.dt, {}, 0, {}};
        for (const BodyDescription& body : scene.bodies) {
            sample.bodies.push_back({body.position, body.angle, body.velocity, body.angularVelocity, true});
        }
        recording.samples.push_back(sample);
    }
    return recording;
}

Recording runOf(const SceneDescription& scene, std::int64_t ticks, Precision precision = Precision::f64) {
    RunnerOptions options;
    options.precision = precision;
    options.measure = true;
    std::string error;
    const auto runner = makeRunner(scene, options, error);
    EXPECT_TRUE(runner) << error;
    return record(*runner, {scene.settings.dt, ticks, 1, 1});
}

TEST(Measures, HaveNamesOfTheirOwn) {
    std::set<std::string> names;
    for (std::size_t i = 0; i < kMeasureCount; ++i) {
        const MeasureInfo& info = allMeasures()[i];
        EXPECT_TRUE(names.insert(info.name).second) << info.name;
        EXPECT_EQ(measureNamed(info.name), static_cast<Measure>(i));
    }
    EXPECT_EQ(measureNamed("penetratoin"), std::nullopt);
    EXPECT_NE(suggestionFor("penetratoin").find("\"penetration\""), std::string::npos);
}

TEST(Measures, PenetrationIsTheDepthOfTheOverlap) {
    SceneDescription scene = emptyScene();
    addFixed(scene, "floor", {0, -1}, {box({5, 1})});
    addDynamic(scene, "ball", {0, 0.5}, {circle(0.5)});
    addDynamic(scene, "crate", {2, 0.5}, {box({0.5, 0.5})});
    Recording recording = stillRecording(scene, 4);
    recording.samples[1].bodies[1].position.y -= 0.125;
    recording.samples[2].bodies[2].position.y -= 0.25;
    const Values values = measuredAlone(scene, recording);
    EXPECT_NEAR(values[Measure::penetration], 0.25, 1e-15);
    EXPECT_NEAR(values[Measure::meanPenetration], 0.375 / 4, 1e-15);
    EXPECT_TRUE(std::isnan(values[Measure::jointError])) << "there is no joint";
    // What may not collide does not overlap.
    scene.bodies[1].shapes[0].filter.mask = 0;
    scene.bodies[2].shapes[0].sensor = true;
    EXPECT_EQ(measuredAlone(scene, recording)[Measure::penetration], 0);
}

TEST(Measures, EnergyIsJudgedWhereItHasToStay) {
    SceneDescription scene = emptyScene();
    addFixed(scene, "floor", {0, -1}, {box({5, 1})});
    addDynamic(scene, "ball", {0, 4}, {build::circle(0.5)}).mass = 2;
    Recording recording = stillRecording(scene, 5);
    const std::array<double, 5> energies{80, 60, 65, 50, 70};  // J; 100 J above the centre of the floor
    for (std::size_t i = 0; i < 5; ++i) { recording.samples[i].energy = energies[i]; }
    Values values = measuredAlone(scene, recording);
    EXPECT_NEAR(values[Measure::energyGain], 0.2, 1e-12);
    EXPECT_TRUE(std::isnan(values[Measure::energyDrift])) << "it rubs";
    EXPECT_TRUE(std::isnan(values[Measure::momentumDrift])) << "there is a floor";
    scene.bodies[1].shapes[0].restitution = 1;
    scene.bodies[1].shapes[0].friction = 0;
    EXPECT_NEAR(measuredAlone(scene, recording)[Measure::energyDrift], 0.3, 1e-12);
    scene.bodies[0].shapes[0].restitutionMixing = MixingRule::minimum;
    EXPECT_TRUE(std::isnan(measuredAlone(scene, recording)[Measure::energyDrift])) << "the floor bounces nothing";
    scene.bodies[0].shapes[0].restitutionMixing = MixingRule::usual;
    scene.bodies[1].shapes[0].rollingResistance = 0.1;
    EXPECT_TRUE(std::isnan(measuredAlone(scene, recording)[Measure::energyDrift])) << "it may roll";
    scene.bodies[0].type = SceneBodyType::kinematic;
    EXPECT_TRUE(std::isnan(measuredAlone(scene, recording)[Measure::energyGain])) << "something pushes";
}

TEST(Measures, MomentumIsWhatGravityMakesOfIt) {
    SceneDescription scene = emptyScene({0, -8});
    addDynamic(scene, "a", {0, 0}, {circle(0.5)}).mass = 3;
    scene.bodies[0].velocity = {4, 0};
    Recording recording = stillRecording(scene, 65);  // 1 s: m v = 12, m g t = 24
    for (Sample& sample : recording.samples) { sample.momentum = {12, -24 * sample.time}; }
    EXPECT_NEAR(measuredAlone(scene, recording)[Measure::momentumDrift], 0, 1e-15);
    recording.samples[30].momentum.x += 3.6;
    EXPECT_NEAR(measuredAlone(scene, recording)[Measure::momentumDrift], 0.1, 1e-12);
}

/// A ball of 32 m/s without gravity, 0.5 m in front of a wall of 2 cm; it gets there in the first step, of 0.5 m.
SceneDescription shot() {
    SceneDescription scene = emptyScene({0, 0});
    addFixed(scene, "wall", {0.01, 0}, {box({0.01, 2})});
    addDynamic(scene, "ball", {-0.375, 0}, {circle(0.125)}).velocity = {32, 0};
    return scene;
}

TEST(Measures, HitsAreMissedLateOrInTime) {
    const SceneDescription scene = shot();
    Recording through = stillRecording(scene, 3);
    Recording stopped = through;
    Recording bounced = through;
    for (std::size_t i = 1; i < 3; ++i) {
        through.samples[i].bodies[1].position.x += 0.5 * static_cast<double>(i);
        stopped.samples[i].bodies[1].position.x = -0.125;
        bounced.samples[i].bodies[1].position.x = -0.375;
        bounced.samples[i].bodies[1].velocity.x = -32;
    }
    stopped.samples[2].bodies[1].velocity.x = 0;
    std::vector<ForeseenHit> hits = foreseenHits(scene, through);
    ASSERT_EQ(hits.size(), 1U);
    EXPECT_NEAR(hits[0].time, 0.25 / 32, 1e-4 / 32);  // the target of the certificate: 2⁻¹⁰ of 2 cm
    EXPECT_TRUE(hits[0].missed);
    EXPECT_EQ(measuredAlone(scene, through)[Measure::missedHits], 1);
    hits = foreseenHits(scene, stopped);
    ASSERT_EQ(hits.size(), 1U);
    EXPECT_FALSE(hits[0].missed);
    EXPECT_TRUE(hits[0].late);
    EXPECT_NEAR(measuredAlone(scene, stopped)[Measure::lateHits], 1.0 / 128, 1e-5);
    hits = foreseenHits(scene, bounced);
    ASSERT_EQ(hits.size(), 1U);
    EXPECT_FALSE(hits[0].missed || hits[0].late);
}

TEST(Measures, TheEngineMissesHitsInModeOffOnly) {
    SceneDescription scene = shot();
    const auto missed = [&](SceneContinuous mode) {
        scene.settings.continuous = mode;
        return measuredAlone(scene, runOf(scene, 8))[Measure::missedHits];
    };
    EXPECT_EQ(missed(SceneContinuous::off), 1);
    EXPECT_EQ(missed(SceneContinuous::stop), 0);
    EXPECT_EQ(missed(SceneContinuous::subStep), 0);
    scene.settings.continuous = SceneContinuous::stop;
    const Values stop = measuredAlone(scene, runOf(scene, 8));
    EXPECT_EQ(stop[Measure::lateHits], 0) << "it responds at its impact";
    EXPECT_NEAR(stop[Measure::lostTime], 1.0 / 128, 1e-4) << "and loses the rest of the step";
}

TEST(Measures, RestAndSwayAreJudgedByWhatStaysInTheReference) {
    SceneDescription scene = emptyScene();
    addFixed(scene, "floor", {0, -1}, {box({50, 1})});
    addDynamic(scene, "resting", {0, 0.5}, {box({0.5, 0.5})});
    addDynamic(scene, "driving", {8, 0.5}, {box({0.5, 0.5})}).velocity = {1, 0};
    Recording truth = stillRecording(scene, 101);
    for (Sample& sample : truth.samples) { sample.bodies[2].position.x += sample.time; }
    Recording mine = truth;
    mine.samples[20].bodies[1].position.x += 0.03;  // sways, and comes back
    mine.samples[100].bodies[1].position.y -= 0.01;
    mine.samples[100].bodies[2].position.y += 7;  // no rest there
    const Values values = measuredAgainst(scene, mine, truth);
    EXPECT_NEAR(values[Measure::stackSway], 0.03, 1e-12);
    EXPECT_NEAR(values[Measure::restingDrift], 0.01, 1e-12);
    EXPECT_NEAR(values[Measure::position], 7, 1e-12);
}

TEST(Measures, TimesOfEventsAreComparedBodyByBody) {
    SceneDescription scene = shot();
    const Recording soon = runOf(scene, 8);
    scene.bodies[1].velocity.x = 16;
    const Recording late = runOf(scene, 8);
    EXPECT_NEAR(measuredAgainst(scene, soon, late)[Measure::eventTime], 0.25 / 16 - 0.25 / 32, 1e-5);
    scene.bodies[1].velocity.x = 0;
    const Recording never = runOf(scene, 8);
    EXPECT_NEAR(measuredAgainst(scene, soon, never)[Measure::eventTime], 8.0 / 64 - 0.25 / 32, 1e-5);
}

TEST(ClosedForms, FreeFlightFallsAsItShould) {
    SceneDescription scene = emptyScene();
    addDynamic(scene, "ball", {1, 2}, {circle(0.5)}).velocity = {7, 11};
    addDynamic(scene, "leaf", {100, 0}, {circle(0.5)}).linearDamping = 2;
    for (BodyDescription& body : scene.bodies) { body.shapes[0].filter.mask = 0; }
    const auto form = closedFormOf(scene, 2);
    ASSERT_TRUE(form);
    EXPECT_NEAR(form->position(0, 2).x, 15, 1e-12);
    EXPECT_NEAR(form->position(0, 2).y, 2 + 22 - 20, 1e-12);
    // v′ = −10 − 2v from rest: v → −5, and y(2) = −5·2 + 2.5·(1 − e⁻⁴).
    EXPECT_NEAR(form->position(1, 2).y, -10 + 2.5 * (1 - std::exp(-4.0)), 1e-12);
    const Reference reference = makeReference(scene, 128);
    EXPECT_TRUE(reference.isClosedForm);
    EXPECT_LT(measured(scene, runOf(scene, 128), reference)[Measure::position], 1e-12);
}

TEST(ClosedForms, ABallBouncesToTheSquareOfItsRestitution) {
    SceneDescription scene = emptyScene({0, -8});
    addFixed(scene, "floor", {0, -0.5}, {box({10, 0.5})});
    addDynamic(scene, "ball", {0, 4.5}, {circle(0.5)}).shapes[0].restitution = 0.5;
    const auto form = closedFormOf(scene, 4);  // falls 4 m in 1 s, then rises for half a second, to 1 m
    ASSERT_TRUE(form);
    EXPECT_NEAR(form->position(1, 1).y, 0.5, 1e-12);
    EXPECT_NEAR(form->position(1, 1.5).y, 1.5, 1e-12);
    EXPECT_NEAR(form->position(1, 2.25).y, 0.75, 1e-12);
    EXPECT_LT(measured(scene, runOf(scene, 120), makeReference(scene, 120))[Measure::position], 0.004);
    scene.bodies[0].shapes[0].restitution = 0.5;
    scene.bodies[1].shapes[0].restitution = 1;
    scene.bodies[0].shapes[0].restitutionMixing = MixingRule::product;  // 0.5 again
    EXPECT_NEAR(closedFormOf(scene, 4)->position(1, 1.5).y, 1.5, 1e-12);
    EXPECT_LT(measured(scene, runOf(scene, 120), makeReference(scene, 120))[Measure::position], 0.004);
    scene.bodies[1].velocity.x = 1;  // then it would roll
    EXPECT_FALSE(closedFormOf(scene, 4));
}

TEST(ClosedForms, APendulumSwingsWithItsPeriod) {
    SceneDescription scene = emptyScene();
    addFixed(scene, "pivot", {0, 0}, {circle(0.02)}).shapes[0].filter.mask = 0;
    addDynamic(scene, "bob", {1, 0}, {circle(0.1)});
    build::hinge(scene, "pivot", "bob", {0, 0});
    // From level: period 4·K(sin 45°)·√(I/(m g)), I/m = 1 + 0.1²/2, K by the arithmetic-geometric mean.
    double a = 1;
    double b = std::sqrt(0.5);
    while (a - b > 1e-15) {
        const double mean = 0.5 * (a + b);
        b = std::sqrt(a * b);
        a = mean;
    }
    const double period = 4 * std::numbers::pi / (2 * a) * std::sqrt(1.005 / 10);
    const auto form = closedFormOf(scene, 3);
    ASSERT_TRUE(form);
    EXPECT_NEAR(form->position(1, period).x, 1, 1e-8);
    EXPECT_NEAR(form->position(1, period / 2).x, -1, 1e-8);
    EXPECT_NEAR(form->position(1, period / 4).y, -1, 1e-8);
    const double error = measured(scene, runOf(scene, 128), makeReference(scene, 128))[Measure::position];
    EXPECT_LT(error, 1e-6);
    EXPECT_GT(error, 1e-12) << "a step of 1/64 s cannot be exact, of whatever order it is";
}

TEST(References, SettleWhereTheMotionIsRegular) {
    SceneDescription scene = emptyScene();
    addFixed(scene, "floor", {0, -0.5}, {box({10, 0.5})});
    addDynamic(scene, "crate", {0, 0.5}, {box({0.5, 0.5})}).velocity = {3, 0};
    const Reference reference = makeReference(scene, 64);
    ASSERT_TRUE(reference.recording.isComplete());
    EXPECT_FALSE(reference.isClosedForm);
    EXPECT_LE(reference.uncertainty[Measure::position], 1.0 / 1024);
    // Friction 0.6 stops it after v²/(2 μ g).
    EXPECT_NEAR(reference.recording.samples.back().bodies[1].position.x, 9.0 / 12, 0.004);
    const double error = measured(scene, runOf(scene, 64, Precision::f32), reference)[Measure::position];
    EXPECT_LT(error, 0.02);
    EXPECT_GT(error, 0);
}

}  // namespace
}  // namespace swept::measures
