#include "joint_support.h"

/// Every kind of joint against a closed form: accelerations, speeds, reactions, momenta.

namespace swept::test {
namespace {

TEST(JointKinds, PrismaticMotorAndLimits) {
    World world = makeWorld(0);
    const BodyId base = anchorOf(world);
    const BodyId block = addBody(world, dynamicAt({0, 0}), box(0.5, 0.5));
    PrismaticJointDef rail;
    rail.base = between(base, block);
    rail.limits = TranslationLimits{-1, 2};
    rail.motor = LinearMotor{3, 4};  // 4 m/s² with 1 kg
    const JointId joint = must(world.createJoint(rail));
    runFor(world, 0.5);
    expectAtMost("speed under full force", std::abs(velocityOf(world, block).x / 2 - 1), 1e-3);
    expectAtMost("force", std::abs(static_cast<double>(world.jointForce(joint).x) / 4 - 1), 1e-3);
    runFor(world, 3);
    expectAtMost("upper", std::abs(static_cast<double>(world.jointTranslation(joint)) - 2), 1e-3);
    must(world.setLinearMotor(joint, LinearMotor{-3, 4}));
    runFor(world, 4);
    expectAtMost("lower", std::abs(static_cast<double>(world.jointTranslation(joint)) + 1), 1e-3);
}

TEST(JointKinds, WheelMotorDrivesAndItsAxisHolds) {
    World world = makeWorld(0);
    const BodyId base = anchorOf(world);
    const BodyId wheel = addBody(world, dynamicAt({1, 0}), circle(0.5));
    WheelJointDef def;
    def.base = between(base, wheel);
    def.anchor = {1, 0};
    def.motor = AngularMotor{5, real(0.1)};
    const JointId joint = must(world.createJoint(def));
    runFor(world, 0.5);
    expectAtMost("spin", std::abs(spinOf(world, wheel) / (0.05 / world.inertia(wheel)) - 1), 1e-3);
    expectAtMost("torque", std::abs(static_cast<double>(world.jointTorque(joint)) / 0.1 - 1), 1e-3);
    must(world.applyImpulse(wheel, vec(1, 0), {1, 0}));
    runFor(world, 10);
    expectAtMost("final spin", std::abs(spinOf(world, wheel) / 5 - 1), 1e-3);
    expectAtMost("across", std::abs(world.position(wheel).x - 1), 1e-3);
}

TEST(JointKinds, RigidWeldCarriesACantilever) {
    World world = makeWorld();
    const BodyId wall = anchorOf(world);
    BodyId before = wall;
    std::vector<JointId> joints;
    double mass = 0;
    for (int i = 0; i < 4; ++i) {
        const BodyId piece = addBody(world, dynamicAt({0.5 + i, 0}), box(0.5, 0.1));
        mass += world.mass(piece);
        WeldJointDef weld;
        weld.base = between(before, piece);
        weld.anchor = {static_cast<double>(i), 0};
        joints.push_back(must(world.createJoint(weld)));
        before = piece;
    }
    runFor(world, 5);
    expectAtMost("force", std::abs(static_cast<double>(world.jointForce(joints[0]).y) / (mass * kGravity) - 1), 2e-3);
    expectAtMost("torque", std::abs(static_cast<double>(world.jointTorque(joints[0])) / (mass * kGravity * 2) - 1),
                 2e-3);
    expectAtMost("sag of 4 m", -world.position(before).y, 0.02);
}

/// Weight mg against a motor of force F < mg: it sinks by g − F/m; F > mg holds it where it is to be.
TEST(JointKinds, MotorForceAgainstWeight) {
    World world = makeWorld();
    const BodyId base = anchorOf(world);
    const BodyId load = addBody(world, dynamicAt({0, 5}), box(0.5, 0.5));
    MotorJointDef def;
    def.base = between(base, load);
    def.drive.maxForce = real(6);
    def.drive.maxTorque = real(5);
    const JointId joint = must(world.createJoint(def));
    runFor(world, 0.5);
    expectAtMost("sinks", std::abs(velocityOf(world, load).y / -2 - 1), 1e-3);
    expectAtMost("force", std::abs(static_cast<double>(world.jointForce(joint).y) / 6 - 1), 1e-3);
    MotorDrive drive;
    drive.maxForce = real(30);
    drive.maxTorque = real(5);
    drive.linearOffset = vec(2, 4);
    drive.angularOffset = real(1.5);
    must(world.setDrive(joint, drive));
    double highest = 0;
    for (int i = 0; i < 240; ++i) {
        must(world.step(kStep));
        highest = std::max(highest, world.angle(load));
    }
    expectAtMost("place", length(world.position(load) - DVec2{2, 4}), 1e-3);
    expectAtMost("angle", std::abs(world.angle(load) - 1.5), 1e-3);
    expectAtMost("overshoot", highest - 1.5, 0.01);
    drive = {};
    drive.maxForce = real(30);
    drive.linearVelocity = vec(-1, 0.5);
    must(world.setDrive(joint, drive));
    runFor(world, 1);
    expectAtMost("velocity", length(velocityOf(world, load) - DVec2{-1, 0.5}), 1e-3);
}

/// A critical pull on the centre: (1 + ωt) e^−ωt of the way is left. A target that moves at v drags it 2v/ω behind.
TEST(JointKinds, MousePullsCritically) {
    const double hertz = 2;
    const double w = 2 * kPi * hertz;
    World world = makeWorld(0);
    const BodyId base = anchorOf(world);
    const BodyId ball = addBody(world, dynamicAt({0, 0}), circle(0.5));
    MouseJointDef def;
    def.base = between(base, ball);
    def.anchor = DVec2{0, 0};
    def.target = {1, 2};
    def.spring = Spring{real(hertz), 1};
    const JointId joint = must(world.createJoint(def));
    double worst = 0;
    for (int i = 1; i <= 90; ++i) {
        must(world.step(kStep));
        const double t = i * kStep;
        const double left = (1 + w * t) * std::exp(-w * t);
        worst = std::max(worst, length(world.position(ball) - (1 - left) * DVec2{1, 2}) / std::sqrt(5));
    }
    expectAtMost("deviation from the critical return", worst, 0.005);
    for (int i = 1; i <= 300; ++i) {
        must(world.setTarget(joint, {1 + i * kStep, 2}));
        must(world.step(kStep));
    }
    const double lag = 1 + 300 * kStep - world.position(ball).x;
    expectAtMost("lag", std::abs(lag / (2 / w) - 1), 0.02);
    expectAtMost("speed", std::abs(velocityOf(world, ball).x - 1), 1e-3);
}

/// Whoever is let go flies on.
TEST(JointKinds, WhatTheMouseDragsHasItsSpeed) {
    for (const Profile profile : {Profile::accurate, Profile::fast}) {
        for (const double speed : {0.5, 6.0, 30.0}) {
            for (const int kind : {0, 1, 2}) {
                WorldSettings settings = awakeSettings(profile, 0);
                World world = makeWorld(settings);
                const BodyId crate = addBody(world, dynamicAt({0, 0}), box(0.3, 0.3));
                MouseJointDef def;
                def.base = between(anchorOf(world), crate);
                if (kind == 1) { def.spring = Spring{30, 1}; }
                if (kind == 2) { def.maxForce = static_cast<Real>(1000 * world.mass(crate)); }
                const JointId joint = must(world.createJoint(def));
                double x = 0;
                for (int i = 0; i < 60; ++i) {
                    x += speed * kStep;
                    must(world.setTarget(joint, {x, 0}));
                    must(world.step(kStep));
                }
                const std::string what = std::to_string(speed) + " m/s, kind " + std::to_string(kind);
                expectAtMost(what + ", speed", std::abs(velocityOf(world, crate).x / speed - 1), 0.01);
                expectAtMost(what + ", lag", std::abs(world.position(crate).x - x), 0.02 * speed);
                must(world.step(kStep));  // the target stands
                if (kind == 0) { expectAtMost(what + ", then", std::abs(velocityOf(world, crate).x), 1e-3 * speed); }
            }
        }
    }
}

TEST(JointKinds, MouseForceIsLimitedAndCarriesWeight) {
    World world = makeWorld();
    const BodyId base = anchorOf(world);
    const BodyId box1 = addBody(world, dynamicAt({0, 0}), box(0.5, 0.5));
    MouseJointDef def;
    def.base = between(base, box1);
    def.target = {0, 0};
    def.spring = Spring{2, 1};
    def.maxForce = real(8);
    const JointId joint = must(world.createJoint(def));
    runFor(world, 2);
    expectAtMost("sinks by g − F/m", std::abs(velocityOf(world, box1).y / -(2 * 2.0) - 1), 0.12);
    expectAtMost("force", std::abs(static_cast<double>(world.jointForce(joint).y) / 8 - 1), 1e-3);
}

/// A is only named. As before there was a joint it holds up what is pulled into it, and so it does afterwards.
TEST(JointKinds, MouseDoesNotPullThroughTheBodyThatItNames) {
    for (const BodyType type : {BodyType::fixed, BodyType::kinematic, BodyType::dynamic}) {
        for (const bool collideConnected : {false, true}) {
            World world = makeWorld();
            addStatic(world, box(10, 1), {}, {0, -4});
            const BodyId floor = addBody(world, bodyAt(type, {0, -2}), box(8, 1), material(0.5, 0, 10));
            const BodyId crate = addBody(world, dynamicAt({0, -0.5}), box(0.5, 0.5));
            run(world, 30);
            MouseJointDef def;
            def.base = between(floor, crate);
            def.base.collideConnected = collideConnected;
            def.target = {0, -0.5};
            def.spring = Spring{5, 1};
            const JointId joint = must(world.createJoint(def));
            must(world.setTarget(joint, {0, -3}));
            for (int i = 0; i < 60; ++i) {
                must(world.step(kStep));
                EXPECT_TRUE(world.contactEvents().empty()) << "it lies there all the time";
            }
            EXPECT_NEAR(world.position(crate).y, -0.5, 0.05);
            const auto told = std::get<MouseJointDef>(world.definition(joint));
            EXPECT_EQ(told.base.collideConnected, collideConnected) << "as it was made";
            must(world.destroyJoint(joint));
            run(world, 30);
            EXPECT_NEAR(world.position(crate).y, -0.5, 0.01);
        }
    }
}

/// What is far away comes with all the force that there is, and stops at the target: with a spring it is the sum of
/// spring and damper that is limited.
TEST(JointKinds, MouseWithLimitedForceComesFromFarAway) {
    for (const Profile profile : {Profile::accurate, Profile::fast}) {
        for (const bool hasSpring : {false, true}) {
            WorldSettings settings = awakeSettings(profile, 0);
            World world = makeWorld(settings);
            const BodyId base = anchorOf(world);
            const BodyId disc = addBody(world, dynamicAt({0, 0}), circle(0.5));
            const double acceleration = 10;
            MouseJointDef def;
            def.base = between(base, disc);
            def.anchor = DVec2{0, 0};
            def.target = {5, 0};
            def.maxForce = static_cast<Real>(acceleration * world.mass(disc));
            if (hasSpring) { def.spring = Spring{5, 1}; }
            must(world.createJoint(def));
            runFor(world, 0.5);
            const std::string what = (hasSpring ? "spring" : "rigid");
            expectAtMost(what + ": speeds up", std::abs(velocityOf(world, disc).x / (0.5 * acceleration) - 1), 0.05);
            runFor(world, 9.5);
            expectAtMost(what + ": is there", length(world.position(disc) - DVec2{5, 0}), 1e-3);
            expectAtMost(what + ": rests", length(velocityOf(world, disc)), 1e-3);
        }
    }
}

/// Two wheels of one gear, first + ratio·second = constant; the torques at the teeth are as 1 : ratio.
TEST(JointKinds, GearCouplesSpinsAndConservesWhatItMust) {
    const double ratio = 2.5;
    World world = makeWorld(0);
    const BodyId base = anchorOf(world);
    const BodyId first = addBody(world, dynamicAt({0, 0}, {}, 4), circle(0.5));
    const BodyId second = addBody(world, dynamicAt({3, 0}), circle(1));
    const auto hinge = [&](BodyId wheel, double x) {
        RevoluteJointDef def;
        def.base = between(base, wheel);
        def.anchor = {x, 0};
        return must(world.createJoint(def));
    };
    GearJointDef def;
    def.jointA = hinge(first, 0);
    def.jointB = hinge(second, 3);
    def.ratio = real(ratio);
    const JointId gear = must(world.createJoint(def));
    const double i1 = world.inertia(first);
    const double i2 = world.inertia(second);
    const double momentum = i1 * 4 - i2 * 0 / ratio;
    runFor(world, 2);
    // ω₂ = −ω₁/ratio; the impulse J on the first and ratio·J on the second: I₁ω₁ − I₂ω₂/ratio is kept.
    expectAtMost("ratio", std::abs(spinOf(world, first) + ratio * spinOf(world, second)), 1e-4);
    expectAtMost("momentum", std::abs((i1 * spinOf(world, first) - i2 * spinOf(world, second) / ratio) / momentum - 1),
                 1e-4);
    expectAtMost("slip", static_cast<double>(world.jointAngleError(gear)), 1e-4);
    must(world.applyTorque(first, real(0.5)));
    const double before = spinOf(world, first);
    must(world.step(kStep));
    const double effective = i1 + i2 / (ratio * ratio);
    expectAtMost("torque through the teeth", std::abs((spinOf(world, first) - before) / (0.5 * kStep / effective) - 1),
                 2e-3);
    // Without one of its joints there is no gear.
    EXPECT_EQ(world.jointCount(), 3U);
    must(world.destroyBody(second));
    EXPECT_EQ(world.jointCount(), 1U);
    EXPECT_FALSE(world.isValid(gear));
}

/// Rack and pinion, on a common frame that moves freely: what the pinion turns, the rack slides.
TEST(JointKinds, GearOfRackAndPinionOnAFreeFrame) {
    World world = makeWorld(0);
    const BodyId frame = addBody(world, dynamicAt({0, 0}), box(2, 0.5));
    const BodyId pinion = addBody(world, dynamicAt({0, 1}, {}, 3), circle(0.5));
    const BodyId rack = addBody(world, dynamicAt({1, 2}), box(1, 0.1));
    RevoluteJointDef hinge;
    hinge.base = between(frame, pinion);
    hinge.anchor = {0, 1};
    PrismaticJointDef rail;
    rail.base = between(frame, rack);
    rail.anchor = {1, 2};
    GearJointDef def;
    def.jointB = must(world.createJoint(hinge));
    def.jointA = must(world.createJoint(rail));
    def.ratio = real(0.5);
    const JointId gear = must(world.createJoint(def));
    const BodyId all[] = {frame, pinion, rack};
    const DVec2 momentum = momentumOf(world, all);
    const double angular = angularMomentumOf(world, all);
    runFor(world, 2);
    expectAtMost("slip", static_cast<double>(world.jointError(gear)), 1e-3);
    EXPECT_GT(std::abs(world.jointTranslation(def.jointA)), real(0.1)) << "it slides";
    expectAtMost("momentum", length(momentumOf(world, all) - momentum), 1e-4);
    expectAtMost("angular momentum", std::abs(angularMomentumOf(world, all) / angular - 1), 2e-3);
}

/// Atwood's machine: a = (m₁ − m₂)·g/(m₁ + m₂), tension 2·m₁·m₂·g/(m₁ + m₂); with a ratio, the forces are as 1 : ratio.
TEST(JointKinds, PulleyIsAnAtwoodMachine) {
    for (const double ratio : {1.0, 2.0}) {
        World world = makeWorld();
        const BodyId left = addBody(world, dynamicAt({-1, 0}), box(0.5, 0.5));
        const BodyId right = addBody(world, dynamicAt({1, 0}), box(0.5, 0.25));
        PulleyJointDef def;
        def.base = between(left, right);
        def.groundA = {-1, 5};
        def.groundB = {1, 5};
        def.anchorA = {-1, 0.5};
        def.anchorB = {1, 0.25};
        def.ratio = real(ratio);
        const JointId joint = must(world.createJoint(def));
        const double m1 = world.mass(left);
        const double m2 = world.mass(right);
        // lengthA + r·lengthB constant: a₂ = −a₁/r; m₁a₁ = m₁g − T, m₂a₂ = m₂g − rT (downwards).
        const double down = kGravity * (m1 - m2 / ratio) / (m1 + m2 / (ratio * ratio));
        const double tension = m1 * (kGravity - down);
        run(world, 30);
        const double t = 30 * kStep;
        expectAtMost("acceleration", std::abs(velocityOf(world, left).y / (-down * t) - 1), 2e-3);
        expectAtMost("other side", std::abs(velocityOf(world, right).y / (down / ratio * t) - 1), 2e-3);
        expectAtMost("tension", std::abs(static_cast<double>(world.jointForce(joint).y) / (ratio * tension) - 1), 2e-3);
        expectAtMost("rope", static_cast<double>(world.jointError(joint)), 1e-3);
        // A rope does not push: what is thrown up flies freely.
        must(world.setVelocity(left, vec(0, 3), 0));
        must(world.setVelocity(right, vec(0, 3), 0));
        must(world.step(kStep));
        EXPECT_NEAR(velocityOf(world, left).y, 3 - kGravity * kStep, 1e-4);
        EXPECT_EQ(length(world.jointForce(joint)), 0);
    }
}

TEST(JointKinds, FilterOnlyKeepsApart) {
    for (const bool filtered : {true, false}) {
        World world = makeWorld();
        const BodyId floor = addStatic(world, box(5, 0.5), material(1), {0, -0.5});
        const BodyId ball = addBody(world, dynamicAt({0, 2}), circle(0.5));
        JointId joint;
        if (filtered) {
            FilterJointDef def;
            def.base = between(floor, ball);
            joint = must(world.createJoint(def));
        }
        run(world, 60);
        if (!filtered) {
            EXPECT_NEAR(world.position(ball).y, 0.5, 0.01);
            continue;
        }
        EXPECT_NEAR(world.position(ball).y, 2 - 5, 1e-4) << "free flight, to the end of the parabola";
        EXPECT_EQ(world.counters().solvedBodies, 0U) << "a filter holds nothing";
        must(world.setPose(ball, {0, 2}, 0));
        must(world.setVelocity(ball, {}, 0));
        must(world.destroyJoint(joint));
        run(world, 120);
        EXPECT_NEAR(world.position(ball).y, 0.5, 0.01) << "and they collide again";
    }
}

/// A joint that holds a sleeping body wakes it when it is told something new.
TEST(JointKinds, SettersWake) {
    WorldSettings settings = awakeSettings();
    settings.sleep = true;
    World world = makeWorld(settings);
    const BodyId base = anchorOf(world);
    const BodyId bar = addBody(world, dynamicAt({0, -1}), box(0.1, 1));
    RevoluteJointDef hinge;
    hinge.base = between(base, bar);
    const JointId joint = must(world.createJoint(hinge));
    run(world, 300);
    ASSERT_FALSE(world.isAwake(bar));
    must(world.setAngularMotor(joint, AngularMotor{1, 100}));
    EXPECT_TRUE(world.isAwake(bar));
    runFor(world, 0.5);
    expectAtMost("it turns", std::abs(world.jointAngle(joint) / 0.5 - 1), 0.01);
    EXPECT_EQ(world.setLinearMotor(joint, LinearMotor{1, 1}).code, StatusCode::wrongJointType);
    EXPECT_EQ(world.setTarget(joint, {0, 0}).code, StatusCode::wrongJointType);
    EXPECT_EQ(world.setAngleLimits(joint, AngleLimits{1, 0}).code, StatusCode::outOfRange);
}

}  // namespace
}  // namespace swept::test
