#include "world_support.h"

/// Coulomb friction against closed forms.

namespace swept::test {
namespace {

const double kTilt = kPi / 6;

/// A body that stands on an incline through the origin, 30° falling to the left.
struct Incline {
    World world = makeWorld();
    BodyId body;

    Incline(const Polygon& polygon, double height, double friction) {
        addStatic(world, box(200, 1), material(friction), turned({0, -1}, kTilt), kTilt);
        BodyDef def = dynamicAt(turned({0, height}, kTilt));
        def.angle = kTilt;
        body = addBody(world, def, polygon, material(friction));
    }
    double downhillSpeed() const { return -dot(velocityOf(world, body), turned({1, 0}, kTilt)); }
    double downhillWay() const { return -dot(world.centerOfMass(body), turned({1, 0}, kTilt)); }
};

TEST(Friction, BlockSlidesDownAnIncline) {
    for (const double friction : {0.0, 0.1, 0.3, 0.5}) {
        Incline incline(box(0.5, 0.5), 0.5, friction);
        run(incline.world, 120);
        const double a = kGravity * (std::sin(kTilt) - friction * std::cos(kTilt));
        const std::string name = "friction " + std::to_string(friction);
        expectAtMost(name + ": speed", std::abs(incline.downhillSpeed() / (2 * a) - 1), 2e-3);
        expectAtMost(name + ": way", std::abs(incline.downhillWay() / (2 * a) - 1), 2e-3);
    }
}

TEST(Friction, BlockSlidesJustBelowTheThreshold) {
    for (const double part : {0.9, 0.99}) {
        const double friction = part * std::tan(kTilt);
        Incline incline(box(0.5, 0.5), 0.5, friction);
        run(incline.world, 600);
        const double a = kGravity * (std::sin(kTilt) - friction * std::cos(kTilt));
        expectAtMost("speed at " + std::to_string(part), std::abs(incline.downhillSpeed() / (10 * a) - 1), 6e-3);
    }
}

TEST(Friction, BlockSticksJustAboveTheThreshold) {
    for (const double part : {1.01, 1.1, 2.0}) {
        Incline incline(box(0.5, 0.5), 0.5, part * std::tan(kTilt));
        run(incline.world, 600);
        expectAtMost("creep in 10 s at " + std::to_string(part), std::abs(incline.downhillWay()), 1e-4);
        expectAtMost("speed at " + std::to_string(part), std::abs(incline.downhillSpeed()), 1e-5);
    }
}

TEST(Friction, DiskRollsDownAnIncline) {
    Incline incline(circle(0.5), 0.5, 0.6);
    run(incline.world, 120);
    const double speed = 2 * kGravity * std::sin(kTilt) * 2 / 3;  // 2/3 of the mass moves, the rest turns
    expectAtMost("speed", std::abs(incline.downhillSpeed() / speed - 1), 2e-3);
    expectAtMost("way", std::abs(incline.downhillWay() / speed - 1), 4e-3);
    // The solver's arm turns with the disk within a step, the contact does not: (ω dt)²/6 of slip at 13 rad/s.
    expectAtMost("slip", std::abs(spinOf(incline.world, incline.body) * 0.5 / incline.downhillSpeed() - 1), 0.01);
}

/// However fast it turns, it rolls on its rim, and the ground is level. (Held by a point that turned with it, it sank
/// by radius·(1 − cos) of its turn in every step: 4 mm at 20 rad/s.)
TEST(Friction, WhatIsRoundRollsLevel) {
    constexpr double kRadius = 0.5;
    for (const double spin : {2.0, 10.0, 20.0, 40.0}) {
        World world = makeWorld();
        addStatic(world, segment(-10, 0, 100, 0), material(1));
        const BodyId disk =
            addBody(world, dynamicAt({0, kRadius}, vec(spin * kRadius, 0), -spin), circle(kRadius), material(1));
        run(world, 10);
        const double speed = velocityOf(world, disk).x;
        double farthest = 0;
        for (int i = 0; i < 110; ++i) {
            must(world.step(kStep));
            farthest = std::max(farthest, std::abs(world.position(disk).y - kRadius));
        }
        const std::string name = std::to_string(spin) + " rad/s: ";
        expectAtMost(name + "height", farthest, 2.5e-5);  // 0.018 mm of it is the give of a contact under its weight
        expectAtMost(name + "speed lost", std::abs(velocityOf(world, disk).x / speed - 1), 1e-6);
    }
}

TEST(Friction, SpinningDiskRunsOff) {
    World world = makeWorld();
    addStatic(world, box(50, 1), material(0.3), {0, -1});
    const BodyId disk = addBody(world, dynamicAt({0, 0.5}, {}, 20), circle(0.5), material(0.3));
    run(world, 180);
    // Angular momentum about a point on the ground stays: m r v + I (v / r) = I ω with I = m r² / 2.
    expectAtMost("final speed", std::abs(-velocityOf(world, disk).x / (20 * 0.5 / 3) - 1), 4e-3);
}

TEST(Friction, BoxSlidesToRest) {
    for (const double speed : {2.0, 5.0, 10.0}) {
        World world = makeWorld();
        addStatic(world, box(100, 1), material(0.3), {0, -1});
        const BodyId body = addBody(world, dynamicAt({0, 0.5}, vec(speed, 0)), box(0.5, 0.5), material(0.3));
        run(world, 300);
        const std::string name = std::to_string(speed) + " m/s";
        expectAtMost(name + ": way", std::abs(world.position(body).x / (speed * speed / (2 * 0.3 * kGravity)) - 1),
                     0.005);
        expectAtMost(name + ": at rest", std::abs(velocityOf(world, body).x), 1e-4);
    }
}

TEST(Friction, KinematicPlatformCarriesABox) {
    World world = makeWorld();
    BodyDef moving = bodyAt(BodyType::kinematic, {0, -0.5});
    moving.velocity = vec(1, 0);
    const BodyId platform = addBody(world, moving, box(20, 0.5), material(0.5));
    const BodyId body = addBody(world, dynamicAt({0, 0.5}), box(0.5, 0.5), material(0.5));
    run(world, 6);  // 0.1 s: friction accelerates it by μ g
    expectAtMost("speed while it slips", std::abs(velocityOf(world, body).x / 0.5 - 1), 1e-4);
    run(world, 594);
    expectAtMost("speed", std::abs(velocityOf(world, body).x - 1), 1e-4);
    // It is left behind by v² / (2 μ g) while it slips, and no more.
    const double behind = world.position(platform).x - world.position(body).x;
    expectAtMost("left behind", std::abs(behind - 0.1), 0.002);
    expectAtMost("platform", std::abs(world.position(platform).x - 10), 1e-5);
}

TEST(Friction, RisingPlatformLiftsABox) {
    World world = makeWorld();
    BodyDef moving = bodyAt(BodyType::kinematic, {0, -0.5});
    moving.velocity = vec(0, 2);
    const BodyId platform = addBody(world, moving, box(2, 0.5), material(0.5));
    const BodyId body = addBody(world, dynamicAt({0, 0.5}, vec(0, 2)), box(0.5, 0.5), material(0.5));
    run(world, 600);
    expectAtMost("height above it", std::abs(world.position(body).y - world.position(platform).y - 1), 1e-4);
}

}  // namespace
}  // namespace swept::test
