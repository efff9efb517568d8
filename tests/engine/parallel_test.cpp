#include <string>

#include <swept/samples/built_in/builtin_scenes.h>
#include <swept/samples/world_builder.h>

#include "../support/random.h"
#include "any_order_tasks.h"
#include "mixed_scene.h"
#include "moved_limits.h"
#include "world_digest.h"
#include "world_support.h"

/// The same bits whoever does the work: one thread or several, in whatever chunks and whatever order. More of it in the
/// long run (SWEPT_LONG).

namespace swept::test {
namespace {

#ifdef SWEPT_LONG
constexpr bool kIsLong = true;
constexpr int kSceneSteps = 150;
constexpr int kMixedSteps = 240;
constexpr int kCrowdSteps = 120;
#else
constexpr bool kIsLong = false;
constexpr int kSceneSteps = 20;
constexpr int kMixedSteps = 20;
constexpr int kCrowdSteps = 24;
#endif

void expectSameSteps(World& serial, World& parallel, const KnownIds& known, int steps, const std::string& name) {
    for (int step = 0; step < steps; ++step) {
        must(serial.step(kStep));
        must(parallel.step(kStep));
        ASSERT_EQ(digestOf(serial, known), digestOf(parallel, known)) << name << ", step " << step;
        ASSERT_EQ(serial.counters().toiIterations, parallel.counters().toiIterations) << name;
        ASSERT_EQ(serial.lostTime().size(), parallel.lostTime().size()) << name;
        ASSERT_EQ(serial.impactPoses().size(), parallel.impactPoses().size()) << name;
    }
}

/// One world on the calling thread, and the same on each task system, all step by step.
void expectSameOnAll(const SceneDescription& scene, const std::vector<TaskSystem*>& systems, int steps) {
    SceneWorld serial;
    std::vector<SceneWorld> others(systems.size());
    std::string error;
    ASSERT_TRUE(buildWorld(scene, serial, error)) << error;
    for (std::size_t i = 0; i < others.size(); ++i) {
        ASSERT_TRUE(buildWorld(scene, others[i], error)) << error;
        others[i].world.setTaskSystem(systems[i]);
    }
    const KnownIds known{serial.bodies, {}, serial.joints};
    for (int step = 0; step < steps; ++step) {
        must(serial.world.step(kStep));
        const std::uint64_t wanted = digestOf(serial.world, known);
        for (std::size_t i = 0; i < others.size(); ++i) {
            must(others[i].world.step(kStep));
            ASSERT_EQ(digestOf(others[i].world, known), wanted) << scene.name << ", step " << step << ", system " << i;
            ASSERT_EQ(others[i].world.counters().toiIterations, serial.world.counters().toiIterations) << scene.name;
        }
    }
}

TEST(Parallel, BuiltinScenes) {
    Crowds crowds;
    for (const BuiltinScene& entry : builtinScenes()) {
        expectSameOnAll(entry.make(), {&crowds.two, &crowds.shuffled}, kSceneSteps);
        if (kIsLong) { expectSameOnAll(entry.make(), crowds.all, kSceneSteps); }
    }
}

TEST(Parallel, ScenesWithErrorBudgets) {
    Crowds crowds;
    for (const BuiltinScene& entry : builtinScenes()) {
        SceneDescription scene = entry.make();
        scene.settings.maxPenetration = 1e-4;
        scene.settings.maxJointError = 1e-4;
        scene.settings.maxLostTime = 0;
        expectSameOnAll(scene, {&crowds.three}, kSceneSteps);
    }
}

TEST(Parallel, AllKindsOfThings) {
    Crowds crowds;
    const SceneDescription scene = scenes::mixedScene();
    SceneWorld watched;
    std::string error;
    ASSERT_TRUE(buildWorld(scene, watched, error)) << error;
    StepCounters sums;
    for (int step = 0; step < kMixedSteps; ++step) {
        must(watched.world.step(kStep));
        sums.flyers += watched.world.counters().flyers;
        sums.impacts += watched.world.counters().impacts;
        sums.wokeUp += watched.world.counters().wokeUp;
        sums.fellAsleep += watched.world.counters().fellAsleep;
    }
    EXPECT_GT(sums.flyers, 200U);
    EXPECT_GE(sums.impacts, 10U);  // 20 or so in either precision, nearly all at the beginning of the run
    EXPECT_GT(sums.wokeUp, 0U);
    for (const SceneProfile profile : {SceneProfile::accurate, SceneProfile::fast}) {
        SceneDescription again = scene;
        again.settings.profile = profile;
        expectSameOnAll(again, crowds.all, kMixedSteps);
    }
}

/// Hundreds of contacts and dozens of flyers at once.
struct Crowd {
    World world;
    KnownIds known;
    explicit Crowd(ContinuousMode mode = ContinuousMode::subStep) {
        WorldSettings settings = awakeSettings();
        settings.continuous = mode;
        world = makeWorld(settings);
        known.bodies.push_back(addStatic(world, box(40, 1), material(0.5, 0.5)));
        addStatic(world, box(1, 40), material(0.2, 1), {-40, 0});
        addStatic(world, box(1, 40), material(0.2, 1), {40, 0});
        Random random(21);
        for (int i = 0; i < 150; ++i) {
            known.bodies.push_back(
                addBody(world, dynamicAt({-10 + 1.01 * (i % 20), 1.5 + 1.01 * (i / 20)}), box(0.5, 0.5)));
        }
        for (int i = 0; i < 60; ++i) {
            const BodyDef def = dynamicAt({random.range(15, 35), random.range(2, 30)},
                                          vec(random.range(-90, 90), random.range(-90, 90)), random.range(-20, 20));
            known.bodies.push_back(addBody(world, def, i % 2 == 0 ? circle(0.2) : box(0.3, 0.1), material(0.3, 0.9)));
        }
    }
};

TEST(Parallel, Crowd) {
    for (const int workers : {2, 8}) {
        Crowd serial;
        Crowd parallel;
        ThreadTasks tasks(workers);
        parallel.world.setTaskSystem(&tasks);
        expectSameSteps(serial.world, parallel.world, serial.known, kCrowdSteps, "crowd");
        EXPECT_GT(tasks.chunksOfOthers(), 0u) << "nobody helped";
        parallel.world.setTaskSystem(nullptr);
        expectSameSteps(serial.world, parallel.world, serial.known, 5, "crowd, back on one thread");
    }
}

TEST(Parallel, AnyOrderOfTheSameWork) {
    for (const ContinuousMode mode : {ContinuousMode::subStep, ContinuousMode::stop}) {
        Crowd serial(mode);
        Crowd shuffled(mode);
        ShuffledTasks tasks;
        shuffled.world.setTaskSystem(&tasks);
        expectSameSteps(serial.world, shuffled.world, serial.known, kCrowdSteps,
                        "mode " + std::to_string(static_cast<int>(mode)));
        EXPECT_GT(serial.world.counters().flyers, 10U) << "too few to prove anything";
    }
}

/// A block that flies at a floor, its bodies beside each other as fast as each other: what passes, and is hemmed in,
/// was told from how far apart shapes were known to be, which depends on what they were asked for together with.
World fallingBlock(std::uint64_t seed) {
    constexpr int kColumns = 14;
    constexpr int kRows = 10;
    Random random(seed);
    World world = makeWorld();
    addStatic(world, box(40, 1), {}, {0, -1});
    const double gap = random.range(0, 0.12);
    for (int i = 0; i < kColumns * kRows; ++i) {
        const DVec2 place{(i % kColumns) * (1 + gap), 1 + (i / kColumns) * (1 + gap)};
        BodyDef def = dynamicAt(place, vec(random.range(-2, 2), -25 + random.range(-2, 2)), random.range(-3, 3));
        def.angle = random.range(-0.1, 0.1);
        addBody(world, def, i % 3 == 0 ? capsule(0.3, 0.2) : box(0.5, 0.5));
    }
    return world;
}

TEST(Parallel, LimitsThatMove) {
    for (const Profile profile : {Profile::accurate, Profile::fast}) {
        MovedLimits serial(profile);
        MovedLimits shuffled(profile);
        ShuffledTasks tasks;
        shuffled.world.setTaskSystem(&tasks);
        for (int step = 0; step < 30; ++step) {
            serial.step();
            shuffled.step();
            ASSERT_EQ(serial.world.stateHash(), shuffled.world.stateHash()) << "step " << step;
        }
    }
}

TEST(Parallel, WhatIsHemmedIn) {
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        World serial = fallingBlock(seed);
        World shuffled = fallingBlock(seed);
        ShuffledTasks tasks;
        shuffled.setTaskSystem(&tasks);
        for (int step = 0; step < 10; ++step) {
            must(serial.step(kStep));
            must(shuffled.step(kStep));
            ASSERT_EQ(serial.counters().touching, shuffled.counters().touching) << "seed " << seed << ", step " << step;
        }
    }
}

/// Balls that jump through a platform from below: where they were before is asked for while others forget it.
World jumpingBalls() {
    constexpr int kBalls = 200;
    World world = makeWorld();
    addStatic(world, box(2000, 0.5), {}, {0, -0.5});
    std::vector<Vec2> platform;
    for (int i = 0; i <= kBalls; ++i) { platform.push_back(vec(2 * kBalls - 4 * i, 3)); }
    must(world.addChain(must(world.createBody({})), platform, false));
    for (int i = 0; i < kBalls; ++i) {
        const DVec2 place{-2.0 * kBalls + 4 * i + 2 + 0.3 * std::sin(i), 0.5 + 0.01 * (i % 7)};
        addBody(world, dynamicAt(place, vec(0, 9 + 0.05 * (i % 20))), circle(0.4));
    }
    return world;
}

TEST(Parallel, WhatComesThroughAPlatform) {
    World serial = jumpingBalls();
    ShuffledTasks shuffledTasks;
    BackwardTasks backwardTasks;
    World shuffled = serial;
    World backward = serial;
    shuffled.setTaskSystem(&shuffledTasks);
    backward.setTaskSystem(&backwardTasks);
    for (int step = 0; step < 60; ++step) {
        for (World* const world : {&serial, &shuffled, &backward}) { must(world->step(kStep)); }
        ASSERT_EQ(serial.stateHash(), shuffled.stateHash()) << "step " << step;
        ASSERT_EQ(serial.stateHash(), backward.stateHash()) << "step " << step;
    }
    int through = 0;
    serial.visitBodies([&](BodyId body) { through += serial.position(body).y > 3 ? 1 : 0; });
    EXPECT_EQ(through, 200);
}

/// A room of flyers that do not see each other, made in one order or in the other.
struct Room {
    World world;
    std::vector<BodyId> flyers;

    explicit Room(bool backwards) : world(makeWorld(0)), flyers(40) {
        for (int side = 0; side < 4; ++side) {
            const double turn = side * kPi / 2;
            addStatic(world, segment(0, -5, 0, 5), material(0.3, 1), turned({5, 0}, turn), turn);
        }
        ShapeDef surface = material(0.3, 1);
        surface.filter.group = -1;
        for (std::size_t i = 0; i < flyers.size(); ++i) {
            const std::size_t which = backwards ? flyers.size() - 1 - i : i;
            Random random(which);
            const double aim = random.range(0, 2 * kPi);
            const double speed = random.range(50, 300);
            const BodyDef def = dynamicAt({random.range(-4, 4), random.range(-4, 4)},
                                          vec(speed * std::cos(aim), speed * std::sin(aim)), random.range(-50, 50));
            flyers[which] = addBody(world, def, which % 2 == 0 ? circle(0.2) : box(0.3, 0.05), surface);
        }
    }
};

TEST(Parallel, FlyersDoNotCareWhoWasMadeFirst) {
    Room forwards(false);
    Room backwards(true);
    std::uint64_t impacts = 0;
    for (int step = 0; step < 60; ++step) {
        must(forwards.world.step(kStep));
        must(backwards.world.step(kStep));
        ASSERT_EQ(forwards.world.counters().flyers, forwards.flyers.size());
        impacts += forwards.world.counters().impacts;
        for (std::size_t i = 0; i < forwards.flyers.size(); ++i) {
            const BodyId a = forwards.flyers[i];
            const BodyId b = backwards.flyers[i];
            ASSERT_EQ(forwards.world.position(a), backwards.world.position(b)) << "step " << step << ", flyer " << i;
            ASSERT_EQ(forwards.world.angle(a), backwards.world.angle(b)) << "step " << step << ", flyer " << i;
            ASSERT_EQ(forwards.world.velocity(a), backwards.world.velocity(b)) << "step " << step << ", flyer " << i;
        }
    }
    EXPECT_GT(impacts, 500U);
}

/// Flails that are thrown about a room, each an island that advances by itself from impact to impact.
struct Flails {
    World world;
    KnownIds known;
    explicit Flails(Profile profile) {
        WorldSettings settings = awakeSettings(profile);
        world = makeWorld(settings);
        for (int side = 0; side < 4; ++side) {
            const double turn = side * kPi / 2;
            addStatic(world, segment(0, -20, 0, 20), material(0.3, 0.2), turned({20, 0}, turn), turn);
        }
        Random random(77);
        for (int i = 0; i < 24; ++i) {
            const DVec2 place{6.0 * (i % 6) - 15, 6.0 * (i / 6) - 9};
            const Vec2 velocity = vec(random.range(-90, 90), random.range(-90, 90));
            for (int link = 0; link < 3; ++link) {
                const DVec2 center = place + DVec2{0.8 * link, 0};
                known.bodies.push_back(addBody(world, dynamicAt(center, velocity, random.range(-9, 9)), box(0.4, 0.1)));
                if (link == 0) { continue; }
                RevoluteJointDef hinge;
                hinge.base.bodyA = known.bodies[known.bodies.size() - 2];
                hinge.base.bodyB = known.bodies.back();
                hinge.anchor = center - DVec2{0.4, 0};
                known.joints.push_back(must(world.createJoint(hinge)));
            }
        }
    }
};

TEST(Parallel, IslandsThatAdvanceByThemselves) {
    for (const Profile profile : {Profile::accurate, Profile::fast}) {
        Flails serial(profile);
        Flails parallel(profile);
        Flails shuffled(profile);
        ThreadTasks tasks(3);
        ShuffledTasks others;
        parallel.world.setTaskSystem(&tasks);
        shuffled.world.setTaskSystem(&others);
        std::uint64_t most = 0;
        for (int step = 0; step < kCrowdSteps; ++step) {
            must(serial.world.step(kStep));
            must(parallel.world.step(kStep));
            must(shuffled.world.step(kStep));
            const std::uint64_t wanted = digestOf(serial.world, serial.known);
            ASSERT_EQ(digestOf(parallel.world, parallel.known), wanted) << "step " << step;
            ASSERT_EQ(digestOf(shuffled.world, shuffled.known), wanted) << "step " << step;
            const StepCounters& counters = serial.world.counters();
            for (const World* world : {&parallel.world, &shuffled.world}) {
                ASSERT_EQ(world->counters().bodySubSteps, counters.bodySubSteps) << "step " << step;
                ASSERT_EQ(world->counters().sweeps, counters.sweeps) << "step " << step;
                ASSERT_EQ(world->counters().constraints, counters.constraints) << "step " << step;
            }
            most = std::max(most, counters.effortClasses);
        }
        EXPECT_GT(most, 12U) << "too few islands advanced to prove anything";
    }
}

TEST(Parallel, EveryMode) {
    for (const ContinuousMode mode :
         {ContinuousMode::off, ContinuousMode::speedLimit, ContinuousMode::speculative, ContinuousMode::stop}) {
        Crowd serial(mode);
        Crowd parallel(mode);
        ThreadTasks tasks(3);
        parallel.world.setTaskSystem(&tasks);
        expectSameSteps(serial.world, parallel.world, serial.known, kCrowdSteps / 2,
                        "mode " + std::to_string(static_cast<int>(mode)));
    }
}

}  // namespace
}  // namespace swept::test
