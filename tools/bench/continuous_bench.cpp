#include "continuous_bench.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include <swept/samples/runner.h>
#include <swept/samples/scene_builder.h>

#include "stopwatch.h"

namespace swept::bench {
namespace {

constexpr SceneContinuous kModes[] = {SceneContinuous::off, SceneContinuous::speedLimit, SceneContinuous::speculative,
                                      SceneContinuous::stop, SceneContinuous::subStep};
constexpr double kMissSpeeds[] = {30, 100, 300, 1000};
constexpr double kWall = 0.02;
constexpr int kMissSteps = 45;
constexpr int kCostBodies = 200;
constexpr int kCostSteps = 60;
constexpr int kCostRuns = 5;

struct Projectile {
    const char* name;
    ShapeDescription shape;
};
std::vector<Projectile> projectiles() {
    return {{"ball 20 cm", build::circle(0.1)},
            {"box 20 cm", build::box({0.1, 0.1})},
            {"bar 50 × 1 cm", build::box({0.25, 0.005})},
            {"capsule 110 × 10 cm", build::capsule({-0.5, 0}, {0.5, 0}, 0.05)}};
}

SceneDescription spaceOf(SceneContinuous mode) {
    SceneDescription scene = build::scene("", {0, 0}, 10);
    scene.gravity = {0, 0};
    scene.settings.continuous = mode;
    scene.settings.sleep = false;
    return scene;
}

/// Runs a scene that is valid by construction. @return the last frame
Frame lastFrameOf(const SceneDescription& scene, int steps) {
    std::string error;
    const std::unique_ptr<Runner> runner = makeRunner(scene, {}, error);
    Frame frame;
    if (!runner) { return frame; }
    for (int i = 0; i < steps; ++i) { runner->step(); }
    runner->read(frame, false);
    return frame;
}

/// Shots at a wall that begins at x = 0, within 30°, spinning up to 100 rad/s, that do not see each other.
int missedOf(SceneContinuous mode, const ShapeDescription& shape, double speed, double wall,
             const ContinuousBenchSettings& settings) {
    SceneDescription scene = spaceOf(mode);
    build::addFixed(scene, "wall", {wall / 2, 0}, {build::box({wall / 2, 1e5})});
    build::Dice dice(settings.seed);
    for (int i = 0; i < settings.shots; ++i) {
        const double aim = dice.range(-std::numbers::pi / 6, std::numbers::pi / 6);
        const double way = 0.8 + dice.range(0, 1) * speed / 60;
        ShapeDescription own = shape;
        own.filter.group = -1;
        BodyDescription& shot =
            build::addDynamic(scene, "", {-way * std::cos(aim), -way * std::sin(aim)}, {std::move(own)});
        shot.velocity = {speed * std::cos(aim), speed * std::sin(aim)};
        shot.angle = dice.range(0, 2 * std::numbers::pi);
        shot.angularVelocity = dice.range(-100, 100);
    }
    const Frame frame = lastFrameOf(scene, kMissSteps);
    return static_cast<int>(std::count_if(frame.bodies.begin() + 1, frame.bodies.end(),
                                          [wall](const BodyFrame& body) { return body.position.x > wall / 2; }));
}

/// Balls that pass above a post at 1 to 20 cm: whatever turns them aside is not there.
int ghostsOf(SceneContinuous mode, double speed, const ContinuousBenchSettings& settings) {
    SceneDescription scene = spaceOf(mode);
    build::addFixed(scene, "post", {0, 0}, {build::box({0.3, 0.3})});
    build::Dice dice(settings.seed);
    for (int i = 0; i < settings.shots; ++i) {
        ShapeDescription ball = build::circle(0.1);
        ball.filter.group = -1;
        const double height = 0.4 + dice.range(0.01, 0.2);
        const double way = 0.45 + dice.range(0, 1) * speed / 60;
        build::addDynamic(scene, "", {-way, height}, {std::move(ball)}).velocity = {speed, 0};
    }
    const Frame frame = lastFrameOf(scene, 4);
    return static_cast<int>(std::count_if(frame.bodies.begin() + 1, frame.bodies.end(),
                                          [](const BodyFrame& body) { return std::fabs(body.velocity.y) > 1e-3; }));
}

/// A ball between two walls, e = 1, for 10 s: what is missing of its way and of its energy.
void measureLosses(SceneContinuous mode, ModeRow& row) {
    constexpr double kSpeed = 60;
    constexpr int kSteps = 600;
    SceneDescription scene = spaceOf(mode);
    build::addFixed(scene, "", {-1.5, 0}, {build::withRestitution(build::box({0.5, 5}), 1)});
    build::addFixed(scene, "", {1.5, 0}, {build::withRestitution(build::box({0.5, 5}), 1)});
    BodyDescription& ball =
        build::addDynamic(scene, "", {0.1, 0}, {build::withFriction(build::withRestitution(build::circle(0.1), 1), 0)});
    ball.velocity = {kSpeed, 0};
    std::string error;
    const std::unique_ptr<Runner> runner = makeRunner(scene, {}, error);
    if (!runner) { return; }
    Frame frame;
    int turns = 0;
    double before = kSpeed;
    for (int i = 0; i < kSteps; ++i) {
        runner->step();
        runner->read(frame, false);
        const double now = frame.bodies[2].velocity.x;
        turns += now * before < 0 ? 1 : 0;
        before = now != 0 ? now : before;
    }
    // 0.8 m to the first wall, then 1.8 m from wall to wall.
    const double expected = 1 + std::floor((kSpeed * kSteps / 60.0 - 0.8) / 1.8);
    row.timeLost = 1 - turns / expected;
    const double share = frame.bodies[2].velocity.x / kSpeed;
    row.energyError = share * share - 1;
    if (std::fabs(frame.bodies[2].position.x) > 1.5) {
        row.timeLost = row.energyError = std::numeric_limits<double>::quiet_NaN();
    }
}

/// Bodies at 60 m/s in a box of walls without thickness; the fastest of some runs.
void measureCost(SceneContinuous mode, const ContinuousBenchSettings& settings, ModeRow& row) {
    SceneDescription scene = spaceOf(mode);
    for (const double side : {-10.0, 10.0}) {
        build::addFixed(scene, "", {side, 0}, {build::withRestitution(build::segment({0, -10}, {0, 10}), 1)});
        build::addFixed(scene, "", {0, side}, {build::withRestitution(build::segment({-10, 0}, {10, 0}), 1)});
    }
    build::Dice dice(settings.seed);
    const std::vector<Projectile> all = projectiles();
    for (int i = 0; i < kCostBodies; ++i) {
        ShapeDescription shape = all[static_cast<std::size_t>(i) % all.size()].shape;
        shape.filter.group = -1;
        const double aim = dice.range(0, 2 * std::numbers::pi);
        const DVec2 place{dice.range(-9, 9), dice.range(-9, 9)};
        BodyDescription& body = build::addDynamic(scene, "", place, {std::move(shape)});
        body.velocity = {60 * std::cos(aim), 60 * std::sin(aim)};
        body.angularVelocity = dice.range(-20, 20);
    }
    double least = std::numeric_limits<double>::infinity();
    Frame frame;
    for (int run = 0; run < kCostRuns; ++run) {
        std::string error;
        const std::unique_ptr<Runner> runner = makeRunner(scene, {}, error);
        if (!runner) { return; }
        const Stopwatch watch;
        for (int i = 0; i < kCostSteps; ++i) { runner->step(); }
        least = std::min(least, watch.seconds());
        runner->read(frame, false);
    }
    row.nanoseconds = 1e9 * least / (kCostBodies * kCostSteps);
    const auto out = std::count_if(frame.bodies.begin(), frame.bodies.end(), [](const BodyFrame& body) {
        return std::fabs(body.position.x) > 10.01 || std::fabs(body.position.y) > 10.01;
    });
    row.escaped = static_cast<double>(out) / kCostBodies;
}

}  // namespace

std::vector<ModeRow> benchModes(const ContinuousBenchSettings& settings, const std::function<void(int)>& progress) {
    std::vector<ModeRow> rows;
    for (const SceneContinuous mode : kModes) {
        ModeRow row{.mode = mode};
        for (const Projectile& projectile : projectiles()) {
            const bool isBall = std::holds_alternative<CircleGeometry>(projectile.shape.geometry);
            for (const double speed : kMissSpeeds) {
                const int missed = missedOf(mode, projectile.shape, speed, kWall, settings);
                row.shots += settings.shots;
                row.missed += missed;
                row.balls += isBall ? settings.shots : 0;
                row.ballsMissed += isBall ? missed : 0;
            }
        }
        for (const double speed : kMissSpeeds) {
            row.passers += settings.shots;
            row.ghosts += ghostsOf(mode, speed, settings);
        }
        measureLosses(mode, row);
        measureCost(mode, settings, row);
        rows.push_back(row);
        progress(static_cast<int>(rows.size()));
    }
    return rows;
}

std::vector<ThicknessRow> benchThickness(const ContinuousBenchSettings& settings,
                                         const std::function<void(int)>& progress) {
    constexpr int kThickest = 13;  // 1 cm times 2 to this power: 82 m
    std::vector<ThicknessRow> rows;
    for (const Projectile& projectile : projectiles()) {
        ThicknessRow row{projectile.name, SceneContinuous::off, {}};
        for (const double speed : kThicknessSpeeds) {
            double needed = std::numeric_limits<double>::infinity();
            // From the thickest down: the first that lets one through says that its double is needed.
            for (int power = kThickest; power >= 0; --power) {
                const double wall = 0.01 * std::ldexp(1.0, power);
                if (missedOf(SceneContinuous::off, projectile.shape, speed, wall, settings) > 0) { break; }
                needed = wall;
            }
            row.metres.push_back(needed);
        }
        rows.push_back(std::move(row));
        progress(static_cast<int>(rows.size()));
    }
    return rows;
}

}  // namespace swept::bench
