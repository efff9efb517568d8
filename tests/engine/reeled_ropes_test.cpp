#include <gtest/gtest.h>

#include <cmath>

#include "joint_support.h"

/// Ropes and rods that calls make shorter and longer while something swings on them.

namespace swept::test {
namespace {

/// Where who swings is after a second in which the rope is reeled in: r'' and θ'' of a point mass, in small steps.
DVec2 endOfReeledSwing(double length, double speed, double pace) {
    constexpr int kParts = 200'000;
    constexpr double kPart = 1.0 / kParts;
    double r = length;
    double angle = 0;
    double spin = speed / length;
    for (int i = 0; i < kParts; ++i) {
        spin += kPart * (-kGravity * std::sin(angle) + 2 * pace * spin) / r;
        angle += kPart * spin;
        r -= kPart * pace;
    }
    return {r * std::sin(angle), -r * std::cos(angle)};
}

/// A winch does work: who swings on a rope that is reeled in gets faster, and is not brought to rest.
TEST(ReeledRopes, MakeWhoSwingsFaster) {
    for (const Profile profile : {Profile::accurate, Profile::fast}) {
        for (const bool isRod : {false, true}) {
            for (const double pace : {0.5, 1.0, 2.0, 3.0}) {
                constexpr double kLength = 6;
                WorldSettings settings = awakeSettings(profile);
                World world = makeWorld(settings);
                BodyDef ball = dynamicAt({0, -kLength}, vec(7, 0));
                ball.fixedRotation = true;
                const BodyId player = addBody(world, ball, capsule(0.4, 0.3));
                DistanceJointDef rope;
                rope.base = {.bodyA = must(world.createBody({})), .bodyB = player};
                rope.anchorA = {0, 0};
                rope.anchorB = {0, -kLength};
                if (!isRod) { rope.limits = LengthLimits{0, real(kLength)}; }
                const JointId joint = must(world.createJoint(rope));
                for (int i = 1; i <= 60; ++i) {
                    const Real length = real(kLength - pace * i * kStep);
                    must(isRod ? world.setLength(joint, length)
                               : world.setLengthLimits(joint, LengthLimits{0, length}));
                    must(world.step(kStep));
                }
                const DVec2 error = world.position(player) - endOfReeledSwing(kLength, 7, pace);
                EXPECT_LT(length(error), 0.02 * pace) << pace << " m/s, " << (isRod ? "rod" : "rope");
            }
        }
    }
}

/// What is shortened far at once is put elsewhere, and keeps the motion that it had.
TEST(ReeledRopes, ThatAreShortenedAtOnceKeepTheMotion) {
    World world = makeWorld();
    const BodyId load = addBody(world, dynamicAt({0, -6}, vec(3, 0)), circle(0.3));
    DistanceJointDef rope;
    rope.base = {.bodyA = must(world.createBody({})), .bodyB = load};
    rope.anchorA = {0, 0};
    rope.anchorB = {0, -6};
    rope.limits = LengthLimits{0, 6};
    const JointId joint = must(world.createJoint(rope));
    run(world, 5);
    must(world.setLengthLimits(joint, LengthLimits{0, 5}));
    run(world, 5);
    EXPECT_NEAR(length(world.position(load)), 5, 0.02);
    EXPECT_GT(length(velocityOf(world, load)), 2.5);
    EXPECT_LT(length(velocityOf(world, load)), 4);
}

/// What swings on a rope or rod that is reeled in comes nearer as fast. (It was told to go around alone.)
TEST(ReeledRopes, DrawInAsFastAsTheyAreReeled) {
    for (const Profile profile : {Profile::accurate, Profile::fast}) {
        for (const bool isRod : {false, true}) {
            for (const double speed : {0.5, 2.0}) {
                World world = makeWorld(profile, 0);
                const BodyId load = addBody(world, dynamicAt({4, 0}, vec(0, 3)), circle(0.2));
                DistanceJointDef def;
                def.base = between(anchorOf(world), load);
                def.anchorA = {0, 0};
                def.anchorB = {4, 0};
                if (!isRod) { def.limits = LengthLimits{0, 4}; }
                const JointId joint = must(world.createJoint(def));
                double reach = 4;
                while (reach > 2) {
                    reach -= speed * kStep;
                    must(isRod ? world.setLength(joint, real(reach))
                               : world.setLengthLimits(joint, LengthLimits{0, real(reach)}));
                    run(world, 1);
                }
                const DVec2 place = world.position(load);
                const DVec2 outwards = (1 / length(place)) * place;
                EXPECT_NEAR(dot(outwards, velocityOf(world, load)), -speed, 0.02 * speed) << profileName(profile);
                EXPECT_NEAR(cross(place, velocityOf(world, load)), 12, 0.06) << profileName(profile);
                EXPECT_NEAR(length(place), reach, 0.002) << profileName(profile);
            }
        }
    }
}

/// Work comes back: on a rod that is drawn in and let out again a load whirls as before.
TEST(ReeledRopes, TakeBackTheWorkThatTheyDid) {
    for (const Profile profile : {Profile::accurate, Profile::fast}) {
        World world = makeWorld(profile, 0);
        const BodyId load = addBody(world, dynamicAt({4, 0}, vec(0, 3)), circle(0.2));
        DistanceJointDef def;
        def.base = between(anchorOf(world), load);
        def.anchorA = {0, 0};
        def.anchorB = {4, 0};
        const JointId rod = must(world.createJoint(def));
        const double before = kineticEnergy(world, load);
        for (int i = 1; i <= 600; ++i) {
            must(world.setLength(rod, real(3 + std::cos(2 * kPi * i / 120))));
            run(world, 1);
        }
        run(world, 60);
        EXPECT_NEAR(kineticEnergy(world, load), before, 0.02 * before) << profileName(profile);
    }
}

}  // namespace
}  // namespace swept::test
