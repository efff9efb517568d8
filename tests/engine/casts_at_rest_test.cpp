#include <array>
#include <vector>

#include "world_support.h"

/// Shapes that are cast from where they stand: along the ground and away from it they are free, into it they are
/// stopped at once, by its normal.

namespace swept::test {
namespace {

enum class Ground { box, tiles, chain };
constexpr std::array kGrounds{Ground::box, Ground::tiles, Ground::chain};
constexpr std::uint32_t kLevel = 2;

/// Its top goes through the origin, at an angle to the horizontal; seams every metre.
void addGround(World& world, Ground kind, double angle) {
    const BodyId body = must(world.createBody(bodyAt(BodyType::fixed, {}, angle)));
    ShapeDef def = material(1);
    def.filter.category = kLevel;
    if (kind == Ground::box) { must(world.addShape(body, must(makeBox(vec(20, 1), vec(0, -1))), def)); }
    if (kind == Ground::tiles) {
        for (int x = -20; x < 20; ++x) {
            must(world.addShape(body, must(makeBox(vec(0.5, 0.5), vec(x + 0.5, -0.5))), def));
        }
    }
    if (kind == Ground::chain) {
        std::vector<Vec2> points;
        for (int x = 20; x >= -20; --x) { points.push_back(vec(x, 0)); }
        must(world.addChain(body, points, false, def));
    }
}

struct Stander {
    const char* name;
    Polygon polygon;
    double height;  ///< of its origin above the ground
};
std::vector<Stander> standers() {
    return {{"circle", circle(0.5), 0.5},
            {"box", box(0.5, 0.25), 0.25},
            {"capsule that lies", capsule(0.4, 0.3), 0.3},
            {"capsule that stands", must(makeCapsule(vec(0, -0.4), vec(0, 0.4), real(0.3))), 0.7}};
}

const QueryFilter kSeesLevel{.mask = kLevel};

/// Ways of 5 m in 16 directions; the first goes along the ground.
std::vector<DVec2> waysFrom(double angle) {
    std::vector<DVec2> ways;
    for (int k = 0; k < 16; ++k) { ways.push_back(turned(turned({5, 0}, k * kPi / 8), angle)); }
    return ways;
}

void expectFreeButInto(const World& world, const Polygon& polygon, const WorldTransform& from, double angle,
                       const std::string& what) {
    const DVec2 up = turned({0, 1}, angle);
    for (const DVec2 way : waysFrom(angle)) {
        const CastHit hit = world.castShape(polygon, from, toReal(way), kSeesLevel);
        int visits = 0;
        world.castShapeAll(polygon, from, toReal(way), kSeesLevel, [&visits](const CastHit&) {
            ++visits;
            return Real(1);
        });
        const bool leadsInto = dot(way, up) < -1e-3;
        EXPECT_EQ(hit.hit, leadsInto) << what << ", way " << way.x << ' ' << way.y;
        EXPECT_EQ(visits > 0, leadsInto) << what << ", way " << way.x << ' ' << way.y;
        if (!hit.hit || !leadsInto) { continue; }
        EXPECT_EQ(hit.fraction, 0) << what;
        EXPECT_EQ(hit.wayOut, Vec2{}) << what;
        EXPECT_LT(dot(toDouble(hit.normal), way), 0) << what;
        // Exactly diagonally into the corner of a tile each of its sides is as good as the other.
        const bool isDiagonal = std::abs(dot(way, up) * dot(way, up) - 12.5) < 1e-6;
        if (!isDiagonal) { EXPECT_LT(length(toDouble(hit.normal) - up), 1e-5) << what; }
    }
}

TEST(CastsAtRest, AreFreeButIntoWhatHoldsThem) {
    for (const Profile profile : {Profile::accurate, Profile::fast}) {
        for (const Ground ground : kGrounds) {
            for (const double angle : {0.0, 0.35}) {
                for (const Stander& stander : standers()) {
                    for (const double along : {0.0, 0.001, 0.37, 0.5, 1.49997}) {
                        WorldSettings settings = awakeSettings(profile);
                        World world = makeWorld(settings);
                        addGround(world, ground, angle);
                        BodyDef def = dynamicAt(turned({along, stander.height}, angle));
                        def.angle = angle;
                        def.fixedRotation = true;
                        const BodyId body = addBody(world, def, stander.polygon, material(1, 0, 100));
                        run(world, 60);
                        expectFreeButInto(world, stander.polygon, world.transform(body), angle,
                                          std::string(stander.name) + " at " + std::to_string(along));
                    }
                }
            }
        }
    }
}

/// As deep as a heap may press what lies below it, and as far off as casts stop.
TEST(CastsAtRest, FromAnyDepthThatContactsHold) {
    for (const Ground ground : kGrounds) {
        for (const Stander& stander : standers()) {
            World world = makeWorld();
            addGround(world, ground, 0);
            for (const double gap : {5e-4, 1e-4, 1e-6, 0.0, -1e-7, -1e-6, -1e-4, -1e-3, -1e-2, -0.05}) {
                for (const double x : {0.37, 0.50001, 3.0}) {
                    expectFreeButInto(world, stander.polygon, {{x, stander.height + gap}, {}}, 0,
                                      std::string(stander.name) + " over a gap of " + std::to_string(gap));
                }
            }
        }
    }
}

TEST(CastsAtRest, WhatIsDeeperIsInsideAndToldTheWayOut) {
    World world = makeWorld();
    addGround(world, Ground::box, 0);
    for (const Stander& stander : standers()) {
        const WorldTransform from{{3, stander.height - 0.2}, {}};
        for (const DVec2 way : waysFrom(0)) {
            const CastHit hit = world.castShape(stander.polygon, from, toReal(way), kSeesLevel);
            ASSERT_TRUE(hit.hit) << stander.name;
            EXPECT_EQ(hit.fraction, 0) << stander.name;
            EXPECT_EQ(hit.normal, Vec2{}) << stander.name;
            EXPECT_LT(length(toDouble(hit.wayOut) - DVec2{0, 0.2}), 1e-5) << stander.name;
        }
    }
}

/// How far can I walk, and is there headroom? Up to a wall and a ceiling, over forty seams.
TEST(CastsAtRest, SeeAsFarAsTheFirstThing) {
    for (const Ground ground : kGrounds) {
        for (const Stander& stander : standers()) {
            World world = makeWorld();
            addGround(world, ground, 0);
            ShapeDef level;
            level.filter.category = kLevel;
            addStatic(world, box(1, 3), level, {16, 3});  // from x = 15 on
            addStatic(world, box(20, 1), level, {0, 5});  // from y = 4 on
            const BodyId body = addBody(world, dynamicAt({-14.3, stander.height}), stander.polygon, material(1));
            run(world, 60);
            const Aabb bounds = boundsOf(stander.polygon, world.transform(body));
            const double ahead = 15 - static_cast<double>(bounds.upper.x);
            const double above = 4 - static_cast<double>(bounds.upper.y);
            const CastHit wall = world.castShape(stander.polygon, world.transform(body), vec(40, 0), kSeesLevel);
            const CastHit ceiling = world.castShape(stander.polygon, world.transform(body), vec(0, 8), kSeesLevel);
            ASSERT_TRUE(wall.hit && ceiling.hit) << stander.name;
            EXPECT_NEAR(40 * static_cast<double>(wall.fraction), ahead, 2e-3) << stander.name;
            EXPECT_LT(length(toDouble(wall.normal) - DVec2{-1, 0}), 1e-5) << stander.name;
            EXPECT_NEAR(8 * static_cast<double>(ceiling.fraction), above, 3e-3) << stander.name;
            EXPECT_LT(length(toDouble(ceiling.normal) - DVec2{0, -1}), 1e-5) << stander.name;
        }
    }
}

/// In a corner the wall stops what goes to it, and neither the wall nor the ground what goes up along it.
TEST(CastsAtRest, InACornerEachSideStopsItsOwn) {
    World world = makeWorld();
    addGround(world, Ground::chain, 0);
    ShapeDef level;
    level.filter.category = kLevel;
    const BodyId walls = addStatic(world, box(1, 3), level, {2, 3});
    const WorldTransform from{{0.5 + 1e-4, 0.5 - 1e-3}, {}};
    EXPECT_FALSE(world.castShape(box(0.5, 0.5), from, vec(0, 5), kSeesLevel).hit);
    EXPECT_FALSE(world.castShape(box(0.5, 0.5), from, vec(-5, 0), kSeesLevel).hit);
    EXPECT_FALSE(world.castShape(box(0.5, 0.5), from, vec(-5, 5), kSeesLevel).hit);
    const CastHit wall = world.castShape(box(0.5, 0.5), from, vec(5, 1), kSeesLevel);
    EXPECT_EQ(wall.body, walls);
    EXPECT_EQ(wall.fraction, 0);
    EXPECT_LT(length(toDouble(wall.normal) - DVec2{-1, 0}), 1e-5);
}

}  // namespace
}  // namespace swept::test
