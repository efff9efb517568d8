#include <string>

#include <swept/samples/builtin_scenes.h>
#include <swept/samples/world_builder.h>

#include "../support/random.h"
#include "../support/thread_tasks.h"
#include "world_digest.h"
#include "world_support.h"

/// The same bits whoever does the work: one thread or several, in whatever chunks.

namespace swept::test {
namespace {

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

TEST(Parallel, BuiltinScenes) {
    for (const BuiltinScene& entry : builtinScenes()) {
        const SceneDescription scene = entry.make();
        for (const int workers : {2, 4}) {
            ThreadTasks tasks(workers);
            SceneWorld serial;
            SceneWorld parallel;
            std::string error;
            ASSERT_TRUE(buildWorld(scene, serial, error) && buildWorld(scene, parallel, error)) << error;
            parallel.world.setTaskSystem(&tasks);
            expectSameSteps(serial.world, parallel.world, {serial.bodies, {}, serial.joints}, 30, entry.name);
        }
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
            known.bodies.push_back(addBody(world, dynamicAt({-10 + 1.01 * (i % 20), 1.5 + 1.01 * (i / 20)}), box(0.5, 0.5)));
        }
        for (int i = 0; i < 60; ++i) {
            const BodyDef def = dynamicAt({random.range(15, 35), random.range(2, 30)},
                                          vec(random.range(-90, 90), random.range(-90, 90)), random.range(-20, 20));
            known.bodies.push_back(addBody(world, def, i % 2 == 0 ? circle(0.2) : box(0.3, 0.1), material(0.3, 0.9)));
        }
    }
};

TEST(Parallel, Crowd) {
    for (const int workers : {2, 3, 8}) {
        Crowd serial;
        Crowd parallel;
        ThreadTasks tasks(workers);
        parallel.world.setTaskSystem(&tasks);
        expectSameSteps(serial.world, parallel.world, serial.known, 60, "crowd");
        EXPECT_GT(tasks.chunksOfOthers(), 0u) << "nobody helped";
        parallel.world.setTaskSystem(nullptr);
        expectSameSteps(serial.world, parallel.world, serial.known, 5, "crowd, back on one thread");
    }
}

TEST(Parallel, EveryMode) {
    for (const ContinuousMode mode : {ContinuousMode::off, ContinuousMode::speedLimit, ContinuousMode::speculative,
                                      ContinuousMode::stop}) {
        Crowd serial(mode);
        Crowd parallel(mode);
        ThreadTasks tasks(3);
        parallel.world.setTaskSystem(&tasks);
        expectSameSteps(serial.world, parallel.world, serial.known, 30, "mode " + std::to_string(static_cast<int>(mode)));
    }
}

}  // namespace
}  // namespace swept::test
