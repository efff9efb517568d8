#include <cmath>
#include <string>

#include "world_support.h"

/// Kinematic ground that turns, and what rides on it: closed forms in the frame of the ground.

namespace swept::test {
namespace {

constexpr double kRiderHalf = 0.3;  // of what rides, m
constexpr double kPull = 9.81;

struct Turntable {
    World world;
    BodyId ground;
    BodyId body;

    /// On a plate that turns about the origin, the centre of the rider `below` it, carried along.
    Turntable(Profile profile, const Polygon& shape, double friction, double gravity, double below, double spin)
        : world(makeWorld(profile)) {
        WorldSettings settings = world.settings();
        settings.gravity = vec(0, -gravity);
        settings.sleep = false;
        must(world.configure(settings));
        ground = must(world.createBody({.type = BodyType::kinematic, .angularVelocity = static_cast<Real>(spin)}));
        const double middle = -below - kRiderHalf - 0.1;
        must(world.addShape(ground, must(makeBox(vec(20, 0.1), vec(0, middle))), material(friction)));
        body = addBody(world,
                       {.type = BodyType::dynamic,
                        .position = {0, -below},
                        .velocity = vec(below * spin, 0),
                        .angularVelocity = static_cast<Real>(spin)},
                       shape, material(friction));
    }
    Vec2 place() const { return applyInverse(world.transform(ground), world.position(body)); }
    void run(double seconds, double hertz) {
        for (int i = 0; i < seconds * hertz; ++i) { must(world.step(1 / hertz)); }
    }
};

Polygon bucketBox() { return must(makeBox(vec(kRiderHalf, kRiderHalf))); }
Polygon bucketBall() { return must(makeCircle({}, static_cast<Real>(kRiderHalf))); }

/// Pressed by 2.4 to 38 times its weight, with a friction of 0.9: it stays where it is. Gravity pulls to either side in
/// each turn, so what it slips it slips for good.
TEST(TurningGround, ABucketThatIsSwungKeepsItsBox) {
    for (const Profile profile : {Profile::fast, Profile::accurate}) {
        for (const double hertz : {60.0, 120.0}) {
            for (const double spin : {3.0, -4.0, 5.0, 6.0, -8.0, 10.0}) {
                SCOPED_TRACE(profileName(profile) + ", " + std::to_string(hertz) + " Hz, " + std::to_string(spin) +
                             " rad/s");
                Turntable rider(profile, bucketBox(), 0.9, kPull, 3.7, spin);
                rider.run(12, hertz);
                // It takes its place in the contact's springs at first.
                EXPECT_LT(std::fabs(static_cast<double>(rider.place().x)), 0.07);
                EXPECT_LT(std::fabs(static_cast<double>(rider.place().y) + 3.7), 0.1);
            }
        }
    }
}

/// Down a plate that tilts: x″ = f·(ω²x − g·sin ωt) with f = 1 of what slides without friction, 2/3 of a disc that
/// rolls.
void expectTilt(Profile profile, const Polygon& shape, double friction, double f, double tolerance) {
    for (const double spin : {0.3, -0.6}) {
        SCOPED_TRACE(profileName(profile) + ", " + std::to_string(spin) + " rad/s");
        Turntable rider(profile, shape, friction, kPull, 0, spin);
        rider.run(1, 60);
        const double amplitude = f * kPull / (spin * spin * (1 + f));
        const double rate = std::sqrt(f) * spin;
        const double expected = amplitude * (std::sin(spin) - spin / rate * std::sinh(rate));
        EXPECT_NEAR(static_cast<double>(rider.place().x), expected, tolerance * std::fabs(expected));
        EXPECT_NEAR(static_cast<double>(rider.place().y), 0, 0.002);
    }
}

TEST(TurningGround, WhatSlidesDownAPlateThatTilts) {
    for (const Polygon& shape : {bucketBox(), bucketBall()}) {
        expectTilt(Profile::fast, shape, 0, 1, 0.008);
        expectTilt(Profile::accurate, shape, 0, 1, 0.002);
    }
}

TEST(TurningGround, WhatRollsDownAPlateThatTilts) {
    expectTilt(Profile::fast, bucketBall(), 1, 2.0 / 3, 0.008);
    expectTilt(Profile::accurate, bucketBall(), 1, 2.0 / 3, 0.002);
}

}  // namespace
}  // namespace swept::test
