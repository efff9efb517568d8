#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include <swept/samples/world_builder.h>

#include "../support/some_of.h"
#include "all_scenes.h"
#include "any_order_tasks.h"
#include "falling_heap.h"
#include "mixed_scene.h"
#include "vandal.h"
#include "world_support.h"

/// A world that was saved and loaded goes on with the bits of the original, whatever it is of: what is seen of it, and
/// all that it would save again.

namespace swept::test {
namespace {

using Bytes = std::vector<std::uint8_t>;

World loaded(const Bytes& bytes) {
    World world;
    must(world.load(bytes));
    return world;
}

/// How often the lists of steps had something in them.
struct Told {
    int events = 0;
    int breaks = 0;
    int lostTime = 0;
    int poses = 0;
    int moved = 0;
};

/// All that a world tells of its last step.
std::uint64_t reportOf(const World& world, Told& told) {
    Digest digest;
    for (const ContactEvent& event : world.contactEvents()) {
        digest.add(event.point);
        digest.add(event.normal);
        digest.add(static_cast<double>(event.approachSpeed));
        digest.add(static_cast<double>(event.impulse));
        for (const std::uint64_t data : {event.userDataA, event.userDataB, event.bodyUserDataA, event.bodyUserDataB}) {
            digest.add(data);
        }
        ++told.events;
    }
    for (const JointBreakEvent& event : world.jointBreaks()) {
        digest.add(event.bodyA);
        digest.add(event.force);
        digest.add(event.torque);
        ++told.breaks;
    }
    for (const LostTimeEntry& entry : world.lostTime()) {
        digest.add(entry.body);
        digest.add(entry.seconds);
        digest.add(static_cast<std::uint64_t>(entry.reason));
        ++told.lostTime;
    }
    for (const ImpactPose& pose : world.impactPoses()) {
        digest.add(pose.body);
        digest.add(pose.position);
        digest.add(pose.fraction);
        ++told.poses;
    }
    for (const BodyId id : world.bodiesPutBack()) { digest.add(id); }
    world.visitMoved([&](BodyId id) {
        digest.add(id);
        ++told.moved;
    });
    std::array<std::uint64_t, sizeof(StepCounters) / sizeof(std::uint64_t)> counters{};
    std::memcpy(counters.data(), &world.counters(), sizeof counters);
    for (const std::uint64_t counter : counters) { digest.add(counter); }
    return digest.sum();
}

/// Both are alike, take the same steps, and are told apart by nothing.
void expectToGoOnAlike(World& original, World& other, const KnownIds& known, int steps, Told& told) {
    for (int step = 0; step <= steps; ++step) {
        ASSERT_EQ(other.stateHash(), original.stateHash()) << "step " << step;
        ASSERT_EQ(digestOf(other, known), digestOf(original, known)) << "step " << step;
        ASSERT_EQ(reportOf(other, told), reportOf(original, told)) << "step " << step;
        if (step == steps) { break; }
        must(original.step(kStep));
        must(other.step(kStep));
    }
    EXPECT_TRUE(other.save() == original.save());
}
void expectToGoOnAlike(World& original, World& other, const KnownIds& known, int steps) {
    Told told;
    expectToGoOnAlike(original, other, known, steps, told);
}

SceneWorld built(const SceneDescription& description) {
    SceneWorld scene;
    std::string error;
    EXPECT_TRUE(buildWorld(description, scene, error)) << error;
    return scene;
}

KnownIds idsIn(const SceneWorld& scene) { return {scene.bodies, {}, scene.joints}; }

TEST(WorldSaving, GoesOnAsTheOriginal) {
    World used;  // which another world was in before
    Told told;
    for (const SceneDescription& description : allScenes()) {
        SCOPED_TRACE(description.name);
        SceneWorld scene = built(description);
        for (const int before : {0, 3, 37}) {
            run(scene.world, before);
            const Bytes bytes = scene.world.save();
            World other = loaded(bytes);
            EXPECT_TRUE(other.save() == bytes);
            must(used.load(bytes));
            World copy = scene.world;
            expectToGoOnAlike(copy, other, idsIn(scene), 15, told);
            expectToGoOnAlike(scene.world, used, idsIn(scene), 15, told);
        }
    }
    for (const int times : {told.events, told.poses, told.moved}) { EXPECT_GT(times, 0); }
}

/// With error budgets, modes that lose time, joints that break, and steps of different lengths.
TEST(WorldSaving, WithOtherSettings) {
    Told told;
    for (const SceneProfile profile : {SceneProfile::accurate, SceneProfile::fast}) {
        for (const ContinuousMode mode :
             {ContinuousMode::stop, ContinuousMode::speedLimit, ContinuousMode::speculative, ContinuousMode::subStep}) {
            SceneDescription description = scenes::mixedScene();
            description.settings.profile = profile;
            SceneWorld scene = built(description);
            WorldSettings settings = scene.world.settings();
            settings.continuous = mode;
            settings.maxPenetration = real(0.002);
            settings.maxJointError = real(0.001);
            settings.maxLostTime = 0.01;
            must(scene.world.configure(settings));
            for (std::size_t turn = 0; turn < 5; ++turn) {
                for (const double rate : {60.0, 75.0}) { must(scene.world.step(1 / rate)); }
                must(scene.world.setBreakLimits(scene.joints[turn], real(1e-3), {}));
                must(scene.world.step(1 / 50.0));
                World other = loaded(scene.world.save());
                World copy = scene.world;
                ASSERT_EQ(reportOf(other, told), reportOf(copy, told));
                for (const double rate : {60.0, 60.0, 90.0}) {
                    must(other.step(1 / rate));
                    must(copy.step(1 / rate));
                }
                expectToGoOnAlike(copy, other, idsIn(scene), 6);
            }
        }
    }
    for (const int times : {told.breaks, told.lostTime}) { EXPECT_GT(times, 0); }
}

/// What sleeps, what is held, and what comes to that after it was loaded.
TEST(WorldSaving, OfWhatComesToRest) {
    for (const SceneProfile profile : {SceneProfile::accurate, SceneProfile::fast}) {
        for (const int seed : {4, 7}) {
            SceneDescription description = scenes::fallingHeap(seed);
            description.settings.profile = profile;
            SceneWorld scene = built(description);
            for (int turn = 0; turn < 8; ++turn) {
                run(scene.world, 60);
                World other = loaded(scene.world.save());
                World copy = scene.world;
                const BodyId one = scene.bodies[static_cast<std::size_t>(turn) + 1];
                for (World* const world : {&copy, &other}) {
                    if (turn % 2 == 1 && world->type(one) == BodyType::dynamic) {
                        must(world->applyImpulse(one, vec(3, 8)));
                    }
                }
                expectToGoOnAlike(copy, other, idsIn(scene), 40);
            }
        }
    }
}

TEST(WorldSaving, WithEveryBroadphase) {
    for (int kind = 0; kind < kBroadphaseKindCount; ++kind) {
        SCOPED_TRACE(kind);
        WorldSettings settings = awakeSettings();
        settings.broadphase = static_cast<BroadphaseKind>(kind);
        settings.sleep = kind % 2 == 0;
        World world = makeWorld(settings);
        KnownIds known;
        known.bodies.push_back(addStatic(world, box(20, 1)));
        for (int i = 0; i < 60; ++i) {
            known.bodies.push_back(addBody(world, dynamicAt({-6 + i % 8 * 1.3, 2 + i / 8 * 1.2}), box(0.5, 0.5)));
        }
        for (int turn = 0; turn < 4; ++turn) {
            run(world, 20);
            must(world.destroyBody(known.bodies[static_cast<std::size_t>(7 * turn) + 3]));
            must(world.setPose(known.bodies[static_cast<std::size_t>(5 * turn) + 1], {20, 3.0 * turn}, 0));
            World other = loaded(world.save());
            expectToGoOnAlike(world, other, known, 20);
            EXPECT_EQ(other.counters().boxTests, world.counters().boxTests);
            const auto listed = [](const World& asked) {
                std::vector<ShapeId> found;
                asked.queryBox({{-30, -30}, {30, 30}}, {}, [&found](ShapeId id) {
                    found.push_back(id);
                    return true;
                });
                return found;
            };
            EXPECT_EQ(listed(other), listed(world));
        }
    }
}

/// In the middle of random calls, between steps or not, whose ends are still to be told.
TEST(WorldSaving, OfWhatIsBeingChanged) {
    for (std::uint64_t seed = 20; seed < 20 + someOf(12U); ++seed) {
        Vandal original(seed, Sizes::usual);
        for (int i = 0; i < 400; ++i) {
            original.act();
            if (i % 20 != 19) { continue; }
            Vandal other(original);
            must(other.world().load(original.world().save()));
            Vandal copy(original);
            for (int k = 0; k < 25; ++k) {
                copy.act();
                other.act();
            }
            ASSERT_EQ(digestOf(other.world(), other.known()), digestOf(copy.world(), copy.known()))
                << "seed " << seed << " action " << i;
            ASSERT_TRUE(other.world().save() == copy.world().save()) << "seed " << seed << " action " << i;
        }
    }
}

/// What was saved on one task system is gone on with on any other.
TEST(WorldSaving, OnAllTaskSystems) {
    Crowds crowds;
    for (const SceneProfile profile : {SceneProfile::accurate, SceneProfile::fast}) {
        SceneDescription description = scenes::mixedScene();
        description.settings.profile = profile;
        SceneWorld scene = built(description);
        const KnownIds known = idsIn(scene);
        for (TaskSystem* const tasks : crowds.all) {
            World world = scene.world;
            world.setTaskSystem(tasks);
            must(world.load(scene.world.save()));
            run(world, 12);
            run(scene.world, 12);
            ASSERT_EQ(digestOf(world, known), digestOf(scene.world, known));
            must(scene.world.load(world.save()));
        }
    }
}

}  // namespace
}  // namespace swept::test
