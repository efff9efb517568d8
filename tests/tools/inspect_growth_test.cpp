#include <gtest/gtest.h>

#ifdef __GLIBC__  // known once a header of the C library has been read
#include <malloc.h>
#endif

#include <algorithm>
#include <cstdint>
#include <ctime>
#include <limits>
#include <string>
#include <tuple>
#include <variant>
#include <vector>

#include <swept/samples/scene_builder.h>
#include <swept/tools/inspect/inspect_scene.h>

// Large scenes: the same findings, and soon.

namespace swept {
namespace {

using build::box;
using build::circle;

/// The same pairs as by asking each for each, and in the order of the scene.
TEST(InspectGrowth, FindsEveryOverlapInTheOrderOfTheScene) {
    constexpr int kDiscs = 300;
    SceneDescription scene = build::scene("crowd", {0, 0}, 10);
    scene.gravity = {0, 0};
    std::uint32_t random = 1;
    const auto next = [&random] {
        random = random * 1664525U + 1013904223U;
        return static_cast<double>(random >> 8U) / (1U << 24U);
    };
    for (int i = 0; i < kDiscs; ++i) {
        const DVec2 place{20 * next(), 20 * next()};
        build::addDynamic(scene, "", place, {circle(0.3 + 0.3 * next())}).type =
            i % 3 == 0 ? SceneBodyType::fixed : SceneBodyType::dynamic;
    }
    std::vector<std::string> expected;
    for (std::size_t a = 0; a < kDiscs; ++a) {
        for (std::size_t b = a + 1; b < kDiscs; ++b) {
            const BodyDescription& first = scene.bodies[a];
            const BodyDescription& second = scene.bodies[b];
            const double apart = length(second.position - first.position);
            const double reach = std::get<CircleGeometry>(first.shapes[0].geometry).radius +
                                 std::get<CircleGeometry>(second.shapes[0].geometry).radius;
            const bool isMoving = first.type == SceneBodyType::dynamic || second.type == SceneBodyType::dynamic;
            if (isMoving && apart < 0.9 * reach) {  // more than the envelope has nothing against
                expected.push_back("body" + std::to_string(b) + " in body" + std::to_string(a));
            }
        }
    }
    std::vector<std::string> found;
    for (const Finding& finding : inspectScene(scene).findings) {
        if (finding.kind != "overlap") { continue; }
        const std::string second = finding.text.substr(0, finding.text.find(' '));
        const std::size_t at = finding.text.find("inside ") + 7;
        const std::string first = finding.text.substr(at, finding.text.find(' ', at) - at);
        const auto indexOf = [](const std::string& name) { return std::stoul(name.substr(4)); };
        const double apart = length(scene.bodies[indexOf(second)].position - scene.bodies[indexOf(first)].position);
        const double reach = std::get<CircleGeometry>(scene.bodies[indexOf(first)].shapes[0].geometry).radius +
                             std::get<CircleGeometry>(scene.bodies[indexOf(second)].shapes[0].geometry).radius;
        if (apart < 0.9 * reach) { found.push_back(second + " in " + first); }
    }
    EXPECT_GT(expected.size(), 100U) << "too few to prove anything";
    EXPECT_EQ(found, expected);
}

/// While it lives, freed memory stays with the process. A page that the system hands out costs as much as its kernel
/// likes, on some machines more than all that is done with the page, and the large scene alone would pay for pages.
class KeepsItsMemory {
public:
    KeepsItsMemory() { set(std::numeric_limits<int>::max(), 0); }
    ~KeepsItsMemory() { set(128 * 1024, 65536); }  // glibc's own defaults
    KeepsItsMemory(const KeepsItsMemory&) = delete;
    KeepsItsMemory& operator=(const KeepsItsMemory&) = delete;

private:
    static void set([[maybe_unused]] int trimThreshold, [[maybe_unused]] int mappedBlocks) {
#ifdef __GLIBC__
        mallopt(M_TRIM_THRESHOLD, trimThreshold);
        mallopt(M_MMAP_MAX, mappedBlocks);
#endif
    }
};

double secondsToInspect(const SceneDescription& scene, int runs) {
    double fastest = std::numeric_limits<double>::infinity();
    for (int i = 0; i < runs; ++i) {
        const std::clock_t start = std::clock();
        EXPECT_FALSE(inspectScene(scene).needs.empty());
        fastest = std::min(fastest, static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC);
    }
    return fastest;
}

/// Eight times as much in a scene takes eight times as long, or some more; by the square it would be 64
/// times.
TEST(InspectGrowth, TakesTimeByTheSceneAndNotByItsSquare) {
    const auto discs = [](int count) {
        SceneDescription scene = build::scene("discs", {0, 0}, 10);
        scene.settings.continuous = SceneContinuous::off;
        build::addFixed(scene, "ground", {0, -1}, {build::chain({{9000, 0}, {-9000, 0}})});
        for (int i = 0; i < count; ++i) {
            ShapeDescription disc = circle(0.5);
            disc.filter.group = -1;
            build::addDynamic(scene, "", {i % 100 * 1.25, i / 100 * 1.25}, {disc});
        }
        return scene;
    };
    const auto ground = [](int count) {
        SceneDescription scene = build::scene("ground", {0, 0}, 10);
        std::vector<DVec2> points;
        for (int i = 0; i < count; ++i) { points.push_back({-0.1 * i, 0.05 * (i % 2)}); }
        build::addFixed(scene, "chain", {0, 0}, {build::chain(points)});
        for (int i = 0; i < count / 8; ++i) { build::addDynamic(scene, "", {-0.7 * i, 2}, {circle(0.1)}); }
        BodyDescription& tower = build::addFixed(scene, "tower", {0, -5}, {});
        for (int i = 0; i < count; ++i) { tower.shapes.push_back(box({5, 0.4}, {0, -static_cast<double>(i)})); }
        return scene;
    };
    const auto rope = [](int count) {
        SceneDescription scene = build::scene("rope", {0, 0}, 10);
        build::addFixed(scene, "0", {0, 0}, {circle(0.1)});
        for (int i = 1; i < count; ++i) {
            const DVec2 place{static_cast<double>(i), 0};
            build::addDynamic(scene, std::to_string(i), place, {circle(0.1)});
            build::rod(scene, std::to_string(i - 1), std::to_string(i), place - DVec2{1, 0}, place);
            scene.joints.back().breakForce = 1;
        }
        return scene;
    };
    constexpr int kFew = 6000;  // fill the caches, too
    const KeepsItsMemory keepsItsMemory;
    for (const auto& [name, few, many] :
         {std::tuple("discs", discs(kFew), discs(8 * kFew)), std::tuple("ground", ground(kFew), ground(8 * kFew)),
          std::tuple("rope", rope(kFew), rope(8 * kFew))}) {
        EXPECT_LT(secondsToInspect(many, 2), 32 * secondsToInspect(few, 3)) << name;
    }
}

}  // namespace
}  // namespace swept
