#include <array>

#include "../support/random.h"
#include "joint_support.h"

/// What was put to sleep, or held, one by one or made something else meanwhile, and then is met.

namespace swept::test {
namespace {

WorldSettings weightless() {
    WorldSettings settings;
    settings.gravity = {};
    return settings;
}

class SleepersRow : public testing::TestWithParam<double> {};
INSTANTIATE_TEST_SUITE_P(Gaps, SleepersRow, testing::Values(0.02, 0.04, 0.3));

/// Four boxes that touch, each put to sleep by itself, and a fifth that hits the first: no momentum goes to ground.
TEST_P(SleepersRow, TakeTheMomentumOfWhatHitsThem) {
    World world = makeWorld(weightless());
    std::vector<BodyId> bodies;
    for (int i = 0; i < 4; ++i) { bodies.push_back(addBody(world, dynamicAt({1.0 * i, 0}), box(0.5, 0.5))); }
    run(world, 3);
    for (const BodyId body : bodies) { must(world.setAwake(body, false)); }
    run(world, 1);
    bodies.push_back(addBody(world, dynamicAt({-1 - GetParam(), 0}, vec(3, 0)), box(0.5, 0.5)));
    run(world, 60);
    EXPECT_NEAR(momentumOf(world, bodies).x, 3, 1e-3);
}

/// The same of two that are welded: what hangs on what was hit wakes with it.
TEST_P(SleepersRow, WakeAcrossJoints) {
    World world = makeWorld(weightless());
    std::vector<BodyId> bodies{addBody(world, dynamicAt({0, 0}), box(0.5, 0.5)),
                               addBody(world, dynamicAt({1.5, 0}), box(0.5, 0.5))};
    WeldJointDef def;
    def.base = between(bodies[0], bodies[1]);
    def.anchor = {0.75, 0};
    must(world.createJoint(def));
    run(world, 3);
    for (const BodyId body : bodies) { must(world.setAwake(body, false)); }
    bodies.push_back(addBody(world, dynamicAt({-1 - GetParam(), 0}, vec(3, 0)), box(0.5, 0.5)));
    run(world, 60);
    EXPECT_NEAR(momentumOf(world, bodies).x, 3, 1e-3);
}

/// Steps after it fell asleep, with nothing else going on.
TEST(Sleepers, WakeWhenThePlatformTheyHangOnSetsOut) {
    World world = makeWorld(WorldSettings{});
    BodyDef def;
    def.type = BodyType::kinematic;
    def.position = {0, 5};
    const BodyId platform = must(world.createBody(def));
    const BodyId load = addBody(world, dynamicAt({0, 3}), box(0.5, 0.5));
    RevoluteJointDef hinge;
    hinge.base = between(platform, load);
    hinge.anchor = {0, 5};
    const JointId joint = must(world.createJoint(hinge));
    run(world, 300);
    ASSERT_FALSE(world.isAwake(load));
    must(world.setVelocity(platform, vec(1, 0), 0));
    run(world, 60);
    EXPECT_TRUE(world.isAwake(load));
    EXPECT_GT(world.position(load).x, 0.5);
    EXPECT_LT(world.jointError(joint), 1e-3);
}

/// Boxes that are held; the lower one is made ground and free again: the other one moves once in a step.
TEST(Sleepers, HeldOnesMayBeFrozenAndFreed) {
    for (const bool wait : {false, true}) {
        World world = makeWorld(WorldSettings{});
        addStatic(world, box(20, 0.5));
        const std::array boxes{addBody(world, dynamicAt({0, 1}), box(0.5, 0.5)),
                               addBody(world, dynamicAt({0, 2}), box(0.5, 0.5))};
        run(world, 20);
        ASSERT_EQ(world.counters().settledBodies, 2U);
        BodyDef def = world.definition(boxes[0]);
        def.type = BodyType::fixed;
        must(world.redefine(boxes[0], def));
        if (wait) { run(world, 200); }
        def.type = BodyType::dynamic;
        must(world.redefine(boxes[0], def));
        must(world.setPose(boxes[1], {10, 50}, 0));
        must(world.setVelocity(boxes[1], vec(1, 0), 0));
        run(world, 6);
        EXPECT_NEAR(world.position(boxes[1]).x, 10.1, 1e-5);
        EXPECT_EQ(world.counters().awakeBodies, 2U);
    }
}

TEST(Sleepers, HeldOnesThatWereFrozenMayLoseTheirNeighbour) {
    World world = makeWorld(WorldSettings{});
    addStatic(world, box(20, 0.5));
    const BodyId below = addBody(world, dynamicAt({0, 1}), box(0.5, 0.5));
    const BodyId above = addBody(world, dynamicAt({0, 2}), box(0.5, 0.5));
    run(world, 20);
    BodyDef def = world.definition(below);
    def.type = BodyType::fixed;
    must(world.redefine(below, def));
    must(world.destroyBody(above));
    def.type = BodyType::dynamic;
    must(world.redefine(below, def));
    run(world, 20);
    EXPECT_NEAR(world.position(below).y, 1, 1e-3);
}

/// Where it is, not where it was made.
TEST(Sleepers, SensorsOnGroundThatWasPutElsewhere) {
    World world = makeWorld(weightless());
    ShapeDef def;
    def.sensor = true;
    const BodyId gate = addStatic(world, box(0.1, 5), def, {0, 100});
    must(world.setPose(gate, {0, 0}, 0));
    addBody(world, dynamicAt({-3, 0}, vec(240, 0)), circle(0.1));
    run(world, 1);
    const std::span<const ContactEvent> events = world.contactEvents();
    ASSERT_EQ(events.size(), 2U);
    EXPECT_EQ(events[0].type, ContactEventType::sensorBegin);
    EXPECT_NEAR(events[0].fraction, 0.7, 1e-3);
    EXPECT_EQ(events[1].type, ContactEventType::sensorEnd);
    EXPECT_NEAR(events[1].fraction, 0.8, 1e-3);
}

/// Its contact is looked at once, though that of others is set aside in the same step.
TEST(Sleepers, SensorsPutOverWhatJustFellAsleep) {
    World world = makeWorld(weightless());
    const BodyId body = addBody(world, dynamicAt({}), box(0.5, 0.5));
    run(world, 3);
    must(world.setAwake(body, false));
    ShapeDef def;
    def.sensor = true;
    addStatic(world, box(1, 1), def);
    run(world, 1);
    EXPECT_EQ(world.contactEvents().size(), 1U);
    EXPECT_FALSE(world.isAwake(body));
}

/// A ball in mode speedLimit between a fast heavy one of any mode and a wall of 2 cm does not pass that.
TEST(Sleepers, SpeedLimitHoldsWhateverPushes) {
    for (const double gap : {0.05, 2.0}) {
        for (const bool bullet : {false, true}) {
            World world = makeWorld(weightless());
            addStatic(world, box(0.01, 5), {}, {3, 0});
            BodyDef def = dynamicAt({});
            def.continuous = ContinuousMode::speedLimit;
            const BodyId ball = addBody(world, def, circle(0.1));
            def = dynamicAt({-0.2 - gap, 0}, vec(100, 0));
            def.mass = 100;
            def.bullet = bullet;
            addBody(world, def, circle(0.1));
            run(world, 60);
            EXPECT_LT(world.position(ball).x, 3) << gap << ' ' << bullet;
        }
    }
}

}  // namespace
}  // namespace swept::test
