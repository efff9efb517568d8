#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "../support/random.h"
#include "joint_scene.h"

namespace swept::test {
namespace {

const double kPi = std::acos(-1.0);

TEST(Distance, RodIsAPendulumThatKeepsItsLength) {
    JointScene scene;
    scene.settings.subSteps = 16;
    scene.gravity = {0, -10};
    scene.addDistance(kFixedSlot, scene.addBody(bodyAt(2 * std::sin(0.1), -2 * std::cos(0.1))), {}).length = 2;
    Oscillation swing;
    for (int i = 0; i < 640; ++i) {
        scene.step();
        swing.add(scene.time(), scene.bodies[1].x);
    }
    const double omega = std::sqrt(10.0 / 2) * (1 - 0.1 * 0.1 / 16);
    ASSERT_GT(swing.halfPeriods(), 5U);
    EXPECT_NEAR(swing.angularFrequency(), omega, 0.005 * omega);
    EXPECT_LT(scene.largestError, 1e-3);
    EXPECT_LT(swing.decayRate(), 0.02);
}

TEST(Distance, RopeIsSlackUntilItsLengthAndHoldsThere) {
    JointScene scene;
    scene.gravity = {0, -10};
    DistanceConstraint& rope = scene.addDistance(kFixedSlot, scene.addBody(bodyAt(0, -1)), {});
    rope.isRigid = false;
    rope.hasLimits = true;
    rope.maxLength = 2;
    // Falls freely: semi-implicit steps of h are at g·t·(t + h)/2.
    for (int i = 0; i < 16; ++i) { scene.step(); }
    const double t = scene.time();
    EXPECT_NEAR(scene.bodies[1].y, -1 - 5 * t * (t + static_cast<double>(scene.h())), 1e-5);
    for (int i = 0; i < 128; ++i) { scene.step(); }
    EXPECT_NEAR(scene.bodies[1].y, -2, 0.002);
    EXPECT_LT(scene.largestError, 0.002);
    EXPECT_LT(length(scene.bodies[1].state.velocity), real(1e-3)) << "a rope does not throw back";
    EXPECT_NEAR(scene.distances[0].upperImpulse, 10 * scene.h(), real(1e-3) * 10 * scene.h());
}

TEST(Distance, LowerLimitKeepsApart) {
    JointScene scene;
    SceneBody body = bodyAt(0, -1.5);
    body.state.velocity = {0, 3};
    DistanceConstraint& rope = scene.addDistance(kFixedSlot, scene.addBody(body), {});
    rope.isRigid = false;
    rope.hasLimits = true;
    rope.minLength = 1;
    rope.maxLength = std::numeric_limits<Real>::infinity();
    double highest = -2;
    for (int i = 0; i < 64; ++i) {
        scene.step();
        highest = std::max(highest, scene.bodies[1].y);
    }
    EXPECT_NEAR(highest, -1, 1e-3);
    EXPECT_LT(length(scene.bodies[1].state.velocity), real(1e-3));
}

TEST(Distance, LimitAtInfinityBetweenBodiesThatCannotMoveMakesNoNan) {
    JointScene scene;
    SceneBody kinematic = bodyAt(0, -1);
    kinematic.inertia = {};
    kinematic.state.velocity = {1, 2};
    DistanceConstraint& rope = scene.addDistance(kFixedSlot, scene.addBody(kinematic), {});
    rope.isRigid = false;
    rope.hasLimits = true;
    rope.maxLength = std::numeric_limits<Real>::infinity();
    scene.step();
    EXPECT_EQ(scene.bodies[1].state.velocity, (Vec2{1, 2}));
}

TEST(Distance, SpringSwingsAtItsFrequencyAndDamping) {
    for (const double hertz : {0.5, 1.0, 3.0}) {
        for (const double zeta : {0.0, 0.05}) {
            JointScene scene;
            const double omega = 2 * kPi * hertz;
            scene.addBody(bodyAt(-1.1, 0, 2));
            scene.addBody(bodyAt(1.1, 0, 3));
            DistanceConstraint& spring = scene.addDistance(1, 2, {});
            spring.isRigid = false;
            spring.hasSpring = true;
            spring.length = 2;
            spring.spring = turningSpringOf(real(omega), real(zeta), scene.h(), real(1.2));  // 2·3/(2 + 3) kg
            Oscillation swing;
            for (int i = 0; i < 512; ++i) {
                scene.step();
                swing.add(scene.time(), scene.bodies[2].x - scene.bodies[1].x - 2);
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

TEST(Distance, AnchorsThatCoincideKeepTheLastAxis) {
    JointScene scene;
    DistanceConstraint& spring = scene.addDistance(kFixedSlot, scene.addBody(bodyAt(0, 0)), {});
    spring.length = 1;
    spring.axis = {0, 1};
    for (int i = 0; i < 64; ++i) { scene.step(); }
    EXPECT_NEAR(scene.bodies[1].x, 0, 1e-6);
    EXPECT_NEAR(scene.bodies[1].y, 1, 1e-3);
}

TEST(Distance, ConservesMomentumOfFreeBodies) {
    int pulled = 0;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        Random random(seed);
        JointScene scene;
        for (int i = 0; i < 2; ++i) {
            SceneBody body = bodyAt(i == 0 ? -1 : 1, 0, std::exp2(random.range(-3, 3)), std::exp2(random.range(-3, 3)));
            body.state.velocity = {real(random.range(-1, 1)), real(random.range(-1, 1))};
            body.state.angularVelocity = real(random.range(-2, 2));
            scene.addBody(body);
        }
        DistanceConstraint& joint = scene.addDistance(1, 2, {0.2, 0.1, -0.3, 0.1});
        joint.isRigid = random.chance(0.5);
        joint.length = real(1.5);
        joint.hasSpring = !joint.isRigid;
        joint.spring = turningSpringOf(6, real(0.1), scene.h(), 1);
        joint.hasLimits = !joint.isRigid;
        joint.minLength = real(1.4);
        joint.maxLength = real(1.6);
        const Momentum before = momentumOf(scene);
        for (int i = 0; i < 32; ++i) { scene.step(); }
        const Momentum after = momentumOf(scene);
        const double rounding = 32 * 4 * 64 * static_cast<double>(kEpsilon) * 16;
        ASSERT_NEAR(after.x, before.x, rounding) << "seed " << seed;
        ASSERT_NEAR(after.y, before.y, rounding) << "seed " << seed;
        ASSERT_NEAR(after.spin, before.spin, 4 * rounding)
            << "seed " << seed << ": the force acts along the anchors' line";
        const DistanceConstraint& end = scene.distances[0];
        const Real most =
            std::max({std::fabs(end.rigidImpulse), std::fabs(end.springImpulse), end.lowerImpulse, end.upperImpulse});
        pulled += most > 0 ? 1 : 0;
        ASSERT_LT(scene.largestError, 0.03) << "seed " << seed;
    }
    EXPECT_EQ(pulled, 200);
}

}  // namespace
}  // namespace swept::test
