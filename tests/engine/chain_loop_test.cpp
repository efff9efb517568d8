#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "world_support.h"

/// A floor that goes over into a loop, all of one chain: the loop comes down where the floor is.

namespace swept::test {
namespace {

constexpr Profile kBoth[] = {Profile::fast, Profile::accurate};

/// From left to right; the floor ends at x = 0.
std::vector<Vec2> floorAndLoop(double piece) {
    constexpr double kLoop = 4;
    std::vector<Vec2> points;
    for (double x = -20; x < 0; x += piece) { points.push_back(vec(x, 0)); }
    for (double turn = 0; turn < 0.97 * 2 * kPi; turn += piece / kLoop) {
        points.push_back(vec(kLoop * std::sin(turn), kLoop - kLoop * std::cos(turn)));
    }
    std::reverse(points.begin(), points.end());
    return points;
}

/// Who rolls on one part of a chain comes through another one of it as through that of any other: it was thrown up by
/// the whole radius, since it stood on the same chain.
TEST(ChainLoop, LetsThroughWhoStandsOnItsFloor) {
    constexpr double kBall = 0.2;
    for (const Profile profile : kBoth) {
        for (const double piece : {0.05, 0.1, 0.5}) {
            World world = makeWorld(profile);
            const BodyId ground = must(world.createBody({}));
            must(world.addChain(ground, floorAndLoop(piece), false, material(0)));
            const BodyId ball = addBody(world, dynamicAt({-3, kBall}, vec(2, 0)), circle(kBall), material(0));
            double highest = 0;
            for (int i = 0; i < 600 && world.position(ball).x < -0.1; ++i) {
                must(world.step(kStep));
                highest = std::max(highest, world.position(ball).y);
            }
            const std::string name = profileName(profile) + ", pieces of " + std::to_string(piece) + ": ";
            expectAtMost(name + "height", highest, kBall + 0.001);
            EXPECT_NEAR(velocityOf(world, ball).x, 2, 0.01) << name;
        }
    }
}

/// At 13 m/s wheels lost up to 0.13 s there, and their hinges parted by 0.34 m.
TEST(ChainLoop, HoldsNoCartUp) {
    for (const Profile profile : kBoth) {
        for (const double piece : {0.05, 0.1, 0.5}) {
            World world = makeWorld(profile);
            must(world.addChain(must(world.createBody({})), floorAndLoop(piece), false, material(0.9)));
            constexpr double kWheel = 0.2;
            constexpr double kSpeed = 13;
            ShapeDef hullDef = material(0.9, 0, 30);
            hullDef.filter.mask = 0;
            const BodyId hull =
                addBody(world, dynamicAt({-10, 0.45}, vec(kSpeed, 0)), must(makeBox(vec(0.5, 0.1))), hullDef);
            std::vector<JointId> hinges;
            for (const double x : {-10.4, -9.6}) {
                BodyDef def = dynamicAt({x, kWheel}, vec(kSpeed, 0));
                def.angularVelocity = real(-kSpeed / kWheel);
                const BodyId wheel = addBody(world, def, circle(kWheel), material(0.9, 0, 20));
                hinges.push_back(must(world.createJoint(
                    RevoluteJointDef{.base = {.bodyA = hull, .bodyB = wheel}, .anchor = {x, kWheel}})));
            }
            double lost = 0;
            double gap = 0;
            for (int i = 0; i < 120 && world.position(hull).x < 1.5; ++i) {
                must(world.step(kStep));
                for (const LostTimeEntry& entry : world.lostTime()) { lost += entry.seconds; }
                for (const JointId hinge : hinges) {
                    gap = std::max(gap, static_cast<double>(world.jointError(hinge)));
                }
            }
            const std::string name = profileName(profile) + ", pieces of " + std::to_string(piece) + ": ";
            EXPECT_GE(world.position(hull).x, 1.5) << name;
            EXPECT_EQ(lost, 0) << name;
            expectAtMost(name + "gap", gap, 0.005);
        }
    }
}

}  // namespace
}  // namespace swept::test
