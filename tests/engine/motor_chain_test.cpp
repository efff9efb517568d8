#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <string>
#include <vector>

#include "../support/some_of.h"
#include "bar_chain.h"

/// Bodies that motors hold or drive against each other, one after the other: arms, masts, cranes. Statics is the
/// oracle.

namespace swept::test {
namespace {

/// Bars one on the end of the other, from the origin to the right; the last one is heavier.
struct BarChain {
    World world;
    std::vector<BodyId> bars;
    std::vector<JointId> joints;

    double torque() const { return std::fabs(static_cast<double>(world.jointTorque(joints.front()))); }
};

/// @param join  makes the joint of a bar with the one before at a place
template <class Join>
BarChain chainOf(const WorldSettings& settings, int bars, double tip, const Join& join) {
    BarChain chain{makeWorld(settings), {}, {}};
    BodyId before = anchorOf(chain.world);
    for (int i = 0; i < bars; ++i) {
        const BodyId bar =
            addBody(chain.world, dynamicAt({2.0 * i + 1, 0}), box(1, 0.2), barOf(i == bars - 1 ? tip : 1));
        chain.joints.push_back(join(chain.world, before, bar, i));
        chain.bars.push_back(bar);
        before = bar;
    }
    return chain;
}

BarChain armOf(const WorldSettings& settings, int bars, double tip, double maxTorque) {
    return chainOf(settings, bars, tip, [maxTorque](World& world, BodyId a, BodyId b, int i) {
        RevoluteJointDef def;
        def.base = between(a, b);
        def.anchor = {2.0 * i, 0};
        def.motor = AngularMotor{0, real(maxTorque)};
        return must(world.createJoint(def));
    });
}

/// At the first hinge, with all bars level.
double staticTorque(int bars, double tip) {
    double torque = 0;
    for (int i = 0; i < bars; ++i) { torque += kBarWeight * (i == bars - 1 ? tip : 1) * (2 * i + 1); }
    return torque;
}

/// They flew about with 20 m/s.
TEST(MotorChain, MastsOfSlidersStand) {
    for (const double maxForce : {2000.0, 1e5}) {
        for (int bars = 1; bars <= 4; ++bars) {
            BarChain mast =
                chainOf(settingsOf(Profile::accurate), bars, 1, [&](World& world, BodyId a, BodyId b, int i) {
                    PrismaticJointDef def;
                    def.base = between(a, b);
                    def.anchor = {2.0 * i, 0};
                    def.axis = {0, 1};
                    def.motor = LinearMotor{0, real(maxForce)};
                    return must(world.createJoint(def));
                });
            EXPECT_LT(fastestTip(mast, 10), 1e-3) << bars;
            EXPECT_NEAR(mast.world.position(mast.bars.back()).y, 0, 1e-4) << bars;
            EXPECT_NEAR(static_cast<double>(mast.world.jointForce(mast.joints.front()).y), bars * kBarWeight,
                        1e-3 * bars * kBarWeight);
        }
    }
}

/// They rose by millimetres a second, for ever.
TEST(MotorChain, ArmsHoldAndSleep) {
    for (int bars = 1; bars <= 5; ++bars) {
        BarChain arm = armOf(settingsOf(Profile::accurate, true), bars, 1, 1e5);
        runFor(arm.world, 20);
        EXPECT_NEAR(arm.world.position(arm.bars.back()).y, 0, 1e-3) << bars;
        EXPECT_FALSE(arm.world.isAwake(arm.bars.back())) << bars;
        EXPECT_NEAR(arm.torque(), staticTorque(bars, 1), 1e-3 * staticTorque(bars, 1)) << bars;
    }
}

TEST(MotorChain, HeavyTipsAreHeld) {
    for (const double tip : {0.1, 10.0, 100.0}) {
        for (int bars = 2; bars <= 5; ++bars) {
            BarChain arm = armOf(settingsOf(Profile::accurate), bars, tip, 1e6);
            EXPECT_LT(fastestTip(arm, 10), 1e-3) << bars << " bars, tip " << tip;
            EXPECT_NEAR(arm.world.position(arm.bars.back()).y, 0, 1e-3) << bars << " bars, tip " << tip;
            EXPECT_NEAR(arm.torque(), staticTorque(bars, tip), 1e-3 * staticTorque(bars, tip)) << bars << ", " << tip;
        }
    }
}

/// Contacts are answered by what the motors hold together.
TEST(MotorChain, ArmsOnABaseThatStandsHold) {
    for (const double tip : {1.0, 10.0}) {
        World world = makeWorld(settingsOf(Profile::accurate));
        addStatic(world, box(50, 0.5), material(0.6), {0, -0.5});
        const BodyId base = addBody(world, dynamicAt({0, 2.5}), box(3, 2.5), material(0.6, 0, 50));
        BodyId before = base;
        std::vector<JointId> hinges;
        for (int i = 0; i < 3; ++i) {
            const BodyId bar =
                addBody(world, dynamicAt({2.0 * i + 1, 5}), box(1, 0.2), untouchable(i == 2 ? 5 * tip : 5));
            RevoluteJointDef hinge;
            hinge.base = between(before, bar);
            hinge.anchor = {2.0 * i, 5};
            hinge.motor = AngularMotor{0, 100000};
            hinges.push_back(must(world.createJoint(hinge)));
            before = bar;
        }
        runFor(world, 5);
        const double height = world.position(before).y;
        runFor(world, 10);
        EXPECT_NEAR(world.position(before).y, height, 1e-3) << tip;
        EXPECT_NEAR(std::fabs(static_cast<double>(world.jointTorque(hinges[0]))), staticTorque(3, tip),
                    1e-2 * staticTorque(3, tip))
            << tip;
    }
}

/// A bar with limits between two with brakes.
TEST(MotorChain, LimitsBetweenBrakesHold) {
    for (const double tip : {1.0, 10.0}) {
        BarChain arm = chainOf(settingsOf(Profile::accurate), 3, tip, [](World& world, BodyId a, BodyId b, int i) {
            RevoluteJointDef def;
            def.base = between(a, b);
            def.anchor = {2.0 * i, 0};
            if (i == 1) { def.limits = AngleLimits{0, 0}; }
            if (i != 1) { def.motor = AngularMotor{0, 100000}; }
            return must(world.createJoint(def));
        });
        runFor(arm.world, 5);
        const double height = arm.world.position(arm.bars.back()).y;
        runFor(arm.world, 15);
        EXPECT_NEAR(arm.world.position(arm.bars.back()).y, height, 1e-3) << tip;
        EXPECT_NEAR(arm.torque(), staticTorque(3, tip), 1e-2 * staticTorque(3, tip)) << tip;
    }
}

/// Two hinges blew up from 8 : 1 on.
TEST(MotorChain, HeavyTipsAreHeldInFast) {
    for (const double tip : {1.0, 8.0, 10.0, 20.0}) {
        for (int bars = 2; bars <= 3; ++bars) {
            BarChain arm = armOf(settingsOf(Profile::fast), bars, tip, 1e5);
            runFor(arm.world, 15);
            EXPECT_LT(fastestTip(arm, 5), tip > 10 ? 0.05 : 1e-2) << bars << " bars, tip " << tip;
            EXPECT_NEAR(arm.torque(), staticTorque(bars, tip), 0.02 * staticTorque(bars, tip)) << bars << ", " << tip;
        }
    }
}

/// What springs and limits along the axis did turned the body against its brake.
TEST(MotorChain, BrakedWheelsHoldOffTheirCentre) {
    enum class Along { limits, room, spring, sprung };
    for (const Along along : {Along::limits, Along::room, Along::spring, Along::sprung}) {
        for (const DVec2 axis : {DVec2{0, 1}, DVec2{1, 0}}) {
            World world = makeWorld(settingsOf(Profile::accurate, true));
            const BodyId ground = anchorOf(world);
            const BodyId body = addBody(world, dynamicAt({2, 0}), box(1, 0.5), material(0.6, 0, 5));
            WheelJointDef def;
            def.base = between(ground, body);
            def.anchor = {1.5, 0};
            def.axis = axis;
            def.motor = AngularMotor{0, 1000};
            if (along == Along::limits) { def.limits = TranslationLimits{0, 0}; }
            if (along == Along::room || along == Along::sprung) {
                def.limits = TranslationLimits{real(-0.1), real(0.1)};
            }
            if (along == Along::spring || along == Along::sprung) { def.spring = Spring{4, real(0.7)}; }
            const JointId wheel = must(world.createJoint(def));
            runFor(world, 5);
            const double before = static_cast<double>(world.jointAngle(wheel));
            runFor(world, 15);
            EXPECT_NEAR(static_cast<double>(world.jointAngle(wheel)), before, 1e-4) << static_cast<int>(along);
            EXPECT_NEAR(before, 0, 5e-3) << static_cast<int>(along);
            EXPECT_NEAR(std::fabs(static_cast<double>(world.jointTorque(wheel))), 50, 0.5) << static_cast<int>(along);
            EXPECT_FALSE(world.isAwake(body)) << static_cast<int>(along);
        }
    }
}

/// A bar whose brake has half of the torque that would hold it falls as if that torque were all that there is.
TEST(MotorChain, WeakBrakesGiveWayAsForces) {
    for (const Profile profile : {Profile::accurate, Profile::fast}) {
        constexpr double kTorque = kBarWeight / 2;
        BarChain arm = armOf(settingsOf(profile), 1, 1, kTorque);
        const double mass = kBarWeight / kGravity;
        const double inertia = mass * (4 + 0.16) / 12 + mass;
        double angle = 0;
        double spin = 0;
        constexpr int kParts = 200;  // of a step
        for (int step = 0; step < 30; ++step) {
            run(arm.world, 1);
            for (int part = 0; part < kParts; ++part) {
                spin += (kTorque - kBarWeight * std::cos(angle)) / inertia * kStep / kParts;
                angle += spin * kStep / kParts;
            }
        }
        const double error = profile == Profile::fast ? 1e-2 : 1e-3;
        EXPECT_LT(angle, -0.4);
        EXPECT_NEAR(static_cast<double>(arm.world.jointAngle(arm.joints[0])), angle, error) << profileName(profile);
        EXPECT_NEAR(arm.torque(), kTorque, 1e-3) << profileName(profile);
    }
}

/// With hardly more than they need, and with much less in the middle of the arm.
TEST(MotorChain, ArmsWithLittleTorqueToSpareDoNotTremble) {
    for (const double strength : {1.01, 2.0}) {
        BarChain arm = armOf(settingsOf(Profile::accurate), 3, 10, strength * staticTorque(3, 10));
        EXPECT_LT(fastestTip(arm, 10), 1e-3) << strength;
        EXPECT_NEAR(arm.torque(), staticTorque(3, 10), 1e-3 * staticTorque(3, 10)) << strength;
    }
    BarChain arm = armOf(settingsOf(Profile::accurate), 3, 10, 1e5);
    // It cannot hold the tip: that hangs down in the end.
    must(arm.world.setAngularMotor(arm.joints[2], AngularMotor{0, 100}));
    runFor(arm.world, 20);
    EXPECT_LT(fastestTip(arm, 5), 1e-2);
    EXPECT_NEAR(static_cast<double>(arm.world.jointAngle(arm.joints[0])), 0, 1e-3);
    EXPECT_NEAR(static_cast<double>(arm.world.jointAngle(arm.joints[1])), 0, 1e-3);
}

TEST(MotorChain, ArmsSwingAtTheirSpeed) {
    for (const Profile profile : {Profile::accurate, Profile::fast}) {
        BarChain arm = armOf(settingsOf(profile), 3, 5, 1e5);
        must(arm.world.setAngularMotor(arm.joints[1], AngularMotor{1, 100000}));
        runFor(arm.world, 1);
        must(arm.world.setAngularMotor(arm.joints[1], AngularMotor{0, 100000}));
        runFor(arm.world, 4);
        // 500 kg·m² take 5 ms to get there.
        const double error = profile == Profile::fast ? 0.05 : 5e-3;
        for (std::size_t i = 0; i < 3; ++i) {
            EXPECT_NEAR(static_cast<double>(arm.world.jointAngle(arm.joints[i])), i == 1 ? 1 : 0, error)
                << profileName(profile) << ", hinge " << i;
        }
        EXPECT_LT(fastestTip(arm, 1), profile == Profile::fast ? 0.05 : 1e-3) << profileName(profile);
    }
}

/// Three bars of random lengths at random angles, five times as dense at the tip in `accurate`.
TEST(MotorChain, RandomArmsDoNotShake) {
    for (const Profile profile : {Profile::accurate, Profile::fast}) {
        int shaking = 0;
        double fastest = 0;
        for (std::uint32_t seed = 0; seed < someOf(100U); ++seed) {
            std::mt19937 random(seed);
            const auto between01 = [&random] { return static_cast<double>(random()) / 4294967296.0; };
            BarChain arm{makeWorld(settingsOf(profile)), {}, {}};
            BodyId before = anchorOf(arm.world);
            DVec2 at{};
            for (int i = 0; i < 3; ++i) {
                const double angle = 2 * between01() - 1;
                const double half = 0.25 + 0.75 * between01();
                const DVec2 along = turned({half, 0}, angle);
                BodyDef def = dynamicAt(at + along);
                def.angle = angle;
                const BodyId bar = addBody(arm.world, def, box(half, 0.2),
                                           untouchable(i == 2 && profile == Profile::accurate ? 25 : 5));
                RevoluteJointDef hinge;
                hinge.base = between(before, bar);
                hinge.anchor = at;
                hinge.motor = AngularMotor{0, 3000};
                arm.joints.push_back(must(arm.world.createJoint(hinge)));
                arm.bars.push_back(bar);
                before = bar;
                at = at + 2.0 * along;
            }
            runFor(arm.world, 8);
            const double speed = fastestTip(arm, 2);
            fastest = std::max(fastest, speed);
            shaking += speed > (profile == Profile::fast ? 0.1 : 1e-3) ? 1 : 0;
        }
        EXPECT_EQ(shaking, 0) << profileName(profile) << ", the fastest " << fastest << " m/s";
    }
}

/// Limits that are never reached are none: what they might do changes nothing.
TEST(MotorChain, IdleLimitsTakeNoEnergy) {
    BarChain pendulum = chainOf(settingsOf(Profile::accurate), 3, 1, [](World& world, BodyId a, BodyId b, int i) {
        RevoluteJointDef def;
        def.base = between(a, b);
        def.anchor = {2.0 * i, 0};
        def.limits = AngleLimits{-1000, 1000};
        return must(world.createJoint(def));
    });
    const double before = energyOf(pendulum.world, pendulum.bars, kGravity);
    double largest = 0;
    for (int step = 0; step < 600; ++step) {
        run(pendulum.world, 1);
        largest = std::max(largest, std::fabs(energyOf(pendulum.world, pendulum.bars, kGravity) - before));
    }
    EXPECT_LT(largest / (3 * kBarWeight), 1e-3);  // of metres that it fell
}

}  // namespace
}  // namespace swept::test
