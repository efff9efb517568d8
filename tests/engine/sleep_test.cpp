#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "sleeping_stack.h"
#include "world_support.h"

/// Sleep: what rests falls asleep, and wakes when something happens to it. Sensors, too.

namespace swept::test {
namespace {

TEST(Sleep, StackFallsAsleepAndStaysPut) {
    SleepingStack stack;
    runFor(stack.world, 5);
    EXPECT_EQ(stack.awake(), 0);
    const DVec2 top = stack.world.position(stack.boxes[4]);
    runFor(stack.world, 5);
    EXPECT_EQ(stack.awake(), 0);
    EXPECT_EQ(stack.world.position(stack.boxes[4]), top);
    EXPECT_EQ(stack.world.counters().solvedBodies, 0U);
    expectAtMost("sag", std::abs(top.y - 4.5), 0.005);
}

/// Iteration solves both points of a contact at once, so that nothing leans: tens of steps of sway kept such a stack
/// awake.
TEST(Sleep, HighStackOfTheFastProfileStandsUprightAndFallsAsleep) {
    WorldSettings settings = awakeSettings();
    settings.sleep = true;
    settings.profile = Profile::fast;
    World world = makeWorld(settings);
    addStatic(world, box(20, 0.5), material(0.6), {0, -0.5});
    std::vector<BodyId> boxes;
    for (int i = 0; i < 10; ++i) {
        boxes.push_back(addBody(world, dynamicAt({1, i + 0.5}), box(0.5, 0.5), material(0.6)));
    }
    run(world, 160);
    for (const BodyId id : boxes) {
        EXPECT_FALSE(world.isAwake(id));
        expectAtMost("lean", std::abs(world.position(id).x - 1), 1e-6);
        expectAtMost("turn", std::abs(world.angle(id)), 1e-6);
    }
}

TEST(Sleep, SleepingOffKeepsAwake) {
    SleepingStack stack(false);
    runFor(stack.world, 5);
    EXPECT_EQ(stack.awake(), 5);
}

TEST(Sleep, MovingBodyStaysAwake) {
    World world = makeWorld(WorldSettings{.gravity = vec(0, -kGravity)});
    addStatic(world, box(100, 0.5), material(0), {0, -0.5});
    const BodyId sliding = addBody(world, dynamicAt({0, 0.5}, vec(0.1, 0)), box(0.5, 0.5), material(0));
    runFor(world, 5);
    EXPECT_TRUE(world.isAwake(sliding));
    expectAtMost("way", std::abs(world.position(sliding).x - 0.5), 1e-3);
}

TEST(Sleep, WhatMovesNoFasterThanTheSleepSpeedFallsAsleepToo) {
    for (const Profile profile : {Profile::accurate, Profile::fast}) {
        World world = makeWorld({.gravity = vec(0, -kGravity), .profile = profile, .sleepSpeed = real(0.05)});
        addStatic(world, box(100, 0.5), material(0), {0, -0.5});
        const BodyId slow = addBody(world, dynamicAt({0, 0.5}, vec(0.04, 0)), box(0.5, 0.5), material(0));
        const BodyId fast = addBody(world, dynamicAt({9, 0.5}, vec(0.06, 0)), box(0.5, 0.5), material(0));
        runFor(world, 3);
        EXPECT_FALSE(world.isAwake(slow));
        runFor(world, 17);
        EXPECT_TRUE(world.isAwake(fast));
        expectAtMost("way", std::abs(world.position(fast).x - 10.2), 1e-3);
    }
}

TEST(Sleep, SoDoesWhatDriftsAndTurnsSoSlowly) {
    World world = makeWorld({.gravity = {}, .sleepSpeed = real(0.05)});
    const auto drifting = [&world](double x, double speed, double spin) {
        BodyDef def = dynamicAt({x, 0}, vec(speed, 0));
        def.angularVelocity = real(spin);
        return addBody(world, def, circle(1));
    };
    const BodyId slow = drifting(0, 0.02, 0.02);
    const BodyId fast = drifting(10, 0.06, 0);
    const BodyId turns = drifting(20, 0.03, 0.03);
    runFor(world, 20);
    EXPECT_FALSE(world.isAwake(slow));
    EXPECT_TRUE(world.isAwake(fast));
    EXPECT_TRUE(world.isAwake(turns)) << "at its rim it is faster";
}

TEST(Sleep, HitWakesTheStack) {
    SleepingStack stack;
    runFor(stack.world, 5);
    ASSERT_EQ(stack.awake(), 0);
    addBody(stack.world, dynamicAt({-3, 4.5}, vec(10, 1)), circle(0.3), material(0.6));
    runFor(stack.world, 1);
    EXPECT_GT(stack.world.position(stack.boxes[4]).x, 0.05);
    EXPECT_GT(stack.awake(), 0);
}

TEST(Sleep, LosingItsSupportWakesTheStack) {
    SleepingStack stack;
    runFor(stack.world, 5);
    ASSERT_EQ(stack.awake(), 0);
    must(stack.world.destroyBody(stack.ground));
    runFor(stack.world, 1);
    EXPECT_EQ(stack.awake(), 5);
    expectAtMost("fall", std::abs(stack.world.position(stack.boxes[4]).y - (4.5 - 5)), 0.1);
}

TEST(Sleep, LosingABoxWakesThoseAbove) {
    SleepingStack stack;
    runFor(stack.world, 5);
    ASSERT_EQ(stack.awake(), 0);
    must(stack.world.destroyBody(stack.boxes[1]));
    runFor(stack.world, 3);
    expectAtMost("new place", std::abs(stack.world.position(stack.boxes[4]).y - 3.5), 0.01);
}

TEST(Sleep, ImpulseWakes) {
    SleepingStack stack;
    runFor(stack.world, 5);
    ASSERT_EQ(stack.awake(), 0);
    must(stack.world.applyImpulse(stack.boxes[4], vec(5, 0), stack.world.position(stack.boxes[4])));
    runFor(stack.world, 0.5);
    EXPECT_GT(stack.world.position(stack.boxes[4]).x, 0.1);
}

/// Two hinged crates on a floor. Whenever something happens to them, however close they are to falling asleep, they do
/// not do so before it shows.
TEST(Sleep, NothingIsLostOnWhatIsAboutToFallAsleep) {
    const double dt = 1.0 / 240;
    World world;
    const BodyId floor = addStatic(world, box(20, 0.5), material(0), {0, -0.5});
    std::array<BodyId, 2> crates{};
    for (std::size_t i = 0; i < 2; ++i) {
        crates.at(i) = addBody(world, dynamicAt({1.1 * static_cast<double>(i), 0.5}), box(0.5, 0.5), material(0));
    }
    const RevoluteJointDef def{.base = {.bodyA = crates[0], .bodyB = crates[1]}, .anchor = {0.55, 1}};
    const JointId hinge = world.createJoint(def).value();
    const auto fallen = [&](const World& after) { return after.velocity(crates[0]).y < real(-0.1); };
    int asleep = 0;
    for (int step = 0; step < 480; ++step, must(world.step(dt))) {
        SCOPED_TRACE(testing::Message() << "step " << step);
        asleep += world.isAwake(crates[0]) ? 0 : 1;
        World without = world;
        must(without.destroyBody(floor));
        run(without, 4, dt);
        EXPECT_TRUE(fallen(without)) << "floor destroyed";
        World elsewhere = world;
        must(elsewhere.setPose(floor, {0, -20}, 0));
        run(elsewhere, 4, dt);
        EXPECT_TRUE(fallen(elsewhere)) << "floor put elsewhere";
        World pushed = world;
        must(pushed.setVelocity(crates[0], vec(0.05, 0), 0));
        must(pushed.setVelocity(crates[1], vec(0.05, 0), 0));
        run(pushed, 1, dt);
        EXPECT_GT(pushed.velocity(crates[0]).x, real(0.04)) << "pushed";
        World pulled = world;
        WorldSettings settings = pulled.settings();
        settings.gravity = vec(1, -9.81);
        must(pulled.configure(settings));
        run(pulled, 4, dt);
        EXPECT_GT(pulled.velocity(crates[0]).x, real(0.01)) << "pulled aside";
        World driven = world;
        must(driven.setAngularMotor(hinge, AngularMotor{.speed = real(0.2), .maxTorque = real(1e6)}));
        run(driven, 1, dt);
        EXPECT_GT(driven.angularVelocity(crates[1]), real(0.01)) << "driven";
    }
    EXPECT_GT(asleep, 100);
}

WorldSettings sleepyVoid() {
    WorldSettings settings = awakeSettings(0);
    settings.sleep = true;
    return settings;
}

/// Seen from above, most of a game's bodies touch nothing.
TEST(Sleep, WhatNothingPullsAtFallsAsleepByItself) {
    World world = makeWorld(sleepyVoid());
    const BodyId crate = addBody(world, dynamicAt({0, 0}), box(0.5, 0.5));
    run(world, 40);
    EXPECT_FALSE(world.isAwake(crate));
    must(world.applyImpulse(crate, vec(1, 0)));
    run(world, 40);
    EXPECT_TRUE(world.isAwake(crate));
    EXPECT_GT(world.position(crate).x, 0.5);
}

TEST(Sleep, WhatDriftsOrTurnsEverSoSlowlyStaysAwake) {
    World world = makeWorld(sleepyVoid());
    const BodyId drifting = addBody(world, dynamicAt({0, 0}, vec(1e-4, 0)), box(0.5, 0.5));
    const BodyId turning = addBody(world, dynamicAt({5, 0}, {}, 1e-4), box(0.5, 0.5));
    runFor(world, 60);
    expectAtMost("way", std::abs(world.position(drifting).x - 6e-3), 1e-6);
    expectAtMost("turn", std::abs(world.angle(turning) - 6e-3), 1e-6);
}

/// v / c metres, w / c radians: less than a thousandth of the extent is left where it falls asleep.
TEST(Sleep, WhatIsDampedGoesAllItsWayFirst) {
    World world = makeWorld(sleepyVoid());
    BodyDef def = dynamicAt({0, 0}, vec(2, 0), 3);
    def.linearDamping = real(0.5);
    def.angularDamping = real(2);
    const BodyId crate = addBody(world, def, box(0.5, 0.5));
    runFor(world, 10);
    EXPECT_TRUE(world.isAwake(crate));
    runFor(world, 20);
    EXPECT_FALSE(world.isAwake(crate));
    expectAtMost("way left", std::abs(world.position(crate).x - 4), 1.0 / 1024);
    expectAtMost("turn left", std::abs(world.angle(crate) - 1.5), 1.0 / 1024);
}

TEST(Sleep, WhatGravityLeavesAloneFallsAsleepUntilItIsNot) {
    WorldSettings settings = awakeSettings();
    settings.sleep = true;
    World world = makeWorld(settings);
    BodyDef def = dynamicAt({0, 0});
    def.gravityScale = 0;
    const BodyId balloon = addBody(world, def, box(0.5, 0.5));
    BodyDef kept = dynamicAt({5, 0});
    const BodyId hovering = addBody(world, kept, box(0.5, 0.5));
    for (int i = 0; i < 200; ++i) {
        must(world.applyForce(hovering, vec(0, kGravity * world.mass(hovering))));
        must(world.step(kStep));
    }
    EXPECT_FALSE(world.isAwake(balloon));
    EXPECT_TRUE(world.isAwake(hovering));
    def = world.definition(balloon);
    def.gravityScale = 1;
    must(world.redefine(balloon, def));
    runFor(world, 1);
    EXPECT_LT(world.position(balloon).y, -4);
    EXPECT_LT(world.position(hovering).y, -4);
}

/// Crates on a planet whose pull acts in every step: they fall asleep if it does not wake them, sleep on while it
/// acts, and once something wakes them it pulls them again.
TEST(Sleep, UnderAForceThatDoesNotWake) {
    for (const Profile profile : {Profile::fast, Profile::accurate}) {
        SCOPED_TRACE(profileName(profile));
        WorldSettings settings = awakeSettings(profile, 0);
        settings.sleep = true;
        World world = makeWorld(settings);
        addStatic(world, circle(20), material(0.6), {0, -20});
        std::array<BodyId, 3> crates{};
        for (std::size_t i = 0; i < crates.size(); ++i) {
            const double height = 0.25 + 0.5 * static_cast<double>(i);
            crates.at(i) = addBody(world, dynamicAt({0, height}), box(0.25, 0.25), material(0.6));
        }
        const auto pull = [&](int steps, Wake wake) {
            for (int i = 0; i < steps; ++i) {
                for (const BodyId crate : crates) {
                    const DVec2 center = world.centerOfMass(crate);
                    const DVec2 down = DVec2{0, -20} - center;
                    const double weight = 10 * static_cast<double>(world.mass(crate));
                    must(world.applyForce(crate, toReal((weight / length(down)) * down), center, wake));
                    must(world.applyTorque(crate, 0, wake));
                }
                must(world.step(kStep));
            }
        };
        const auto asleep = [&] {
            return std::count_if(crates.begin(), crates.end(), [&](BodyId crate) { return !world.isAwake(crate); });
        };
        pull(600, Wake::no);
        EXPECT_EQ(asleep(), 3);
        const DVec2 place = world.position(crates[2]);
        pull(60, Wake::no);
        EXPECT_EQ(asleep(), 3);
        expectAtMost("crept", length(world.position(crates[2]) - place), 0);
        must(world.applyImpulse(crates[2], vec(0, 1)));
        pull(10, Wake::no);
        EXPECT_GT(world.position(crates[2]).y, place.y + 0.05);
        pull(600, Wake::no);
        EXPECT_EQ(asleep(), 3);
        expectAtMost("came back", std::fabs(world.position(crates[2]).y - place.y), 0.01);
        pull(600, Wake::yes);
        EXPECT_EQ(asleep(), 0);
    }
}

/// Whether what wakes a body comes before or after a force that does not.
TEST(Sleep, ForcesThatDoNotWakeActOnWhatWakesBeforeTheStep) {
    Vec2 velocities[2];
    for (const bool pullsFirst : {false, true}) {
        WorldSettings settings = awakeSettings(0);
        settings.sleep = true;
        World world = makeWorld(settings);
        const BodyId ball = addBody(world, dynamicAt({0, 5}), circle(0.5));
        runFor(world, 3);
        ASSERT_FALSE(world.isAwake(ball));
        const auto pull = [&] { must(world.applyForce(ball, vec(0, -3), Wake::no)); };
        if (pullsFirst) { pull(); }
        must(world.applyForce(ball, vec(1, 0)));
        if (!pullsFirst) { pull(); }
        must(world.step(kStep));
        velocities[pullsFirst ? 1 : 0] = world.velocity(ball);
        EXPECT_LT(world.velocity(ball).y, 0);
        must(world.step(kStep));
        EXPECT_EQ(world.velocity(ball), velocities[pullsFirst ? 1 : 0]) << "a force acts for one step";
    }
    EXPECT_EQ(velocities[0], velocities[1]);
}

/// An empty third argument is a point, not a way to wake.
TEST(Sleep, ForcesAtTheOriginTurnWhatIsBeside) {
    World world = makeWorld(0);
    const BodyId ball = addBody(world, dynamicAt({0, 5}), circle(0.5));
    must(world.applyForce(ball, vec(1, 0), {}));
    must(world.step(kStep));
    EXPECT_GT(world.angularVelocity(ball), 0);
}

/// However slowly a force moves what touches nothing, it moves on.
TEST(Sleep, WhatAForceMovesInTheAirStaysAwake) {
    for (const Wake wake : {Wake::yes, Wake::no}) {
        WorldSettings settings = awakeSettings(0);
        settings.sleep = true;
        World world = makeWorld(settings);
        BodyDef def = dynamicAt({});
        def.linearDamping = 1;
        const BodyId ball = addBody(world, def, circle(0.5));
        for (int i = 0; i < 1200; ++i) {
            const Vec2 force = vec(0.0015 * world.mass(ball), 0);
            must(world.applyForce(ball, force, wake));
            must(world.step(kStep));
        }
        EXPECT_NEAR(world.position(ball).x, 0.0285, 1e-4);
    }
}

TEST(Sensor, ReportsBeginAndEndAndDoesNotCollide) {
    for (const double speed : {2.0, 10.0}) {
        World world = makeWorld(0);
        ShapeDef watch;
        watch.sensor = true;
        const BodyId gate = addStatic(world, box(0.5, 2), watch);
        const BodyId ball = addBody(world, dynamicAt({-3, 0}, vec(speed, 0)), circle(0.25));
        std::vector<double> begins;
        std::vector<double> ends;
        for (int i = 1; i <= static_cast<int>(6 / speed * kRate); ++i) {
            must(world.step(kStep));
            for (const ContactEvent& event : world.contactEvents()) {
                EXPECT_EQ(event.bodyA, gate);
                EXPECT_EQ(event.bodyB, ball);
                const double time = (i - 1 + event.fraction) * kStep;
                if (event.type == ContactEventType::sensorBegin) { begins.push_back(time); }
                if (event.type == ContactEventType::sensorEnd) { ends.push_back(time); }
            }
        }
        ASSERT_EQ(begins.size(), 1U) << speed;
        ASSERT_EQ(ends.size(), 1U) << speed;
        const std::string name = std::to_string(speed) + " m/s: ";
        expectAtMost(name + "begin", std::abs(begins[0] - 2.25 / speed), 1.01 * kStep);
        expectAtMost(name + "end", std::abs(ends[0] - 3.75 / speed), 1.01 * kStep);
        expectAtMost(name + "speed", std::abs(velocityOf(world, ball).x / speed - 1), 0);
    }
}

/// Slow motion is no rest: without gravity nothing tells how long that is but seconds.
TEST(Sleep, WhatTurnsSlowlyGoesOnInShortStepsWithoutGravity) {
    for (const double rate : {60.0, 600.0, 6000.0}) {
        WorldSettings settings = awakeSettings(0);
        settings.sleep = true;
        World world = makeWorld(settings);
        RevoluteJointDef hinge;
        hinge.base.bodyA = must(world.createBody({}));
        hinge.base.bodyB = addBody(world, dynamicAt({0, 0}, {}, 0.1), box(0.5, 0.5));
        must(world.createJoint(hinge));
        run(world, 200, 1 / rate);
        EXPECT_NEAR(world.angularVelocity(hinge.base.bodyB), 0.1, 1e-5) << rate << " Hz";
    }
}

}  // namespace
}  // namespace swept::test
