#include <cstdint>

#include "../support/random.h"
#include "joint_support.h"

/// What joints tell of their speeds, against how far they get in a short step.

namespace swept::test {
namespace {

constexpr double kTick = 1.0 / 4096;

/// Two bodies that fly about a frame which flies and turns itself, with one joint between them.
struct Pair {
    World world = makeWorld(0);
    BodyId a;
    BodyId b;

    explicit Pair(std::uint64_t seed) {
        Random random(seed);
        const auto moving = [&random](DVec2 from, DVec2 to) {
            BodyDef def = dynamicAt({random.range(from.x, to.x), random.range(from.y, to.y)});
            def.velocity = {real(random.range(-2, 2)), real(random.range(-2, 2))};
            def.angularVelocity = real(random.range(-3, 3));
            return def;
        };
        a = addBody(world, moving({-1, -1}, {1, 1}), box(1, 0.3), material(0, 0, 50));
        b = addBody(world, moving({3, -1}, {4, 1}), box(0.5, 0.2), material(0));
    }
};

template <class Definition>
void expectSpeeds(std::uint64_t seed, Definition def) {
    SCOPED_TRACE(testing::Message() << "seed " << seed << ", joint " << static_cast<int>(AnyJointDef(def).index()));
    Pair pair(seed);
    def.base = between(pair.a, pair.b);
    World& world = pair.world;
    const JointId joint = must(world.createJoint(def));
    for (int i = 0; i < 64; ++i) {  // what it holds has found its speed by then
        ASSERT_TRUE(world.step(kTick).ok());
    }
    const double speed = static_cast<double>(world.jointSpeed(joint));
    const double turning = static_cast<double>(world.jointAngularVelocity(joint));
    const double place = static_cast<double>(world.jointTranslation(joint));
    const double angle = world.jointAngle(joint);
    for (int i = 0; i < 4; ++i) { ASSERT_TRUE(world.step(kTick).ok()); }
    const double after = static_cast<double>(world.jointSpeed(joint));
    const double turningAfter = static_cast<double>(world.jointAngularVelocity(joint));
    // The mean of both ends, as a chord has it, but for the third order of its time.
    const double way = static_cast<double>(world.jointTranslation(joint)) - place;
    EXPECT_NEAR(way / (4 * kTick), (speed + after) / 2, 0.01);
    EXPECT_NEAR((world.jointAngle(joint) - angle) / (4 * kTick), (turning + turningAfter) / 2, 0.01);
}

TEST(JointSpeed, IsHowFastPlacesAndAnglesGrow) {
    for (std::uint64_t seed = 1; seed <= 20; ++seed) {
        PrismaticJointDef slider;
        slider.anchor = {1, 0.5};
        slider.axis = {0.6, 0.8};
        expectSpeeds(seed, slider);
        WheelJointDef wheel;
        wheel.anchor = {2, 0.5};
        wheel.axis = {-0.8, 0.6};
        expectSpeeds(seed, wheel);
        RevoluteJointDef hinge;
        hinge.anchor = {1.5, 0};
        expectSpeeds(seed, hinge);
        DistanceJointDef spring;
        spring.anchorA = {0.5, 0.2};
        spring.anchorB = {3.2, -0.2};
        spring.spring = Spring{real(0.5), 0};
        expectSpeeds(seed, spring);
        MouseJointDef mouse;
        mouse.target = {3.5, 0.1};
        mouse.spring = Spring{real(0.5), 0};
        expectSpeeds(seed, mouse);
    }
}

/// Where nothing is to be told: no joint, and anchors that coincide.
TEST(JointSpeed, IsNothingWithoutADirection) {
    World world = makeWorld();
    EXPECT_EQ(world.jointSpeed({}), 0);
    EXPECT_EQ(world.jointAngularVelocity({}), 0);
    DistanceJointDef rope;
    rope.base = between(anchorOf(world), addBody(world, dynamicAt({0, 0}, vec(1, 2)), box(1, 1)));
    rope.limits = LengthLimits{0, 5};
    EXPECT_EQ(world.jointSpeed(must(world.createJoint(rope))), 0);
}

}  // namespace
}  // namespace swept::test
