#include <algorithm>
#include <limits>
#include <vector>

#include "world_support.h"

/// Numbers near the ends of their range: answered as any other, or refused when they are given.

namespace swept::test {
namespace {

constexpr Real kEndless = std::numeric_limits<Real>::infinity();

TEST(ExtremeNumbers, BoxesWithoutEndFindAllShapes) {
    World world = makeWorld();
    std::vector<ShapeId> all;
    for (int i = 0; i < 11; ++i) {
        const BodyType type = i % 3 == 0 ? BodyType::fixed : BodyType::dynamic;
        const BodyId body = must(world.createBody(bodyAt(type, {3.0 * i, 0})));
        all.push_back(must(world.addShape(body, circle(1))));
    }
    run(world, 2);
    const auto countIn = [&world](const Aabb& box) {
        std::vector<ShapeId> found;
        world.queryBox(box, {}, [&found](ShapeId id) { return found.push_back(id), true; });
        EXPECT_TRUE(std::all_of(found.begin(), found.end(), [&world](ShapeId id) { return world.isValid(id); }));
        return found.size();
    };
    EXPECT_EQ(countIn({{-kEndless, -kEndless}, {kEndless, kEndless}}), all.size());
    EXPECT_EQ(countIn({{vec(14, 0).x, -kEndless}, {kEndless, kEndless}}), 6U);
    EXPECT_EQ(countIn({{-kEndless, -kEndless}, {vec(7.1, 0).x, kEndless}}), 3U);
    EXPECT_EQ(countIn({{kEndless, kEndless}, {-kEndless, -kEndless}}), 0U);
    EXPECT_EQ(countIn({{kEndless, kEndless}, {kEndless, kEndless}}), 0U);
}

}  // namespace
}  // namespace swept::test
