#include <algorithm>
#include <limits>
#include <vector>

#include "world_support.h"

/// Numbers near the ends of their range: answered as any other, or refused when they are given.

namespace swept::test {
namespace {

constexpr bool kInDouble = sizeof(Real) == sizeof(double);
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

TEST(ExtremeNumbers, LongRaysHitWhereTheyShould) {
    World world = makeWorld();
    addStatic(world, circle(1));
    const Real longest = kInDouble ? Real(1e155L) : Real(1e30L);
    const CastHit hit = world.castRay({-5, 0}, {longest, 0});
    ASSERT_TRUE(hit.hit);
    EXPECT_NEAR(hit.point.x, -1, 1e-6);
    EXPECT_EQ(hit.normal, (Vec2{-1, 0}));
}

/// Its area is a number, its moment of inertia is none in double. (Nobody weighs what stands, until it shall move.)
TEST(ExtremeNumbers, StepIsRefusedWithAMassBeyondAllNumbers) {
    World world = makeWorld();
    const BodyId body = addBody(world, bodyAt(BodyType::fixed, {0, 0}), box(0.5, 0.5));
    const Real huge = sizeof(Real) == 8 ? Real(1e120) : Real(1e15);
    const ShapeId largest = must(world.addShape(body, must(makeBox({huge, huge}))));
    must(world.redefine(body, dynamicAt({0, 0})));
    EXPECT_EQ(world.step(kStep).code, sizeof(Real) == 8 ? StatusCode::missingMass : StatusCode::ok);
    EXPECT_TRUE(isFinite(world.position(body)) && std::isfinite(world.inertia(body)));
    must(world.destroyShape(largest));
    must(world.step(kStep));
    EXPECT_GT(world.inertia(body), 0);
}

/// Already when the shape is given, or its density.
TEST(ExtremeNumbers, ShapesOfDynamicBodiesHaveAWeight) {
    World world = makeWorld();
    const BodyId body = addBody(world, dynamicAt({0, 0}), box(0.5, 0.5));
    const std::uint64_t before = world.stateHash();
    const auto codeOf = [&](const Result<Polygon>& polygon, Real density = 1) {
        ShapeDef def;
        def.density = density;
        return world.addShape(body, must(polygon), def).status();
    };
    if (kInDouble) {
        for (const Real size : {Real(1e120L), Real(1e80L), Real(1e-90L), Real(1e-170L)}) {
            EXPECT_EQ(codeOf(makeBox({size, size})).code, StatusCode::outOfRange);
            EXPECT_STREQ(codeOf(makeCircle({0, 0}, size)).field, "density");
            EXPECT_EQ(codeOf(makeCapsule({-size, 0}, {size, 0}, size)).code, StatusCode::outOfRange);
        }
        EXPECT_EQ(world.stateHash(), before) << "a refusal changes nothing";
        ShapeDef heavy = {};
        heavy.density = Real(1e150L);
        const ShapeId large = must(world.addShape(body, must(makeBox({Real(1e60L), Real(1e60L)}))));
        EXPECT_EQ(world.redefine(large, heavy).code, StatusCode::outOfRange);
        must(world.destroyShape(large));
        EXPECT_TRUE(codeOf(makeCircle({0, 0}, Real(1e120L)), 0).ok()) << "who has no density is not weighed";
    } else {
        EXPECT_TRUE(codeOf(makeBox({Real(4e18L), Real(4e18L)})).ok());
        EXPECT_TRUE(codeOf(makeCircle({0, 0}, Real(1e-15L))).ok());
    }
    must(world.step(kStep));
}

}  // namespace
}  // namespace swept::test
