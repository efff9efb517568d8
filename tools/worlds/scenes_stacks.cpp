#include <swept/samples/scene_builder.h>

#include "bench_scene.h"

namespace swept::worlds {
namespace {

constexpr double kHalf = 0.5;  // of a box, metres

void addPyramid(SceneDescription& scene, int base, DVec2 corner) {
    for (int i = 0; i < base; ++i) {
        for (int j = i; j < base; ++j) {
            build::addDynamic(scene, "", corner + kHalf * DVec2{i + 1.0 + 2 * (j - i), 2 * i + 1.0},
                              {build::box({kHalf, kHalf})});
        }
    }
}

}  // namespace

BenchScene makeLargePyramid(double size) {
    const int base = scaledSide(100, size);
    BenchScene bench = emptyBench("large-pyramid", 30, 500);
    bench.scene.settings.sleep = false;
    build::addFixed(bench.scene, "ground", {0, -1}, {build::box({100, 1})});
    addPyramid(bench.scene, base, {-kHalf * base, 0});
    return bench;
}

BenchScene makeManyPyramids(double size) {
    constexpr int kBase = 10;
    const int side = scaledSide(20, size);
    const double spacing = 2 * kHalf * (kBase + 1);
    const double width = side * spacing;
    BenchScene bench = emptyBench("many-pyramids", 30, 200);
    bench.scene.settings.sleep = false;
    std::vector<ShapeDescription> floors;
    for (int i = 0; i < side; ++i) {
        floors.push_back(build::segment({-width / 2, i * spacing}, {width / 2, i * spacing}));
    }
    build::addFixed(bench.scene, "floors", {0, 0}, std::move(floors));
    for (int i = 0; i < side; ++i) {
        for (int j = 0; j < side; ++j) {
            addPyramid(bench.scene, kBase, {-width / 2 + j * spacing + kHalf, i * spacing});
        }
    }
    return bench;
}

}  // namespace swept::worlds
