#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "../support/random.h"
#include "joint_scene.h"

namespace swept::test {
namespace {

const double kHalfTurn = std::acos(-1.0);

TEST(Revolute, PendulumKeepsItsPivotAndItsPeriod) {
    JointScene scene;
    scene.settings.subSteps = 16;
    scene.gravity = {0, -10};
    SceneBody bob = bodyAt(1, 0, 1, 0.1);
    bob.x = std::sin(0.1);
    bob.y = -std::cos(0.1);
    bob.angle = 0.1;
    scene.addRevolute(kFixedSlot, scene.addBody(bob), {0, 0, 0, 1});
    Oscillation swing;
    for (int i = 0; i < 640; ++i) {
        scene.step();
        swing.add(scene.time(), scene.bodies[1].angle);
    }
    // Physical pendulum: ω² = m·g·l/(I + m·l²), first correction of the amplitude θ₀²/16.
    const double omega = std::sqrt(10 / 1.1) * (1 - 0.1 * 0.1 / 16);
    ASSERT_GT(swing.halfPeriods(), 8U);
    EXPECT_NEAR(swing.angularFrequency(), omega, 0.005 * omega);
    EXPECT_LT(scene.largestGap, 1e-3);
    EXPECT_LT(swing.decayRate(), 0.02);
}

TEST(Revolute, ChainOfTenStaysTogether) {
    JointScene scene;
    scene.settings.subSteps = 8;
    scene.gravity = {0, -10};
    BodySlot last = kFixedSlot;
    for (int i = 0; i < 10; ++i) {
        const BodySlot next = scene.addBody(bodyAt(0.5 + i, 0, 1, 1.0 / 12));
        scene.addRevolute(last, next, {last == kFixedSlot ? 0 : 0.5, 0, -0.5, 0});
        last = next;
    }
    for (int i = 0; i < 128; ++i) { scene.step(); }
    EXPECT_LT(scene.bodies.back().y, -3) << "it swings";
    EXPECT_LT(scene.largestGap, 0.03);
}

TEST(Revolute, ClosesAnInitialGapWithoutSpeed) {
    JointScene scene;
    scene.addRevolute(kFixedSlot, scene.addBody(bodyAt(1.1, 0, 1, 0.1)), {0, 0, -1, 0});
    for (int i = 0; i < 64; ++i) { scene.step(); }
    const RevoluteConstraint& joint = scene.batch.revolutes[0];
    EXPECT_LT(anchorGap(joint, scene.batch.states[0], scene.batch.states[1]), real(1e-4));
    EXPECT_LT(length(scene.bodies[1].state.velocity), real(1e-3));
}

TEST(Revolute, LimitsHold) {
    for (const double side : {1.0, -1.0}) {
        JointScene scene;
        SceneBody bar = bodyAt(0, 0, 1, 0.1);
        bar.state.angularVelocity = real(side * 5);
        RevoluteConstraint& joint = scene.addRevolute(kFixedSlot, scene.addBody(bar), {});
        joint.hasLimits = true;
        joint.lower = real(-0.5);
        joint.upper = real(0.25);
        double least = 0;
        double most = 0;
        for (int i = 0; i < 64; ++i) {
            scene.step();
            least = std::min(least, scene.bodies[1].angle);
            most = std::max(most, scene.bodies[1].angle);
        }
        EXPECT_GT(least, -0.5 - 1e-3);
        EXPECT_LT(most, 0.25 + 1e-3);
        EXPECT_NEAR(scene.bodies[1].angle, side > 0 ? 0.25 : -0.5, 1e-3) << "it has come to the limit and stays";
        EXPECT_NEAR(scene.bodies[1].state.angularVelocity, 0, 1e-3);
    }
}

TEST(Revolute, OneLimitAtInfinityBetweenBodiesThatCannotTurnMakesNoNan) {
    JointScene scene;
    SceneBody body = bodyAt(0, 0);
    body.inertia.inverseInertia = 0;
    RevoluteConstraint& joint = scene.addRevolute(kFixedSlot, scene.addBody(body), {});
    joint.hasLimits = true;
    joint.lower = -std::numeric_limits<Real>::infinity();
    joint.upper = 1;
    scene.step();
    EXPECT_EQ(scene.bodies[1].state.angularVelocity, 0);
    EXPECT_EQ(scene.batch.revolutes[0].lowerImpulse, 0);
}

TEST(Revolute, MotorReachesItsSpeedAtItsTorque) {
    JointScene scene;
    RevoluteConstraint& joint = scene.addRevolute(kFixedSlot, scene.addBody(bodyAt(0, 0, 1, 0.5)), {});
    joint.hasMotor = true;
    joint.motorSpeed = 4;
    joint.maxMotorImpulse = 2 * scene.h();  // 2 N·m: 4 rad/s² with 0.5 kg·m², one second to the speed
    for (int i = 0; i < 32; ++i) { scene.step(); }
    EXPECT_NEAR(scene.bodies[1].state.angularVelocity, 2, 1e-4);
    EXPECT_EQ(scene.revolutes[0].motorImpulse, scene.revolutes[0].maxMotorImpulse);
    for (int i = 0; i < 64; ++i) { scene.step(); }
    EXPECT_NEAR(scene.bodies[1].state.angularVelocity, 4, 1e-4);
    EXPECT_NEAR(scene.revolutes[0].motorImpulse, 0, 1e-4);
}

TEST(Revolute, SpringSwingsAtItsFrequencyAndDamping) {
    for (const double hertz : {0.5, 1.0, 3.0}) {
        for (const double zeta : {0.0, 0.05}) {
            JointScene scene;
            const double omega = 2 * kHalfTurn * hertz;
            SceneBody bar = bodyAt(0, 0, 1, 0.3);
            bar.angle = 0.4;
            RevoluteConstraint& joint = scene.addRevolute(kFixedSlot, scene.addBody(bar), {});
            joint.hasSpring = true;
            joint.spring = springGainsOf(real(omega), real(zeta), scene.h());
            Oscillation swing;
            for (int i = 0; i < 512; ++i) {
                scene.step();
                swing.add(scene.time(), scene.bodies[1].angle);
            }
            const SpringMotion discrete = discreteSpring(omega, zeta, static_cast<double>(scene.h()));
            ASSERT_GT(swing.halfPeriods(), 4U);
            EXPECT_NEAR(swing.angularFrequency(), omega * std::sqrt(1 - zeta * zeta), 0.01 * omega) << hertz << " Hz";
            EXPECT_NEAR(swing.angularFrequency(), discrete.angularFrequency, 0.002 * omega) << hertz << " Hz";
            EXPECT_NEAR(swing.decayRate(), discrete.decayRate, 0.01 * discrete.decayRate + 0.001 * hertz)
                << hertz << " Hz " << zeta;
        }
    }
}

TEST(Revolute, ConservesMomentumOfFreeBodies) {
    int moved = 0;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        Random random(seed);
        JointScene scene;
        for (int i = 0; i < 2; ++i) {
            SceneBody body = bodyAt(i == 0 ? -1 : 1, 0, std::exp2(random.range(-3, 3)), std::exp2(random.range(-3, 3)));
            body.state.velocity = {real(random.range(-1, 1)), real(random.range(-1, 1))};
            body.state.angularVelocity = real(random.range(-2, 2));
            scene.addBody(body);
        }
        RevoluteConstraint& joint = scene.addRevolute(1, 2, {1, 0, -1, 0});
        joint.hasLimits = random.chance(0.5);
        joint.lower = real(-0.1);
        joint.upper = real(0.1);
        joint.hasMotor = random.chance(0.5);
        joint.motorSpeed = 1;
        joint.maxMotorImpulse = scene.h();
        joint.hasSpring = random.chance(0.5);
        joint.spring = springGainsOf(6, real(0.1), scene.h());
        const Momentum before = momentumOf(scene);
        for (int i = 0; i < 32; ++i) { scene.step(); }
        const Momentum after = momentumOf(scene);
        const double rounding = 32 * 4 * 64 * static_cast<double>(kEpsilon) * 16;
        ASSERT_NEAR(after.x, before.x, rounding) << "seed " << seed;
        ASSERT_NEAR(after.y, before.y, rounding) << "seed " << seed;
        // The two ends of the joint's force are the gap apart, which makes a small torque.
        ASSERT_NEAR(after.spin, before.spin, 0.005 * (1 + std::fabs(before.spin))) << "seed " << seed;
        moved += length(scene.revolutes[0].linearImpulse) > 0 ? 1 : 0;
        ASSERT_LT(scene.largestGap, 0.01) << "seed " << seed;
    }
    EXPECT_EQ(moved, 200);
}

}  // namespace
}  // namespace swept::test
