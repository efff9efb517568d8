#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include <swept/samples/scene_builder.h>

#include "bench_scene.h"

namespace swept::worlds {
namespace {

BenchScene crates(const char* name, double size, bool sleep) {
    constexpr int kHigh = 10;
    const int stacks = scaledCount(50, size);
    BenchScene bench = emptyBench(name, sleep ? 150 : 30, 300);
    bench.scene.settings.sleep = sleep;
    build::addFixed(bench.scene, "ground", {0, -1}, {build::box({2.0 * stacks, 1})});
    for (int i = 0; i < stacks; ++i) {
        for (int j = 0; j < kHigh; ++j) {
            build::addDynamic(bench.scene, "", {2.0 * i - stacks, j + 0.5}, {build::box({0.5, 0.5})});
        }
    }
    return bench;
}

}  // namespace

/// What a body costs that nothing holds. They fall side by side, slowly enough not to be swept.
BenchScene makeDisks(double size) {
    constexpr int kWide = 100;
    const int count = scaledCount(10000, size);
    BenchScene bench = emptyBench("disks", 10, 300);
    bench.scene.gravity = {0, -0.01};
    bench.scene.settings.sleep = false;
    for (int i = 0; i < count; ++i) {
        const DVec2 position{3.0 * (i % kWide), 3.0 * (i / kWide)};
        build::addDynamic(bench.scene, "", position, {build::circle(0.5)}).velocity = {1, 0};
    }
    return bench;
}

BenchScene makeCrates(double size) { return crates("crates", size, false); }
BenchScene makeCratesAsleep(double size) { return crates("crates-asleep", size, true); }

/// Crates asleep in stacks of two, as many as the size tells; beside them, whatever the size, disks that are driven to
/// and fro, and now and then one crate that is kicked up.
BenchScene makeWarehouse(double size) {
    constexpr int kStacksPerFloor = 50;
    constexpr std::int64_t kStepsPerKick = 10;
    constexpr std::int64_t kStacksPerKick = 7;
    constexpr std::int64_t kStepsPerTurn = 60;
    const int stacks = scaledCount(5000, size);
    BenchScene bench = emptyBench("warehouse", 150, 300);
    std::vector<ShapeDescription> floors{build::box({50, 1}, {-100, -1})};
    for (int i = 0; i < stacks; i += kStacksPerFloor) {
        floors.push_back(build::box({kStacksPerFloor, 1}, {2.0 * i + kStacksPerFloor - 1, -1}));
    }
    build::addFixed(bench.scene, "floors", {0, 0}, std::move(floors));
    std::vector<std::uint32_t> disks;
    for (int i = 0; i < 20; ++i) {
        disks.push_back(static_cast<std::uint32_t>(bench.scene.bodies.size()));
        build::addDynamic(bench.scene, "", {4.0 * i - 138, 0.5}, {build::circle(0.5)});
    }
    std::vector<std::uint32_t> tops;
    for (int i = 0; i < stacks; ++i) {
        build::addDynamic(bench.scene, "", {2.0 * i, 0.5}, {build::box({0.5, 0.5})});
        tops.push_back(static_cast<std::uint32_t>(bench.scene.bodies.size()));
        build::addDynamic(bench.scene, "", {2.0 * i, 1.5}, {build::box({0.5, 0.5})});
    }
    bench.script = [disks, tops](std::int64_t step) {
        SceneChange change;
        const auto kick = static_cast<std::size_t>(step / kStepsPerKick * kStacksPerKick);
        if (step % kStepsPerKick == 0) { change.pushed.push_back({tops[kick % tops.size()], {0, 1}}); }
        if (step % kStepsPerTurn != 0) { return change; }
        const double side = step / kStepsPerTurn % 2 == 0 ? 1 : -1;
        for (std::size_t i = 0; i < disks.size(); ++i) {
            change.pushed.push_back({disks[i], {side * (2.0 + static_cast<double>(i % 3)), 0}});
        }
        return change;
    };
    return bench;
}

/// Boxes, disks and capsules fall into a tray; most of them lie still when it is about them.
BenchScene makeTray(double size) {
    const int count = scaledCount(1024, size);
    const int columns = static_cast<int>(std::sqrt(2.0 * count)) + 1;
    const double width = 1.2 * columns;
    BenchScene bench = emptyBench("tray", 300, 1200);
    build::addFixed(bench.scene, "tray", {0, 0},
                    {build::box({width, 0.5}, {0, -0.5}), build::box({0.5, width}, {-0.6 * width - 1, width}),
                     build::box({0.5, width}, {0.6 * width + 1, width})});
    for (int i = 0; i < count; ++i) {
        const int row = i / columns;
        const DVec2 place{1.2 * (i % columns) - 0.6 * width + 0.1 * (row % 2), 1 + 1.2 * row};
        const std::array<ShapeDescription, 3> shapes{build::box({0.5, 0.4}), build::circle(0.5),
                                                     build::capsule({-0.3, 0}, {0.3, 0}, 0.2)};
        build::addDynamic(bench.scene, "", place, {shapes[static_cast<std::size_t>(i) % shapes.size()]});
    }
    return bench;
}

/// Ground of tiles with a step every ten, above it platforms that go to and fro, three riders on each.
BenchScene makePlatformer(double size) {
    constexpr int kTilesPerMover = 20;
    const int movers = scaledCount(20, size);
    BenchScene bench = emptyBench("platformer", 60, 600);
    for (int i = 0; i < movers * kTilesPerMover; ++i) {
        const double high = i / 10 % 2 == 0 ? 0 : 1;
        build::addFixed(bench.scene, "", {static_cast<double>(i), high}, {build::box({0.5, 0.5})});
    }
    std::vector<std::uint32_t> platforms;
    for (int i = 0; i < movers; ++i) {
        const double x = kTilesPerMover * (i + 0.5);
        platforms.push_back(static_cast<std::uint32_t>(bench.scene.bodies.size()));
        build::addKinematic(bench.scene, "", {x, 5}, {build::box({3, 0.25})});
        build::addDynamic(bench.scene, "", {x - 1.5, 6}, {build::box({0.5, 0.5})});
        build::addDynamic(bench.scene, "", {x, 6}, {build::circle(0.4)});
        build::addDynamic(bench.scene, "", {x + 1.5, 6.25}, {build::capsule({0, -0.4}, {0, 0.4}, 0.35)}).fixedRotation =
            true;
    }
    bench.script = [platforms](std::int64_t step) {
        constexpr double kPeriod = 240;  // steps
        SceneChange change;
        for (std::size_t i = 0; i < platforms.size(); ++i) {
            const double phase =
                2 * std::numbers::pi * (static_cast<double>(step) / kPeriod + static_cast<double>(i) / 7);
            change.pushed.push_back({platforms[i], {2.5 * std::cos(phase), i % 2 == 0 ? 0 : 1.5 * std::sin(phase)}});
        }
        return change;
    };
    return bench;
}

/// Bullets pass each other and bounce off walls and posts for ever.
BenchScene makeBulletHell(double size) {
    constexpr double kHalf = 50;
    constexpr std::uint32_t kWall = 1;
    constexpr std::uint32_t kBullet = 2;
    constexpr double kRadius = 0.1;
    const int count = scaledCount(5000, size);
    BenchScene bench = emptyBench("bullet-hell", 30, 300);
    bench.scene.gravity = {0, 0};
    std::vector<ShapeDescription> walls;
    for (const double side : {-kHalf, kHalf}) {
        walls.push_back(build::box({0.5, kHalf}, {side, 0}));
        walls.push_back(build::box({kHalf, 0.5}, {0, side}));
    }
    for (int i = 0; i < 10; ++i) {
        for (int j = 0; j < 10; ++j) {
            walls.push_back(build::box({0.5, 0.5}, {9.0 * i - 40.5, 9.0 * j - 40.5}, 0.3 * (i + j)));
        }
    }
    for (ShapeDescription& wall : walls) {
        wall = build::withFriction(build::withRestitution(wall, 1), 0);
        wall.filter.category = kWall;
    }
    build::addFixed(bench.scene, "walls", {0, 0}, std::move(walls));
    build::Dice dice(5);
    for (int i = 0; i < count; ++i) {
        ShapeDescription bullet = build::withFriction(build::withRestitution(build::circle(kRadius), 1), 0);
        bullet.filter = {kBullet, kWall, 0};
        // In the lanes between the posts.
        const double lane = 9 * std::floor(dice.range(0, 9)) - 36;
        const double along = dice.range(-kHalf + 2, kHalf - 2);
        const double across = lane + dice.range(-2, 2);
        const double speed = dice.range(5, 20);
        const double angle = dice.range(0, 2 * std::numbers::pi);
        BodyDescription& body =
            build::addDynamic(bench.scene, "", i % 2 == 0 ? DVec2{along, across} : DVec2{across, along}, {bullet});
        body.velocity = {speed * std::cos(angle), speed * std::sin(angle)};
    }
    return bench;
}

/// Balls that are swept against crates adrift, too, and bounce off them and the walls for ever; they pass each other.
BenchScene makeShootOut(double size) {
    constexpr std::uint32_t kBullet = 2;
    constexpr double kCrateSpacing = 4;  // metres, at the start
    const int side = scaledSide(24, size);
    const int count = scaledCount(1600, size);
    const double half = kCrateSpacing * side / 2;
    BenchScene bench = emptyBench("shoot-out", 60, 300);
    bench.scene.gravity = {0, 0};
    const auto elastic = [](ShapeDescription shape) {
        return build::withFriction(build::withRestitution(std::move(shape), 1), 0);
    };
    std::vector<ShapeDescription> walls;
    for (const double edge : {-half, half}) {
        walls.push_back(elastic(build::box({0.5, half + 0.5}, {edge, 0})));
        walls.push_back(elastic(build::box({half + 0.5, 0.5}, {0, edge})));
    }
    build::addFixed(bench.scene, "walls", {0, 0}, std::move(walls));
    build::Dice dice(11);
    const auto adrift = [&dice](BodyDescription& body, double speed) {
        const double angle = dice.range(0, 2 * std::numbers::pi);
        body.velocity = {speed * std::cos(angle), speed * std::sin(angle)};
    };
    const auto placeOf = [half](int cell) { return kCrateSpacing * (cell + 0.5) - half; };
    for (int i = 0; i < side * side; ++i) {
        const DVec2 place{placeOf(i % side), placeOf(i / side)};
        adrift(build::addDynamic(bench.scene, "", place, {elastic(build::box({0.5, 0.5}))}), 1);
    }
    for (int i = 0; i < count; ++i) {
        ShapeDescription ball = elastic(build::circle(0.1));
        ball.filter = {kBullet, ~kBullet, 0};
        // Between the rows of crates.
        const int cell = i % (side * side);
        const DVec2 place{placeOf(cell % side) + dice.range(-1, 1), placeOf(cell / side) + 0.4 * kCrateSpacing};
        BodyDescription& body = build::addDynamic(bench.scene, "", place, {ball});
        body.bullet = true;
        adrift(body, dice.range(30, 60));
    }
    return bench;
}

}  // namespace swept::worlds
