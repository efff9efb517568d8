#include <swept/samples/built_in/builtin_scenes.h>
#include <swept/samples/world_builder.h>
#include <swept/shapes/manifold_batch.h>
#include <swept/shapes/wide_targets.h>
// after it
#include <hwy/targets.h>

#include "../support/random.h"
#include "falling_heap.h"
#include "moved_limits.h"
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

/// What calls move stands in no block, what they leave alone does.
TEST_F(Batches, ChangeNothingWhereLimitsMove) {
    for (const Profile profile : {Profile::accurate, Profile::fast}) {
        MovedLimits with(profile);
        MovedLimits without(profile);
        for (int step = 0; step < 60; ++step) {
            with.step();
            switchOff();
            without.step();
            switchOn();
            ASSERT_EQ(with.world.stateHash(), without.world.stateHash()) << "step " << step;
        }
    }
}

/// A row of boxes on joints of all kinds, the first of which is so fast that squares overflow.
World overflowing(std::uint64_t seed) {
    Random random(seed);
    WorldSettings settings = awakeSettings(Profile::fast, 0);
    World world = makeWorld(settings);
    const int count = random.integer(3, 6);
    JointDef base;
    for (int i = 0; i < count; ++i) {
        base.bodyA = base.bodyB;
        base.bodyB = addBody(world, dynamicAt({1.0 * i, 0}), box(0.2, 0.1));
        if (i == 0) {
            const double most = std::ldexp(1.0, std::numeric_limits<Real>::max_exponent / 2 - 4);
            must(world.setVelocity(base.bodyB, vec(random.range(-most, most), random.range(-most, most)),
                                   real(random.range(-most, most))));
            continue;
        }
        const DVec2 middle{i - 0.5, 0};
        switch (random.integer(0, 3)) {
            case 0: {
                DistanceJointDef rod{base, {i - 1.0, 0}, {1.0 * i, 0}};
                rod.limits = LengthLimits{real(0.5), real(1.5)};
                must(world.createJoint(rod));
                break;
            }
            case 1:
                must(world.createJoint(PrismaticJointDef{base, middle, {1, 0.3}}));
                break;
            case 2:
                must(world.createJoint(WheelJointDef{base, middle, {0.2, 1}}));
                break;
            default:
                must(world.createJoint(WeldJointDef{base, middle}));
                break;
        }
    }
    return world;
}

/// What overflowed is put back, with all that joints tie to it: whose numbers are still numbers then depends on who
/// multiplies what by nothing. Nor is there a contact that is no number.
TEST_F(Batches, ChangeNothingWhereStatesOverflow) {
    std::size_t putBack = 0;
    for (std::uint64_t seed = 0; seed < 100; ++seed) {
        World with = overflowing(seed);
        World without = with;
        for (int step = 0; step < 3; ++step) {
            must(with.step(kStep));
            switchOff();
            must(without.step(kStep));
            switchOn();
            ASSERT_EQ(with.stateHash(), without.stateHash()) << "seed " << seed << ", step " << step;
            putBack += with.bodiesPutBack().size();
            with.visitContacts([&](const ContactView& contact) {
                EXPECT_TRUE(isFinite(contact.separation) && isFinite(contact.point)) << "seed " << seed;
            });
        }
    }
    EXPECT_GT(putBack, 100U) << "little overflowed";
}

}  // namespace
}  // namespace swept::test
