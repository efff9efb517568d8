#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

#include <swept/samples/scene_builder.h>

#include "bench_scene.h"

namespace swept::worlds {
namespace {

constexpr std::uint32_t kGround = 1;  // categories
constexpr std::uint32_t kBone = 2;
constexpr double kFrictionTorque = 0.05;  // N·m

/// Heights are above the soles, of the body and of the hinge to its parent; metres.
struct Bone {
    int parent;
    double height;
    double low, high;  // ends of the capsule, from the body
    double radius;
    double hinge;
    double lower, upper;  // angles, in π
    double friction;      // share of the torque
    double damping;
    bool hasFoot;
};

constexpr int kNone = -1;
constexpr std::array<Bone, 11> kBones = {{
    {kNone, 0.95, -0.02, 0.02, 0.095, 0, 0, 0, 1, 0, false},             // 0 hip
    {0, 1.2, -0.135, 0.135, 0.09, 1.0, -0.25, 0, 0.5, 0, false},         // 1 torso
    {1, 1.475, -0.038, 0.039, 0.075, 1.4, -0.3, 0.1, 0.25, 0.1, false},  // 2 head
    {0, 0.775, -0.125, 0.125, 0.06, 0.9, -0.05, 0.4, 1, 0, false},       // 3, 5 thighs
    {3, 0.475, -0.155, 0.125, 0.045, 0.625, -0.5, -0.02, 0.5, 0, true},  // 4, 6 shanks
    {0, 0.775, -0.125, 0.125, 0.06, 0.9, -0.05, 0.4, 1, 0, false},
    {5, 0.475, -0.155, 0.125, 0.045, 0.625, -0.5, -0.02, 0.5, 0, true},
    {1, 1.225, -0.125, 0.125, 0.035, 1.35, -0.1, 0.8, 0.5, 0, false},  // 7, 9 upper arms
    {7, 0.975, -0.125, 0.125, 0.03, 1.1, -0.2, 0.3, 0.1, 0.1, false},  // 8, 10 forearms
    {1, 1.225, -0.125, 0.125, 0.035, 1.35, -0.1, 0.8, 0.5, 0, false},
    {9, 0.975, -0.125, 0.125, 0.03, 1.1, -0.2, 0.3, 0.1, 0.1, false},
}};

std::vector<ShapeDescription> shapesOf(const Bone& bone, int group) {
    ShapeDescription limb = build::withFriction(build::capsule({0, bone.low}, {0, bone.high}, bone.radius), 0.2);
    limb.filter = {kBone, kGround | kBone, -group};
    std::vector<ShapeDescription> shapes{limb};
    if (bone.hasFoot) {
        constexpr double kFootRadius = 0.015;
        const ShapeDescription sole = build::polygon({{-0.03, -0.185}, {0.11, -0.185}, {0.11, -0.16}, {-0.03, -0.14}});
        shapes.push_back(build::withFriction(build::rounded(sole, kFootRadius), 0.2));
        shapes.back().filter = {kBone, kGround, 0};
    }
    return shapes;
}

/// Eleven capsules held by ten hinges, and two feet.
/// @param place  between the soles
/// @param group  > 0; its bones do not collide, nor do those of others of the same group
void addRagdoll(SceneDescription& scene, DVec2 place, int group) {
    std::array<std::string, kBones.size()> names;
    for (std::size_t i = 0; i < kBones.size(); ++i) {
        const Bone& bone = kBones[i];
        build::addDynamic(scene, "", place + DVec2{0, bone.height}, shapesOf(bone, group)).linearDamping = bone.damping;
        names[i] = build::lastBody(scene);
        if (bone.parent == kNone) { continue; }
        RevoluteDescription& hinge =
            build::hinge(scene, names[static_cast<std::size_t>(bone.parent)], names[i], place + DVec2{0, bone.hinge});
        hinge.lower = bone.lower * std::numbers::pi;
        hinge.upper = bone.upper * std::numbers::pi;
        hinge.motorSpeed = 0;
        hinge.maxMotorTorque = bone.friction * kFrictionTorque;
        hinge.hertz = 5;
        hinge.dampingRatio = 0.5;
    }
}

}  // namespace

BenchScene makeJointGrid(double size) {
    constexpr std::uint32_t kCategory = 2;
    const int side = scaledSide(100, size);
    BenchScene bench = emptyBench("joint-grid", 30, 500);
    bench.scene.settings.sleep = false;
    ShapeDescription knot = build::circle(0.4);
    knot.filter = {kCategory, ~kCategory, 0};
    const auto nameAt = [](int k, int i) { return std::to_string(k) + '.' + std::to_string(i); };
    const auto isFixed = [side](int k, int i) { return std::abs(k - side / 2) <= 3 && i == 0; };
    for (int k = 0; k < side; ++k) {
        for (int i = 0; i < side; ++i) {
            BodyDescription& body =
                build::addDynamic(bench.scene, nameAt(k, i), {static_cast<double>(k), static_cast<double>(-i)}, {knot});
            if (isFixed(k, i)) { body.type = SceneBodyType::fixed; }
            if (i > 0) { build::hinge(bench.scene, nameAt(k, i - 1), nameAt(k, i), {k + 0.0, 0.5 - i}); }
            if (k > 0 && !(isFixed(k - 1, i) && isFixed(k, i))) {  // which would hold nothing
                build::hinge(bench.scene, nameAt(k - 1, i), nameAt(k, i), {k - 0.5, -i + 0.0});
            }
        }
    }
    return bench;
}

BenchScene makeRain(double size) {
    constexpr int kRows = 5;
    constexpr int kGroupSize = 5;
    constexpr int kTiles = 500;
    constexpr double kTile = 0.5;
    constexpr double kRowHeight = 45;
    constexpr int kDelay = 8;     // steps between columns
    constexpr int kColumns = 40;  // of turns: a smaller scene leaves the rest of them out
    const int columns = scaledCount(kColumns, size);
    // Until the first column falls anew; where that is nearly all there is, before it does.
    BenchScene bench = emptyBench("rain", columns < kColumns ? 300 : 330, 1000);
    std::vector<ShapeDescription> tiles;
    for (int row = 0; row < kRows; ++row) {
        for (int i = 0; i <= kTiles; ++i) {
            tiles.push_back(build::box({kTile / 2, kTile / 2}, {kTile * (i - kTiles / 2), kRowHeight * row}));
        }
    }
    build::addFixed(bench.scene, "ground", {0, 0}, std::move(tiles));
    for (int column = 0; column < columns; ++column) {
        for (int row = 0; row < kRows; ++row) {
            const double x = kTile * kTiles * ((column + 0.5) / columns - 0.5);
            for (int i = 0; i < kGroupSize; ++i) {
                addRagdoll(bench.scene, {x + 0.5 * i, 40 + kRowHeight * row}, i + 1);
            }
        }
    }
    for (std::uint32_t body = 1; body < bench.scene.bodies.size(); ++body) { bench.absent.push_back(body); }
    bench.script = [columns, cycle = std::max(columns, kColumns)](std::int64_t step) {
        constexpr auto kBodies =
            static_cast<std::uint32_t>(kRows * kGroupSize) * static_cast<std::uint32_t>(kBones.size());
        SceneChange change;
        if (step % kDelay != 0) { return change; }
        const std::int64_t turn = step / kDelay;
        const std::int64_t column = turn % cycle;
        if (column >= columns) { return change; }
        const auto first = 1 + static_cast<std::uint32_t>(column) * kBodies;
        for (std::uint32_t body = first; body < first + kBodies; ++body) { change.added.push_back(body); }
        if (turn != column) { change.removed = change.added; }
        return change;
    };
    return bench;
}

}  // namespace swept::worlds
