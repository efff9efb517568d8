#include "world_support.h"

/// A chain as a platform that one jumps onto from below: it is there for what comes from above alone.

namespace swept::test {
namespace {

constexpr double kTall = 0.8;  ///< half height of all jumpers

/// A thin platform at y = 0, and one who jumps through it from below.
struct Jump {
    World world = makeWorld();
    ShapeId platform;
    BodyId jumper;

    Jump(const Polygon& shape, double speed) {
        const std::array points{vec(5, 0), vec(-5, 0)};
        platform = must(world.addChain(must(world.createBody({})), points, false, material(0.5)));
        BodyDef def = dynamicAt({0, -1.5}, vec(0.2, speed));
        def.fixedRotation = true;
        jumper = addBody(world, def, shape, material(0.5));
    }
    double height() const { return world.position(jumper).y; }
};

class Platform : public testing::TestWithParam<Polygon> {};
INSTANTIATE_TEST_SUITE_P(Jumpers, Platform,
                         testing::Values(must(makeBox(vec(0.4, kTall))),
                                         must(makeCapsule(vec(0, -0.5), vec(0, 0.5), real(0.3))),
                                         must(makeCircle({0, 0}, real(kTall)))));

TEST_P(Platform, LetsThroughFromBelowAndCarriesFromAbove) {
    for (const double speed : {8.0, 12.0, 60.0}) {
        Jump jump(GetParam(), speed);
        double top = jump.height();
        for (int i = 0; i < 20 * 60; ++i) {
            must(jump.world.step(kStep));
            top = std::max(top, jump.height());
        }
        // As if nothing was there, but that a body half way through may be helped out: its place, not its speed.
        const double free = -1.5 + speed * speed / (2 * kGravity);
        EXPECT_GT(top, free - 0.01) << speed;
        EXPECT_LT(top, free + 0.1) << speed;
        EXPECT_NEAR(jump.height(), kTall, 0.01) << speed;
    }
}

TEST_P(Platform, IsNotThereForWhoDoesNotGetOverIt) {
    for (const double speed : {3.0, 4.0, 5.0}) {
        Jump jump(GetParam(), speed);
        runFor(jump.world, 1);
        EXPECT_NEAR(jump.height(), -1.5 + speed - kGravity / 2, 0.01) << speed;
    }
}

TEST_P(Platform, IsLeftDownwardsByAFilter) {
    Jump jump(GetParam(), 8);
    runFor(jump.world, 3);
    ASSERT_NEAR(jump.height(), kTall, 0.01);
    ShapeDef def = jump.world.definition(jump.platform);
    def.filter.mask = 0;
    must(jump.world.redefine(jump.platform, def));
    runFor(jump.world, 1);
    EXPECT_NEAR(jump.height(), kTall - kGravity / 2, 0.1);
}

}  // namespace
}  // namespace swept::test
