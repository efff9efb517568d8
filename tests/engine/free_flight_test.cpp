#include <swept/engine/state/number_range.h>

#include "world_support.h"

/// Free flight is exact for constant acceleration: closed forms, met to rounding.

namespace swept::test {
namespace {

constexpr double kEps = static_cast<double>(std::numeric_limits<Real>::epsilon());

/// What rounding the velocity in every step may make of a position: half a unit in the last place of the largest speed,
/// once a step, all in one direction, over all of the time.
double roundingOf(double speed, int steps, double seconds) { return 0.5 * kEps * speed * steps * seconds; }

TEST(FreeFlight, ProjectileFliesItsParabola) {
    World world = makeWorld();
    const BodyId ball = addBody(world, dynamicAt({1, 2}, vec(7, 11), 3), circle(0.5));
    run(world, 120);
    const DVec2 p = world.position(ball);
    expectAtMost("x", std::abs(p.x - 15), roundingOf(11, 120, 2));
    expectAtMost("y", std::abs(p.y - (2 + 22 - 20)), roundingOf(11, 120, 2));
    expectAtMost("angle", std::abs(world.angle(ball) - 6), roundingOf(3, 120, 2));
    expectAtMost("vy", std::abs(velocityOf(world, ball).y + 9), roundingOf(11, 120, 1));
}

TEST(FreeFlight, DampedProjectileFollowsTheExponential) {
    const double c = 0.5;
    const double spinDamping = 0.25;
    World world = makeWorld();
    BodyDef def = dynamicAt({}, vec(7, 11), 3);
    def.linearDamping = real(c);
    def.angularDamping = real(spinDamping);
    const BodyId ball = addBody(world, def, circle(0.5));
    const double t = 2;
    run(world, 120);
    const double decay = std::exp(-c * t);
    const double fall = -kGravity / c;  // final velocity
    const double limit = roundingOf(11, 120, 2) + 1e-13;
    const DVec2 p = world.position(ball);
    expectAtMost("x", std::abs(p.x - 7 * (1 - decay) / c), limit);
    expectAtMost("y", std::abs(p.y - (fall * t + (11 - fall) * (1 - decay) / c)), limit);
    expectAtMost("vy", std::abs(velocityOf(world, ball).y - (fall + (11 - fall) * decay)), limit);
    expectAtMost("angle", std::abs(world.angle(ball) - 3 * (1 - std::exp(-spinDamping * t)) / spinDamping), limit);
    expectAtMost("spin", std::abs(spinOf(world, ball) - 3 * std::exp(-spinDamping * t)), limit);
}

TEST(FreeFlight, FarFromTheOriginNothingIsLost) {
    const double far = 1e6;
    World world = makeWorld(0);
    const BodyId ball = addBody(world, dynamicAt({far, -far}, vec(1, 1)), circle(0.5));
    run(world, 600);
    const DVec2 p = world.position(ball);
    const double limit = 600 * far * std::numeric_limits<double>::epsilon();  // positions are double in both builds
    expectAtMost("x", std::abs(p.x - far - 10), limit);
    expectAtMost("y", std::abs(p.y + far - 10), limit);
}

TEST(FreeFlight, StepSizeDoesNotMatter) {
    for (const double rate : {15.0, 30.0, 240.0, 960.0}) {
        World world = makeWorld();
        const BodyId ball = addBody(world, dynamicAt({}, vec(7, 11)), circle(0.5));
        const int steps = static_cast<int>(2 * rate);
        run(world, steps, 1 / rate);
        expectAtMost("y at " + std::to_string(rate) + " Hz", std::abs(world.position(ball).y - 2),
                     roundingOf(11, steps, 2));
    }
}

TEST(FreeFlight, BodyTurnsAboutItsCentreOfMass) {
    World world = makeWorld();
    const BodyId ball = addBody(world, dynamicAt({}, vec(7, 11), 3), circle(0.5, vec(1, 0)));
    run(world, 120);
    const DVec2 center = world.centerOfMass(ball);
    expectAtMost("centre", length(center - DVec2{15, 2}), roundingOf(11, 120, 2));
    // The frame's rotation is of type Real: a few units in the last place of the arm of 1 m.
    expectAtMost("origin", length(world.position(ball) - (center - turned({1, 0}, 6.0))),
                 roundingOf(3, 120, 2) + 4 * kEps);
}

TEST(FreeFlight, ForceAndTorqueAccelerate) {
    World world = makeWorld(0);
    const BodyId body = addBody(world, dynamicAt({}), box(0.5, 0.5));
    const double mass = world.mass(body);
    const double inertia = world.inertia(body);
    for (int i = 0; i < 60; ++i) {
        must(world.applyForce(body, vec(3, 0), world.centerOfMass(body)));
        must(world.applyTorque(body, real(0.5)));
        must(world.step(kStep));
    }
    const double limit = roundingOf(3, 60, 1) * 4;
    expectAtMost("x", std::abs(world.position(body).x - 0.5 * 3 / mass), limit);
    expectAtMost("angle", std::abs(world.angle(body) - 0.5 * 0.5 / inertia), limit);
    const double x = world.position(body).x;
    run(world, 60);  // forces last for one step only
    expectAtMost("x, coasting", std::abs(world.position(body).x - x - 3 / mass), limit);
}

/// The only limit of speeds is the user's: past a wall, in every mode without limits or ghosts of its own.
TEST(FreeFlight, NoSpeedIsTooHigh) {
    for (const ContinuousMode mode : {ContinuousMode::off, ContinuousMode::stop, ContinuousMode::subStep}) {
        for (const double speed : {1e2, 1e3, 1e4, 1e6}) {
            for (const double spin : {0.0, 50.0, 1000.0, 1e4}) {
                WorldSettings settings = awakeSettings(0);
                settings.continuous = mode;
                World world = makeWorld(settings);
                addStatic(world, segment(-10, -5, 10, -5), material(0.3));
                const BodyId bar = addBody(world, dynamicAt({0, 0}, vec(speed, 0), spin), box(0.5, 0.05));
                for (int i = 0; i < 60; ++i) {
                    must(world.step(kStep));
                    EXPECT_TRUE(world.lostTime().empty());
                    EXPECT_EQ(world.counters().speedsLimited + world.counters().speedsCapped, 0U);
                }
                const std::string name = "mode " + std::to_string(static_cast<int>(mode)) + ", " +
                                         std::to_string(speed) + " m/s, " + std::to_string(spin) + " rad/s: ";
                EXPECT_EQ(velocityOf(world, bar), (DVec2{speed, 0})) << name;
                EXPECT_EQ(spinOf(world, bar), spin) << name;
                expectAtMost(name + "x", std::abs(world.centerOfMass(bar).x / speed - 1), 1e-13);
                expectAtMost(name + "angle", std::abs(world.angle(bar) - spin), 1e-13 * spin);
            }
        }
    }
}

/// What the user's limit cuts is counted, in every part that a body can play: in flight, at a wall, pushed by another.
TEST(FreeFlight, TheUsersMaxSpeedIsKeptAndReported) {
    constexpr double kLimit = 50;
    WorldSettings settings = awakeSettings(0);
    settings.maxSpeed = real(kLimit);
    World world = makeWorld(settings);
    addStatic(world, segment(2, -1, 2, 1), material(0, 1));
    const BodyId free = addBody(world, dynamicAt({0, 50}, vec(80, 0)), circle(0.2));
    const BodyId flyer = addBody(world, dynamicAt({0, 0}, vec(70, 0)), circle(0.2), material(0, 1));
    const BodyId hit = addBody(world, dynamicAt({0, -50}), circle(0.2), material(0));
    const BodyId hitter = addBody(world, dynamicAt({-0.4, -50}, vec(49, 0)), circle(0.2), material(0, 0, 100));
    must(world.applyImpulse(hit, vec(60 * world.mass(hit), 0), world.position(hit)));
    std::uint64_t limited = 0;
    for (int i = 0; i < 10; ++i) {
        must(world.step(kStep));
        limited += world.counters().speedsLimited;
        for (const BodyId body : {free, flyer, hit, hitter}) {
            EXPECT_LE(length(velocityOf(world, body)), kLimit * (1 + 1e-6)) << "step " << i;
        }
    }
    EXPECT_GE(limited, 3U);
    EXPECT_NEAR(velocityOf(world, free).x, kLimit, 1e-5 * kLimit);
    EXPECT_NEAR(velocityOf(world, flyer).x, -kLimit, 1e-5 * kLimit);
    EXPECT_GT(velocityOf(world, hit).x, 0.9 * kLimit);
}

/// Between a wall and a plate that closes in on it an elastic ball would get as fast as it has impacts left.
TEST(FreeFlight, MaxSpeedHoldsWhatIsSqueezed) {
    for (const Profile profile : kProfiles) {
        for (const bool bullet : {false, true}) {
            SCOPED_TRACE(profileName(profile) + (bullet ? " bullet" : ""));
            WorldSettings settings = awakeSettings(profile, 0);
            settings.maxSpeed = 12;
            World world = makeWorld(settings);
            addStatic(world, box(0.1, 1), material(0, 1), {-1.1, 0});
            BodyDef def = dynamicAt({-0.8, 0}, vec(-2, 0));
            def.bullet = bullet;
            const BodyId ball = addBody(world, def, circle(0.04), material(0, 1, 5));
            const BodyId plate = addBody(world, bodyAt(BodyType::kinematic, {-0.5, 0}), circle(0.06), material(0, 0.8));
            must(world.setVelocity(plate, vec(-8, 0), 0));
            for (int i = 0; i < 8; ++i) {
                must(world.step(kStep));
                EXPECT_LE(length(velocityOf(world, ball)), 12 * (1 + 1e-6)) << "step " << i;
                if (world.position(plate).x < -0.8) { must(world.setVelocity(plate, {}, 0)); }
            }
        }
    }
}

/// What is kinematic moves as it is told, for all others of the step as well: a ball meets a plate where that goes.
TEST(FreeFlight, MaxSpeedSlowsNothingKinematic) {
    WorldSettings settings = awakeSettings(0);
    settings.maxSpeed = 10;
    World world = makeWorld(settings);
    const BodyId plate = addBody(world, bodyAt(BodyType::kinematic, {0, 0}), box(0.1, 2));
    const BodyId ball = addBody(world, dynamicAt({1, 0}, vec(-9, 0)), circle(0.1), material(0, 1));
    must(world.setVelocity(plate, vec(100, 0), 0));
    int hits = 0;
    for (int i = 1; i <= 6; ++i) {
        const double target = i > 3 ? 2.0 * i - 1 : 100 * i * kStep;
        if (i > 3) { must(world.driveTo(plate, {target, 0}, 0, kStep)); }
        must(world.step(kStep));
        EXPECT_NEAR(world.position(plate).x, target, 1e-5) << "step " << i;
        EXPECT_GT(world.position(ball).x, target) << "step " << i;
        EXPECT_LE(length(velocityOf(world, ball)), 10 * (1 + 1e-6)) << "step " << i;
        for (const ContactEvent& event : world.contactEvents()) {
            if (event.type != ContactEventType::hit) { continue; }
            ++hits;
            EXPECT_LE(event.point.x, target + 0.11) << "step " << i;
        }
    }
    EXPECT_GE(hits, 1);
}

/// Nor does a solve slow it: a crate lies on a platform that slides away under it.
TEST(FreeFlight, MaxSpeedSlowsNoPlatformInASolve) {
    for (const Profile profile : {Profile::fast, Profile::accurate}) {
        WorldSettings settings = awakeSettings();
        settings.maxSpeed = 10;
        settings.profile = profile;
        World world = makeWorld(settings);
        const BodyId platform = addBody(world, bodyAt(BodyType::kinematic, {0, -0.5}), box(100, 0.5), material(0));
        const BodyId crate = addBody(world, dynamicAt({0, 0.5}, vec(1, 0)), box(0.5, 0.5), material(0));
        must(world.setVelocity(platform, vec(20, 0), 0));
        for (int i = 1; i <= 6; ++i) {
            must(world.step(kStep));
            EXPECT_EQ(world.counters().solvedBodies, 1U) << "step " << i;
            EXPECT_EQ(world.counters().speedsLimited, 0U) << "step " << i;
            EXPECT_NEAR(world.position(platform).x, 20 * i * kStep, 1e-5) << "step " << i;
        }
        EXPECT_NEAR(velocityOf(world, crate).x, 1, 1e-5);
    }
}

TEST(FreeFlight, GravityScaleScales) {
    World world = makeWorld();
    BodyDef def = dynamicAt({});
    def.gravityScale = real(-0.5);
    const BodyId balloon = addBody(world, def, circle(0.5));
    run(world, 60);
    expectAtMost("y", std::abs(world.position(balloon).y - 2.5), roundingOf(5, 60, 1));
}

/// Not even the sum of what all others are and have may be taken for a state that overflowed.
TEST(FreeFlight, OnlyWhatLeavesTheRangeIsPutBack) {
    World world = makeWorld(0.0);
    for (int i = 0; i < 40; ++i) {
        addBody(world, bodyAt(BodyType::kinematic, {0.4 * kLargestNumber, 0.01 * i * kLargestNumber}), circle(0.5));
    }
    must(world.step(1));
    EXPECT_EQ(world.counters().putBack, 0U);
    const DVec2 start{0.6 * kLargestNumber, 0};
    const BodyId leaver = addBody(world, bodyAt(BodyType::kinematic, start), circle(0.5));
    must(world.setVelocity(leaver, {real(0.5 * kLargestNumber), 0}, 0));
    must(world.step(1));
    EXPECT_EQ(world.counters().putBack, 1U);
    ASSERT_EQ(world.bodiesPutBack().size(), 1U);
    EXPECT_EQ(world.bodiesPutBack()[0], leaver);
    EXPECT_EQ(world.position(leaver).x, start.x);
    EXPECT_EQ(velocityOf(world, leaver).x, 0);
}

/// A body that leaves the range in the solve, and then is tied to a kinematic one that leaves it as it moves.
TEST(FreeFlight, WhatIsPutBackTwiceIsToldOnce) {
    World world = makeWorld(0.0);
    const BodyId carrier = addBody(world, bodyAt(BodyType::kinematic, {0.9 * kLargestNumber, 0}), circle(0.5));
    const BodyId carried = addBody(world, dynamicAt({0.9 * kLargestNumber, 1}), circle(0.5));
    must(world.createJoint(WeldJointDef{.base = {.bodyA = carrier, .bodyB = carried}}));
    must(world.setVelocity(carrier, {real(0.5 * kLargestNumber), 0}, 0));
    must(world.setVelocity(carried, {real(0.5 * kLargestNumber), 0}, 0));
    must(world.step(1));
    EXPECT_EQ(world.counters().putBack, 2U);
    std::vector<BodyId> back(world.bodiesPutBack().begin(), world.bodiesPutBack().end());
    std::sort(back.begin(), back.end(), [](BodyId a, BodyId b) { return a.index < b.index; });
    EXPECT_EQ(back, (std::vector<BodyId>{carrier, carried}));
    EXPECT_EQ(velocityOf(world, carrier).x, 0);
    EXPECT_EQ(velocityOf(world, carried).x, 0);
}

/// A sleeper that is struck out of the range of numbers has contacts again, before they lose their points.
TEST(FreeFlight, WhatIsPutBackTouchesAsMuchAsBefore) {
    WorldSettings settings = awakeSettings();
    settings.sleep = true;
    settings.profile = Profile::fast;
    World world = makeWorld(settings);
    addStatic(world, box(50, 1), {}, {0, -1});
    const BodyId struck = addBody(world, dynamicAt({0, 0.5}), box(0.5, 0.5), material(0.6, 1, 0.001));
    addBody(world, dynamicAt({20, 0.5}), box(0.5, 0.5));
    run(world, 200);
    ASSERT_FALSE(world.isAwake(struck));
    ASSERT_EQ(world.counters().touching, 2U);
    for (int i = 0; i < 3; ++i) {
        BodyDef def = dynamicAt({-3, 0.5}, {real(0.97 * kLargestNumber), 0});
        def.gravityScale = 0;
        def.bullet = true;
        const BodyId bullet = addBody(world, def, circle(0.2), material(0.6, 1, 1000));
        must(world.step(kStep));
        const std::span<const BodyId> back = world.bodiesPutBack();
        ASSERT_TRUE(std::find(back.begin(), back.end(), struck) != back.end()) << "shot " << i;
        must(world.destroyBody(bullet));
        run(world, 300);
        EXPECT_FALSE(world.isAwake(struck)) << "shot " << i;
        EXPECT_EQ(world.counters().touching, 2U) << "shot " << i;
    }
}

/// No kind of broadphase takes what flies alone for ground in its own way.
TEST(FreeFlight, IsTheSameToTheBitWithEveryBroadphase) {
    for (int i = 0; i < 50; ++i) {
        std::vector<double> angles;
        for (const BroadphaseKind kind :
             {BroadphaseKind::automatic, BroadphaseKind::allPairs, BroadphaseKind::sortAndSweep,
              BroadphaseKind::quadtree, BroadphaseKind::grid, BroadphaseKind::bvh, BroadphaseKind::wideBvh}) {
            WorldSettings settings = awakeSettings();
            settings.broadphase = kind;
            World world = makeWorld(settings);
            BodyDef def = dynamicAt({-0.7 + 0.0006 * i, 0}, vec(41.3, 0), 3.1 + 0.01 * i);
            def.angle = -0.05 - 0.0003 * i;
            const BodyId body = addBody(world, def, box(0.1, 0.1));
            must(world.applyTorque(body, real(0.001)));
            run(world, 1);
            angles.push_back(world.angle(body));
        }
        EXPECT_EQ(angles, std::vector<double>(angles.size(), angles[0])) << "flight " << i;
    }
}

}  // namespace
}  // namespace swept::test
