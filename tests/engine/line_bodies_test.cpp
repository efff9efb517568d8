#include <array>
#include <cmath>
#include <cstdint>
#include <string>

#include "../support/random.h"
#include "../support/some_of.h"
#include "world_support.h"

/// Dynamic segments without a radius and pegs, which both are thin: whatever sinks in by half of the peg is on its
/// other side, and pushed out there. So such bodies are swept however slow they are. (Of the first ones below hundreds
/// went through; of planks of 1 mm hardly any did.)

namespace swept::test {
namespace {

class LineBodies : public testing::TestWithParam<Profile> {};

/// Sees a line pass through a peg: it is above in one step and below in the next, and never ended before the peg.
class PegWatch {
public:
    PegWatch(BodyId line, DVec2 peg, double first, double last) : line_(line), peg_(peg), first_(first), last_(last) {}

    /// After every step. @return whether it passed
    bool passed(const World& world, DVec2 peg) {
        peg_ = peg;
        const bool wasOver = isOver_;
        const DVec2 offset = turned(peg_ - world.position(line_), -world.angle(line_));
        isOver_ = offset.x > first_ && offset.x < last_;
        const bool wasAbove = isAbove_;
        isAbove_ = offset.y < 0;
        return wasOver && isOver_ && wasAbove && !isAbove_;
    }
    bool passed(const World& world) { return passed(world, peg_); }

private:
    BodyId line_;
    DVec2 peg_;
    double first_;
    double last_;
    bool isOver_ = false;
    bool isAbove_ = false;
};

Polygon pegOf(Random& random, double half) { return random.chance(0.5) ? circle(half) : box(half, half); }
double thinHalf(Random& random) { return std::pow(10, random.range(-3, -1.5)); }

BodyDef lineAt(DVec2 position) {
    BodyDef def = dynamicAt(position);
    def.mass = 1;
    def.inertia = real(0.1);
    return def;
}

TEST_P(LineBodies, ThatSwingAreStoppedByPegs) {
    int stopped = 0;
    for (std::uint64_t seed = 0; seed < someOf(600U); ++seed) {
        Random random(seed);
        World world = makeWorld(GetParam(), 0);
        const double half = thinHalf(random);
        addStatic(world, pegOf(random, half), material(0));
        const DVec2 pivot{-random.range(0.2, 0.95), 0};
        const BodyId post = must(world.createBody({.position = pivot}));
        BodyDef def = lineAt(pivot);
        def.angle = random.range(0.3, 2);
        def.angularVelocity = -real(random.range(2, 40));
        const BodyId line = addBody(world, def, segment(0, 0, 1, 0));
        must(world.createJoint(RevoluteJointDef{.base = {.bodyA = post, .bodyB = line}, .anchor = pivot}));
        PegWatch watch(line, {}, 0.02, 0.98);
        for (int i = 0; i < 60 && spinOf(world, line) <= 0; ++i) {
            run(world, 1);
            ASSERT_FALSE(watch.passed(world)) << profileName(GetParam()) << ", seed " << seed << ", step " << i;
        }
        stopped += spinOf(world, line) > 0 || world.angle(line) > -0.5 ? 1 : 0;
    }
    EXPECT_GT(stopped, someOf(590));
}

TEST_P(LineBodies, ThatABoxPressesLieOnTheirPegs) {
    for (std::uint64_t seed = 0; seed < someOf(300U); ++seed) {
        Random random(seed);
        World world = makeWorld(GetParam());
        const double half = thinHalf(random);
        const std::array<DVec2, 2> pegs{DVec2{-0.4, 0}, {0.4, 0}};
        for (const DVec2 peg : pegs) { addStatic(world, pegOf(random, half), material(0.6), peg); }
        const BodyId line = addBody(world, lineAt({0, 1.1 * half + 0.001}), segment(-0.5, 0, 0.5, 0));
        const double size = random.range(0.05, 0.3);
        const double x = random.range(-0.2, 0.2);
        BodyDef def = dynamicAt({x, size + random.range(0.02, 2)}, vec(0, -std::pow(10, random.range(-1, 1.5))));
        def.angle = random.range(-1, 1);
        addBody(world, def, box(size, size), material(0.6, 0, std::pow(10, random.range(0, 3))));
        std::array<PegWatch, 2> watches{PegWatch(line, pegs[0], -0.48, 0.48), PegWatch(line, pegs[1], -0.48, 0.48)};
        bool isThrough = false;
        for (int i = 0; i < 120; ++i) {
            run(world, 1);
            for (PegWatch& watch : watches) { isThrough = watch.passed(world) || isThrough; }
        }
        EXPECT_FALSE(isThrough) << profileName(GetParam()) << ", seed " << seed << ", pegs of " << 2 * half;
    }
}

/// The peg comes from below, and lifts what lies on two others.
TEST_P(LineBodies, AreLiftedByAPeg) {
    for (std::uint64_t seed = 0; seed < someOf(300U); ++seed) {
        Random random(seed);
        World world = makeWorld(GetParam());
        const double half = thinHalf(random);
        for (const double x : {-0.4, 0.4}) { addStatic(world, pegOf(random, half), material(0.6), {x, 0}); }
        const BodyId line = addBody(world, lineAt({0, 1.1 * half + 0.001}), segment(-0.5, 0, 0.5, 0));
        const double x = random.range(-0.1, 0.1);
        const BodyId peg = addBody(world, bodyAt(BodyType::kinematic, {x, -0.5}), pegOf(random, half), material(0.6));
        run(world, static_cast<int>(random.range(1, 30)));
        must(world.setVelocity(peg, vec(0, std::pow(10, random.range(-1, 1.5))), real(0)));
        PegWatch watch(line, {}, -0.48, 0.48);
        for (int i = 0; i < 60; ++i) {
            run(world, 1);
            EXPECT_FALSE(watch.passed(world, world.position(peg)))
                << profileName(GetParam()) << ", seed " << seed << ", step " << i;
        }
    }
}

INSTANTIATE_TEST_SUITE_P(InProfile, LineBodies, testing::ValuesIn(kProfiles),
                         [](const auto& given) { return profileName(given.param); });

}  // namespace
}  // namespace swept::test
