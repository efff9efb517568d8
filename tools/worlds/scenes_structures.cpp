#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include <swept/samples/scene_builder.h>

#include "bench_scene.h"

namespace swept::worlds {
namespace {

std::string knotAt(int column, int row) { return std::to_string(column) + '.' + std::to_string(row); }

/// Of the joints that hold two knots of a net.
DistanceDescription& tie(SceneDescription& scene, const std::string& a, const std::string& b) {
    const auto placeOf = [&scene](const std::string& name) {
        const auto body = std::find_if(scene.bodies.rbegin(), scene.bodies.rend(),
                                       [&name](const BodyDescription& candidate) { return candidate.name == name; });
        return body->position;
    };
    return build::rod(scene, a, b, placeOf(a), placeOf(b));
}

/// Twenty-five disks on springs to their neighbours, those across included.
void addSoftBody(SceneDescription& scene, const std::string& name, DVec2 corner) {
    constexpr int kSide = 5;
    constexpr double kPitch = 0.5;
    const auto nameAt = [&name](int column, int row) { return name + ':' + knotAt(column, row); };
    for (int row = 0; row < kSide; ++row) {
        for (int column = 0; column < kSide; ++column) {
            build::addDynamic(scene, nameAt(column, row), corner + DVec2{kPitch * column, kPitch * row},
                              {build::circle(0.2)});
        }
    }
    constexpr std::pair<int, int> kNeighbours[] = {{1, 0}, {0, 1}, {1, 1}, {-1, 1}};
    for (int row = 0; row < kSide; ++row) {
        for (int column = 0; column < kSide; ++column) {
            for (const auto& [right, up] : kNeighbours) {
                if (column + right < 0 || column + right >= kSide || row + up >= kSide) { continue; }
                DistanceDescription& spring = tie(scene, nameAt(column, row), nameAt(column + right, row + up));
                spring.hertz = 8;
                spring.dampingRatio = 0.3;
            }
        }
    }
}

}  // namespace

/// They fall on each other, ten side by side.
BenchScene makeSoftBodies(double size) {
    constexpr int kWide = 10;
    const int count = scaledCount(200, size);
    BenchScene bench = emptyBench("soft-bodies", 60, 600);
    build::addFixed(bench.scene, "ground", {0, -1}, {build::box({100, 1})});
    for (int i = 0; i < count; ++i) {
        addSoftBody(bench.scene, std::to_string(i), {4.0 * (i % kWide) - 20, 2 + 4.0 * (i / kWide)});
    }
    return bench;
}

/// Hangs from every eighth knot of its upper edge.
BenchScene makeCloth(double size) {
    constexpr double kPitch = 0.5;
    constexpr int kBetweenPins = 8;
    const int side = scaledSide(80, size);
    BenchScene bench = emptyBench("cloth", 60, 600);
    for (int row = 0; row < side; ++row) {
        for (int column = 0; column < side; ++column) {
            BodyDescription& knot = build::addDynamic(bench.scene, knotAt(column, row),
                                                      {kPitch * column, -kPitch * row}, {build::circle(0.1)});
            if (row == 0 && column % kBetweenPins == 0) { knot.type = SceneBodyType::fixed; }
            if (row > 0) { tie(bench.scene, knotAt(column, row - 1), knotAt(column, row)); }
            if (column > 0) { tie(bench.scene, knotAt(column - 1, row), knotAt(column, row)); }
        }
    }
    return bench;
}

/// Of ten boxes each, which are welded; they fall on each other, five side by side.
BenchScene makeBeams(double size) {
    constexpr int kWide = 5;
    constexpr int kBoxes = 10;
    const int count = scaledCount(200, size);
    BenchScene bench = emptyBench("beams", 60, 600);
    build::addFixed(bench.scene, "ground", {0, -1}, {build::box({300, 1})});
    for (int i = 0; i < count; ++i) {
        const DVec2 start{12.0 * (i % kWide) + 0.7 * (i / kWide), 1 + 1.5 * (i / kWide)};
        std::string last;
        for (int k = 0; k < kBoxes; ++k) {
            build::addDynamic(bench.scene, "", start + DVec2{static_cast<double>(k), 0}, {build::box({0.5, 0.25})});
            std::string box = build::lastBody(bench.scene);
            if (k > 0) { build::weld(bench.scene, last, box, start + DVec2{k - 0.5, 0}); }
            last = std::move(box);
        }
    }
    return bench;
}

/// Let go level, side by side; their links pass through everything, so that nothing is solved but hinges.
BenchScene makeRopes(double size) {
    constexpr int kLinks = 20;
    constexpr double kLink = 0.5;  // metres
    const int count = scaledCount(200, size);
    BenchScene bench = emptyBench("ropes", 30, 600);
    build::addFixed(bench.scene, "beam", {0, 0}, {build::box({1, 1})});
    for (int i = 0; i < count; ++i) {
        const DVec2 start{12.0 * (i % 20), 12.0 * (i / 20)};
        std::string last = "beam";
        for (int k = 0; k < kLinks; ++k) {
            ShapeDescription link = build::capsule({-0.4 * kLink, 0}, {0.4 * kLink, 0}, 0.06);
            link.filter.mask = 0;
            build::addDynamic(bench.scene, "", start + DVec2{(k + 0.5) * kLink, 0}, {link});
            std::string name = build::lastBody(bench.scene);
            build::hinge(bench.scene, last, name, start + DVec2{k * kLink, 0});
            last = std::move(name);
        }
    }
    return bench;
}

}  // namespace swept::worlds
