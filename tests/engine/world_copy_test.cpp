#include <swept/samples/world_builder.h>

#include "../support/some_of.h"
#include "all_scenes.h"
#include "mixed_scene.h"
#include "vandal.h"
#include "world_support.h"

/// A copy of a world is a snapshot: it goes on with the bits of the original, whatever it is of, wherever it was put,
/// and neither knows of the other.

namespace swept::test {
namespace {

constexpr int kBefore = 40;
constexpr int kAfter = 30;

KnownIds idsOf(const SceneWorld& scene) { return {scene.bodies, {}, scene.joints}; }

std::vector<std::uint64_t> digestsOfSteps(World& world, const KnownIds& known, int steps) {
    std::vector<std::uint64_t> digests;
    for (int step = 0; step < steps; ++step) {
        must(world.step(kStep));
        digests.push_back(digestOf(world, known));
    }
    return digests;
}

TEST(WorldCopy, GoesOnAsTheOriginal) {
    World used = makeWorld();  // which another world was in before
    for (const SceneDescription& description : allScenes()) {
        SceneWorld scene;
        std::string error;
        ASSERT_TRUE(buildWorld(description, scene, error)) << error;
        const KnownIds known = idsOf(scene);
        (void)digestsOfSteps(scene.world, known, kBefore);
        World copy(scene.world);
        used = scene.world;
        EXPECT_EQ(digestOf(copy, known), digestOf(scene.world, known)) << description.name;
        const std::vector<std::uint64_t> wanted = digestsOfSteps(scene.world, known, kAfter);
        EXPECT_EQ(digestsOfSteps(copy, known, kAfter), wanted) << description.name;
        EXPECT_EQ(digestsOfSteps(used, known, kAfter), wanted) << description.name << ", assigned";
    }
}

/// As games do that correct what they took for granted: back to a snapshot, and the same steps once more.
TEST(WorldCopy, IsGoneBackTo) {
    SceneWorld scene;
    std::string error;
    ASSERT_TRUE(buildWorld(scenes::mixedScene(), scene, error)) << error;
    const KnownIds known = idsOf(scene);
    for (int turn = 0; turn < 10; ++turn) {
        const World before(scene.world);
        const std::vector<std::uint64_t> wanted = digestsOfSteps(scene.world, known, 8);
        must(scene.world.destroyBody(scene.bodies[static_cast<std::size_t>(turn)]));
        must(scene.world.setVelocity(scene.bodies.back(), vec(3, 4), 5));
        run(scene.world, 3);
        scene.world = before;
        EXPECT_EQ(digestsOfSteps(scene.world, known, 8), wanted) << "turn " << turn;
    }
}

TEST(WorldCopy, WithEveryBroadphase) {
    for (int kind = 0; kind < kBroadphaseKindCount; ++kind) {
        WorldSettings settings = awakeSettings();
        settings.broadphase = static_cast<BroadphaseKind>(kind);
        World world = makeWorld(settings);
        KnownIds known;
        known.bodies.push_back(addStatic(world, box(20, 1)));
        for (int i = 0; i < 60; ++i) {
            known.bodies.push_back(addBody(world, dynamicAt({-6 + i % 8 * 1.3, 2 + i / 8 * 1.2}), box(0.5, 0.5)));
        }
        run(world, 50);
        World copy(world);
        EXPECT_EQ(digestsOfSteps(copy, known, 40), digestsOfSteps(world, known, 40)) << "kind " << kind;
        EXPECT_EQ(copy.counters().boxTests, world.counters().boxTests) << "kind " << kind;
    }
}

/// In the middle of random calls, between steps or not, whose ends are still to be told.
TEST(WorldCopy, OfWhatIsBeingChanged) {
    for (std::uint64_t seed = 0; seed < someOf(8U); ++seed) {
        Vandal original(seed, Sizes::usual);
        for (int i = 0; i < 400; ++i) {
            original.act();
            if (i % 40 != 39) { continue; }
            Vandal copy(original);
            Vandal other(original);
            for (int k = 0; k < 25; ++k) {
                other.act();
                copy.act();
            }
            ASSERT_EQ(digestOf(copy.world(), copy.known()), digestOf(other.world(), other.known()))
                << "seed " << seed << " action " << i;
        }
        Vandal undisturbed(seed, Sizes::usual);
        for (int i = 0; i < 400; ++i) { undisturbed.act(); }
        EXPECT_EQ(digestOf(original.world(), original.known()), digestOf(undisturbed.world(), undisturbed.known()));
    }
}

TEST(WorldCopy, OfItselfAndOfOneThatWasMovedFrom) {
    World world = makeWorld();
    KnownIds known{{addStatic(world, box(5, 1)), addBody(world, dynamicAt({0, 3}), box(0.5, 0.5))}, {}, {}};
    run(world, 10);
    const std::uint64_t before = digestOf(world, known);
    const World& same = world;
    world = same;
    EXPECT_EQ(digestOf(world, known), before);
    World moved(std::move(world));
    world = moved;
    EXPECT_EQ(digestOf(world, known), before);
    EXPECT_EQ(digestsOfSteps(world, known, 30), digestsOfSteps(moved, known, 30));
}

}  // namespace
}  // namespace swept::test
