#include <bit>
#include <optional>

#include "../support/random.h"
#include "world_support.h"

/// What joints tie together is found once, and again only when joints come, change or go, or one of their bodies wakes
/// or falls asleep.

namespace swept::test {
namespace {

/// Links side by side in a row, hinged one to the next; too far from everything to touch.
struct Row {
    World world;
    std::vector<BodyId> links;
    std::vector<JointId> hinges;

    Row(const WorldSettings& settings, int count) : world(makeWorld(settings)) {
        for (int i = 0; i < count; ++i) { links.push_back(addBody(world, dynamicAt({3.0 * i, 5}), box(0.5, 0.25))); }
        for (std::size_t i = 1; i < links.size(); ++i) { hinges.push_back(hinge(i - 1, i)); }
    }

    JointId hinge(std::size_t a, std::size_t b) {
        RevoluteJointDef def;
        def.base.bodyA = links[a];
        def.base.bodyB = links[b];
        def.anchor = {1.5 * static_cast<double>(a + b), 5};
        return must(world.createJoint(def));
    }
    std::uint64_t islandsAfterStep() {
        must(world.step(kStep));
        return world.counters().islands;
    }
};

TEST(JointChains, IslandsFollowTheJoints) {
    Row row(awakeSettings(), 8);
    EXPECT_EQ(row.islandsAfterStep(), 1U);
    EXPECT_EQ(row.islandsAfterStep(), 1U);
    must(row.world.destroyJoint(row.hinges[3]));
    EXPECT_EQ(row.islandsAfterStep(), 2U);
    (void)addBody(row.world, dynamicAt({0, 50}), circle(0.5));  // takes a slot, and is no island
    EXPECT_EQ(row.islandsAfterStep(), 2U);
    (void)row.hinge(3, 4);
    EXPECT_EQ(row.islandsAfterStep(), 1U);
    must(row.world.destroyBody(row.links[5]));
    EXPECT_EQ(row.islandsAfterStep(), 2U);
    must(row.world.destroyBody(row.links[1]));  // what is left of its chain is a body alone
    EXPECT_EQ(row.islandsAfterStep(), 2U);
    FilterJointDef filter;
    filter.base.bodyA = row.links[2];
    filter.base.bodyB = row.links[6];
    (void)must(row.world.createJoint(filter));
    EXPECT_EQ(row.islandsAfterStep(), 2U);
}

TEST(JointChains, OfWhatSleepsAreNone) {
    WorldSettings settings;
    settings.gravity = {};
    Row row(settings, 3);
    const BodyId far = addBody(row.world, dynamicAt({100, 5}), box(0.5, 0.25));
    for (const BodyId link : row.links) { must(row.world.setAwake(link, false)); }
    EXPECT_EQ(row.islandsAfterStep(), 0U);
    row.links.push_back(far);
    (void)row.hinge(0, 3);
    EXPECT_EQ(row.islandsAfterStep(), 1U);
    EXPECT_EQ(row.world.counters().solvedBodies, 4U);
}

/// Bit for bit, whether the chains are found anew in every step or not: their sums decide how islands are solved.
TEST(JointChains, KeptOrFoundAnewTheyMoveAlike) {
    const auto run = [](bool anew) {
        constexpr int kLinks = 20;
        Row row(awakeSettings(), kLinks);
        (void)addStatic(row.world, box(200, 0.5), {}, {0, 0});
        for (int i = 0; i < 90; ++i) {
            if (i == 30) { must(row.world.destroyJoint(row.hinges[10])); }
            if (i == 60) { must(row.world.setAngularMotor(row.hinges[3], AngularMotor{.speed = 1, .maxTorque = 10})); }
            const auto limit = anew && i % 2 == 0 ? std::optional(Real(0x1p60)) : std::nullopt;
            must(row.world.setBreakLimits(row.hinges[5], limit, std::nullopt));
            must(row.world.step(kStep));
        }
        std::vector<std::uint64_t> bits;
        for (const BodyId link : row.links) {
            bits.push_back(std::bit_cast<std::uint64_t>(row.world.position(link).x));
            bits.push_back(std::bit_cast<std::uint64_t>(row.world.position(link).y));
        }
        return bits;
    };
    EXPECT_EQ(run(false), run(true));
}

/// The same of what falls asleep, is put to sleep, woken and kicked in any order, beside a pair that never sleeps.
TEST(JointChains, KeptOrFoundAnewTheyWakeAlike) {
    struct Outcome {
        std::vector<std::uint64_t> bits;
        std::uint64_t fellAsleep = 0;
        std::uint64_t wokeUp = 0;
    };
    const auto run = [](std::uint64_t seed, bool anew) {
        constexpr int kLinks = 24;
        Row row(WorldSettings{}, kLinks);
        (void)addStatic(row.world, box(200, 0.5), {}, {0, 0});
        for (std::size_t i = 3; i < kLinks - 1; i += 4) { must(row.world.destroyJoint(row.hinges[i])); }  // six chains
        BodyDef def = dynamicAt({0, 100});
        def.gravityScale = 0;
        for (int i = 0; i < 2; ++i) {
            def.angularVelocity = Real(0.5);
            def.position.x += 3;
            row.links.push_back(addBody(row.world, def, box(0.5, 0.25)));
        }
        const JointId watch = row.hinge(kLinks, kLinks + 1);
        Random random(seed);
        Outcome outcome;
        for (int i = 0; i < 400; ++i) {
            const BodyId link = row.links[static_cast<std::size_t>(random.integer(0, kLinks - 1))];
            const int what = random.integer(0, 11);
            if (what == 0) { must(row.world.setAwake(link, false)); }
            if (what == 1) { must(row.world.setAwake(link, true)); }
            if (what == 2 && i % 3 == 0) { must(row.world.setVelocity(link, vec(0, 2), 0)); }
            const auto limit = anew && i % 2 == 0 ? std::optional(Real(0x1p60)) : std::nullopt;
            must(row.world.setBreakLimits(watch, limit, std::nullopt));
            must(row.world.step(kStep));
            outcome.fellAsleep += row.world.counters().fellAsleep;
            outcome.wokeUp += row.world.counters().wokeUp;
            outcome.bits.push_back(row.world.counters().islands);
        }
        for (const BodyId link : row.links) {
            outcome.bits.push_back(std::bit_cast<std::uint64_t>(row.world.position(link).x));
            outcome.bits.push_back(std::bit_cast<std::uint64_t>(row.world.position(link).y));
        }
        return outcome;
    };
    std::uint64_t fellAsleep = 0;
    std::uint64_t wokeUp = 0;
    for (std::uint64_t seed = 1; seed <= 5; ++seed) {
        const Outcome kept = run(seed, false);
        EXPECT_EQ(kept.bits, run(seed, true).bits) << "seed " << seed;
        fellAsleep += kept.fellAsleep;
        wokeUp += kept.wokeUp;
    }
    EXPECT_GT(fellAsleep, 50U);
    EXPECT_GT(wokeUp, 100U);
}

}  // namespace
}  // namespace swept::test
