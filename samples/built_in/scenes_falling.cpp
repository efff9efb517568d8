#include "../scene_builder.h"
#include "builtin_scenes.h"

/// Free bodies that fall, pile up, bounce and slide.

namespace swept::scenes {
namespace {

using namespace build;

// All of about the same size (0.5 m from the centre to the rim), so that they fit a grid.
ShapeDescription shapeOfKind(int kind) {
    switch (kind % 7) {
        case 0:
            return box({0.4, 0.3});
        case 1:
            return circle(0.42);
        case 2:
            return capsule({-0.3, 0}, {0.3, 0}, 0.2);
        case 3:
            return polygon({{-0.45, -0.3}, {0.45, -0.3}, {0, 0.5}});
        case 4:
            return polygon({{0.5, 0}, {0.25, 0.433}, {-0.25, 0.433}, {-0.5, 0}, {-0.25, -0.433}, {0.25, -0.433}});
        case 5:
            return rounded(box({0.25, 0.25}), 0.12);
        default:
            return polygon({{-0.45, -0.2}, {0.3, -0.35}, {0.45, 0.1}, {-0.1, 0.45}});
    }
}

void addTray(SceneDescription& scene, double halfWidth, double wallHeight) {
    addFixed(scene, "tray", {0, 0},
             {box({halfWidth, 0.2}, {0, -0.2}), box({0.2, wallHeight / 2}, {-halfWidth - 0.2, wallHeight / 2 - 0.4}),
              box({0.2, wallHeight / 2}, {halfWidth + 0.2, wallHeight / 2 - 0.4})});
}

}  // namespace

SceneDescription fallingShapes() {
    SceneDescription scene = build::scene("falling shapes", {0, 3.9}, 10);
    addTray(scene, 7, 3.5);
    Dice dice(2);
    for (int row = 0; row < 5; ++row) {
        for (int column = 0; column < 9; ++column) {
            // Odd rows are shifted by half a column: they fall onto the gaps.
            const double x = 1.3 * (column - 4) + (row % 2 == 0 ? 0.0 : 0.35);
            BodyDescription& body = addDynamic(scene, "", {x, 2.5 + 1.3 * row}, {shapeOfKind(9 * row + column)});
            body.angle = dice.range(-3, 3);
            body.velocity = {dice.range(-0.5, 0.5), 0};
            body.angularVelocity = dice.range(-2, 2);
        }
    }
    return scene;
}

SceneDescription pyramid() {
    constexpr int kRows = 20;
    constexpr double kHalf = 0.22;
    SceneDescription scene = build::scene("pyramid", {0, 4.1}, 10.6);
    addFixed(scene, "floor", {0, 0}, {box({70, 0.2}, {0, -0.2})});
    for (int row = 0; row < kRows; ++row) {
        const int count = kRows - row;
        for (int i = 0; i < count; ++i) {
            const double x = (i - 0.5 * (count - 1)) * 2.2 * kHalf;
            addDynamic(scene, "", {x, (2 * row + 1) * kHalf}, {box({kHalf, kHalf})});
        }
    }
    BodyDescription& ball = addDynamic(scene, "ball", {-64, 0.8}, {withDensity(circle(0.8), 20)});
    ball.velocity = {12, 0};  // rolls in after five seconds of standing still
    ball.angularVelocity = -15;
    return scene;
}

SceneDescription tallStack() {
    constexpr int kFloors = 20;
    SceneDescription scene = build::scene("tall stack", {0, 4.6}, 12);
    addFixed(scene, "floor", {0, 0}, {box({9, 0.2}, {0, -0.2})});
    for (int i = 0; i < kFloors; ++i) {
        addDynamic(scene, "box" + std::to_string(i), {-5, 0.5 * i + 0.25}, {box({0.25, 0.25})});
    }
    for (int i = 0; i < kFloors / 2; ++i) {  // a ladder: each plank lies on two blocks
        const double y = 0.4 * i + 0.1;
        addDynamic(scene, "", {0, y + 0.2}, {box({1.1, 0.1})});
        addDynamic(scene, "", {-0.8, y}, {box({0.2, 0.1})});
        addDynamic(scene, "", {0.8, y}, {box({0.2, 0.1})});
    }
    double density = 1;
    for (int i = 0; i < 5; ++i) {  // the hard way round: each box twice as dense as the one below
        addDynamic(scene, "heavy" + std::to_string(i), {5, i + 0.5}, {withDensity(box({0.5, 0.5}), density)});
        density *= 2;
    }
    return scene;
}

SceneDescription bouncingBalls() {
    SceneDescription scene = build::scene("bouncing balls", {0, 3.5}, 9.5);
    addFixed(scene, "floor", {0, 0}, {box({9, 0.2}, {0, -0.2}), box({0.2, 2}, {-8, 2}), box({0.2, 2}, {8, 2})});
    for (int i = 0; i <= 8; ++i) {
        const double x = 1.6 * (i - 4);
        const double restitution = i / 8.0;
        addDynamic(scene, "ball" + std::to_string(i), {x, 7}, {withRestitution(circle(0.35), restitution)});
        BodyDescription& die =
            addDynamic(scene, "die" + std::to_string(i), {x, 3}, {withRestitution(box({0.2, 0.2}), restitution)});
        die.angle = 0.3;  // lands on a corner, and spins off
    }
    // One negative group: they pass through each other, so that each shows its own restitution and nothing else.
    for (BodyDescription& body : scene.bodies) {
        if (body.type == SceneBodyType::dynamic) { body.shapes[0].filter.group = -1; }
    }
    return scene;
}

SceneDescription frictionRamp() {
    SceneDescription scene = build::scene("friction ramp", {0, 2.9}, 9);
    // A slope of 3 in 4. Friction mixes as √(μ₁μ₂), so a box stays put when its own μ is above 0.75, as the ramp's is.
    const std::vector<DVec2> ramp{{-7, 0}, {1, 0}, {-7, 6}};
    addFixed(scene, "ramp", {0, 0}, {withFriction(polygon(ramp), 0.75)});
    addFixed(scene, "floor", {0, 0}, {box({9, 0.2}, {0, -0.2}), box({0.2, 0.8}, {8.5, 0.8})});
    constexpr double kSlope = -0.6435011087932844;  // −atan(3/4)
    const DVec2 along{0.8, -0.6};
    const DVec2 normal{0.6, 0.8};
    const double frictions[] = {1.0, 0.8, 0.7, 0.5, 0.2};
    for (int i = 0; i < 5; ++i) {
        const DVec2 foot = DVec2{-7, 6} + (1.2 + 1.5 * i) * along;
        BodyDescription& body = addDynamic(scene, "box" + std::to_string(i), foot + 0.3 * normal,
                                           {withFriction(box({0.4, 0.3}), frictions[i])});
        body.angle = kSlope;
    }
    return scene;
}

SceneDescription dominoes() {
    SceneDescription scene = build::scene("dominoes", {0, 2.4}, 8.6);
    addFixed(scene, "floor", {0, 0}, {box({9, 0.2}, {0, -0.2})});
    addFixed(scene, "shelf", {0, 3}, {box({6, 0.1}, {0, -0.1})});
    for (int i = 0; i < 22; ++i) {
        addDynamic(scene, "lower" + std::to_string(i), {-4.8 + 0.5 * i, 0.55}, {box({0.07, 0.55})});
    }
    for (int i = 0; i < 20; ++i) {
        addDynamic(scene, "upper" + std::to_string(i), {4 - 0.45 * i, 3.5}, {box({0.06, 0.5})});
    }
    BodyDescription& left = addDynamic(scene, "left", {-6.6, 0.3}, {circle(0.3)});
    left.velocity = {3, 0};
    left.angularVelocity = -10;
    BodyDescription& right = addDynamic(scene, "right", {5.6, 3.3}, {circle(0.3)});
    right.velocity = {-3, 0};
    right.angularVelocity = 10;
    return scene;
}

}  // namespace swept::scenes
