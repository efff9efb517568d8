#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "../support/random.h"
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

/// What throws up a flipper within a step or two.
enum class FlippedBy : std::uint8_t { motor, spring, torque, push };
constexpr FlippedBy kFlippedBy[] = {FlippedBy::motor, FlippedBy::spring, FlippedBy::torque, FlippedBy::push};
constexpr const char* kFlippedByNames[] = {"motor", "spring", "torque", "push"};

/// A ball hovers over it, or lies on it.
struct FlipperShot {
    FlippedBy by = FlippedBy::motor;
    double spin = 0;    ///< rad/s that it comes to
    double gap = 0;     ///< metres
    double place = 0;   ///< of the ball, from the hinge, metres
    double torque = 2;  ///< of the motor, N·m

    std::string name() const {
        return std::string(kFlippedByNames[static_cast<int>(by)]) + " of " + std::to_string(spin) + " rad/s, " +
               std::to_string(gap) + " m above, " + std::to_string(place) + " m out";
    }
};

struct FlungBall {
    double speed = 0;  ///< in the end, m/s
    bool passed = false;
};

FlungBall flyFrom(const FlipperShot& shot, Profile profile, double rate) {
    World world = makeWorld(awakeSettings(profile, 0));
    const BodyId level = must(world.createBody({}));
    const BodyId flipper = must(world.createBody({.type = BodyType::dynamic}));
    must(world.addShape(flipper, must(makeBox(vec(0.035, kFlipperHalf), vec(0.035, 0))), material(0, 0, 60)));
    RevoluteJointDef hinge;
    hinge.base = {.bodyA = level, .bodyB = flipper};
    hinge.limits = AngleLimits{.lower = 0, .upper = 1};
    if (shot.by == FlippedBy::motor) {
        hinge.motor = AngularMotor{.speed = real(shot.spin), .maxTorque = real(shot.torque)};
    }
    if (shot.by == FlippedBy::spring) {
        hinge.spring = Spring{.hertz = real(shot.spin / 6), .dampingRatio = real(0.7)};
        hinge.springTarget = real(1.2);
    }
    must(world.createJoint(hinge));
    if (shot.by == FlippedBy::push) { must(world.setAngularVelocity(flipper, real(shot.spin))); }
    BodyDef def = dynamicAt({shot.place, kFlipperHalf + kBallRadius + shot.gap});
    def.bullet = true;
    const BodyId ball = addBody(world, def, circle(kBallRadius), material(0, 0, 140));
    const double inertia = world.inertia(flipper) + world.mass(flipper) * 0.035 * 0.035;
    FlungBall result;
    for (int i = 0; i < static_cast<int>(rate / 5); ++i) {
        if (shot.by == FlippedBy::torque) {
            must(world.applyTorque(flipper, real(inertia * shot.spin * shot.spin / 2)));
        }
        run(world, 1, 1 / rate);
        const DVec2 seen = toDouble(applyInverse(world.transform(flipper), world.position(ball)));
        result.passed = result.passed || (seen.y < 0 && seen.x > 0 && seen.x < 0.07);
    }
    result.speed = length(velocityOf(world, ball));
    return result;
}

/// It was at rest as the step began, and is at rest on its limit as that ends. The ball lies on it on the way, and
/// slides outwards. (As it was struck once, by the mean of that way and with what the flipper weighs alone, it had 0.1
/// to 0.5 of its speed at 40 rad/s and more; before, the flipper passed through it.)
TEST(Flippers, ShootBulletsAsInTinySteps) {
    for (const FlippedBy by : kFlippedBy) {
        for (const double spin : {20.0, 40.0, 80.0}) {
            double sum[2] = {0, 0};
            int count = 0;
            for (const double gap : {0.0, 0.002, 0.008}) {
                for (const double place : {0.02, 0.03, 0.04, 0.05}) {
                    const FlipperShot shot{by, spin, gap, place};
                    const double right = flyFrom(shot, Profile::accurate, 3840).speed;
                    ++count;
                    for (const Profile profile : kProfiles) {
                        const FlungBall ball = flyFrom(shot, profile, kRate);
                        EXPECT_FALSE(ball.passed) << shot.name();
                        const double error = std::abs(ball.speed / right - 1);
                        expectAtMost(profileName(profile) + ", " + shot.name(), error, 0.25);
                        sum[static_cast<int>(profile)] += error;
                    }
                }
            }
            for (const Profile profile : kProfiles) {
                const std::string name = std::string(kFlippedByNames[static_cast<int>(by)]) + std::to_string(spin);
                expectAtMost(profileName(profile) + ", " + name, sum[static_cast<int>(profile)] / count, 0.08);
            }
        }
    }
}

/// The closed form, for a motor that needs no time to get to its speed.
TEST(Flippers, OfStrongMotorsShootBulletsAsFastAsTheyShould) {
    for (const Profile profile : kProfiles) {
        for (const double spin : {20.0, 40.0, 60.0}) {
            for (const double place : {0.02, 0.03}) {
                const FlipperShot shot{FlippedBy::motor, spin, 0, place, 100};
                expectAtMost(profileName(profile) + ", " + shot.name(),
                             std::abs(flyFrom(shot, profile, kRate).speed / speedAfterOneRadian(spin, place) - 1),
                             0.125);
            }
        }
    }
}

/// A flipper that waits on its motor, at its lower stop.
struct Waiting {
    explicit Waiting(const WorldSettings& settings) : world(makeWorld(settings)) {
        level = must(world.createBody({}));
        flipper = must(world.createBody({.type = BodyType::dynamic}));
        must(world.addShape(flipper, must(makeBox(vec(0.035, kFlipperHalf), vec(0.035, 0))), material(0, 0, 60)));
        RevoluteJointDef hinge;
        hinge.base = {.bodyA = level, .bodyB = flipper};
        hinge.limits = AngleLimits{.lower = 0, .upper = 1};
        joint = must(world.createJoint(hinge));
    }

    BodyId addBall(double gap) {
        BodyDef def = dynamicAt({0.04, kFlipperHalf + kBallRadius + gap});
        def.bullet = true;
        return addBody(world, def, circle(kBallRadius), material(0, 0, 140));
    }
    void press(double spin, double torque) {
        must(world.setAngularMotor(joint, AngularMotor{.speed = real(spin), .maxTorque = real(torque)}));
    }

    World world;
    BodyId level;
    BodyId flipper;
    JointId joint;
};

/// The same shot whether the ball slept or not: what sleeps in its way wakes.
TEST(Flippers, ShootWhatSleeps) {
    for (const Profile profile : kProfiles) {
        for (const double spin : {40.0, 80.0}) {
            double speeds[2] = {0, 0};
            for (const bool sleeps : {false, true}) {
                WorldSettings settings = awakeSettings(profile, 0);
                settings.sleep = sleeps;
                Waiting shot(settings);
                const BodyId ball = shot.addBall(0.002);
                run(shot.world, 60);
                EXPECT_EQ(shot.world.isAwake(ball), !sleeps);
                shot.press(spin, 2);
                run(shot.world, 12);
                speeds[sleeps ? 1 : 0] = length(velocityOf(shot.world, ball));
            }
            EXPECT_GT(speeds[0], 0.03 * spin) << profileName(profile);
            EXPECT_NEAR(speeds[1], speeds[0], 1e-3 * speeds[0]) << profileName(profile);
        }
    }
}

/// What whirled in a step is forgotten by the next one, though its last bullet is gone: saved games leave it out.
TEST(Flippers, ForgetBulletsThatAreGone) {
    for (const Profile profile : kProfiles) {
        Waiting shot(awakeSettings(profile, 0));
        const BodyId ball = shot.addBall(0.01);
        shot.press(20, 2);
        run(shot.world, 2);
        must(shot.world.destroyBody(ball));
        World copy = shot.world;
        World loaded;
        must(loaded.load(shot.world.save()));
        for (int i = 0; i < 5; ++i) {
            for (World* const world : {&shot.world, &copy, &loaded}) { must(world->step(kStep)); }
            EXPECT_EQ(copy.stateHash(), shot.world.stateHash()) << profileName(profile) << ", step " << i;
            EXPECT_EQ(loaded.stateHash(), shot.world.stateHash()) << profileName(profile) << ", step " << i;
        }
    }
}

/// A flipper that turns up to the level above it, with a ball between them, for five seconds.
struct PinchedBall {
    World world;
    BodyId flipper;
    BodyId ball;

    PinchedBall(Profile profile, const std::optional<AngularMotor>& motor, const std::optional<Spring>& spring,
                double target) {
        WorldSettings settings;
        settings.profile = profile;
        world = makeWorld(settings);
        const BodyId level = addStatic(world, box(1, 0.02), material(0.6), {0, 0.08});
        flipper = must(world.createBody({.type = BodyType::dynamic}));
        must(world.addShape(flipper, must(makeCapsule({}, vec(0.2, 0), real(0.01))), material(0.6, 0, 100)));
        RevoluteJointDef hinge{.base = {.bodyA = level, .bodyB = flipper}};
        hinge.motor = motor;
        hinge.spring = spring;
        hinge.springTarget = real(target);
        hinge.limits = AngleLimits{.lower = -1, .upper = 1};
        must(world.createJoint(hinge));
        BodyDef def = dynamicAt({0.15, 0.0351});
        def.bullet = true;
        ball = addBody(world, def, circle(0.025), material(0.6, 0, 100));
        run(world, 300);
    }
};

/// It presses a ball against a wall: a motor that is blocked throws nothing, and all of it comes to rest. (As if it
/// might go at its speed in each step, it trembled, and let the ball go.)
TEST(Flippers, ThatPinchABulletComeToRest) {
    for (const Profile profile : kProfiles) {
        for (const double spin : {5.0, 10.0, 20.0, 40.0}) {
            for (const double torque : {2.0, 5.0, 10.0, 20.0}) {
                const AngularMotor motor{.speed = real(spin), .maxTorque = real(torque)};
                const PinchedBall scene(profile, motor, {}, 0);
                const std::string name =
                    profileName(profile) + ", " + std::to_string(spin) + " rad/s, " + std::to_string(torque) + " N m";
                EXPECT_FALSE(scene.world.isAwake(scene.flipper)) << name;
                // With seventy times its weight it may slip out of the grip of soft contacts, and rest is without it.
                if (torque <= 10) { EXPECT_GT(scene.world.position(scene.ball).y, 0) << name; }
            }
        }
    }
}

/// So does a spring that is blocked, but for a few in soft contacts. (Of these 30, 15 trembled on.)
TEST(Flippers, ThatPinchABulletWithASpringComeToRest) {
    int restless = 0;
    for (const Profile profile : kProfiles) {
        for (const double hertz : {2.0, 5.0, 10.0, 20.0, 30.0}) {
            for (const double target : {0.3, 0.6, 1.0}) {
                const PinchedBall scene(profile, {}, Spring{real(hertz), real(0.2)}, target);
                restless += scene.world.isAwake(scene.flipper) ? 1 : 0;
            }
        }
    }
    expectAtMost("restless flippers", restless, 8);
}

/// A wheel turns with a bar on a hinge that does not, and that strikes a ball before it.
double struckByWheel(Profile profile, double spin, double lift, double rate) {
    World world = makeWorld(awakeSettings(profile, 0));
    const BodyId wheel = must(world.createBody({.type = BodyType::kinematic, .velocity = vec(0, lift)}));
    must(world.setVelocity(wheel, vec(0, lift), real(spin)));
    BodyDef barDef = dynamicAt({0, 0});
    barDef.angle = -0.5;
    barDef.velocity = vec(0, lift);
    barDef.angularVelocity = real(spin);
    const BodyId bar = addBody(world, barDef, must(makeBox(vec(0.035, 0.005), vec(0.035, 0))), material(0, 0, 60));
    must(world.createJoint(RevoluteJointDef{
        .base = {.bodyA = wheel, .bodyB = bar}, .anchor = {0, 0}, .limits = AngleLimits{.lower = 0, .upper = 0}}));
    BodyDef def = dynamicAt({0.04, 0.007});
    def.bullet = true;
    const BodyId ball = addBody(world, def, circle(kBallRadius), material(0, 0, 140));
    double fastest = 0;
    for (int i = 0; i < static_cast<int>(rate / 20); ++i) {
        run(world, 1, 1 / rate);
        fastest = std::max(fastest, length(velocityOf(world, ball)));
    }
    return fastest;
}

/// (It turned unseen, since its hinge does not: 0.72 of the speed.)
TEST(Flippers, OnWheelsThatTurn) {
    for (const Profile profile : kProfiles) {
        for (const double spin : {20.0, 40.0}) {
            for (const double lift : {0.0, 1.0}) {
                const double right = struckByWheel(Profile::accurate, spin, lift, 3840);
                const double speed = struckByWheel(profile, spin, lift, kRate);
                expectAtMost(profileName(profile) + ", " + std::to_string(spin) + " rad/s, lifted at " +
                                 std::to_string(lift) + " m/s",
                             std::abs(speed / right - 1), 0.1);
            }
        }
    }
}

/// A spring throws a plunger to the end of its way, 6 cm, and the ball before it.
double shotByPlunger(Profile profile, double hertz, double gap, double rate) {
    World world = makeWorld(awakeSettings(profile, 0));
    const BodyId level = must(world.createBody({}));
    const BodyId plunger = addBody(world, dynamicAt({0, 0}), box(0.017, 0.02), material(0, 0, 100));
    BodyDef def = dynamicAt({0, 0.02 + kBallRadius + gap});
    def.bullet = true;
    const BodyId ball = addBody(world, def, circle(kBallRadius), material(0, 0.2, 140));
    PrismaticJointDef slide;
    slide.base = {.bodyA = level, .bodyB = plunger};
    slide.axis = {0, 1};
    slide.limits = TranslationLimits{.lower = 0, .upper = real(0.06)};
    slide.spring = Spring{.hertz = real(hertz), .dampingRatio = real(0.2)};
    slide.springTarget = real(0.08);
    must(world.createJoint(slide));
    run(world, static_cast<int>(rate / 5), 1 / rate);
    return velocityOf(world, ball).y;
}

/// (It was left at rest where the plunger stopped, with an impulse of nothing.)
TEST(Flippers, PlungersShootBullets) {
    for (const Profile profile : kProfiles) {
        for (const double hertz : {8.0, 15.0}) {
            for (const double gap : {0.0005, 0.002, 0.005}) {
                const double right = shotByPlunger(Profile::accurate, hertz, gap, 3840);
                const double speed = shotByPlunger(profile, hertz, gap, kRate);
                EXPECT_GT(speed, 0.5 * right) << hertz << " Hz, " << gap << " m before it";
                EXPECT_LT(speed, 1.1 * right) << hertz << " Hz, " << gap << " m before it";
            }
        }
    }
}

}  // namespace
}  // namespace swept::test
