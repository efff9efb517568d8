#include <cmath>
#include <string>
#include <variant>
#include <vector>

#include "joint_support.h"

/// Joints that are made where their bodies are not at rest in them: half way along, or apart.

namespace swept::test {
namespace {

constexpr double kRounding = kIsDouble ? 1e-12 : 1e-5;

DVec2 centerOfMassOf(const World& world, const std::vector<BodyId>& bodies) {
    DVec2 sum;
    double mass = 0;
    for (const BodyId body : bodies) {
        sum += world.mass(body) * world.centerOfMass(body);
        mass += world.mass(body);
    }
    return (1 / mass) * sum;
}

/// A post, and a door of 1 m whose edge is at it, open by an angle.
struct Door {
    Door(Profile profile, double angle) : world(makeWorld(profile, 0)) {
        post = addStatic(world, box(0.1, 0.1));
        leaf = addBody(world, bodyAt(BodyType::dynamic, turned({0.5, 0}, angle), angle), box(0.5, 0.05));
        def.base = between(post, leaf);
        def.referenceAngle = 0;
        def.limits = AngleLimits{real(0), real(1.5)};
    }

    World world;
    BodyId post;
    BodyId leaf;
    RevoluteJointDef def;
};

TEST(JointFrames, DoorsBeginHalfOpen) {
    for (const Profile profile : kProfiles) {
        Door door(profile, 0.6);
        const JointId hinge = must(door.world.createJoint(door.def));
        EXPECT_NEAR(door.world.jointAngle(hinge), 0.6, kRounding);
        EXPECT_LE(door.world.jointError(hinge), real(kRounding));
        run(door.world, 30);
        EXPECT_NEAR(door.world.jointAngle(hinge), 0.6, 1e-6) << "nothing moves it";
        for (const double end : {1.5, 0.0}) {
            must(door.world.setAngularMotor(hinge, AngularMotor{real(end > 1 ? 2 : -2), real(50)}));
            run(door.world, 120);
            EXPECT_NEAR(door.world.angle(door.leaf), end, 2e-3) << profileName(profile);
            const DVec2 place = turned({0.5, 0}, end);
            expectAtMost(profileName(profile) + ": place of the door, m",
                         length(door.world.position(door.leaf) - place), 2e-3);
        }
    }
}

/// What is jointed falls by sub-steps, which are ahead of the parabola by g·t·h/2, m.
double aheadOfFall(Profile profile, double time) {
    const double subStep = kStep / (profile == Profile::fast ? 4 : 16);
    return 1.01 * kGravity * time * subStep / 2;
}

/// x = 0.3 + g t²/2 until the limit.
TEST(JointFrames, SlidersBeginOnTheirWay) {
    for (const Profile profile : kProfiles) {
        World world = makeWorld(profile);
        const BodyId rail = addStatic(world, box(0.1, 0.1));
        const BodyId sled = addBody(world, dynamicAt({0, -0.3}), box(0.1, 0.1));
        PrismaticJointDef def;
        def.base = between(rail, sled);
        def.anchorB = DVec2{0, -0.3};
        def.axis = {0, -1};
        def.limits = TranslationLimits{real(0), real(1)};
        const JointId slider = must(world.createJoint(def));
        EXPECT_NEAR(static_cast<double>(world.jointTranslation(slider)), 0.3, kRounding);
        EXPECT_LE(world.jointError(slider), real(kRounding)) << "the way along the axis is no gap";
        run(world, 15);
        const double time = 15 * kStep;
        EXPECT_NEAR(static_cast<double>(world.jointTranslation(slider)), 0.3 + kGravity * time * time / 2,
                    aheadOfFall(profile, time));
        run(world, 120);
        EXPECT_NEAR(static_cast<double>(world.jointTranslation(slider)), 1, 5e-3) << profileName(profile);
        EXPECT_NEAR(world.position(sled).y, -1, 5e-3);
    }
}

/// Around the place where the anchors are one, and the angle of reference: with the amplitude with which it began.
TEST(JointFrames, SpringsPullToWhereTheyAreZero) {
    const Spring spring{real(1), real(0)};
    for (const Profile profile : kProfiles) {
        World world = makeWorld(profile, 0);
        const BodyId base = addStatic(world, box(0.1, 0.1));
        const BodyId sled = addBody(world, dynamicAt({0.3, 2}), box(0.1, 0.1));
        const BodyId wheel = addBody(world, dynamicAt({0.3, 4}), circle(0.2));
        const BodyId arm = addBody(world, bodyAt(BodyType::dynamic, {0, 6}, 0.3), box(0.4, 0.1));
        const BodyId held = addBody(world, bodyAt(BodyType::dynamic, {0.3, 8}, 0.3), box(0.4, 0.1));
        PrismaticJointDef slide;
        slide.base = between(base, sled);
        slide.anchor = {0, 2};
        slide.anchorB = DVec2{0.3, 2};
        slide.spring = spring;
        const JointId slider = must(world.createJoint(slide));
        WheelJointDef roll;
        roll.base = between(base, wheel);
        roll.anchor = {0, 4};
        roll.anchorB = DVec2{0.3, 4};
        roll.axis = {1, 0};
        roll.spring = spring;
        const JointId axle = must(world.createJoint(roll));
        RevoluteJointDef turn;
        turn.base = between(base, arm);
        turn.anchor = {0, 6};
        turn.referenceAngle = 0;
        turn.spring = spring;
        const JointId hinge = must(world.createJoint(turn));
        WeldJointDef soft;
        soft.base = between(base, held);
        soft.anchor = {0, 8};
        soft.anchorB = DVec2{0.3, 8};
        soft.referenceAngle = 0;
        soft.linearSpring = soft.angularSpring = spring;
        const JointId weld = must(world.createJoint(soft));
        for (int step = 1; step <= 60; ++step) {
            run(world, 1);
            const double wanted = 0.3 * std::cos(2 * kPi * step * kStep);
            const std::string when = profileName(profile) + ", step " + std::to_string(step);
            EXPECT_NEAR(static_cast<double>(world.jointTranslation(slider)), wanted, 0.01) << when;
            EXPECT_NEAR(static_cast<double>(world.jointTranslation(axle)), wanted, 0.01) << when;
            EXPECT_NEAR(world.jointAngle(hinge), wanted, 0.01) << when;
            EXPECT_NEAR(world.position(held).x, wanted, 0.01) << when;
            EXPECT_NEAR(world.jointAngle(weld), wanted, 0.01) << when;
        }
    }
}

/// A spring has its stiffness where its joint is to be, not where it begins: as one that is made there.
TEST(JointFrames, SpringsAreAsStiffAsWhereTheyAreZero) {
    const auto swing = [](bool isMadeApart) {
        World world = makeWorld(real(0));
        const BodyId frame = addBody(world, dynamicAt({0, 0}), box(0.5, 0.2));
        const BodyId sled = addBody(world, dynamicAt({0.8, 0}), box(0.1, 0.6));
        WheelJointDef def;
        def.base = between(frame, sled);
        def.anchor = {0.8, 0.3};
        def.axis = {1, 0};
        def.spring = Spring{real(2), real(0.1)};
        if (isMadeApart) {
            must(world.setPose(sled, {1, 0.1}, 1.2));
            def.anchorB = apply(world.transform(sled), vec(0, 0.3));
            def.referenceAngle = 0;
            must(world.createJoint(def));
        } else {
            must(world.createJoint(def));
            must(world.setPose(sled, {1, 0.1}, 1.2));
        }
        run(world, 20);
        return world.position(sled);
    };
    expectAtMost("made apart, or put there, m", length(swing(true) - swing(false)), 1e-4);
}

/// What is welded from afar is drawn together: by inner forces alone, and stays there.
TEST(JointFrames, WeldsSnapTogether) {
    for (const Profile profile : kProfiles) {
        for (const double gap : {0.1, 0.5, 2.0}) {
            World world = makeWorld(profile, 0);
            const std::vector<BodyId> bodies{
                addBody(world, dynamicAt({0, 0}), box(0.5, 0.5)),
                addBody(world, bodyAt(BodyType::dynamic, {1 + gap, 0.2}, 0.7), box(0.5, 0.25))};
            WeldJointDef def;
            def.base = between(bodies[0], bodies[1]);
            def.anchor = {0.5, 0};
            def.anchorB = apply(world.transform(bodies[1]), vec(-0.5, 0));
            def.referenceAngle = 0;
            const DVec2 center = centerOfMassOf(world, bodies);
            const JointId weld = must(world.createJoint(def));
            EXPECT_NEAR(world.jointAngle(weld), 0.7, kRounding);
            const double begun = static_cast<double>(world.jointError(weld));
            const std::string what = profileName(profile) + ", gap " + std::to_string(gap);
            double last = begun;
            for (int step = 0; step < 120; ++step) {
                run(world, 1);
                const auto now = static_cast<double>(world.jointError(weld));
                EXPECT_LE(now, last + 1e-3) << what << ", step " << step;
                last = now;
            }
            expectAtMost(what + ": left of the gap, m", last, 1e-3);
            expectAtMost(what + ": left of the turn, rad", std::fabs(world.jointAngle(weld)), 1e-3);
            expectAtMost(what + ": the centre of mass moved, m", length(centerOfMassOf(world, bodies) - center), 1e-4);
            for (const BodyId body : bodies) {
                expectAtMost(what + ": speed, m/s", length(velocityOf(world, body)), 0.02);
                expectAtMost(what + ": spin, rad/s", std::fabs(spinOf(world, body)), 0.02);
            }
        }
    }
}

TEST(JointFrames, MotorJointsDriveToAnglesOfReference) {
    for (const Profile profile : kProfiles) {
        World world = makeWorld(profile, 0);
        const BodyId base = addStatic(world, box(0.1, 0.1));
        const BodyId tool = addBody(world, bodyAt(BodyType::dynamic, {2, 1}, 1.2), box(0.3, 0.2));
        MotorJointDef def;
        def.base = between(base, tool);
        def.referenceAngle = 0;
        def.drive.maxTorque = real(100);
        const JointId motor = must(world.createJoint(def));
        EXPECT_NEAR(world.jointAngle(motor), 1.2, kRounding);
        run(world, 120);
        EXPECT_NEAR(world.angle(tool), 0, 1e-3) << "no offset is that angle";
        must(world.setDrive(motor, {.angularOffset = real(-0.5), .maxTorque = real(100)}));
        run(world, 120);
        EXPECT_NEAR(world.angle(tool), -0.5, 1e-3);
    }
}

/// Gears couple angles from where these count: what limits one wheel stops both.
TEST(JointFrames, GearsTurnHingesWithAnglesOfReference) {
    for (const Profile profile : kProfiles) {
        World world = makeWorld(profile, 0);
        const BodyId base = addStatic(world, box(0.1, 0.1));
        const BodyId first = addBody(world, bodyAt(BodyType::dynamic, {1, 0}, 0.4), circle(0.4));
        const BodyId second = addBody(world, bodyAt(BodyType::dynamic, {2, 0}, -0.1), circle(0.2));
        RevoluteJointDef def;
        def.base = between(base, first);
        def.anchor = {1, 0};
        def.referenceAngle = 0;
        def.limits = AngleLimits{real(0), real(1)};
        const JointId hingeA = must(world.createJoint(def));
        def.base = between(base, second);
        def.anchor = {2, 0};
        def.limits.reset();
        const JointId hingeB = must(world.createJoint(def));
        GearJointDef gear;
        gear.jointA = hingeA;
        gear.jointB = hingeB;
        gear.ratio = real(0.5);
        const JointId mesh = must(world.createJoint(gear));
        EXPECT_LE(world.jointAngleError(mesh), real(kRounding));
        for (const double end : {1.0, 0.0}) {
            must(world.setAngularMotor(hingeB, AngularMotor{real(end > 0.5 ? -3 : 3), real(1)}));
            run(world, 180);
            EXPECT_NEAR(world.jointAngle(hingeA), end, 0.01) << profileName(profile);
            EXPECT_NEAR(world.jointAngle(hingeA) + 0.5 * world.jointAngle(hingeB), 0.35, 0.01);
        }
    }
}

/// What a joint holds it turns by half a turn at most. What may turn on counts whole turns.
TEST(JointFrames, WholeTurnsAreNotTurnedBack) {
    const auto angleAt = [](double angle, auto def) {
        World world = makeWorld(real(0));
        const BodyId base = addStatic(world, box(0.1, 0.1));
        const BodyId wheel = addBody(world, bodyAt(BodyType::dynamic, {}, angle), circle(0.5));
        def.base = between(base, wheel);
        def.referenceAngle = 0.25;
        return world.jointAngle(must(world.createJoint(def)));
    };
    const double near = 2 * kPi + 0.5;
    const double far = -6 * kPi + 0.5;
    WeldJointDef weld;
    PrismaticJointDef slider;
    MotorJointDef seeking;
    seeking.drive.maxTorque = real(1);
    for (const double angle : {near, far, 0.5}) {
        EXPECT_NEAR(angleAt(angle, weld), 0.25, 1e-9);
        EXPECT_NEAR(angleAt(angle, slider), 0.25, 1e-9);
        EXPECT_NEAR(angleAt(angle, seeking), 0.25, 1e-9);
    }
    RevoluteJointDef hinge;
    WheelJointDef axle;
    MotorJointDef turning = seeking;
    turning.drive.angularVelocity = real(1);
    for (const double angle : {near, far}) {
        EXPECT_EQ(angleAt(angle, hinge), angle - 0.25);
        EXPECT_EQ(angleAt(angle, axle), angle - 0.25);
        EXPECT_EQ(angleAt(angle, turning), angle - 0.25);
    }
    hinge.limits = AngleLimits{real(-1), real(1)};
    EXPECT_NEAR(angleAt(near, hinge), 0.25, 1e-9);
    hinge.limits = AngleLimits{real(-1), real(8)};
    EXPECT_EQ(angleAt(near, hinge), near - 0.25) << "a winch";
    EXPECT_NEAR(angleAt(far, hinge), far - 0.25 + 6 * kPi, 1e-9);
}

/// Said in so many words what is usual.
TEST(JointFrames, OfWhereTheJointIsMadeAreTheUsualOnes) {
    const auto hashOf = [](bool isSaid) {
        World world = makeWorld();
        const BodyId base = addBody(world, bodyAt(BodyType::fixed, {0, 3}, 0.4), box(0.1, 0.1));
        BodyId last = base;
        for (int i = 0; i < 4; ++i) {
            const BodyId link = addBody(world, bodyAt(BodyType::dynamic, {1.0 + i, 3}, 0.1 * i), box(0.5, 0.1));
            const auto join = [&](auto def) {
                def.base = between(last, link);
                def.anchor = {0.5 + i, 3};
                if (isSaid) {
                    def.anchorB = def.anchor;
                    def.referenceAngle = world.angle(link) - world.angle(last);
                }
                must(world.createJoint(def));
            };
            if (i == 0) { join(RevoluteJointDef{.limits = AngleLimits{real(-1), real(1)}}); }
            if (i == 1) { join(PrismaticJointDef{.motor = LinearMotor{real(0.1), real(100)}}); }
            if (i == 2) { join(WheelJointDef{}); }
            if (i == 3) { join(WeldJointDef{}); }
            last = link;
        }
        run(world, 60);
        return world.stateHash();
    };
    EXPECT_EQ(hashOf(true), hashOf(false));
}

/// A rope that is longer than its way: a free fall until it is taut.
TEST(JointFrames, RopesOfPulleysMayBeSlack) {
    for (const Profile profile : kProfiles) {
        World world = makeWorld(profile);
        const BodyId heavy = addBody(world, bodyAt(BodyType::fixed, {0, 0}), box(0.5, 0.5));
        const BodyId light = addBody(world, dynamicAt({4, 0}), box(0.2, 0.2));
        PulleyJointDef def;
        def.base = between(heavy, light);
        def.groundA = {0, 5};
        def.groundB = {4, 5};
        def.anchorB = {4, 0};
        def.length = real(12);
        const JointId rope = must(world.createJoint(def));
        EXPECT_EQ(world.jointError(rope), 0);
        run(world, 30);
        EXPECT_NEAR(world.position(light).y, -kGravity * 0.5 * 0.5 / 2, aheadOfFall(profile, 0.5))
            << profileName(profile);
        run(world, 120);
        EXPECT_NEAR(world.position(light).y, -2, 0.01) << profileName(profile);
        auto now = std::get<PulleyJointDef>(world.definition(rope));
        EXPECT_EQ(now.length, real(12));
        now.ratio = real(2);
        must(world.redefine(rope, now));
        now = std::get<PulleyJointDef>(world.definition(rope));
        EXPECT_NEAR(static_cast<double>(now.length.value_or(0)), 19, 0.01) << "its slack stays";
        run(world, 60);
        EXPECT_NEAR(world.position(light).y, -2, 0.01) << profileName(profile);
    }
}

TEST(JointFrames, StayInDefinitions) {
    Door door(Profile::accurate, 0.6);
    door.def.anchorB = DVec2{0, 0.125};
    const JointId hinge = must(door.world.createJoint(door.def));
    run(door.world, 30);
    auto def = std::get<RevoluteJointDef>(door.world.definition(hinge));
    EXPECT_EQ(def.anchorB, (DVec2{0, 0.125}));
    EXPECT_EQ(def.referenceAngle, 0.0);
    World other = door.world;
    def.anchorB = DVec2{7, 7};
    def.referenceAngle = 3;
    must(other.redefine(hinge, def));
    run(door.world, 30);
    run(other, 30);
    EXPECT_EQ(other.stateHash(), door.world.stateHash()) << "points and angles of reference stay";
    World copy;
    must(copy.load(door.world.save()));
    EXPECT_EQ(std::get<RevoluteJointDef>(copy.definition(hinge)).referenceAngle, 0.0);
}

}  // namespace
}  // namespace swept::test
