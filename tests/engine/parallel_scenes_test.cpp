#include <cmath>
#include <vector>

#include "../support/random.h"
#include "any_order_tasks.h"
#include "world_digest.h"
#include "world_support.h"

/// The same bits on all task systems: of scenes whose contacts are solved one by one, or met in flight.

namespace swept::test {
namespace {

/// Copies of a scene, each on a task system of its own, step to the bits of the original.
/// @param afterStep  called with the original
template <class Scene, class AfterStep>
void expectSameOnAll(Scene& serial, int steps, const AfterStep& afterStep) {
    Crowds crowds;
    std::vector<Scene> others(crowds.all.size(), serial);
    for (std::size_t i = 0; i < others.size(); ++i) { others[i].world.setTaskSystem(crowds.all[i]); }
    for (int step = 0; step < steps; ++step) {
        must(serial.world.step(kStep));
        afterStep(serial.world);
        const std::uint64_t wanted = digestOf(serial.world, serial.known);
        for (std::size_t i = 0; i < others.size(); ++i) {
            must(others[i].world.step(kStep));
            ASSERT_EQ(digestOf(others[i].world, serial.known), wanted) << "step " << step << ", system " << i;
        }
    }
}

/// Disks that roll down slopes and off each other, each contact solved on its own.
struct RollingCrowd {
    World world;
    KnownIds known;
    explicit RollingCrowd(Profile profile) {
        WorldSettings settings = awakeSettings(profile);
        world = makeWorld(settings);
        for (const double side : {-1.0, 1.0}) {
            addStatic(world, box(30, 1), material(0.8), {side * 20, 5}, side * 0.25);
        }
        Random random(5);
        for (int i = 0; i < 160; ++i) {
            ShapeDef surface = material(0.6);
            surface.rollingResistance = real(random.range(0, 0.3));
            const DVec2 place{-12 + 1.3 * (i % 20), 9 + 1.3 * (i / 20)};
            known.bodies.push_back(
                addBody(world, dynamicAt(place, vec(random.range(-3, 3), 0)), circle(random.range(0.3, 0.6)), surface));
        }
    }
};

TEST(ParallelScenes, WhatResistsRolling) {
    for (const Profile profile : {Profile::accurate, Profile::fast}) {
        RollingCrowd crowd(profile);
        run(crowd.world, 60);
        expectSameOnAll(crowd, 30, [](const World&) {});
        EXPECT_GT(crowd.world.counters().touching, 150u);
    }
}

/// Rafts of flush planks fall onto the ground, fast, in many islands that advance side by side.
struct FallingRafts {
    World world;
    KnownIds known;

    explicit FallingRafts(Profile profile) : world(makeWorld(awakeSettings(profile))) {
        addStatic(world, box(200, 0.5), material(0.4), {0, -0.5});
        Random random(3);
        for (int i = 0; i < 40; ++i) {
            const DVec2 place{6.0 * (i / 2) - 60, 1 + 2.0 * (i % 2)};
            BodyDef def = dynamicAt(place, vec(random.range(-5, 5), -random.range(20, 60)));
            def.angle = random.range(-0.3, 0.3);
            known.bodies.push_back(must(world.createBody(def)));
            for (int k = 0; k < 6; ++k) {
                must(world.addShape(known.bodies.back(), must(makeBox(vec(0.4, 0.2), vec(0.8 * k - 2, 0))),
                                    material(0.4)));
            }
        }
    }
};

TEST(ParallelScenes, FallingRafts) {
    for (const Profile profile : {Profile::accurate, Profile::fast}) {
        FallingRafts rafts(profile);
        std::uint64_t impacts = 0;
        expectSameOnAll(rafts, 40, [&impacts](const World& world) { impacts += world.counters().impacts; });
        EXPECT_GT(impacts, 40u);
    }
}

/// Bullets among crates, some of which are fast, some slow and some asleep, in a room of walls that bounce.
struct ShootOut {
    World world;
    KnownIds known;

    explicit ShootOut(Profile profile) : world(makeWorld(0)) {
        WorldSettings settings = world.settings();
        settings.profile = profile;
        must(world.configure(settings));
        constexpr double kHalf = 12;
        for (int side = 0; side < 4; ++side) {
            const double turn = side * kPi / 2;
            addStatic(world, segment(0, -kHalf, 0, kHalf), material(0.3, 1), turned({kHalf, 0}, turn), turn);
        }
        Random random(8);
        const auto place = [&] {
            return DVec2{random.range(-kHalf + 1, kHalf - 1), random.range(-kHalf + 1, kHalf - 1)};
        };
        for (int i = 0; i < 60; ++i) {
            const double speed = i % 3 == 0 ? 0 : i % 3 == 1 ? 1 : 60;
            known.bodies.push_back(
                addBody(world, dynamicAt(place(), vec(speed, 0)), box(0.3, 0.3), material(0.3, 0.5)));
        }
        ShapeDef surface = material(0.1, 1);
        for (int i = 0; i < 120; ++i) {
            const double aim = random.range(0, 2 * kPi);
            const double speed = random.range(20, 200);
            BodyDef def = dynamicAt(place(), vec(speed * std::cos(aim), speed * std::sin(aim)), random.range(-50, 50));
            def.bullet = true;
            surface.filter.group = i % 2 == 0 ? -1 : 0;
            known.bodies.push_back(addBody(world, def, i % 4 == 0 ? box(0.1, 0.05) : circle(0.06), surface));
        }
    }
};

TEST(ParallelScenes, BulletsAmongCrates) {
    for (const Profile profile : {Profile::accurate, Profile::fast}) {
        ShootOut crates(profile);
        std::uint64_t impacts = 0;
        expectSameOnAll(crates, 60, [&impacts](const World& world) { impacts += world.counters().impacts; });
        EXPECT_GT(impacts, 1000U);
    }
}

}  // namespace
}  // namespace swept::test
