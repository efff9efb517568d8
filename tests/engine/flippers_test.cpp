#include <cmath>

#include "world_support.h"

/// Kinematic flippers that turn far within a step swing up what lies on them: as fast as a flipper of tiny steps does.

namespace swept::test {
namespace {

constexpr double kBallRadius = 0.0135;
constexpr double kFlipperHalf = 0.005;

struct Flung {
    double speed = 0;      ///< with which the ball leaves, m/s
    double lost = 0;       ///< seconds
    std::size_t hits = 0;  ///< that were told
};

/// A ball lies on a flipper that turns by one radian, and then stops.
Flung flungBy(Profile profile, double spin, double place, double rate, double restitution, bool isBullet) {
    WorldSettings settings = awakeSettings(profile, 0);
    World world = makeWorld(settings);
    const BodyId flipper = must(world.createBody({.type = BodyType::kinematic}));
    const Polygon bar = must(makeCapsule({}, vec(0.15, 0), real(kFlipperHalf)));
    must(world.addShape(flipper, bar, material(0, restitution)));
    BodyDef def = dynamicAt({place, kBallRadius + kFlipperHalf});
    def.bullet = isBullet;
    const BodyId ball = addBody(world, def, circle(kBallRadius), material(0, restitution));
    Flung result;
    const auto step = [&] {
        run(world, 1, 1 / rate);
        for (const LostTimeEntry& entry : world.lostTime()) { result.lost += entry.seconds; }
        for (const ContactEvent& event : world.contactEvents()) {
            result.hits += event.type == ContactEventType::hit ? 1U : 0U;
        }
    };
    const int steps = static_cast<int>(std::lround(rate / spin));
    for (int i = 1; i <= steps; ++i) {
        must(world.driveTo(flipper, {}, static_cast<double>(i) / steps, 1 / rate));
        step();
    }
    must(world.setVelocity(flipper, {}, 0));
    step();
    step();
    result.speed = length(velocityOf(world, ball));
    return result;
}

/// In the frame of the flipper a ball without friction slides out by r = r0·cosh(a) + h·sinh(a), a the angle.
double speedAfterOneRadian(double spin, double place) {
    constexpr double kHeight = kBallRadius + kFlipperHalf;
    const double out = place * std::cosh(1) + kHeight * std::sinh(1);
    const double along = place * std::sinh(1) + kHeight * std::cosh(1) - kHeight;
    return spin * std::hypot(out, along);
}

TEST(Flippers, SwingABallUpAtAnyRate) {
    for (const Profile profile : {Profile::accurate, Profile::fast}) {
        for (const double spin : {15.0, 30.0, 60.0}) {
            for (const double place : {0.02, 0.04, 0.06}) {
                for (const double rate : {60.0, 120.0, 240.0}) {
                    const std::string name = std::to_string(spin) + " rad/s at " + std::to_string(rate) + " Hz, " +
                                             std::to_string(place) + " m out";
                    const Flung ball = flungBy(profile, spin, place, rate, 0, true);
                    const double right = speedAfterOneRadian(spin, place);
                    expectAtMost(name, std::abs(ball.speed / right - 1), 0.02);
                    EXPECT_EQ(ball.lost, 0) << name;
                    // What slides does not hit; but what a step finds as it begins may.
                    EXPECT_LE(static_cast<double>(ball.hits), rate / spin + 1) << name;
                }
            }
        }
    }
}

/// It bounces a few times, ever lower, and then slides.
TEST(Flippers, SwingUpWhatBounces) {
    for (const bool isBullet : {false, true}) {
        for (const double restitution : {0.3, 0.6}) {
            const double right = flungBy(Profile::accurate, 60, 0.06, 6000, restitution, isBullet).speed;
            const Flung ball = flungBy(Profile::accurate, 60, 0.06, 60, restitution, isBullet);
            const std::string name = "restitution " + std::to_string(restitution);
            expectAtMost(name, std::abs(ball.speed / right - 1), 0.05);
            EXPECT_EQ(ball.lost, 0) << name;
        }
    }
}

}  // namespace
}  // namespace swept::test
