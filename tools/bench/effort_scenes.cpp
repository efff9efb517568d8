#include "effort_scenes.h"

#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include <swept/samples/scene_builder.h>

namespace swept::bench {
namespace {

using namespace build;

constexpr double kPi = std::numbers::pi;
constexpr double kGravity = 10;

SceneDescription emptyScene(const char* name, DVec2 viewCenter, double viewHeight) {
    SceneDescription scene = build::scene(name, viewCenter, viewHeight);
    scene.gravity = {0, -kGravity};
    scene.settings.sleep = false;
    return scene;
}

void addLift(SceneDescription& scene, double half, double speed) {
    addKinematic(scene, "lift", {0, -0.5}, {box({half, 0.5})}).velocity = {0, speed};
}

void addPyramid(SceneDescription& scene, double x, int rows) {
    for (int row = 0; row < rows; ++row) {
        for (int i = 0; i < rows - row; ++i) {
            addDynamic(scene, "", {x + i - 0.5 * (rows - row - 1), row + 0.5}, {box({0.5, 0.5})});
        }
    }
}

/// A weight hangs on a spring, and falls as deep as `low` at its centre, ever less.
void addHammer(SceneDescription& scene, double low, double high) {
    constexpr double kLength = 15;
    addFixed(scene, "beam", {0, high + kLength}, {box({1, 0.5})});
    addDynamic(scene, "weight", {0, high}, {withDensity(box({0.5, 0.5}), 50)}).fixedRotation = true;
    DistanceDescription& spring = rod(scene, "beam", "weight", {0, high + kLength}, {0, high});
    spring.hertz =
        std::sqrt(2 * kGravity / (high - low)) / (2 * kPi);  // at the lowest point it has given m·g·(high − low) away
    spring.dampingRatio = 0;
}

/// A weight on a spring strikes a pyramid that a lift carries, ever less deep, until it no longer gets there.
SceneDescription hammer() {
    constexpr int kRows = 6;
    SceneDescription scene = emptyScene("hammer", {0, 4}, 12);
    scene.settings.maxPenetration = 0.003;
    addLift(scene, 6, -0.2);
    addPyramid(scene, 0, kRows);
    addHammer(scene, kRows + 0.1, kRows + 1.5);
    return scene;
}

/// The same on one of many piles.
SceneDescription oneOfMany() {
    constexpr int kRows = 3;
    SceneDescription scene = emptyScene("one-of-many", {0, 4}, 40);
    scene.settings.maxPenetration = 0.003;
    addLift(scene, 60, -0.05);
    for (int i = -12; i <= 12; ++i) { addPyramid(scene, 4.0 * i, kRows); }
    addHammer(scene, kRows - 0.5, kRows + 1.5);
    return scene;
}

/// Piles on a belt pass below a roller that is heavy.
SceneDescription roller() {
    SceneDescription scene = emptyScene("roller", {0, 4}, 12);
    scene.settings.maxPenetration = 0.008;
    scene.settings.maxJointError = 0.004;
    addKinematic(scene, "belt", {20, -0.5}, {box({60, 0.5})}).velocity = {-2, 0};
    for (int i = 0; i < 12; ++i) {
        for (int row = 0; row < 3; ++row) {
            addDynamic(scene, "", {6.0 * i + 5, row + 0.5}, {box({1, 0.5})}).velocity = {-2, 0};
        }
    }
    addFixed(scene, "frame", {0, 10}, {box({1, 0.2})});
    addDynamic(scene, "fork", {0, 4.8}, {withDensity(box({0.5, 0.5}), 50)});
    PrismaticDescription& guide = slider(scene, "frame", "fork", {0, 4.8}, {0, 1});
    guide.lower = 0;
    guide.upper = 2;
    addDynamic(scene, "roll", {0, 4.8}, {withDensity(circle(2), 20)});
    hinge(scene, "fork", "roll", {0, 4.8});
    return scene;
}

/// A crank lifts the middle of a rope between two posts once a turn, and lets it fall.
SceneDescription tug() {
    constexpr int kLinks = 12;
    SceneDescription scene = emptyScene("tug", {0, 0}, 12);
    scene.settings.maxJointError = 4e-4;
    const auto place = [](int i) {
        return DVec2{0.8 * (i - kLinks / 2), 0.6 * (std::abs(i - kLinks / 2) - kLinks / 2)};
    };
    addFixed(scene, "left", place(0), {circle(0.1)});
    addFixed(scene, "right", place(kLinks), {circle(0.1)});
    std::string last = "left";
    std::string middle;
    for (int i = 0; i < kLinks; ++i) {
        addLimb(scene, "", place(i), place(i + 1), 0.25).shapes[0].filter.group = -1;
        hinge(scene, last, lastBody(scene), place(i));
        last = lastBody(scene);
        if (i == kLinks / 2) { middle = last; }
    }
    hinge(scene, last, "right", place(kLinks));
    addKinematic(scene, "crank", {0, 0}, {circle(0.1, {0, -1})}).angularVelocity = 2;
    DistanceDescription& tether = rod(scene, "crank", middle, {0, -1}, place(kLinks / 2));
    tether.minLength = 0;
    tether.maxLength = 0.6 * kLinks / 2;
    return scene;
}

constexpr std::array kScenes{
    EffortScene{"hammer", "a weight on a spring strikes a pyramid that a lift carries", 10, hammer},
    EffortScene{"one-of-many", "the same on one of 25 piles", 8, oneOfMany},
    EffortScene{"roller", "piles on a belt pass below a heavy roller, one after the other", 20, roller},
    EffortScene{"tug", "a crank lifts a rope once a turn, and lets it fall", 14, tug},
};

}  // namespace

std::span<const EffortScene> effortScenes() { return kScenes; }

}  // namespace swept::bench
