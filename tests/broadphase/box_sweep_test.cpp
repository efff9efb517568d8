#include <gtest/gtest.h>

#include <swept/broadphase/box_sweep.h>
#include <swept/broadphase/wide_bvh.h>

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
        if (touch == BoxSweep::kNever) { continue; }
        ++met;
        ASSERT_LE(sweep.firstTouch(outer, 1), touch) << "case " << i;
    }
    EXPECT_GT(met, 2000);
}

/// Whether a tree of that one box shows it to a sweep.
bool isShown(WideBvh& tree, const Aabb& box, const Aabb& moving, DVec2 by, Real limit) {
    const Result<ProxyId> proxy = tree.insert(box, ProxyKind::dynamic);
    bool shown = false;
    tree.sweep(moving, by, limit, [&shown](ProxyId, Real far) {
        shown = true;
        return far;
    });
    (void)tree.remove(proxy.value());
    return shown;
}

TEST(BoxSweep, IsFilteredWithoutLoss) {
    Random random(13);
    WideBvh plain(scalarKernels());
    WideBvh wide;
    int met = 0;
    for (int i = 0; i < 20000; ++i) {
        const Family family = kFamilies[below(random, 7)];
        const Aabb box = randomBox(family, random);
        const Aabb moving = randomBox(family, random);
        // Past one of the box's corners, as near as rounding allows; half of the time the way ends there.
        const bool fromBelow = below(random, 2) == 0;
        const DVec2 corner = toDouble(fromBelow ? Vec2{box.lower.x, box.upper.y} : Vec2{box.upper.x, box.lower.y});
        const DVec2 own =
            toDouble(fromBelow ? Vec2{moving.upper.x, moving.lower.y} : Vec2{moving.lower.x, moving.upper.y});
        const DVec2 by = static_cast<double>(1 + below(random, 2)) * (corner - own);
        const Real limit = below(random, 2) == 0 ? Real(1) : Real(0.5);
        const bool isMet = BoxSweep::ofBox(moving, by).firstTouch(box, static_cast<double>(limit)) != BoxSweep::kNever;
        met += isMet ? 1 : 0;
        ASSERT_EQ(isShown(plain, box, moving, by, limit), isMet) << "case " << i;
        ASSERT_EQ(isShown(wide, box, moving, by, limit), isMet) << "case " << i;
    }
    EXPECT_GT(met, 2000);
    EXPECT_LT(met, 18000);
}

}  // namespace
}  // namespace swept::test
