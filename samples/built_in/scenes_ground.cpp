#include "../scene_builder.h"
#include "builtin_scenes.h"

/// Chains as ground and as a drum, kinematic bodies, sensors.

namespace swept::scenes {
namespace {

using namespace build;

// A hill of the given height and half-width at half height; quotients of polynomials are the same on every machine.
double hill(double x, double at, double height, double width) {
    const double u = (x - at) / width;
    return height / (1 + u * u);
}

double groundHeight(double x) {
    return 0.08 * x * x + hill(x, -2.5, 0.35, 0.6) + hill(x, 1.2, 0.5, 0.6) + hill(x, 4.5, 1.1, 0.9);
}

}  // namespace

SceneDescription terrain() {
    constexpr double kEdge = 8.4;
    constexpr int kPieces = 72;
    SceneDescription scene = build::scene("terrain", {0, 3.2}, 10);
    std::vector<DVec2> ground{{kEdge, 7}};  // from right to left: the solid side is on the left of the direction
    for (int i = 0; i <= kPieces; ++i) {
        const double x = kEdge - 2 * kEdge * i / kPieces;
        ground.push_back({x, groundHeight(x)});
    }
    ground.push_back({-kEdge, 7});
    addFixed(scene, "ground", {0, 0}, {chain(std::move(ground))});
    for (int i = 0; i < 9; ++i) {  // a loose row down the slope; what rolls runs away from what slides
        const double x = -7.7 + 0.85 * i;
        const double size = 0.24 + 0.03 * (i % 3);
        const ShapeDescription kinds[] = {withFriction(box({size, size}), 0.02), circle(size),
                                          withFriction(capsule({-size, 0}, {size, 0}, 0.7 * size), 0.02)};
        addDynamic(scene, "", {x, groundHeight(x) + 0.8}, {kinds[i % 3]}).velocity = {2.5 + 0.25 * i, -1};
    }
    return scene;
}

SceneDescription paddleDrum() {
    SceneDescription scene = build::scene("paddle in a drum", {0, 0}, 9);
    // 16 corners on a circle of radius 4, clockwise: such a loop is hollow.
    constexpr double kC = 0.9238795325112867;  // cosine and sine of an eighth of π, and of a quarter
    constexpr double kS = 0.3826834323650898;
    constexpr double kD = 0.7071067811865476;
    const DVec2 quarter[] = {{0, 1}, {kS, kC}, {kD, kD}, {kC, kS}};
    std::vector<DVec2> rim;
    for (int turn = 0; turn < 4; ++turn) {
        for (DVec2 corner : quarter) {
            for (int i = 0; i < turn; ++i) { corner = {corner.y, -corner.x}; }
            rim.push_back(4.0 * corner);
        }
    }
    addFixed(scene, "drum", {0, 0}, {chain(std::move(rim), true)});
    addKinematic(scene, "paddle", {0, 0}, {box({3.45, 0.1}), box({0.1, 3.45})}).angularVelocity = 1;

    ShapeDescription gate = box({0.9, 0.6});
    gate.sensor = true;
    addFixed(scene, "gate", {0, -3.2}, {gate});

    Dice dice(11);
    for (int i = 0; i < 36; ++i) {
        // A square of nine in each of the four chambers, clear of the paddle.
        const int chamber = i / 9;
        const double x = (chamber % 2 == 0 ? 1 : -1) * (0.5 + 0.5 * (i % 3));
        const double y = (chamber < 2 ? 1 : -1) * (0.5 + 0.5 * static_cast<double>(i % 9 / 3));
        const double size = dice.range(0.12, 0.19);
        const ShapeDescription shape = i % 5 == 0 ? box({0.8 * size, 0.8 * size}) : circle(size);
        addDynamic(scene, "", {x, y}, {withRestitution(shape, 0.2)});
    }
    return scene;
}

}  // namespace swept::scenes
