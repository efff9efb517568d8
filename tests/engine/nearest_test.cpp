#include "../support/random.h"
#include "world_support.h"

/// The shape that is nearest, by hand and in crowds (query_oracle_test.cpp: in random worlds of all shapes).

namespace swept::test {
namespace {

/// Far from a crowd boxes of growing size go from nothing to all of it at once; within it many overlap.
TEST(Nearest, OfACrowd) {
    Random random(3);
    World world = makeWorld(0.0);
    std::vector<DVec2> places;
    for (int i = 0; i < 500; ++i) {
        const double x = random.range(0, 20);
        places.push_back({x, random.range(0, 20)});
        addStatic(world, circle(0.7), {}, places.back());
    }
    for (int i = 0; i < 300; ++i) {
        const double away = std::exp(random.range(0, 7));
        const double x = random.range(-away, 20 + away);
        const DVec2 from{x, random.range(-away, 20 + away)};
        double wanted = std::numeric_limits<double>::infinity();
        for (const DVec2 place : places) { wanted = std::min(wanted, length(place - from) - 0.7); }
        const NearestShape nearest = world.nearest(from, 1e4);
        ASSERT_TRUE(nearest.found) << "seed 3, query " << i;
        ASSERT_NEAR(static_cast<double>(nearest.distance), wanted, 1e-5 * (1 + away)) << "seed 3, query " << i;
        for (const Real reach : {real(0), std::numeric_limits<Real>::denorm_min(), std::numeric_limits<Real>::min()}) {
            ASSERT_EQ(world.nearest(from, reach).found, nearest.distance <= reach) << "seed 3, query " << i;
        }
    }
}

/// By hand: inside and outside, and what asks for nothing.
TEST(Nearest, ToAPoint) {
    World world = makeWorld();
    const BodyId body = must(world.createBody(bodyAt(BodyType::fixed, {10, 0}, kPi / 2)));
    const ShapeId plank = must(world.addShape(body, box(2, 1)));            // stands on end: 9 … 11, −2 … 2
    const ShapeId ball = must(world.addShape(body, circle(1, vec(5, 0))));  // at (10, 5)
    const NearestShape beside = world.nearest({7, 1}, 100);
    EXPECT_EQ(beside.shape, plank);
    EXPECT_NEAR(static_cast<double>(beside.distance), 2, 1e-6);
    EXPECT_LT(length(beside.point - DVec2{9, 1}), 1e-6);
    EXPECT_LT(length(toDouble(beside.normal) - DVec2{-1, 0}), 1e-6);
    const NearestShape inside = world.nearest({10.75, 1}, 100);
    EXPECT_EQ(inside.shape, plank);
    EXPECT_NEAR(static_cast<double>(inside.distance), -0.25, 1e-6);
    EXPECT_LT(length(inside.point - DVec2{11, 1}), 1e-6);
    EXPECT_LT(length(toDouble(inside.normal) - DVec2{1, 0}), 1e-6);
    EXPECT_EQ(world.nearest({10, 3.6}, 100).shape, ball);
    EXPECT_NEAR(static_cast<double>(world.nearest({10, 5}, 0).distance), -1, 1e-6) << "at its centre";
    EXPECT_TRUE(world.nearest({7, 1}, real(2.001)));
    EXPECT_FALSE(world.nearest({7, 1}, real(1.999)));
    const NearestShape far = world.nearest(ball, {1010, 5});
    EXPECT_NEAR(static_cast<double>(far.distance), 999, 1e-3);
    constexpr Real kNan = std::numeric_limits<Real>::quiet_NaN();
    constexpr Real kInfinity = std::numeric_limits<Real>::infinity();
    for (const Real reach : {real(-1), kNan, kInfinity}) { EXPECT_FALSE(world.nearest({10, 5}, reach)); }
    EXPECT_FALSE(world.nearest({std::numeric_limits<double>::quiet_NaN(), 5}, 1));
    EXPECT_FALSE(world.nearest(Polygon{}, WorldTransform{{10, 5}, {}}, 1));
    EXPECT_FALSE(world.nearest(ball, {10, std::numeric_limits<double>::infinity()}));
    must(world.destroyShape(ball));
    EXPECT_FALSE(world.nearest(ball, {10, 5}));
    EXPECT_EQ(world.nearest({10, 5}, 100).shape, plank);
    EXPECT_TRUE(world.nearest({7, 1}, std::numeric_limits<Real>::max()));
    EXPECT_FALSE(world.nearest({7, 1}, std::numeric_limits<Real>::denorm_min()));
}

}  // namespace
}  // namespace swept::test
