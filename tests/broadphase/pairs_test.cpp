#include <gtest/gtest.h>

#include <swept/broadphase/wide_bvh.h>

#include <memory>

#include "../support/some_of.h"
#include "model.h"

namespace swept::test {
namespace {

std::vector<std::unique_ptr<Broadphase>> everyImplementation() {
    std::vector<std::unique_ptr<Broadphase>> all;
    for (const BroadphaseKind kind : kEveryKind) { all.push_back(makeBroadphase(kind)); }
    all.push_back(std::make_unique<WideBvh>(scalarKernels()));
    return all;
}

std::uint32_t anySlot(const Model& model, Random& random) {
    auto at = model.proxies().begin();
    std::advance(at, below(random, static_cast<std::uint32_t>(model.proxies().size())));
    return at->first;
}

/// One random call, made to the model and to all implementations alike.
void randomCall(Family family, Random& random, Model& model, std::vector<std::unique_ptr<Broadphase>>& all) {
    const double choice = random.uniform();
    if (choice < 0.3 || model.proxies().empty()) {
        const Aabb box = randomBox(family, random);
        const ProxyKind kind = randomKind(random);
        const auto expected = static_cast<ProxyId>(model.insert(box, kind));
        for (const auto& broadphase : all) {
            const Result<ProxyId> id = broadphase->insert(box, kind);
            ASSERT_TRUE(id.ok());
            ASSERT_EQ(id.value(), expected) << "the lowest free slot is taken first";
        }
    } else if (choice < 0.45) {
        const std::uint32_t slot = anySlot(model, random);
        model.remove(slot);
        for (const auto& broadphase : all) { ASSERT_TRUE(broadphase->remove(static_cast<ProxyId>(slot)).ok()); }
    } else if (choice < 0.5) {
        const std::uint32_t slot = anySlot(model, random);
        model.renew(slot);
        for (const auto& broadphase : all) { ASSERT_TRUE(broadphase->renewPairs(static_cast<ProxyId>(slot)).ok()); }
    } else {
        const std::uint32_t slot = anySlot(model, random);
        const bool teleport = choice > 0.9;
        const Aabb box = teleport ? randomBox(family, random) : shifted(model.proxies().at(slot).box, random);
        model.move(slot, box);
        for (const auto& broadphase : all) {
            ASSERT_TRUE(broadphase->move(static_cast<ProxyId>(slot), box).ok());
            ASSERT_EQ(broadphase->box(static_cast<ProxyId>(slot)), box);
        }
    }
}

class Pairs : public testing::TestWithParam<Family> {};

TEST_P(Pairs, AreThoseOfTheModelAfterAnyProgram) {
    std::uint64_t found = 0;
    std::uint64_t unmovedAsWell = 0;
    for (std::uint64_t seed = 0; seed < someOf(6U); ++seed) {
        Random random(seed * 977 + static_cast<std::uint64_t>(GetParam()));
        Model model;
        auto all = everyImplementation();
        std::vector<ProxyPair> pairs;
        for (int round = 0; round < 100; ++round) {
            const std::uint32_t calls = random.chance(0.3) ? below(random, 80) : below(random, 8);
            for (std::uint32_t call = 0; call < calls; ++call) {
                randomCall(GetParam(), random, model, all);
                if (HasFatalFailure()) { FAIL() << "seed " << seed << " round " << round; }
            }
            const std::vector<ProxyPair> expected = model.pairs();
            found += expected.size();
            for (const auto& broadphase : all) {
                broadphase->pairs(pairs);
                ASSERT_EQ(pairs, expected) << GetParam() << " seed " << seed << " round " << round;
                broadphase->pairs(pairs);
                ASSERT_TRUE(pairs.empty()) << "nothing moved since the last call";
            }
            unmovedAsWell += model.proxies().size() > calls ? 1 : 0;
        }
    }
    EXPECT_GT(found, someOf(1000U)) << "too few pairs to prove anything";
    EXPECT_GT(unmovedAsWell, someOf(100U)) << "mostly only some of the proxies should have moved";
}

INSTANTIATE_TEST_SUITE_P(AllFamilies, Pairs, testing::ValuesIn(kFamilies),
                         [](const testing::TestParamInfo<Family>& family) { return nameOf(family.param); });

TEST(PairsOfManyProxies, AreTheSameInTheSameOrder) {
    Random random(42);
    auto all = everyImplementation();
    constexpr std::uint32_t kCount = 3000;
    std::vector<Aabb> boxes;
    for (std::uint32_t i = 0; i < kCount; ++i) {
        boxes.push_back(boxAround(random.range(-60, 60), random.range(-60, 60), 0.6, 0.6));
        for (const auto& broadphase : all) {
            ASSERT_TRUE(broadphase->insert(boxes.back(), i % 7 == 0 ? ProxyKind::fixed : ProxyKind::dynamic).ok());
        }
    }
    std::vector<std::vector<ProxyPair>> pairs(all.size());
    for (int round = 0; round < 20; ++round) {
        // Every share of moved proxies: the pair list is sorted in two ways, by how long it is.
        const std::uint32_t stride = round < 5 ? 1 : 1U << static_cast<unsigned>(round - 4);
        for (std::uint32_t i = 0; i < kCount; i += stride) {
            boxes[i] = shifted(boxes[i], random);
            for (const auto& broadphase : all) {
                ASSERT_TRUE(broadphase->move(static_cast<ProxyId>(i), boxes[i]).ok());
            }
        }
        for (std::size_t i = 0; i < all.size(); ++i) { all[i]->pairs(pairs[i]); }
        ASSERT_TRUE(std::is_sorted(pairs[0].begin(), pairs[0].end()));
        ASSERT_TRUE(std::adjacent_find(pairs[0].begin(), pairs[0].end()) == pairs[0].end());
        for (std::size_t i = 1; i < all.size(); ++i) { ASSERT_EQ(pairs[i], pairs[0]) << i << " round " << round; }
        if (stride == 1) { EXPECT_GT(pairs[0].size(), kCount / 8); }
    }
    for (std::size_t i = 1; i < all.size(); ++i) {
        EXPECT_LT(4 * all[i]->counters().boxTests, all[0]->counters().boxTests) << i << " does not prune";
    }
}

TEST(Pairs, DoNotDependOnHowTheTreeCameAbout) {
    Random random(7);
    std::vector<Aabb> boxes;
    for (int i = 0; i < 300; ++i) { boxes.push_back(randomBox(Family::mixedSizes, random)); }
    const auto direct = makeBroadphase(BroadphaseKind::bvh);
    const auto detour = makeBroadphase(BroadphaseKind::bvh);
    for (const Aabb& box : boxes) {
        ASSERT_TRUE(direct->insert(box, ProxyKind::dynamic).ok());
        ASSERT_TRUE(detour->insert(randomBox(Family::scattered, random), ProxyKind::dynamic).ok());
    }
    for (std::size_t i = boxes.size(); i-- > 0;) { ASSERT_TRUE(detour->move(static_cast<ProxyId>(i), boxes[i]).ok()); }
    std::vector<ProxyPair> a;
    std::vector<ProxyPair> b;
    direct->pairs(a);
    detour->pairs(b);
    EXPECT_EQ(a, b);
    EXPECT_GT(a.size(), 300U);
}

TEST(Pairs, OfAnEmptyWorldAreNone) {
    for (const auto& broadphase : everyImplementation()) {
        std::vector<ProxyPair> pairs = {{ProxyId{1}, ProxyId{2}}};
        broadphase->pairs(pairs);
        EXPECT_TRUE(pairs.empty());
        const Result<ProxyId> only = broadphase->insert({{0, 0}, {1, 1}}, ProxyKind::dynamic);
        broadphase->pairs(pairs);
        EXPECT_TRUE(pairs.empty());
        EXPECT_TRUE(broadphase->remove(only.value()).ok());
        broadphase->pairs(pairs);
        EXPECT_TRUE(pairs.empty());
    }
}

TEST(Pairs, OfAWorldThatIsCleared) {
    for (const auto& broadphase : everyImplementation()) {
        std::vector<ProxyPair> pairs;
        for (int round = 0; round < 2; ++round) {
            std::vector<ProxyId> ids;
            for (int i = 0; i < 100; ++i) {
                const Real x = static_cast<Real>(i) / 2;
                ids.push_back(broadphase->insert({{x, 0}, {x + 1, 1}}, ProxyKind::dynamic).value());
            }
            broadphase->pairs(pairs);
            EXPECT_GE(pairs.size(), 99U);
            ASSERT_TRUE(broadphase->move(ids[3], {{5, 5}, {6, 6}}).ok());
            for (const ProxyId id : ids) { ASSERT_TRUE(broadphase->remove(id).ok()); }
            broadphase->pairs(pairs);
            EXPECT_TRUE(pairs.empty());
        }
    }
}

TEST(Pairs, ForgetAMovedProxyThatWasRemovedAndItsSlotTakenAgain) {
    for (const auto& broadphase : everyImplementation()) {
        ASSERT_TRUE(broadphase->insert({{0, 0}, {1, 1}}, ProxyKind::dynamic).ok());
        const ProxyId second = broadphase->insert({{0, 0}, {1, 1}}, ProxyKind::dynamic).value();
        ASSERT_TRUE(broadphase->remove(second).ok());
        ASSERT_EQ(broadphase->insert({{1, 1}, {2, 2}}, ProxyKind::fixed).value(), second);
        std::vector<ProxyPair> pairs;
        broadphase->pairs(pairs);
        ASSERT_EQ(pairs.size(), 1U) << "touching boxes overlap, each pair once";
        EXPECT_EQ(pairs[0], (ProxyPair{ProxyId{0}, second}));
    }
}

TEST(Counters, TellWhatWasDone) {
    for (const auto& broadphase : everyImplementation()) {
        const ProxyId first = broadphase->insert({{0, 0}, {1, 1}}, ProxyKind::dynamic).value();
        ASSERT_TRUE(broadphase->insert({{0, 0}, {1, 1}}, ProxyKind::dynamic).ok());
        EXPECT_EQ(broadphase->counters().reinserted, 0U);
        EXPECT_EQ(broadphase->counters().pairsReported, 0U);
        std::vector<ProxyPair> pairs;
        broadphase->pairs(pairs);
        const std::uint64_t tests = broadphase->counters().boxTests;
        EXPECT_GE(tests, 1U);
        EXPECT_EQ(broadphase->counters().pairsReported, 1U);
        ASSERT_TRUE(broadphase->move(first, {{0, 0}, {2, 2}}).ok());
        EXPECT_EQ(broadphase->counters().reinserted, 1U);
        broadphase->pairs(pairs);
        EXPECT_EQ(broadphase->counters().pairsReported, 1U) << "a pair that goes on is not new";
        ASSERT_TRUE(broadphase->renewPairs(first).ok());
        EXPECT_EQ(broadphase->counters().reinserted, 1U);
        broadphase->pairs(pairs);
        EXPECT_EQ(broadphase->counters().pairsReported, 2U);
        EXPECT_GT(broadphase->memoryBytes(), 2 * sizeof(Aabb));
        broadphase->query({{0, 0}, {1, 1}}, [](ProxyId) { return true; });
        EXPECT_GE(broadphase->counters().boxTests, tests + 2);
    }
}

}  // namespace
}  // namespace swept::test
