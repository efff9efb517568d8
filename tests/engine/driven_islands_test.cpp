#include <optional>

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
        const bool gets = expected > 2.99 && i * kStep < 12.1;
        if (!gets) { ASSERT_EQ(one.world.counters().mostSubSteps, 1U) << "step " << i; }
        if (i < 700) { ASSERT_NEAR(one.world.jointTorque(one.joint), torque, 1e-4 * torque) << "step " << i; }
        if (i > 730) { ASSERT_NEAR(one.world.jointTorque(one.joint), 0, 1e-4 * torque) << "step " << i; }
    }
}

/// As a motor is switched off.
TEST(DrivenIslands, AMotorWithoutStrengthIsNone) {
    World world = makeWorld(Profile::accurate);
    World plain = makeWorld(Profile::accurate);
    const auto addBar = [](World& of, const std::optional<AngularMotor>& motor) {
        const BodyId bar = addBody(of, dynamicAt({1, 0}), box(1, 0.1));
        RevoluteJointDef hinge;
        hinge.base = between(anchorOf(of), bar);
        hinge.motor = motor;
        must(of.createJoint(hinge));
        return bar;
    };
    const BodyId bar = addBar(world, AngularMotor{3, 0});
    const BodyId same = addBar(plain, std::nullopt);
    for (int i = 0; i < 60; ++i) {
        run(world, 1);
        run(plain, 1);
        ASSERT_LE(world.counters().mostSubSteps, 2U) << "step " << i;
        ASSERT_NEAR(world.angle(bar), plain.angle(same), 1e-4) << "step " << i;
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

/// Two arms on motors in a row: the strong one jerks to and fro, the weak one gives no more than it has.
TEST(DrivenIslands, NoMotorGivesMoreThanItsStrength) {
    World world = makeWorld(Profile::accurate, 0);
    const BodyId inner = addBody(world, dynamicAt({0.5, 0}), box(0.5, 0.1));
    const BodyId outer = addBody(world, dynamicAt({2, 0}), box(1, 0.1));
    RevoluteJointDef hinge;
    hinge.base = between(anchorOf(world), inner);
    hinge.motor = AngularMotor{0, real(1e6)};
    const JointId strong = must(world.createJoint(hinge));
    hinge.base = between(inner, outer);
    hinge.anchor = {1, 0};
    const double strength = 0.5;
    hinge.motor = AngularMotor{0, real(strength)};
    const JointId weak = must(world.createJoint(hinge));
    double most = 0;
    for (int i = 0; i < 240; ++i) {
        if (i % 3 == 0) {
            must(world.setAngularMotor(strong, AngularMotor{real(i % 2 == 0 ? 0.02 : -0.02), real(1e6)}));
        }
        must(world.step(kStep));
        most = std::max(most, std::abs(static_cast<double>(world.jointTorque(weak))));
    }
    expectAtMost("part of its strength", most / strength, 1.0001);
    EXPECT_GT(most, 0.5 * strength);
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

void expectSame(const World& one, BodyId a, const World& other, BodyId b) {
    EXPECT_EQ(one.position(a), other.position(b));
    EXPECT_EQ(one.angle(a), other.angle(b));
    EXPECT_EQ(one.velocity(a), other.velocity(b));
    EXPECT_EQ(one.angularVelocity(a), other.angularVelocity(b));
}

/// Four bars that stand out from the ground; b of each joint is the outer one.
template <class Def>
struct BentBar {
    World world = makeWorld(Profile::accurate);
    std::vector<BodyId> bars;
    std::vector<JointId> joints;

    /// @param def  all but its bodies and its anchor
    explicit BentBar(Def def) {
        BodyId last = anchorOf(world);
        for (int i = 0; i < 4; ++i) {
            bars.push_back(addBody(world, dynamicAt({i + 0.5, 0}), box(0.5, 0.1)));
            def.base = between(last, bars.back());
            def.anchor = {static_cast<double>(i), 0};
            joints.push_back(must(world.createJoint(def)));
            last = bars.back();
        }
    }
};

/// A weld whose angle is a spring leaves free what a hinge does.
TEST(DrivenIslands, WeldsThatBendAreHingesWithThatSpring) {
    const Spring spring{4, real(0.1)};
    RevoluteJointDef hinge;
    hinge.spring = spring;
    WeldJointDef weld;
    weld.angularSpring = spring;
    BentBar hinged(hinge);
    BentBar welded(weld);
    double lowest = 0;
    for (int i = 0; i < 240; ++i) {
        must(hinged.world.step(kStep));
        must(welded.world.step(kStep));
        EXPECT_LE(welded.world.counters().mostSubSteps, 2U);
        for (std::size_t k = 0; k < 4; ++k) {
            expectSame(hinged.world, hinged.bars[k], welded.world, welded.bars[k]);
            EXPECT_EQ(hinged.world.jointForce(hinged.joints[k]), welded.world.jointForce(welded.joints[k]));
            EXPECT_EQ(hinged.world.jointTorque(hinged.joints[k]), welded.world.jointTorque(welded.joints[k]));
        }
        lowest = std::min(lowest, welded.world.position(welded.bars.back()).y);
    }
    EXPECT_LT(lowest, -1) << "it bends";
    EXPECT_GT(std::abs(welded.world.jointTorque(welded.joints[0])), 1);
}

/// Nothing is held all at once where nothing is rigid; but gravity acts half before and half after each motion, so that
/// what flies on a spring falls as a body does.
TEST(DrivenIslands, WhatFliesOnASpringFallsByTheParabola) {
    World world = makeWorld(Profile::accurate);
    const std::vector<BodyId> both{addBody(world, dynamicAt({0, 0}, vec(1, 8), 1), box(0.5, 0.1)),
                                   addBody(world, dynamicAt({1, 0}, vec(1, 8), -2), box(0.5, 0.1))};
    DistanceJointDef spring;
    spring.base = between(both[0], both[1]);
    spring.anchorA = {0, 0.1};
    spring.anchorB = {1, 0};
    spring.spring = Spring{2, 0};
    must(world.createJoint(spring));
    double worst = 0;
    for (int i = 1; i <= 120; ++i) {
        must(world.step(kStep));
        const double t = i * kStep;
        const double height = (world.position(both[0]).y + world.position(both[1]).y) / 2;
        worst = std::max(worst, std::abs(height - (8 * t - kGravity / 2 * t * t)));
    }
    expectAtMost("m", worst, 2e-4);  // with all of it before the motion 10 mm
    EXPECT_EQ(world.counters().directBodies, 0U);
}

/// A pendulum that is at its limit now and then, one that is not, and a pair on a spring that flies.
struct Machines {
    World world;
    BodyId stopped;
    BodyId free;
    BodyId flying;

    Machines(int subSteps, bool hasStopped, bool hasOthers) {
        WorldSettings settings = awakeSettings(Profile::accurate);
        if (subSteps > 0) { settings.subSteps = subSteps; }
        world = makeWorld(settings);
        if (hasStopped) { stopped = addPendulum(0, 0.3); }
        if (hasOthers) {
            free = addPendulum(10, 50);
            flying = addPair(20);
        }
    }
    BodyId addPendulum(double x, double limit) {
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
    }
    BodyId addPair(double x) {
        const BodyId left = addBody(world, dynamicAt({x, 0}, vec(0, 3), 2), box(0.5, 0.1));
        const BodyId right = addBody(world, dynamicAt({x + 1, 0}, vec(0, 3), -1), box(0.5, 0.1));
        RevoluteJointDef hinge;
        hinge.base = between(left, right);
        hinge.anchor = {x + 0.5, 0};
        hinge.spring = Spring{3, 0};
        must(world.createJoint(hinge));
        return right;
    }
};

/// Each goes as it would alone, to the bit, however the others are solved.
TEST(DrivenIslands, ThoseThatAreLeftDisturbNoOther) {
    for (const int subSteps : {0, 8}) {
        Machines all(subSteps, true, true);
        Machines stopped(subSteps, true, false);
        Machines others(subSteps, false, true);
        std::uint64_t left = 0;
        for (int i = 0; i < 120; ++i) {
            SCOPED_TRACE(testing::Message() << subSteps << " sub-steps, step " << i);
            for (Machines* machines : {&all, &stopped, &others}) { must(machines->world.step(kStep)); }
            left += stopped.world.counters().mostSubSteps >= 8 ? 1 : 0;
            EXPECT_LT(others.world.counters().mostSubSteps, 8U);
            expectSame(all.world, all.stopped, stopped.world, stopped.stopped);
            expectSame(all.world, all.free, others.world, others.free);
            expectSame(all.world, all.flying, others.world, others.flying);
            if (HasFailure()) { return; }
        }
        EXPECT_GT(left, 30U);
        EXPECT_LT(left, 119U);
    }
}

}  // namespace
}  // namespace swept::test
