#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "../support/random.h"
#include "world_support.h"

/// The end of a chain is solid all around. What leans over it has its middle in front and touches it from behind: a
/// sweep stopped there, and no contact turned it away, so that it hung for a second. Where a chain goes on as another
/// one, there is no end.

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

/// Hills from x = -5 to 60 m, in pieces of so many segments.
void addHills(World& world, double amplitude, double length, double step, std::size_t pieces, bool knowEachOther) {
    std::vector<Vec2> points;
    for (double x = 60; x > -5; x -= step) { points.push_back(vec(x, amplitude * std::sin(2 * kPi * x / length))); }
    const BodyId level = must(world.createBody({}));
    for (std::size_t i = 0; i + 1 < points.size(); i += pieces) {
        const std::size_t last = std::min(i + pieces, points.size() - 1);
        ChainNeighbours beyond;
        if (knowEachOther && i > 0) { beyond.before = points[i - 1]; }
        if (knowEachOther && last + 1 < points.size()) { beyond.after = points[last + 1]; }
        must(world.addChain(level, std::span(points).subspan(i, last - i + 1), false, material(0), 0, beyond));
    }
}

/// Where they do not know each other, boxes trip, and balls lose speed, in the valleys between them.
TEST_P(ChainEnds, OfPiecesThatKnowEachOtherAreNone) {
    const Polygon things[] = {box(0.4, 0.3), circle(0.3), capsule(0.3, 0.2)};
    double apart = 0;
    for (std::uint32_t seed = 0; seed < 6; ++seed) {
        for (const Polygon& thing : things) {
            Random random(seed);
            const double amplitude = random.range(0.03, 0.3);
            const double length = random.range(6, 20);
            const double step =
                random.range(0.7, 1.5);  // no shorter than the things: tolerances follow the smaller extent
            const double speed = random.range(3, 12);
            const std::size_t pieces[] = {1000, 4, 1, 4};
            std::array<DVec2, 4> ends;
            for (std::size_t i = 0; i < ends.size(); ++i) {
                World world = makeWorld(GetParam());
                addHills(world, amplitude, length, step, pieces[i], i < 3);
                const BodyId body = addBody(world, dynamicAt({0, 1}, vec(speed, 0)), thing, material(0));
                run(world, 150);
                ends[i] = world.position(body);
            }
            const std::string name = profileName(GetParam()) + ", seed " + std::to_string(seed);
            EXPECT_EQ(ends[1], ends[0]) << name << ", pieces of four segments";
            EXPECT_EQ(ends[2], ends[0]) << name << ", of one";
            apart = std::max(apart, std::hypot(ends[3].x - ends[0].x, ends[3].y - ends[0].y));
        }
    }
    EXPECT_GT(apart, 1) << "there is something to trip over";
}

/// Who comes through one piece from behind comes through the next one, too, as through one chain, also if that is of
/// another body.
TEST_P(ChainEnds, OfPiecesThatKnowEachOtherHoldNobodyUpFromBehind) {
    const Polygon things[] = {box(0.4, 0.2), circle(0.3), capsule(0.3, 0.1)};
    for (std::uint32_t seed = 0; seed < 120; ++seed) {
        Random random(seed);
        World world = makeWorld(GetParam(), 0);
        const Vec2 right = vec(4, 4 * random.range(-0.4, 0.4));
        const Vec2 left = vec(-4, 0);
        const Vec2 origin = seed % 2 == 0 ? Vec2{} : vec(16, 3);
        const BodyId level = must(world.createBody({}));
        const BodyId next = must(world.createBody(bodyAt(BodyType::fixed, -toDouble(origin))));
        const std::array<Vec2, 2> first{right, Vec2{}};
        const std::array<Vec2, 2> second{origin, left + origin};
        must(world.addChain(level, first, false, {}, 0, {.after = left}));
        must(world.addChain(next, second, false, {}, 0, {.before = right + origin}));
        const double speed = std::exp(random.range(1, 4));
        const double way = random.range(0.8, kPi - 0.8);
        const DVec2 velocity{speed * std::cos(way), speed * std::sin(way)};
        const double wait = 1.5 / velocity.y;
        BodyDef def = dynamicAt(DVec2{random.range(-0.6, 0.6), 0} - wait * velocity, toReal(velocity));
        def.angle = random.range(-kPi, kPi);
        const BodyId body = addBody(world, def, things[seed % 3], material(0.3));
        const std::string name = profileName(GetParam()) + ", seed " + std::to_string(seed);
        EXPECT_EQ(lostIn(world, static_cast<int>(2.5 * wait * kRate) + 2), 0) << name;
        EXPECT_NEAR(static_cast<double>(length(world.velocity(body) - def.velocity)), 0, 1e-4 * speed) << name;
    }
}

INSTANTIATE_TEST_SUITE_P(OfBoth, ChainEnds, testing::ValuesIn(kProfiles),
                         [](const auto& profile) { return profileName(profile.param); });

}  // namespace
}  // namespace swept::test
