#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "joint_support.h"

/// Ground is softer for what kinematic bodies squeeze, and for that alone.

namespace swept::test {
namespace {

struct Squeeze {
    double speed;    ///< of the plate, m/s down
    double height;   ///< of the hinge over the middle of the crates, metres
    double tilt;     ///< of the plate
    double density;  ///< of the right crate, times that of the left one
    double offset;   ///< of the plate, metres
};

/// Fastest that one of two crates on a hinge is under a plate that comes down to the floor, over the plate's speed.
double fastestOf(const Squeeze& squeeze) {
    World world = makeWorld(Profile::fast);
    addStatic(world, box(50, 0.5), material(0.6), {0, -0.5});
    const BodyId left = addBody(world, dynamicAt({-0.5, 0.5}), box(0.5, 0.5), material(0.6));
    const BodyId right = addBody(world, dynamicAt({0.52, 0.5}), box(0.5, 0.5), material(0.6, 0, squeeze.density));
    RevoluteJointDef hinge;
    hinge.base = between(left, right);
    hinge.anchor = {0, 0.5 + squeeze.height};
    must(world.createJoint(hinge));
    BodyDef plate = bodyAt(BodyType::kinematic, {squeeze.offset, 1.6}, squeeze.tilt);
    plate.velocity = vec(0, -squeeze.speed);
    addBody(world, plate, box(3, 0.2));
    double fastest = 0;
    const int steps = static_cast<int>(kRate * 1.4 / squeeze.speed);
    for (int i = 0; i < steps; ++i) {
        run(world, 1);
        fastest = std::max({fastest, length(velocityOf(world, left)), length(velocityOf(world, right))});
    }
    return fastest / squeeze.speed;
}

/// Of each squeeze alone little can be said: how crates come out from under a plate differs with the last bit. Without
/// the softer ground they are nearly twice as fast in the mean.
TEST(Strained, HingedCratesThatAPlateSqueezesAreNotFlungAway) {
    double sum = 0;
    int count = 0;
    for (const double speed : {0.5, 1.0}) {
        for (const double height : {0.0, 0.16, 0.32, 0.48}) {
            for (const double tilt : {0.0, 0.1, 0.2}) {
                for (const double density : {0.2, 1.0, 5.0}) {
                    for (const double offset : {0.0, 0.4}) {
                        sum += fastestOf({speed, height, tilt, density, offset});
                        ++count;
                    }
                }
            }
        }
    }
    expectAtMost("speed over that of the plate, mean of " + std::to_string(count), sum / count, 10);
}

/// A crate on a crate; the upper one is `ratio` times as heavy.
struct LoadedStack {
    BodyId lower;
    BodyId upper;
};
LoadedStack addLoadedStack(World& world, double ratio) {
    const BodyId lower = addBody(world, dynamicAt({0, 0.505}), box(0.5, 0.5), material(0.6));
    return {lower, addBody(world, dynamicAt({0, 1.51}), box(0.5, 0.5), material(0.6, 0, ratio))};
}

/// A lift, a door or somebody who walks by touches nothing: the stack dropped by up to 14 mm as they came near.
TEST(Strained, AMoverThatPassesBesideAStackLeavesItInPlace) {
    for (const double gap : {0.001, 0.005, 0.01, 0.02}) {
        for (const BodyType ground : {BodyType::fixed, BodyType::kinematic}) {
            for (const double ratio : {10.0, 50.0}) {
                World world = makeWorld(Profile::fast);
                addBody(world, bodyAt(ground, {0, -0.5}), box(20, 0.5), material(0.6));
                const LoadedStack stack = addLoadedStack(world, ratio);
                const BodyId mover = addBody(world, bodyAt(BodyType::kinematic, {3, 1}), box(0.4, 0.9), material(0.6));
                run(world, 400);
                const double before = world.position(stack.upper).y;
                double lowest = before;
                double highest = before;
                for (int i = 0; i < 400; ++i) {
                    const double x = world.position(mover).x;
                    const double speed = i < 200 ? std::max(-2.0, 12 * (0.9 + gap - x)) : std::min(2.0, 6 * (3 - x));
                    must(world.setVelocity(mover, vec(speed, 0), 0));
                    run(world, 1);
                    lowest = std::min(lowest, world.position(stack.upper).y);
                    highest = std::max(highest, world.position(stack.upper).y);
                }
                const std::string what = std::to_string(1000 * gap) + " mm beside, load of " + std::to_string(ratio) +
                                         (ground == BodyType::fixed ? ", on fixed ground" : ", on a kinematic body");
                expectAtMost(what + ": drops by mm", 1000 * (before - lowest), 0.3);
                expectAtMost(what + ": rises by mm", 1000 * (highest - before), 0.3);
            }
        }
    }
}

struct GroundPiece {
    BodyType type;
    DVec2 place;
    DVec2 half;
};

/// How deep the lower crate of a loaded stack is in the floor in the end, mm.
double sinkingOn(const std::vector<GroundPiece>& pieces) {
    World world = makeWorld(Profile::fast);
    for (const GroundPiece& piece : pieces) {
        addBody(world, bodyAt(piece.type, piece.place), box(piece.half.x, piece.half.y), material(0.6));
    }
    const LoadedStack stack = addLoadedStack(world, 50);
    run(world, 400);
    return 1000 * (0.5 - world.position(stack.lower).y);
}

TEST(Strained, WhatPushesTheSameWayOrAtRightAnglesSqueezesNothing) {
    const GroundPiece floor{BodyType::fixed, {0, -0.5}, {20, 0.5}};
    const GroundPiece left{BodyType::fixed, {-10, -0.5}, {10, 0.5}};
    const double onFloor = sinkingOn({floor});
    const double onSeam = sinkingOn({left, {BodyType::fixed, {10, -0.5}, {10, 0.5}}});
    EXPECT_NEAR(sinkingOn({floor, {BodyType::kinematic, {0.9, 1}, {0.4, 1}}}), onFloor, 0.3) << "a wall that touches";
    EXPECT_NEAR(sinkingOn({floor, {BodyType::kinematic, {0.899, 1}, {0.4, 1}}}), onFloor, 0.3) << "a wall that presses";
    EXPECT_NEAR(sinkingOn({left, {BodyType::kinematic, {10, -0.5}, {10, 0.5}}}), onSeam, 0.3) << "half on a lift";
}

}  // namespace
}  // namespace swept::test
