#include <array>
#include <cmath>
#include <cstdint>

#include "../support/random.h"
#include "world_support.h"

/// The end of a chain is solid all around. What leans over it has its middle in front and touches it from behind: a
/// sweep stopped there, and no contact turned it away, so that it hung for a second.

namespace swept::test {
namespace {

class ChainEnds : public testing::TestWithParam<Profile> {};

/// @return seconds that were lost until there was room to fly on
double lostIn(World& world, int steps) {
    double lost = 0;
    for (int i = 0; i < steps; ++i) {
        must(world.step(kStep));
        for (const LostTimeEntry& entry : world.lostTime()) { lost += entry.seconds; }
    }
    return lost;
}

/// As where two pieces of a level that is loaded bit by bit meet.
TEST_P(ChainEnds, ThatMeetAtAPeakHoldNobodyUp) {
    int cases = 0;
    for (std::uint32_t seed = 0; seed < 250; ++seed) {
        Random random(seed);
        World world = makeWorld(GetParam());
        const BodyId level = must(world.createBody({}));
        const double left = random.range(1, 6);
        const double right = random.range(1, 6);
        const std::array<Vec2, 2> fromRight{vec(0.5, -0.5 * right), vec(0, 0)};
        const std::array<Vec2, 2> toLeft{vec(0, 0), vec(-0.5, -0.5 * left)};
        must(world.addChain(level, fromRight, false));
        must(world.addChain(level, toLeft, false));
        BodyDef def = dynamicAt({random.range(-0.2, 0.2), random.range(1, 3)});
        def.angle = random.range(-kPi, kPi);
        const double down = random.range(0, 8);
        def.velocity = vec(random.range(-1, 1), -down);
        def.angularVelocity = real(random.range(-10, 10));
        const BodyId body = addBody(world, def, capsule(0.2, 0.1));
        EXPECT_EQ(lostIn(world, 60), 0) << profileName(GetParam()) << ", seed " << seed;
        cases += world.position(body).y < -1 ? 1 : 0;
    }
    EXPECT_GT(cases, 200) << "they fall past it";
}

TEST_P(ChainEnds, HoldNobodyUpWhoComesPastThemFromBehind) {
    for (std::uint32_t seed = 0; seed < 250; ++seed) {
        Random random(seed);
        World world = makeWorld(GetParam(), 0);
        const std::array<Vec2, 2> line{vec(3, 0), vec(0, 0)};
        must(world.addChain(must(world.createBody({})), line, false));
        const double speed = random.range(3, 60);
        const double way = random.range(0.5, kPi - 0.5);
        const DVec2 velocity{speed * std::cos(way), speed * std::sin(way)};
        const double wait = 1.2 / velocity.y;
        BodyDef def = dynamicAt(DVec2{random.range(-0.4, 0.4), 0} - wait * velocity, toReal(velocity));
        def.angle = random.range(-kPi, kPi);
        def.angularVelocity = real(random.range(-5, 5));
        const BodyId body = addBody(world, def, capsule(0.3, 0.1), material(0.3));
        const int steps = static_cast<int>(2 * wait * kRate) + 2;
        EXPECT_EQ(lostIn(world, steps), 0) << profileName(GetParam()) << ", seed " << seed;
        EXPECT_GT(length(world.velocity(body)), 0.1 * speed) << profileName(GetParam()) << ", seed " << seed;
    }
}

INSTANTIATE_TEST_SUITE_P(OfBoth, ChainEnds, testing::ValuesIn(kProfiles),
                         [](const auto& info) { return profileName(info.param); });

}  // namespace
}  // namespace swept::test
