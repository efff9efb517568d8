#include <array>
#include <cmath>

#include <swept/samples/scene_builder.h>

#include "threads_bench.h"

namespace swept::worlds {
namespace {

using namespace build;

constexpr int kRows = 10;  ///< of a pyramid: 55 boxes
constexpr int kWarmSteps = 20;

BenchScene emptyGrowing(const char* name) {
    BenchScene bench;
    bench.scene = build::scene(name, {0, 5}, 20);
    bench.scene.settings.sleep = false;
    bench.warmSteps = kWarmSteps;
    return bench;
}

BenchScene pyramids(int bodies) {
    BenchScene bench = emptyGrowing("pyramids");
    addFixed(bench.scene, "ground", {0, -0.5}, {box({2.0 * bodies + 20, 0.5})});
    int made = 0;
    for (int pyramid = 0; made < bodies; ++pyramid) {
        for (int row = 0; row < kRows && made < bodies; ++row) {
            for (int i = 0; i < kRows - row && made < bodies; ++i, ++made) {
                addDynamic(bench.scene, "", {12.0 * pyramid + i + 0.5 * row, 0.5 + row}, {box({0.5, 0.5})});
            }
        }
    }
    return bench;
}

BenchScene heap(int bodies) {
    BenchScene bench = emptyGrowing("heap");
    const int columns = static_cast<int>(std::sqrt(2.0 * bodies)) + 1;
    const double width = 1.2 * columns;
    addFixed(bench.scene, "bowl", {0, 0},
             {box({width, 0.5}, {0, -0.5}), box({0.5, width}, {-0.6 * width - 1, width}),
              box({0.5, width}, {0.6 * width + 1, width})});
    for (int i = 0; i < bodies; ++i) {
        const int row = i / columns;
        const DVec2 place{1.2 * (i % columns) - 0.6 * width + 0.1 * (row % 2), 1 + 1.2 * row};
        const std::array<ShapeDescription, 3> shapes{box({0.5, 0.4}), circle(0.5), capsule({-0.3, 0}, {0.3, 0}, 0.2)};
        addDynamic(bench.scene, "", place, {shapes[static_cast<std::size_t>(i) % shapes.size()]});
    }
    return bench;
}

BenchScene swarm(int bodies) {
    BenchScene bench = emptyGrowing("swarm");
    bench.scene.gravity = {0, 0};
    const double half = 2 * std::sqrt(static_cast<double>(bodies)) + 2;
    const auto wall = [](DVec2 halfSize, DVec2 center) { return withRestitution(box(halfSize, center), 1); };
    addFixed(bench.scene, "walls", {0, 0},
             {wall({half, 1}, {0, -half}), wall({half, 1}, {0, half}), wall({1, half}, {-half, 0}),
              wall({1, half}, {half, 0})});
    Dice dice(7);
    for (int i = 0; i < bodies; ++i) {
        const DVec2 place{dice.range(2 - half, half - 2), dice.range(2 - half, half - 2)};
        addDynamic(bench.scene, "", place, {withRestitution(circle(0.3), 1)}).velocity = {dice.range(-60, 60),
                                                                                          dice.range(-60, 60)};
    }
    return bench;
}

}  // namespace

std::span<const GrowingScene> growingScenes() {
    static constexpr std::array<GrowingScene, 3> kScenes{{{"pyramids", pyramids}, {"heap", heap}, {"swarm", swarm}}};
    return kScenes;
}

}  // namespace swept::worlds
