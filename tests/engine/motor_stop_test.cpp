#include <cmath>
#include <string>

#include "joint_support.h"

/// Motors and the limits of their own joints: however strong the motor, the limits hold.

namespace swept::test {
namespace {

constexpr double kPartOfSize = 1.0 / 64;  ///< of the size, or radians, that a limit may give

struct Rate {
    Profile profile;
    double dt;
};
constexpr Rate kRates[] = {
    {Profile::accurate, 1.0 / 60}, {Profile::accurate, 1.0 / 30}, {Profile::fast, 1.0 / 60}, {Profile::fast, 1.0 / 30}};

World worldAt(const Rate& rate) {
    WorldSettings settings = awakeSettings();
    settings.profile = rate.profile;
    return makeWorld(settings);
}

std::string stopCase(const Rate& rate, double torque) {
    return profileName(rate.profile) + ", dt " + std::to_string(rate.dt) + ", times " + std::to_string(torque);
}

/// A flipper of 7.5 cm, up to ten thousand times as strong as its weight asks for.
TEST(MotorStop, FlippersStopAtTheirLimits) {
    for (const Rate& rate : kRates) {
        for (const double strength : {10.0, 1e3, 1e5}) {
            World world = worldAt(rate);
            const BodyId table = must(world.createBody({}));
            const BodyId flipper = addBody(world, dynamicAt({0.0375, 0}), box(0.0375, 0.0075), material(0.6, 0, 10));
            RevoluteJointDef def;
            def.base = between(table, flipper);
            def.limits = AngleLimits{real(-0.5), real(0.5)};
            const double weight = 0.0375 * kGravity * world.mass(flipper);
            const JointId hinge = must(world.createJoint(def));
            for (const double way : {1.0, -1.0, 1.0}) {
                must(world.setAngularMotor(hinge, AngularMotor{real(20 * way), real(strength * weight)}));
                double farthest = 0;
                for (int step = 0; step < 60; ++step) {
                    run(world, 1, rate.dt);
                    farthest = std::max(farthest, way * world.jointAngle(hinge));
                }
                EXPECT_NEAR(way * world.jointAngle(hinge), 0.5, 1e-3) << stopCase(rate, strength);
                EXPECT_LT(farthest, 0.5 + 3 * kPartOfSize) << stopCase(rate, strength);
            }
        }
    }
}

TEST(MotorStop, SlidersStopAtTheirLimits) {
    for (const Rate& rate : kRates) {
        for (const double strength : {10.0, 1e3, 1e5}) {
            World world = worldAt(rate);
            const BodyId post = must(world.createBody({}));
            const BodyId lift = addBody(world, dynamicAt({0, 0}), box(0.05, 0.05));
            PrismaticJointDef def;
            def.base = between(post, lift);
            def.axis = {0, 1};
            def.limits = TranslationLimits{real(-0.1), real(0.2)};
            const double weight = kGravity * world.mass(lift);
            const JointId slider = must(world.createJoint(def));
            for (const double way : {1.0, -1.0}) {
                must(world.setLinearMotor(slider, LinearMotor{real(3 * way), real(strength * weight)}));
                run(world, 60, rate.dt);
                EXPECT_NEAR(world.jointTranslation(slider), way > 0 ? 0.2 : -0.1, 0.1 * kPartOfSize)
                    << stopCase(rate, strength);
            }
        }
    }
}

/// What turns far in a step gets through it in parts: in each of them the motor came to the stop by a part of what was
/// left, so that it took ten steps to get there.
TEST(MotorStop, FastFlippersGetToTheirLimits) {
    for (const Rate& rate : kRates) {
        World world = worldAt(rate);
        const BodyId table = must(world.createBody({}));
        const BodyId flipper = addBody(world, dynamicAt({0.0375, 0}), box(0.0375, 0.0075), material(0.6, 0, 10));
        constexpr double kSpin = 40;
        RevoluteJointDef def;
        def.base = between(table, flipper);
        def.limits = AngleLimits{real(-0.5), real(1.5)};
        def.motor = AngularMotor{real(kSpin), 2};
        const JointId hinge = must(world.createJoint(def));
        const int steps = static_cast<int>(std::ceil(1.5 / (kSpin * rate.dt)));
        run(world, steps, rate.dt);
        EXPECT_GT(world.jointAngle(hinge), 1.5 - kPartOfSize) << stopCase(rate, kSpin);
        EXPECT_LT(world.jointAngle(hinge), 1.5 + 6 * kPartOfSize) << stopCase(rate, kSpin);  // limits are soft
    }
}

/// What was carried past, as by limits that were moved, is brought back no faster than the motor goes.
TEST(MotorStop, BringBackWhatIsPast) {
    World world = makeWorld(awakeSettings(0));
    const BodyId post = must(world.createBody({}));
    const BodyId door = addBody(world, dynamicAt({0.5, 0}), box(0.5, 0.05));
    RevoluteJointDef def;
    def.base = between(post, door);
    def.limits = AngleLimits{real(-1), real(1)};
    const JointId hinge = must(world.createJoint(def));
    must(world.setAngularMotor(hinge, AngularMotor{real(2), real(1e4)}));
    run(world, 60);
    EXPECT_NEAR(world.jointAngle(hinge), 1, 1e-3);
    must(world.setAngleLimits(hinge, AngleLimits{real(-1), real(0.5)}));
    double fastest = 0;
    for (int step = 0; step < 60; ++step) {
        run(world, 1);
        fastest = std::max(fastest, std::abs(static_cast<double>(world.angularVelocity(door))));
    }
    EXPECT_NEAR(world.jointAngle(hinge), 0.5, 1e-3);
    EXPECT_LT(fastest, 2.1);
}

}  // namespace
}  // namespace swept::test
