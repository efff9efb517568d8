#include "joint_support.h"

/// Islands of joints with springs, motors and limits that nothing touches, in profile `accurate`: against closed forms,
/// and where sub-steps take over.

namespace swept::test {
namespace {

/// A disc of radius r on a hinge at its middle.
struct OneWheel {
    World world = makeWorld(Profile::accurate, 0);
    BodyId wheel = addBody(world, dynamicAt({0, 0}), circle(0.5));
    RevoluteJointDef hinge;
    JointId joint;

    void hang() {
        hinge.base = between(anchorOf(world), wheel);
        joint = must(world.createJoint(hinge));
    }
    double inertia() const { return static_cast<double>(world.inertia(wheel)); }
    double angle() const { return world.jointAngle(joint); }
};

/// Radians by which what was recorded in each step of a minute is off at most.
template <class Expected>
double worstOfAMinute(OneWheel& one, const Expected& expected) {
    double worst = 0;
    for (int i = 1; i <= 3600; ++i) {
        must(one.world.step(kStep));
        EXPECT_LE(one.world.counters().mostSubSteps, 2U);
        worst = std::max(worst, std::abs(one.angle() - expected(i * kStep)));
    }
    return worst;
}

TEST(DrivenIslands, ASpringSwingsAMinuteInItsTime) {
    OneWheel one;
    one.hinge.spring = Spring{real(2), 0};
    one.hang();
    must(one.world.setAngularVelocity(one.wheel, 3));
    const double rate = 2 * kPi * 2;
    const double worst = worstOfAMinute(one, [rate](double t) { return 3 / rate * std::sin(rate * t); });
    expectAtMost("rad", worst, 5e-5);  // of 0.24; in sub-steps it was 1.3e-3
}

TEST(DrivenIslands, ADampedSpringComesToRestInItsTime) {
    OneWheel one;
    one.hinge.spring = Spring{real(0.5), real(0.02)};
    one.hang();
    must(one.world.setAngularVelocity(one.wheel, 3));
    const double rate = kPi;
    const double decay = 0.02 * rate;
    const double damped = std::sqrt(rate * rate - decay * decay);
    const double worst =
        worstOfAMinute(one, [&](double t) { return 3 / damped * std::exp(-decay * t) * std::sin(damped * t); });
    expectAtMost("rad", worst, 5e-6);  // in sub-steps it was 5.7e-4
}

TEST(DrivenIslands, AMotorPushesAsHardAsItMayThenHolds) {
    OneWheel one;
    one.hang();
    const double torque = 0.25 * one.inertia();  // 0.25 rad/s²
    must(one.world.setAngularMotor(one.joint, AngularMotor{3, real(torque)}));
    for (int i = 1; i <= 900; ++i) {
        must(one.world.step(kStep));
        const double expected = std::min(0.25 * i * kStep, 3.0);
        ASSERT_NEAR(spinOf(one.world, one.wheel), expected, 2e-5) << "step " << i;
        const bool gets = i * kStep > 11.9 && i * kStep < 12.1;
        ASSERT_EQ(one.world.counters().mostSubSteps, gets && expected > 2.99 ? one.world.counters().mostSubSteps : 1U);
        if (i < 700) { ASSERT_NEAR(one.world.jointTorque(one.joint), torque, 1e-4 * torque) << "step " << i; }
        if (i > 730) { ASSERT_NEAR(one.world.jointTorque(one.joint), 0, 1e-4 * torque) << "step " << i; }
    }
}

/// A bar that a motor holds level carries its weight at an arm, as the joint tells.
TEST(DrivenIslands, AMotorHoldsWhatItsStrengthHolds) {
    for (const double strength : {0.9, 1.1}) {
        World world = makeWorld(Profile::accurate);
        const BodyId bar = addBody(world, dynamicAt({1, 0}), box(1, 0.1));
        RevoluteJointDef hinge;
        hinge.base = between(anchorOf(world), bar);
        const double weight = kGravity * static_cast<double>(world.mass(bar));
        hinge.motor = AngularMotor{0, real(strength * weight)};
        const JointId joint = must(world.createJoint(hinge));
        runFor(world, 1);
        const double sunk = -world.position(bar).y;
        if (strength > 1) {
            EXPECT_NEAR(world.jointTorque(joint), weight, 1e-4 * weight);
            expectAtMost("sunk, m", std::abs(sunk), 1e-6);
        } else {
            EXPECT_GT(sunk, 0.1);
        }
    }
}

/// A block on a spring along the vertical, once on a slider, once as a wheel: s = −g/ω²·(1 − cos ωt).
TEST(DrivenIslands, SpringsOfSlidersAndWheelsFollowTheirClosedForm) {
    const double rate = 2 * kPi * 1.5;
    for (const bool isWheel : {false, true}) {
        World world = makeWorld(Profile::accurate);
        const BodyId block = addBody(world, dynamicAt({0, 0}), box(0.2, 0.1));
        const auto setUp = [&](auto joint) {
            joint.base = between(anchorOf(world), block);
            joint.axis = {0, 1};
            joint.spring = Spring{real(1.5), 0};
            must(world.createJoint(joint));
        };
        isWheel ? setUp(WheelJointDef{}) : setUp(PrismaticJointDef{});
        double worst = 0;
        for (int i = 1; i <= 600; ++i) {
            must(world.step(kStep));
            EXPECT_EQ(world.counters().mostSubSteps, 1U);
            const double expected = -kGravity / (rate * rate) * (1 - std::cos(rate * i * kStep));
            worst = std::max(worst, std::abs(world.position(block).y - expected));
        }
        expectAtMost("m", worst, 2e-6);  // of 0.23 m; in sub-steps it was 4.2e-5
    }
}

/// Two bars on a spring that whirl without gravity. The hinge is at the middle of one, so what the spring moves is the
/// same at any angle.
TEST(DrivenIslands, WhatWhirlsOnASpringKeepsItsEnergy) {
    World world = makeWorld(Profile::accurate, 0);
    const BodyId a = addBody(world, dynamicAt({0, 0}, {}, 3), box(0.5, 0.1));
    const BodyId b = addBody(world, dynamicAt({0.5, 0}, vec(0, 1), -2), box(0.5, 0.1));
    RevoluteJointDef hinge;
    hinge.base = between(a, b);
    hinge.spring = Spring{1, 0};
    hinge.limits = AngleLimits{-3, 3};
    const JointId joint = must(world.createJoint(hinge));
    const double inertiaOfA = static_cast<double>(world.inertia(a));
    const double inertiaOfB = static_cast<double>(world.inertia(b)) + static_cast<double>(world.mass(b)) / 2 * 0.25;
    const double stiffness = 4 * kPi * kPi * inertiaOfA * inertiaOfB / (inertiaOfA + inertiaOfB);
    const auto energy = [&] {
        const double bent = world.jointAngle(joint);
        return kineticEnergy(world, a) + kineticEnergy(world, b) + 0.5 * stiffness * bent * bent;
    };
    run(world, 1);  // speeds agree with the joint
    const double begun = energy();
    double worst = 0;
    double farthest = 0;
    for (int i = 0; i < 3600; ++i) {
        must(world.step(kStep));
        EXPECT_EQ(world.counters().mostSubSteps, 1U);
        worst = std::max(worst, std::abs(energy() / begun - 1));
        farthest = std::max(farthest, std::abs(world.jointAngle(joint)));
    }
    expectAtMost("part of the energy", worst, 1e-5);
    EXPECT_GT(farthest, 0.3);
}

/// Of two pendulums one is at its limit, and has sub-steps: each goes as it would alone, to the bit.
TEST(DrivenIslands, ThoseThatAreLeftDisturbNoOther) {
    const auto addPendulum = [](World& world, double x, double limit) {
        const BodyId bar = addBody(world, dynamicAt({x + 0.5, 0}), box(0.5, 0.1));
        const BodyId end = addBody(world, dynamicAt({x + 1.5, 0}), box(0.5, 0.1));
        RevoluteJointDef hinge;
        hinge.base = between(addStatic(world, circle(0.05), {}, {x, 1}), bar);
        hinge.anchor = {x, 0};
        hinge.limits = AngleLimits{real(-limit), real(limit)};
        must(world.createJoint(hinge));
        hinge.base = between(bar, end);
        hinge.anchor = {x + 1, 0};
        must(world.createJoint(hinge));
        return end;
    };
    World both = makeWorld(Profile::accurate);
    World stopped = makeWorld(Profile::accurate);
    World free = makeWorld(Profile::accurate);
    const BodyId stoppedOfBoth = addPendulum(both, 0, 0.3);
    const BodyId freeOfBoth = addPendulum(both, 10, 50);
    const BodyId stoppedAlone = addPendulum(stopped, 0, 0.3);
    const BodyId freeAlone = addPendulum(free, 10, 50);
    int left = 0;
    for (int i = 0; i < 120; ++i) {
        for (World* world : {&both, &stopped, &free}) { must(world->step(kStep)); }
        left += stopped.counters().mostSubSteps >= 16 ? 1 : 0;
        EXPECT_LT(free.counters().mostSubSteps, 8U) << "step " << i;
        ASSERT_EQ(both.position(stoppedOfBoth), stopped.position(stoppedAlone)) << "step " << i;
        ASSERT_EQ(both.angle(stoppedOfBoth), stopped.angle(stoppedAlone)) << "step " << i;
        ASSERT_EQ(both.position(freeOfBoth), free.position(freeAlone)) << "step " << i;
        ASSERT_EQ(both.angle(freeOfBoth), free.angle(freeAlone)) << "step " << i;
    }
    EXPECT_GT(left, 30);
    EXPECT_LT(left, 119);
}

}  // namespace
}  // namespace swept::test
