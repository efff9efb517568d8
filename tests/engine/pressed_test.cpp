#include <array>

#include "joint_support.h"
#include "thrown_crowd.h"

/// What is pressed or pulled into a wall, slowly and with any force, gets no farther than into it: what does not yield
/// comes first, then what kinematic bodies and joints ask. What that costs is reported.

namespace swept::test {
namespace {

struct Rest {
    World world;
    BodyId body;
    double lost = 0;  ///< s

    void go(int steps) {
        for (int i = 0; i < steps; ++i) {
            must(world.step(kStep));
            for (const LostTimeEntry& entry : world.lostTime()) { lost += entry.seconds; }
        }
    }
};

std::array<Polygon, 3> someShapes() { return {circle(0.4), box(0.4, 0.4), capsule(0.3, 0.2)}; }

/// The plate goes on through the ceiling, and leaves the body behind.
TEST(Pressed, AgainstACeilingByAPlate) {
    for (const Profile profile : {Profile::accurate, Profile::fast}) {
        for (const double speed : {0.1, 0.5, 1.5, 5.0, 20.0}) {
            for (const Polygon& polygon : someShapes()) {
                for (const bool isThin : {false, true}) {
                    WorldSettings settings = awakeSettings(profile);
                    Rest rest{makeWorld(settings), {}};
                    addStatic(rest.world, isThin ? segment(-5, 3, 5, 3) : box(5, 0.2), {}, {0, isThin ? 0.0 : 3.2});
                    BodyDef plate = bodyAt(BodyType::kinematic, {0, 1.5});
                    plate.velocity = vec(0, speed);
                    addBody(rest.world, plate, box(2, 0.2));
                    rest.body = addBody(rest.world, dynamicAt({0, 2.2}), polygon);
                    double highest = 0;
                    for (int i = 0; i < static_cast<int>(4 / speed * kRate); ++i) {
                        rest.go(1);
                        highest = std::max(highest, rest.world.position(rest.body).y);
                    }
                    EXPECT_LT(highest, 3) << (profile == Profile::fast ? "fast, " : "accurate, ") << speed << " m/s, "
                                          << polygon.count << " vertices" << (isThin ? ", thin" : "");
                    EXPECT_GT(rest.lost, 0);
                }
            }
        }
    }
}

/// Its rod is made fast to something that goes away on the other side of the wall.
TEST(Pressed, AgainstAWallByARod) {
    for (const double speed : {0.2, 1.0, 5.0}) {
        for (const Polygon& polygon : someShapes()) {
            Rest rest{makeWorld(), {}};
            addStatic(rest.world, segment(-5, 0, 5, 0), material(0.5));
            addStatic(rest.world, segment(1, -5, 1, 5), material(0.5));
            BodyDef puller = bodyAt(BodyType::kinematic, {2, 1});
            puller.velocity = vec(speed, 0);
            rest.body = addBody(rest.world, dynamicAt({0.5, 0.45}), polygon, material(0.5));
            DistanceJointDef rod;
            rod.base = between(rest.body, must(rest.world.createBody(puller)));
            rod.anchorA = {0.5, 0.45};
            rod.anchorB = {2, 1};
            must(rest.world.createJoint(rod));
            rest.go(static_cast<int>(3 / speed * kRate));
            EXPECT_LT(rest.world.position(rest.body).x, 1) << speed << " m/s, " << polygon.count << " vertices";
            EXPECT_GT(rest.lost, 0);
        }
    }
}

/// Its axle runs along a wall, and nearer to it than the body may sink in, for a second; then away from it again. What
/// is pressed as deep as it may be goes along: held where it is, it would stay behind by all the way.
TEST(Pressed, AlongAWall) {
    constexpr double kThickness = 0.24;
    const std::array<Polygon, 3> shapes{box(0.3, kThickness / 2), capsule(0.2, kThickness / 2), circle(kThickness / 2)};
    for (const Profile profile : {Profile::fast, Profile::accurate}) {
        for (const double speed : {0.5, 8.0, 30.0}) {
            for (const Polygon& polygon : shapes) {
                for (const bool isThin : {false, true}) {
                    WorldSettings settings = awakeSettings(profile, 0);
                    Rest rest{makeWorld(settings), {}};
                    addStatic(rest.world, isThin ? segment(0, -50, 0, 50) : box(1, 50), {}, {isThin ? 0.0 : -1.0, 0});
                    BodyDef moving = bodyAt(BodyType::kinematic, {0.13, -20});
                    moving.velocity = vec(-0.1, speed);
                    BodyDef upright = bodyAt(BodyType::dynamic, moving.position, kPi / 2);
                    rest.body = addBody(rest.world, upright, polygon);
                    RevoluteJointDef hinge;
                    const BodyId axle = must(rest.world.createBody(moving));
                    hinge.base = between(axle, rest.body);
                    hinge.anchor = moving.position;
                    const JointId joint = must(rest.world.createJoint(hinge));
                    double error = 0;
                    double deepest = 0;
                    for (int i = 0; i < 120; ++i) {
                        if (i == 60) { must(rest.world.setVelocity(axle, vec(0.1, speed), 0)); }
                        rest.go(1);
                        error = std::max(error, static_cast<double>(rest.world.jointError(joint)));
                        deepest = std::max(deepest, deepestOverlap(rest.world));
                    }
                    const std::string which = std::string(profile == Profile::fast ? "fast, " : "accurate, ") +
                                              std::to_string(speed) + " m/s, " + std::to_string(polygon.count) +
                                              " vertices" + (isThin ? ", thin" : "");
                    EXPECT_LT(error, kThickness / 2) << which;
                    EXPECT_LT(deepest, 1.001 * kThickness / 4) << which;
                    EXPECT_LT(static_cast<double>(rest.world.jointError(joint)), 1e-4) << which;
                }
            }
        }
    }
}

/// A heavy box presses a thin plank to a wall. In `fast` the plank stands there as deep in the wall as it may be, and
/// its contacts give a little more in each step: that it does not get there costs it no time, and neither does a wall
/// that moves and takes it along.
TEST(Pressed, ByALoadThatStandsLosesNoTime) {
    constexpr double kThickness = 0.108;
    constexpr double kForce = 9000;
    for (const double speed : {0.0, 0.5, -0.5}) {
        for (const double density : {200.0, 2000.0, 20000.0}) {
            WorldSettings settings = awakeSettings(Profile::fast, 0);
            Rest rest{makeWorld(settings), {}};
            BodyDef moving = bodyAt(speed == 0 ? BodyType::fixed : BodyType::kinematic, {-1, 0});
            moving.velocity = vec(speed, 0);
            const BodyId wall = addBody(rest.world, moving, box(1, 5), material(1));
            const Polygon plank = box(kThickness / 2, 0.14);
            rest.body = addBody(rest.world, dynamicAt({kThickness / 2, 0}), plank, material(1, 0, 100));
            BodyDef pressing = dynamicAt({kThickness + 0.4, 0});
            pressing.fixedRotation = true;
            const BodyId press = addBody(rest.world, pressing, box(0.4, 0.1), material(1, 0, density));
            double depth = 0;
            for (int i = 0; i < 180; ++i) {
                must(rest.world.applyForce(press, vec(-kForce, 0), rest.world.position(press)));
                rest.go(1);
                depth = rest.world.position(wall).x + 1 + kThickness / 2 - rest.world.position(rest.body).x;
            }
            const std::string which = std::to_string(speed) + " m/s, " + std::to_string(density) + " kg/m²";
            EXPECT_GT(depth, kThickness / 8) << which;  // or it is not held
            EXPECT_LT(depth, 1.001 * kThickness / 4) << which;
            EXPECT_EQ(rest.lost, 0) << which;
        }
    }
}

/// What turns back and forth counts as fast, and is sunk into the wall by half of its radius. The box does not let go.
TEST(Pressed, WhileItShakes) {
    for (const bool isThin : {true, false}) {
        WorldSettings settings = awakeSettings(Profile::fast, 0);
        Rest rest{makeWorld(settings), {}};
        addStatic(rest.world, isThin ? segment(0, -5, 0, 5) : box(0.2, 5), {}, {isThin ? 0.0 : -0.2, 0});
        BodyDef upright = dynamicAt({0.05, 0});
        upright.angle = 1.5707963267948966;
        rest.body = addBody(rest.world, upright, capsule(0.3, 0.1), material(0));
        BodyDef pressing = dynamicAt({0.4, 0});
        pressing.fixedRotation = true;
        const BodyId press = addBody(rest.world, pressing, box(0.3, 0.3), material(0));
        const double start = rest.world.position(rest.body).x;
        for (int i = 0; i < 200; ++i) {
            must(rest.world.setVelocity(rest.body, rest.world.velocity(rest.body), i % 2 == 0 ? -5 : 5));
            must(rest.world.applyForce(press, vec(-100, 0), rest.world.position(press)));
            must(rest.world.step(0.05));
        }
        EXPECT_GT(rest.world.position(rest.body).x, start - 1e-5) << (isThin ? "thin" : "thick");
    }
}

/// A rod between a box and the wall of a wedge, both bullets, and something kinematic that comes after them: it is
/// deep in the rod, and must not set it out on the other side of the wall.
TEST(Pressed, BulletsIntoTheWallOfAWedge) {
    const std::array<Vec2, 3> wedge{vec(5, 1.32241369), vec(5, -1.32241369), vec(-5, 0)};
    for (const Profile profile : {Profile::fast, Profile::accurate}) {
        for (const bool isChain : {true, false}) {
            WorldSettings settings;
            settings.profile = profile;
            World world = makeWorld(settings);
            const BodyId walls = must(world.createBody({}));
            if (isChain) { must(world.addChain(walls, wedge, true)); }
            for (std::size_t i = 0; i < 3 && !isChain; ++i) {
                must(world.addShape(walls, must(makeSegment(wedge[i], wedge[(i + 1) % 3]))));
            }
            BodyDef thin = dynamicAt({4.5910026707065539, -0.18146804141025452});
            thin.angle = 5.9769211183306865;
            thin.bullet = true;
            const Vec2 end = vec(0.266023219, -0.163694546);
            const BodyId rod =
                addBody(world, thin, must(makeCapsule(-end, end, real(0.00624705572))), material(0.265865266));
            BodyDef thick = dynamicAt({3.8414477515539955, -0.18826673213512368});
            thick.angle = 3.1747451030095855;
            thick.bullet = true;
            const std::array<Vec2, 4> corners{vec(0.423305839, -0.427226871), vec(0.308287054, 0.516400754),
                                              vec(-0.423305839, 0.427226871), vec(-0.308287054, -0.516400754)};
            const std::array<Vec2, 4> handle{vec(-0.051622171, 0.0298513938), vec(-0.512510836, 0.295026094),
                                             vec(-0.528000176, 0.268104732), vec(-0.067111522, 0.00293003116)};
            const BodyId crate = addBody(world, thick, must(makePolygon(corners)), material(0.942205071, 0.0592946969));
            must(world.addShape(crate, must(makePolygon(handle)), material(0.942205071, 0.0592946969)));
            BodyDef pusher = bodyAt(BodyType::kinematic, {2.4296058980158923, -0.20993957674218366}, 2.376680016979158);
            pusher.velocity = vec(5.00283337, 0.0321088731);
            pusher.angularVelocity = real(3.67047715);
            const std::array<Vec2, 4> square{vec(0.732707739, -0.0163122136), vec(0.0227534212, 0.732536018),
                                             vec(-0.732849717, -0.00761638395), vec(0.0105173998, -0.732813835)};
            addBody(world, pusher, must(makePolygon(square, real(0.0732889324))), material(0.6));
            for (int step = 0; step < 90; ++step) {
                run(world, 1);
                ASSERT_LT(world.position(rod).x, 5) << "step " << step << (isChain ? ", chain" : ", segments");
                ASSERT_LT(world.position(crate).x, 5) << "step " << step;
            }
        }
    }
}

/// A plank that is sunk into a steep wall with one end, which turns out of it, while the other one turns into it: its
/// turn was left out of each step, but not taken from it, and it hung there for ever.
TEST(Pressed, WhatTurnsIntoAWallComesOutOfItAndSlidesDown) {
    constexpr double kSlope = 2.5;
    constexpr double kTilt = -4.742;
    for (const Profile profile : {Profile::accurate, Profile::fast}) {
        for (const bool isBox : {false, true}) {
            for (const double depth : {0.002, 0.0035, 0.005, 0.006256, 0.008}) {
                for (const double rate : {30.0, 60.0, 240.0}) {
                    WorldSettings settings = awakeSettings(9.81);
                    settings.profile = profile;
                    World world = makeWorld(settings);
                    const Polygon wall = isBox ? must(makeBox(vec(0.1, 50), vec(-4.1, 0))) : segment(-4, -50, -4, 50);
                    addStatic(world, wall, {}, {}, kSlope);
                    const double out = 0.0125 * std::fabs(std::sin(kTilt)) + 0.316 * std::fabs(std::cos(kTilt)) - depth;
                    BodyDef def = dynamicAt(turned({-4 + out, 0}, kSlope), vec(0.5234, -0.1829), 2.2919);
                    def.angle = kSlope + kTilt;
                    const BodyId plank = addBody(world, def, box(0.316, 0.0125));
                    const double before = world.position(plank).y;
                    runFor(world, 3, 1 / rate);
                    EXPECT_LT(world.position(plank).y, before - 3)
                        << "depth " << depth << ", " << rate << " Hz" << (isBox ? ", box" : ", segment");
                }
            }
        }
    }
}

/// Rods that are put between bodies in flight, and jam between them and the walls.
TEST(Pressed, ByRodsInAClosedChamber) {
    constexpr double kHalf = 10;
    constexpr double kSlowStep = 1.0 / 30;
    for (std::uint64_t seed = 1; seed <= 40; ++seed) {
        WorldSettings settings = awakeSettings(seed % 2 == 0 ? 0 : kGravity);
        settings.profile = seed % 3 == 0 ? Profile::fast : Profile::accurate;
        World world = makeWorld(settings);
        for (const double side : {-kHalf, kHalf}) {
            addStatic(world, segment(side, -kHalf, side, kHalf));
            addStatic(world, segment(-kHalf, side, kHalf, side));
        }
        Random random(seed);
        const std::vector<BodyId> bodies = throwCrowd(world, random, 24, [](int, BodyDef&, ShapeDef&) {});
        for (int step = 0; step < 150; ++step) {
            if (step % 4 == 0) {
                const std::size_t first = static_cast<std::size_t>(random.range(0, 23.9));
                DistanceJointDef rod;
                rod.base = between(bodies[first], bodies[(first + 1) % bodies.size()]);
                rod.anchorA = world.position(rod.base.bodyA);
                rod.anchorB = world.position(rod.base.bodyB);
                must(world.createJoint(rod));
            }
            run(world, 1, kSlowStep);
            ASSERT_TRUE(areInside(world, bodies, kHalf)) << "seed " << seed << ", step " << step;
        }
    }
}

}  // namespace
}  // namespace swept::test
