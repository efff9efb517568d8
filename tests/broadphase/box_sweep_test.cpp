#include <gtest/gtest.h>

#include <swept/broadphase/box_sweep.h>

#include "model.h"

namespace swept::test {
namespace {

TEST(BoxSweep, TouchesExactlyAtTheEdges) {
    const Aabb wall = {{4, -1}, {5, 1}};
    const BoxSweep ray = BoxSweep::ofRay({0, 0}, {8, 0});
    EXPECT_NEAR(ray.firstTouch(wall, 1), 0.5, 1e-12);
    EXPECT_NEAR(ray.firstTouch(wall, 0.5), 0.5, 1e-12) << "the limit itself counts";
    EXPECT_EQ(ray.firstTouch(wall, 0.4999), BoxSweep::kNever);
    EXPECT_NE(BoxSweep::ofRay({0, 1}, {8, 0}).firstTouch(wall, 1), BoxSweep::kNever) << "grazing along the upper edge";
    EXPECT_EQ(BoxSweep::ofRay({0, 1.0001}, {8, 0}).firstTouch(wall, 1), BoxSweep::kNever);
    EXPECT_EQ(BoxSweep::ofRay({4.5, 0}, {0, 0}).firstTouch(wall, 0), 0) << "a ray of length 0 is a point";
    EXPECT_EQ(BoxSweep::ofRay({6, 0}, {1, 0}).firstTouch(wall, 1e9), BoxSweep::kNever) << "it lies behind";
    EXPECT_NEAR(BoxSweep::ofBox({{0, 0}, {1, 1}}, {6, 0}).firstTouch(wall, 1), 0.5, 1e-12);
}

TEST(BoxSweep, NeverLosesACornerItGoesThrough) {
    // The ray is aimed at the corner of a box; both are exact doubles, the quotient is not.
    Random random(11);
    for (int i = 0; i < 20000; ++i) {
        const DVec2 direction = {std::floor(random.range(1, 1 << 20)), std::floor(random.range(1, 1 << 20))};
        const double scale = std::ldexp(1.0, -static_cast<int>(below(random, 12)));
        // The ray passes through (direction · scale) exactly: the lower right corner of the box, and nothing more of
        // it.
        const auto x = static_cast<Real>(direction.x * scale);
        const auto y = static_cast<Real>(direction.y * scale);
        ASSERT_EQ(static_cast<double>(x), direction.x * scale);
        const Aabb box = {{x - 1, y}, {x, y + 1}};
        ASSERT_EQ(static_cast<double>(box.upper.x), direction.x * scale);
        const Aabb above = {{x / 2, y}, {x, 2 * y}};
        ASSERT_NE(BoxSweep::ofRay({0, 0}, direction).firstTouch(above, 1), BoxSweep::kNever) << "case " << i;
        ASSERT_NE(BoxSweep::ofRay({0, 0}, direction).firstTouch(above, scale), BoxSweep::kNever) << "case " << i;
    }
}

TEST(BoxSweep, MeetsEveryBoxAroundABoxItMeets) {
    Random random(12);
    int met = 0;
    for (int i = 0; i < 20000; ++i) {
        const Family family = kFamilies[below(random, 7)];
        const Aabb inner = randomBox(family, random);
        const Aabb outer = hullOf(inner, randomBox(family, random));
        const Aabb target = randomBox(family, random);
        const Aabb moving = randomBox(family, random);
        const DVec2 by = {static_cast<double>(target.lower.x) - static_cast<double>(moving.lower.x),
                          static_cast<double>(target.lower.y) - static_cast<double>(moving.lower.y)};
        const BoxSweep sweep = BoxSweep::ofBox(moving, by);
        const double touch = sweep.firstTouch(inner, 1);
        if (touch == BoxSweep::kNever) {
            continue;
        }
        ++met;
        ASSERT_LE(sweep.firstTouch(outer, 1), touch) << "case " << i;
    }
    EXPECT_GT(met, 2000);
}

}  // namespace
}  // namespace swept::test
