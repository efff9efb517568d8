#include "builtin_scenes.h"
#include "scene_builder.h"

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
    return 0.05 * x * x + hill(x, -2.5, 0.9, 0.8) + hill(x, 1.2, 0.6, 0.5) + hill(x, 4.5, 1.1, 0.9);
}

}  // namespace

SceneDescription terrain() {
    constexpr double kEdge = 9;
    constexpr int kPieces = 72;
    SceneDescription scene = build::scene("terrain", {0, 4}, 10.5);
    std::vector<DVec2> ground{{kEdge, 9}};  // from right to left: the solid side is on the left of the direction
    for (int i = 0; i <= kPieces; ++i) {
        const double x = kEdge - 2 * kEdge * i / kPieces;
        ground.push_back({x, groundHeight(x)});
    }
    ground.push_back({-kEdge, 9});
    addFixed(scene, "ground", {0, 0}, {chain(std::move(ground))});
    for (int i = 0; i < 12; ++i) {
        const double x = -8 + 0.7 * (i % 4);
        const double y = groundHeight(-8) + 1 + 1.1 * static_cast<double>(i / 4);
        const double size = 0.22 + 0.03 * (i % 3);
        const ShapeDescription kinds[] = {circle(size), capsule({-size, 0}, {size, 0}, 0.7 * size), box({size, size})};
        BodyDescription& body = addDynamic(scene, "", {x, y}, {kinds[i % 3]});
        body.velocity = {2, 0};
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
            for (int i = 0; i < turn; ++i) {
                corner = {corner.y, -corner.x};
            }
            rim.push_back(4.0 * corner);
        }
    }
    addFixed(scene, "drum", {0, 0}, {chain(std::move(rim), true)});
    addKinematic(scene, "paddle", {0, 0}, {box({2.9, 0.1}), box({0.1, 2.9})}).angularVelocity = 1;

    ShapeDescription gate = box({0.9, 0.6});
    gate.sensor = true;
    addFixed(scene, "gate", {0, -3.2}, {gate});

    Dice dice(11);
    for (int i = 0; i < 40; ++i) {
        // Ten in each of the four chambers, on a grid that keeps clear of the paddle.
        const double x = 0.45 + 0.42 * (i % 4);
        const double y = 0.45 + 0.42 * static_cast<double>(i / 4 % 3);
        const double right = i % 2 == 0 ? 1 : -1;
        const double upper = i / 20 == 0 ? 1 : -1;
        const double size = dice.range(0.12, 0.19);
        const ShapeDescription shape = i % 5 == 0 ? box({0.8 * size, 0.8 * size}) : circle(size);
        addDynamic(scene, "", {right * x, upper * y}, {withRestitution(shape, 0.2)});
    }
    return scene;
}

}  // namespace swept::scenes
