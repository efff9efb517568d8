#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "bar_chain.h"

/// Bodies that motor joints hold or drive against each other, with hinges beside them or without. Statics is the
/// oracle.

namespace swept::test {
namespace {

enum class Held { byHinge, byMotor };

struct ArmChain {
    World world;
    std::vector<BodyId> bars;
    std::vector<JointId> hinges;
    std::vector<JointId> motors;

    double tipHeight() const { return world.position(bars.back()).y; }
    double torque() const { return std::fabs(static_cast<double>(world.jointTorque(motors.front()))); }
};

struct Arm {
    int bars = 1;
    double tip = 1;
    Held held = Held::byHinge;
    MotorDrive drive{};
};

/// Bars one on the end of the other, from the origin to the right; the last one is heavier.
ArmChain motorJointChainOf(const WorldSettings& settings, const Arm& arm) {
    ArmChain chain{makeWorld(settings), {}, {}, {}};
    BodyId before = anchorOf(chain.world);
    for (int i = 0; i < arm.bars; ++i) {
        const BodyId bar =
            addBody(chain.world, dynamicAt({2.0 * i + 1, 0}), box(1, 0.2), barOf(i == arm.bars - 1 ? arm.tip : 1));
        if (arm.held == Held::byHinge) {
            RevoluteJointDef hinge;
            hinge.base = between(before, bar);
            hinge.anchor = {2.0 * i, 0};
            chain.hinges.push_back(must(chain.world.createJoint(hinge)));
        }
        MotorJointDef motor;
        motor.base = between(before, bar);
        motor.drive = arm.drive;
        chain.motors.push_back(must(chain.world.createJoint(motor)));
        chain.bars.push_back(bar);
        before = bar;
    }
    return chain;
}

MotorDrive holdOf(double maxTorque) {
    MotorDrive drive;
    drive.maxTorque = real(maxTorque);
    return drive;
}
MotorDrive poseOf(double maxForce, double maxTorque) {
    MotorDrive drive = holdOf(maxTorque);
    drive.maxForce = real(maxForce);
    return drive;
}

/// Of the first motor, with all bars level: about its hinge, or about the middle of the first bar.
double torqueAtRest(const Arm& arm) {
    double torque = 0;
    for (int i = 0; i < arm.bars; ++i) {
        const double lever = arm.held == Held::byHinge ? 2 * i + 1 : 2 * i;
        torque += kBarWeight * (i == arm.bars - 1 ? arm.tip : 1) * lever;
    }
    return torque;
}

/// From two bars and 10 : 1 on they flew about with 60 to 260 m/s.
TEST(MotorJointChain, ArmsHoldAndSleep) {
    for (const double tip : {1.0, 10.0, 100.0}) {
        for (int bars = 1; bars <= 5; ++bars) {
            const Arm arm{.bars = bars, .tip = tip, .drive = holdOf(1e6)};
            ArmChain chain = motorJointChainOf(settingsOf(Profile::accurate, true), arm);
            runFor(chain.world, 15);
            EXPECT_NEAR(chain.tipHeight(), 0, 1e-3) << bars << " bars, tip " << tip;
            EXPECT_FALSE(chain.world.isAwake(chain.bars.back())) << bars << " bars, tip " << tip;
            EXPECT_NEAR(chain.torque(), torqueAtRest(arm), 1e-3 * torqueAtRest(arm)) << bars << " bars, tip " << tip;
            EXPECT_NEAR(static_cast<double>(chain.world.jointForce(chain.hinges.front()).y),
                        kBarWeight * (bars - 1 + tip), 1e-3 * kBarWeight * (bars - 1 + tip))
                << bars << " bars, tip " << tip;
        }
    }
}

/// Without hinges three bars did, with a tip of 10 : 1.
TEST(MotorJointChain, MastsStandWithoutHinges) {
    for (const double tip : {1.0, 10.0, 100.0}) {
        for (int bars = 2; bars <= 5; ++bars) {
            const Arm arm{.bars = bars, .tip = tip, .held = Held::byMotor, .drive = poseOf(1e6, 1e6)};
            ArmChain chain = motorJointChainOf(settingsOf(Profile::accurate), arm);
            EXPECT_LT(fastestTip(chain, 10), 1e-3) << bars << " bars, tip " << tip;
            EXPECT_NEAR(chain.tipHeight(), 0, 1e-3) << bars << " bars, tip " << tip;
            EXPECT_NEAR(chain.torque(), torqueAtRest(arm), 1e-3 * torqueAtRest(arm)) << bars << " bars, tip " << tip;
            const double weight = kBarWeight * (bars - 1 + tip);
            EXPECT_NEAR(static_cast<double>(chain.world.jointForce(chain.motors.front()).y), weight, 1e-3 * weight);
        }
    }
}

/// Both drives beside a hinge close a loop, which is iterated.
TEST(MotorJointChain, BothDrivesBesideAHingeHold) {
    for (const double tip : {1.0, 10.0, 100.0}) {
        for (int bars = 2; bars <= 3; ++bars) {
            const Arm arm{.bars = bars, .tip = tip, .drive = poseOf(1e6, 1e6)};
            ArmChain chain = motorJointChainOf(settingsOf(Profile::accurate), arm);
            runFor(chain.world, 10);
            EXPECT_LT(fastestTip(chain, 5), 1e-3) << bars << " bars, tip " << tip;
            EXPECT_NEAR(chain.tipHeight(), 0, 1e-3 * tip + 1e-3) << bars << " bars, tip " << tip;
        }
    }
}

/// Three equal bars whirled with 200 m/s.
TEST(MotorJointChain, ArmsAndMastsStandInFast) {
    for (const Held held : {Held::byHinge, Held::byMotor}) {
        for (const double tip : {1.0, 3.0, 10.0}) {
            for (int bars = 1; bars <= 3; ++bars) {
                const MotorDrive drive = held == Held::byHinge ? holdOf(1e6) : poseOf(1e6, 1e6);
                const Arm arm{.bars = bars, .tip = tip, .held = held, .drive = drive};
                ArmChain chain = motorJointChainOf(settingsOf(Profile::fast), arm);
                runFor(chain.world, 10);
                EXPECT_LT(fastestTip(chain, 5), 1e-3) << bars << " bars, tip " << tip;
                // Twice what welds give way.
                EXPECT_NEAR(chain.tipHeight(), 0, 2e-3 * std::pow(bars, 4) * (1 + tip / 5)) << bars << ", tip " << tip;
                EXPECT_NEAR(chain.torque(), torqueAtRest(arm), 1e-2 * torqueAtRest(arm)) << bars << ", tip " << tip;
            }
        }
    }
}

/// Of a hinge what it holds is told, whoever pushed for it: all of its weight, and nothing to the side.
TEST(MotorJointChain, HingesTellWhatTheyHoldInFast) {
    for (const bool isReversed : {false, true}) {
        World world = makeWorld(settingsOf(Profile::fast));
        const BodyId ground = anchorOf(world);
        const BodyId bar = addBody(world, dynamicAt({1, 0}), box(1, 0.2), barOf(1));
        RevoluteJointDef hinge;
        hinge.base = isReversed ? between(bar, ground) : between(ground, bar);
        const JointId held = must(world.createJoint(hinge));
        MotorJointDef motor;
        motor.base = between(ground, bar);
        motor.drive = holdOf(1000);
        const JointId turned = must(world.createJoint(motor));
        runFor(world, 5);
        EXPECT_NEAR(static_cast<double>(world.jointForce(held).y), isReversed ? -kBarWeight : kBarWeight, 1e-2);
        EXPECT_NEAR(static_cast<double>(world.jointForce(held).x), 0, 1e-2);
        EXPECT_EQ(world.jointForce(turned), Vec2{});
        EXPECT_NEAR(static_cast<double>(world.jointTorque(turned)), kBarWeight, 1e-2);
    }
}

/// A body that one motor joint alone holds does not give way: it has nothing to shake with.
TEST(MotorJointChain, OneAloneHoldsExactly) {
    for (const Profile profile : {Profile::accurate, Profile::fast}) {
        ArmChain chain = motorJointChainOf(settingsOf(profile), {.held = Held::byMotor, .drive = poseOf(1e4, 1e4)});
        runFor(chain.world, 5);
        EXPECT_NEAR(chain.tipHeight(), 0, 1e-6) << profileName(profile);
        EXPECT_LT(fastestTip(chain, 1), 1e-6) << profileName(profile);
    }
}

/// Rows in the frames of what turns. (Three boxes that spun at 1 rad/s flew apart with 24 000 times their energy, since
/// the matrix followed their turns from step to step only.)
TEST(MotorJointChain, WhatTheyHoldTogetherSpinsOn) {
    constexpr double kSpacing = 1.5;
    constexpr double kSpin = 5;  // rad/s
    for (const Profile profile : {Profile::accurate, Profile::fast}) {
        for (const int boxes : {2, 3, 5}) {
            WorldSettings settings = settingsOf(profile);
            settings.gravity = {};
            World world = makeWorld(settings);
            std::vector<BodyId> row;
            std::vector<JointId> motors;
            for (int i = 0; i < boxes; ++i) {
                BodyDef def = dynamicAt({kSpacing * (i - (boxes - 1) / 2.0), 0});
                def.velocity = {0, real(kSpin * def.position.x)};
                def.angularVelocity = real(kSpin);
                row.push_back(addBody(world, def, box(0.5, 0.5)));
                if (i == 0) { continue; }
                MotorJointDef motor;
                motor.base = between(row[row.size() - 2], row.back());
                motor.drive = poseOf(1e6, 1e6);
                motors.push_back(must(world.createJoint(motor)));
            }
            runFor(world, 2);
            const std::string what = profileName(profile) + ", " + std::to_string(boxes);
            const double gap = length(world.position(row[1]) - world.position(row[0])) - kSpacing;
            EXPECT_NEAR(gap, 0, 5e-3) << what;
            // The drives follow the frame of A within a step, and so lose a part of the speed.
            EXPECT_NEAR(static_cast<double>(world.angularVelocity(row[0])), kSpin, 0.02 * kSpin) << what;
            const double pull = world.mass(row[0]) * kSpin * kSpin * kSpacing * (boxes - 1) / 2;
            EXPECT_NEAR(static_cast<double>(length(world.jointForce(motors[0]))), pull, 0.05 * pull) << what;
        }
    }
}

/// What they carry counts with what it stands on.
TEST(MotorJointChain, ArmsOnABaseThatStandsHold) {
    for (const double tip : {1.0, 10.0}) {
        World world = makeWorld(settingsOf(Profile::accurate));
        addStatic(world, box(50, 0.5), material(0.6), {0, -0.5});
        BodyId before = addBody(world, dynamicAt({0, 2.5}), box(3, 2.5), material(0.6, 0, 50));
        std::vector<JointId> motors;
        for (int i = 0; i < 3; ++i) {
            const BodyId bar = addBody(world, dynamicAt({2.0 * i + 1, 5}), box(1, 0.2), barOf(i == 2 ? tip : 1));
            RevoluteJointDef hinge;
            hinge.base = between(before, bar);
            hinge.anchor = {2.0 * i, 5};
            must(world.createJoint(hinge));
            MotorJointDef motor;
            motor.base = between(before, bar);
            motor.drive = holdOf(1e5);
            motors.push_back(must(world.createJoint(motor)));
            before = bar;
        }
        runFor(world, 5);
        const double height = world.position(before).y;
        runFor(world, 10);
        EXPECT_NEAR(world.position(before).y, height, 1e-3) << tip;
        const double torque = torqueAtRest({.bars = 3, .tip = tip});
        EXPECT_NEAR(std::fabs(static_cast<double>(world.jointTorque(motors[0]))), torque, 1e-2 * torque) << tip;
    }
}

/// The middle joint goes up by a radian in a second, and stays there.
TEST(MotorJointChain, ArmsFollowATargetThatMoves) {
    for (const Profile profile : {Profile::accurate, Profile::fast}) {
        ArmChain chain = motorJointChainOf(settingsOf(profile), {.bars = 3, .tip = 5, .drive = holdOf(1e5)});
        double largest = 0;
        for (int step = 1; step <= 600; ++step) {
            MotorDrive drive = holdOf(1e5);
            drive.angularOffset = real(std::min(step * kStep, 1.0));
            must(chain.world.setDrive(chain.motors[1], drive));
            run(chain.world, 1);
            largest = std::max(largest, static_cast<double>(chain.world.angle(chain.bars[1])));
        }
        const double error = profile == Profile::fast ? 0.05 : 1e-4;
        for (std::size_t i = 0; i < 3; ++i) {
            EXPECT_NEAR(static_cast<double>(chain.world.angle(chain.bars[i])), i == 0 ? 0 : 1, error)
                << profileName(profile) << ", bar " << i;
        }
        EXPECT_LT(largest, 1 + error) << profileName(profile);
        EXPECT_LT(fastestTip(chain, 1), 1e-3) << profileName(profile);
    }
}

/// A bar whose motor has half of the torque that would hold it falls as if that torque were all that there is.
TEST(MotorJointChain, WeakMotorsGiveWayAsForces) {
    for (const Profile profile : {Profile::accurate, Profile::fast}) {
        constexpr double kTorque = kBarWeight / 2;
        ArmChain chain = motorJointChainOf(settingsOf(profile), {.drive = holdOf(kTorque)});
        const double mass = kBarWeight / kGravity;
        const double inertia = mass * (4 + 0.16) / 12 + mass;
        double angle = 0;
        double spin = 0;
        constexpr int kParts = 200;  // of a step
        for (int step = 0; step < 30; ++step) {
            run(chain.world, 1);
            EXPECT_NEAR(chain.torque(), kTorque, 1e-3) << profileName(profile);
            for (int part = 0; part < kParts; ++part) {
                spin += (kTorque - kBarWeight * std::cos(angle)) / inertia * kStep / kParts;
                angle += spin * kStep / kParts;
            }
        }
        EXPECT_LT(angle, -0.4);
        EXPECT_NEAR(static_cast<double>(chain.world.angle(chain.bars[0])), angle,
                    profile == Profile::fast ? 1e-2 : 1e-3)
            << profileName(profile);
    }
}

/// A load that is more than its force goes down as under what is left of its weight.
TEST(MotorJointChain, AGripThatIsTooWeakSlides) {
    World world = makeWorld(settingsOf(Profile::accurate));
    const BodyId ground = anchorOf(world);
    const BodyId arm = addBody(world, dynamicAt({1, 0}), box(1, 0.2), barOf(1));
    RevoluteJointDef hinge;
    hinge.base = between(ground, arm);
    must(world.createJoint(hinge));
    MotorJointDef motor;
    motor.base = between(ground, arm);
    motor.drive = holdOf(1e5);
    must(world.createJoint(motor));
    const BodyId load = addBody(world, dynamicAt({2, -1}), box(1, 0.2), barOf(1));
    MotorJointDef grip;
    grip.base = between(arm, load);
    grip.drive = poseOf(kBarWeight / 2, 1000);
    const JointId held = must(world.createJoint(grip));
    runFor(world, 0.5);
    EXPECT_NEAR(world.position(load).y, -1 - 0.5 * kGravity / 2 * 0.25, 2e-3);
    EXPECT_NEAR(length(toDouble(world.jointForce(held))), kBarWeight / 2, 1e-3);
    EXPECT_NEAR(world.position(arm).y, 0, 1e-3);
}

}  // namespace
}  // namespace swept::test
