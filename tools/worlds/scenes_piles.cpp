#include <cmath>
#include <numbers>

#include <swept/samples/scene_builder.h>

#include "bench_scene.h"

namespace swept::worlds {
namespace {

using build::box;

constexpr double kPi = std::numbers::pi;
constexpr double kTurnRate = 25 * kPi / 180;  // rad/s of the drums

DVec2 onCircle(double radius, double angle) { return {radius * std::cos(angle), radius * std::sin(angle)}; }

/// A floor of tiles a metre wide, −half … half, and walls of `high` more.
void addTub(SceneDescription& scene, int half, int high) {
    std::vector<ShapeDescription> tiles;
    for (int i = -half; i <= half; ++i) { tiles.push_back(box({0.55, 0.5}, {static_cast<double>(i), 0})); }
    for (const int side : {-half, half}) {
        for (int i = 1; i <= high; ++i) {
            tiles.push_back(box({0.5, 0.55}, {static_cast<double>(side), static_cast<double>(i)}));
        }
    }
    build::addFixed(scene, "tub", {0, 0}, std::move(tiles));
}

RevoluteDescription motor(DVec2 anchor, double speed, double torque) {
    RevoluteDescription revolute;
    revolute.anchor = anchor;
    revolute.motorSpeed = speed;
    revolute.maxMotorTorque = torque;
    return revolute;
}

void addMotor(SceneDescription& scene, const char* a, const char* b, DVec2 anchor, double speed, double torque) {
    build::hinge(scene, a, b, anchor) = motor(anchor, speed, torque);
}

/// A ring of 36 blocks, a little wider than their share, with four paddles inside.
std::vector<ShapeDescription> washerDrum() {
    constexpr double kPart = kPi / 18;
    const auto block = [](double inner, double outer, double from, double to) {
        return build::polygon({onCircle(inner, from), onCircle(outer, from), onCircle(outer, to), onCircle(inner, to)});
    };
    std::vector<ShapeDescription> shapes;
    for (int i = 0; i < 36; ++i) {
        const double from = i * kPart;
        shapes.push_back(block(16, 18, from - 0.1 * kPart, from + 1.1 * kPart));
        if (i % 9 == 0) { shapes.push_back(block(14, 16, from, from + kPart)); }
    }
    return shapes;
}

}  // namespace

BenchScene makeCompounds(double size) {
    constexpr int kColumns = 20;
    const int rows = scaledCount(150, size);
    BenchScene bench = emptyBench("compounds", 120, 500);
    addTub(bench.scene, 40, 100);
    const ShapeDescription left = build::withFriction(build::polygon({{-1, 0}, {0.5, 1}, {0, 2}}), 0.5);
    const ShapeDescription right = build::withFriction(build::polygon({{1, 0}, {-0.5, 1}, {0, 2}}), 0.5);
    double side = 0.25;
    for (int i = 0; i < kColumns; ++i) {
        for (int j = 0; j < rows; ++j) {
            build::addDynamic(bench.scene, "", {2.0 * i - (kColumns - 1) + side, 2.25 * j + 5.575}, {left, right});
            side = -side;
        }
    }
    return bench;
}

BenchScene makeJunkyard(double size) {
    constexpr int kColumns = 200;
    constexpr double kRadius = 0.25;
    const int rows = scaledCount(40, size);
    BenchScene bench = emptyBench("junkyard", 120, 800);
    addTub(bench.scene, 80, 50);
    // Five points of a Fibonacci ring, as they follow each other around it.
    const double golden = kPi * (std::sqrt(5.0) - 1);
    std::vector<DVec2> points;
    for (int i = 0; i < 5; ++i) { points.push_back(onCircle(kRadius, golden * i)); }
    const ShapeDescription junk = build::polygon(points);
    double side = -0.1;
    for (int i = 0; i < kColumns; ++i) {
        for (int j = 0; j < rows; ++j) {
            build::addDynamic(bench.scene, "", {1.5 * (2.0 * i - kColumns) * kRadius + side, 4 * kRadius * j + 15},
                              {junk});
            side = -side;
        }
    }
    const auto pusher = static_cast<std::uint32_t>(bench.scene.bodies.size());
    build::addKinematic(bench.scene, "pusher", {0, 0}, {box({2, 4}, {0, 4})});
    bench.script = [pusher](std::int64_t step) {
        constexpr double kHertz = 60;
        const auto placeAt = [](std::int64_t i) { return 60 * std::sin(0.2 * static_cast<double>(i) / kHertz); };
        return SceneChange{{}, {}, {{pusher, {kHertz * (placeAt(step) - placeAt(step - 1)), 0}}}};
    };
    return bench;
}

BenchScene makeSmash(double size) {
    const int columns = scaledSide(120, size);
    const int rows = scaledSide(80, size);
    BenchScene bench = emptyBench("smash", 75, 300);
    bench.scene.gravity = {0, 0};
    build::addDynamic(bench.scene, "hammer", {-20, 0}, {build::withDensity(box({4, 4}), 8)}).velocity = {40, 0};
    for (int i = 0; i < columns; ++i) {
        for (int j = 0; j < rows; ++j) {
            build::addDynamic(bench.scene, "", {0.4 * i + 30, 0.4 * (j - rows / 2.0)}, {box({0.2, 0.2})}).awake = false;
        }
    }
    return bench;
}

BenchScene makeSpinner(double size) {
    constexpr int kPoints = 360;
    constexpr DVec2 kHub{0, 12};
    const int count = scaledCount(6076, size);
    BenchScene bench = emptyBench("spinner", 60, 500);
    std::vector<DVec2> rim;
    for (int i = 0; i < kPoints; ++i) {  // clockwise: solid outside
        rim.push_back(onCircle(40, -2 * kPi * i / kPoints) + DVec2{0, 32});
    }
    build::addFixed(bench.scene, "rim", {0, 0}, {build::withFriction(build::chain(rim, true), 0.1)});
    build::addDynamic(bench.scene, "blade", kHub, {build::withFriction(build::rounded(box({0.4, 20}), 0.2), 0)});
    addMotor(bench.scene, "rim", "blade", kHub, 5, 1e9);
    const std::array<ShapeDescription, 3> kinds{build::capsule({-0.25, 0}, {0.25, 0}, 0.25), build::circle(0.35),
                                                box({0.35, 0.35})};
    DVec2 at{-23, 2};
    for (int i = 0; i < count; ++i) {
        ShapeDescription shape = build::withFriction(kinds[static_cast<std::size_t>(i % 3)], 0.1);
        shape.density = 0.25;
        shape.restitution = 0.1;
        build::addDynamic(bench.scene, "", at, {std::move(shape)});
        at.x += 0.5;
        if (at.x >= 23) { at = {-23, at.y + 0.5}; }
    }
    return bench;
}

BenchScene makeTumbler(double size) {
    const int side = scaledSide(45, size);
    BenchScene bench = emptyBench("tumbler", 100, 750);
    build::addFixed(bench.scene, "base", {0, 0}, {});
    std::vector<ShapeDescription> walls;
    for (const double at : {10., -10.}) {
        walls.push_back(build::withDensity(box({0.5, 10}, {at, 0}), 50));
        walls.push_back(build::withDensity(box({10, 0.5}, {0, at}), 50));
    }
    build::addDynamic(bench.scene, "drum", {0, 10}, std::move(walls));
    addMotor(bench.scene, "base", "drum", {0, 10}, kTurnRate, 1e8);
    for (int i = 0; i < side; ++i) {
        for (int j = 0; j < side; ++j) {
            build::addDynamic(bench.scene, "", {-0.2 * side + 0.4 * j, -0.2 * side + 10 + 0.4 * i},
                              {box({0.125, 0.125})});
        }
    }
    return bench;
}

BenchScene makeWasher(double size) {
    constexpr double kHalf = 0.1;
    const int side = scaledSide(90, size);
    BenchScene bench = emptyBench("washer", 60, 500);
    BodyDescription& drum = build::addKinematic(bench.scene, "drum", {0, 10}, washerDrum());
    drum.angularVelocity = kTurnRate;
    drum.velocity = {0.001, -0.002};
    for (int i = 0; i < side; ++i) {
        for (int j = 0; j < side; ++j) {
            const DVec2 at{-1.1 * kHalf * side + 2.1 * kHalf * j, -1.1 * kHalf * side + 10 + 2.1 * kHalf * i};
            build::addDynamic(bench.scene, "", at, {box({kHalf, kHalf})});
        }
    }
    return bench;
}

}  // namespace swept::worlds
