#include <swept/samples/builtin_scenes.h>
#include <swept/samples/world_builder.h>
#include <swept/shapes/manifold_batch.h>
#include <swept/shapes/wide_targets.h>
// after it
#include <hwy/targets.h>

#include "falling_heap.h"
#include "world_digest.h"
#include "world_support.h"

/// The same bits without wide kernels, where pairs are handled one by one, as in a build without SIMD and, in f64, in
/// WebAssembly: they are switched off at run time here.

namespace swept::test {
namespace {

/// Of both profiles, after each step.
std::vector<std::uint64_t> digestsOf(SceneDescription description, int steps) {
    std::vector<std::uint64_t> digests;
    for (const SceneProfile profile : {SceneProfile::accurate, SceneProfile::fast}) {
        description.settings.profile = profile;
        SceneWorld scene;
        std::string error;
        EXPECT_TRUE(buildWorld(description, scene, error)) << error;
        const KnownIds known{scene.bodies, {}, scene.joints};
        for (int step = 0; step < steps; ++step) {
            must(scene.world.step(kStep));
            digests.push_back(digestOf(scene.world, known));
        }
    }
    return digests;
}

class Batches : public testing::Test {
protected:
    void SetUp() override {
        if (!canCollideInBatches()) { GTEST_SKIP() << "this machine has none"; }
        switchOff();
        const bool areOff = !canCollideInBatches();
        switchOn();
        if (!areOff) { GTEST_SKIP() << "this build has no kernels for plain processors"; }
    }
    void TearDown() override { switchOn(); }

    static void switchOff() { hwy::SetSupportedTargetsForTest(HWY_EMU128); }
    static void switchOn() { hwy::SetSupportedTargetsForTest(0); }

    static void expectSameWithout(const SceneDescription& scene, int steps) {
        const std::vector<std::uint64_t> with = digestsOf(scene, steps);
        switchOff();
        const std::vector<std::uint64_t> without = digestsOf(scene, steps);
        switchOn();
        EXPECT_EQ(with, without) << scene.name;
    }
};

TEST_F(Batches, ChangeNothingInBuiltinScenes) {
    for (const BuiltinScene& entry : builtinScenes()) { expectSameWithout(entry.make(), 40); }
}

/// What passes each other in a heap was told from bounds of distances, of which other ones are found one by one: nine
/// of ten such heaps differed.
TEST_F(Batches, ChangeNothingInFallingHeaps) {
    for (int seed = 0; seed < 16; ++seed) { expectSameWithout(scenes::fallingHeap(seed), 30); }
}

}  // namespace
}  // namespace swept::test
