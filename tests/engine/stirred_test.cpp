#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "../support/random.h"
#include "../support/some_of.h"
#include "world_support.h"

/// What something heavy and fast runs into is thrown at its neighbours within the same step, and meets them there: in
/// `accurate`, contacts know of them before.

namespace swept::test {
namespace {

/// Deepest overlap of any two shapes, metres, in so many steps.
double deepestIn(World& world, int steps) {
    double deepest = 0;
    for (int i = 0; i < steps; ++i) {
        run(world, 1);
        world.visitContacts(
            [&](const ContactView& contact) { deepest = std::max(deepest, -static_cast<double>(contact.separation)); });
    }
    return deepest;
}

/// A tub of loose balls, in rows of ten.
void addTub(World& world, int balls) {
    addStatic(world, box(100, 1), material(0.6), {0, -1});
    for (const double x : {-3.5, 3.5}) { addStatic(world, box(0.5, 20), material(0.6), {x, 20}); }
    for (int i = 0; i < balls; ++i) {
        addBody(world, dynamicAt({i % 10 * 0.6 - 2.7, 0.3 + 0.6 * (i / 10)}), circle(0.28), material(0.6));
    }
    run(world, 200);
}

std::string stirredCase(double ratio, double value) { return std::to_string(ratio) + " : 1, " + std::to_string(value); }

/// (0.21 to 0.47 m deep, of 0.56, before contacts knew of it.)
TEST(Stirred, HeavyBallsThrowLightOnesIntoNoOther) {
    for (const double height : {3.0, 6.0}) {
        for (const int balls : {20, 40}) {
            World world = makeWorld(Profile::accurate);
            addTub(world, balls);
            addBody(world, dynamicAt({0, 0.06 * balls + 1 + height}), circle(1), material(0.6, 0, 300 * 0.28 * 0.28));
            expectAtMost(std::to_string(balls) + " balls, " + stirredCase(300, height), deepestIn(world, 200), 0.15);
        }
    }
}

/// (0.19 to 0.44 m.) The car stands on the ground: its boxes do not reach ahead.
TEST(Stirred, CarsThrowCratesIntoNoOther) {
    for (const double ratio : {10.0, 100.0}) {
        for (const double speed : {20.0, 30.0}) {
            World world = makeWorld(Profile::accurate);
            addStatic(world, box(100, 1), material(0.6), {0, -1});
            for (int row = 0; row < 5; ++row) {
                for (int i = 0; i < 5 - row; ++i) {
                    addBody(world, dynamicAt({4 + 1.1 * i + 0.55 * row, 0.5 + row}), box(0.5, 0.5), material(0.6));
                }
            }
            run(world, 60);
            BodyDef car = dynamicAt({-4, 0.8});
            car.velocity = vec(speed, 0);
            addBody(world, car, box(2, 0.75), material(0.1, 0, ratio / 6));
            expectAtMost(stirredCase(ratio, speed), deepestIn(world, 240), 0.05);
        }
    }
}

/// The wall is held in balance until it is struck. (0.11 and 0.18 m.)
TEST(Stirred, WreckingBallsThrowBricksIntoNoOther) {
    for (const double ratio : {10.0, 100.0}) {
        World world = makeWorld(Profile::accurate);
        addStatic(world, box(100, 1), material(0.6), {0, -1});
        for (int row = 0; row < 8; ++row) {
            for (int i = 0; i < 6; ++i) {
                const DVec2 place{i * 1.01 + row % 2 * 0.25, 0.25 + 0.5 * row};
                addBody(world, dynamicAt(place), box(0.5, 0.25), material(0.6, 0, 2));
            }
        }
        run(world, 60);
        BodyDef ball = dynamicAt({-4, 2});
        ball.velocity = vec(10, 0);
        addBody(world, ball, circle(1), material(0.6, 0, ratio / kPi));
        expectAtMost(stirredCase(ratio, 10), deepestIn(world, 240), 0.08);
    }
}

/// A copy goes on like the original in the midst of it, and so does one that changes to the other profile.
TEST(Stirred, CopiesGoOnAlike) {
    for (const Profile profile : kProfiles) {
        World world = makeWorld(Profile::accurate);
        addTub(world, 20);
        const BodyId ball = addBody(world, dynamicAt({0, 4}), circle(1), material(0.6, 0, 300 * 0.28 * 0.28));
        run(world, 35);
        World copy = world;
        for (World* each : {&world, &copy}) {
            must(each->configure(awakeSettings(profile)));
            run(*each, 60);
        }
        EXPECT_EQ(world.position(ball), copy.position(ball));
        EXPECT_EQ(world.velocity(ball), copy.velocity(ball));
        EXPECT_LT(world.position(ball).y, 3);
    }
}

/// A crowd of all masses, some of it fast.
World crowd(std::uint64_t seed, BroadphaseKind kind) {
    WorldSettings settings = awakeSettings(Profile::accurate);
    settings.broadphase = kind;
    World world = makeWorld(settings);
    addStatic(world, box(50, 1), material(0.6), {0, -1});
    Random random(seed);
    for (int i = 0; i < 120; ++i) {
        BodyDef def = dynamicAt({random.range(-8, 8), random.range(0.5, 9)});
        const double pace = random.chance(0.6) ? 0.05 : 1;
        const double x = pace * random.range(-25, 25);
        def.velocity = vec(x, pace * random.range(-15, 15));
        def.mass = real(std::exp(random.range(-1, 6)));
        addBody(world, def, circle(random.range(0.15, 0.4)), material(0.6));
    }
    return world;
}

/// Whom a striker comes to is told in an order that is the broadphase's own: it does not matter.
TEST(Stirred, IsTheSameToTheBitWithEveryBroadphase) {
    for (std::uint64_t seed = 0; seed < someOf(std::uint64_t{30}); ++seed) {
        World usual = crowd(seed, BroadphaseKind::automatic);
        std::vector<std::uint64_t> hashes;
        for (int i = 0; i < 60; ++i) {
            run(usual, 1);
            hashes.push_back(usual.stateHash());
        }
        for (const BroadphaseKind kind : {BroadphaseKind::allPairs, BroadphaseKind::sortAndSweep,
                                          BroadphaseKind::quadtree, BroadphaseKind::grid, BroadphaseKind::bvh}) {
            World world = crowd(seed, kind);
            for (std::size_t i = 0; i < hashes.size(); ++i) {
                run(world, 1);
                ASSERT_EQ(world.stateHash(), hashes[i])
                    << "seed " << seed << " kind " << static_cast<int>(kind) << " step " << i;
            }
        }
    }
}

}  // namespace
}  // namespace swept::test
