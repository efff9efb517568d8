#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include <swept/engine/containers/island_items.h>
#include <swept/engine/containers/pair_table.h>
#include <swept/engine/containers/slot_pool.h>
#include <swept/engine/ids.h>

#include "../support/random.h"

/// The containers of the world that keep names, pairs and islands apart, against the standard library's.

namespace swept::test {
namespace {

using Pool = SlotPool<int, BodyId>;

TEST(SlotPool, TakesTheSlotThatWasFreedLast) {
    Pool pool;
    const BodyId a = *pool.insert(1);
    const BodyId b = *pool.insert(2);
    const BodyId c = *pool.insert(3);
    EXPECT_EQ(c.index, 2u);
    pool.erase(a);
    pool.erase(b);
    EXPECT_EQ(pool.insert(4)->index, b.index);
    EXPECT_EQ(pool.insert(5)->index, a.index);
    EXPECT_EQ(pool.insert(6)->index, 3u);
    EXPECT_EQ(pool.slotCount(), 4u);
}

TEST(SlotPool, StaleNullAndForeignIdsFindNothing) {
    Pool pool;
    const BodyId id = *pool.insert(7);
    EXPECT_EQ(*pool.find(id), 7);
    EXPECT_EQ(pool.find({}), nullptr);
    EXPECT_EQ(pool.find({id.index, id.generation + 1}), nullptr);
    EXPECT_EQ(pool.find({id.index + 1, id.generation}), nullptr);
    pool.erase(id);
    EXPECT_EQ(pool.find(id), nullptr);
    const BodyId next = *pool.insert(8);
    EXPECT_EQ(next.index, id.index);
    EXPECT_EQ(pool.find(id), nullptr) << "an old name of a slot that lives again";
    EXPECT_EQ(*pool.find(next), 8);
}

/// Random programs against a map from every id ever given.
TEST(SlotPool, AgreesWithAMap) {
    Random random(11);
    Pool pool;
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> living;
    std::vector<BodyId> given;
    int reused = 0;
    for (int i = 0; i < 20'000; ++i) {
        const bool grow = living.size() < 40 && (living.size() < 5 || random.chance(0.5));
        if (grow) {
            const std::uint32_t slots = pool.slotCount();
            const BodyId id = *pool.insert(i);
            reused += id.index < slots ? 1 : 0;
            EXPECT_TRUE(living.emplace(std::pair(id.index, id.generation), i).second) << "given twice";
            given.push_back(id);
        } else {
            const BodyId id = given[static_cast<std::size_t>(random.integer(0, static_cast<int>(given.size()) - 1))];
            if (pool.isValid(id)) {
                pool.erase(id);
                living.erase(std::pair(id.index, id.generation));
            }
        }
        const BodyId probe = given[static_cast<std::size_t>(random.integer(0, static_cast<int>(given.size()) - 1))];
        const auto found = living.find(std::pair(probe.index, probe.generation));
        ASSERT_EQ(pool.isValid(probe), found != living.end()) << "operation " << i;
        if (found != living.end()) { ASSERT_EQ(*pool.find(probe), found->second) << "operation " << i; }
        ASSERT_EQ(pool.size(), living.size());
    }
    EXPECT_GT(reused, 1'000);
}

/// Pairs from a small range, so that insertions repeat and deletions hit, and probe sequences run into each other.
TEST(PairTable, AgreesWithASet) {
    int repeated = 0;
    int erased = 0;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        Random random(seed);
        PairTable table;
        std::set<std::pair<std::uint32_t, std::uint32_t>> pairs;
        const int range = seed % 2 == 0 ? 12 : 90;
        for (int i = 0; i < 20'000; ++i) {
            const auto a = static_cast<std::uint32_t>(random.integer(0, range));
            const auto b = static_cast<std::uint32_t>(random.integer(0, range) + (seed % 3 == 0 ? 1 << 20 : 0));
            const std::pair key(std::min(a, b), std::max(a, b));
            if (random.chance(seed % 4 < 2 ? 0.5 : 0.7)) {
                const bool fresh = pairs.insert(key).second;
                repeated += fresh ? 0 : 1;
                ASSERT_EQ(table.insert(a, b), fresh) << "seed " << seed << " operation " << i;
            } else {
                table.erase(a, b);
                erased += static_cast<int>(pairs.erase(key));
            }
            ASSERT_EQ(table.size(), pairs.size()) << "seed " << seed << " operation " << i;
        }
        // Whatever is left is found, and can be taken out again, in either order of the two.
        for (const auto& [a, b] : pairs) { EXPECT_FALSE(table.insert(b, a)) << "seed " << seed; }
        for (const auto& [a, b] : pairs) { table.erase(b, a); }
        EXPECT_EQ(table.size(), 0u);
    }
    EXPECT_GT(repeated, 10'000);
    EXPECT_GT(erased, 10'000);
}

TEST(IslandItems, StandIslandByIslandInTheOrderOfAdding) {
    IslandItems items;  // used again and again, as the world does
    std::size_t empty = 0;
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        Random random(seed);
        const auto islands = static_cast<std::size_t>(random.integer(1, 40));
        std::vector<std::vector<std::uint32_t>> expected(islands);
        items.clear();
        const int count = random.integer(0, 100);
        for (int i = 0; i < count; ++i) {
            const auto island = static_cast<std::size_t>(random.integer(0, static_cast<int>(islands) - 1));
            const auto item = static_cast<std::uint32_t>(random.integer(0, 1000));
            expected[island].push_back(item);
            items.add(static_cast<std::uint32_t>(island), item);
        }
        items.sort(islands);
        for (std::size_t island = 0; island < islands; ++island) {
            const auto found = items.of(island);
            ASSERT_TRUE(std::equal(found.begin(), found.end(), expected[island].begin(), expected[island].end()))
                << "seed " << seed << " island " << island;
            empty += found.empty() ? 1 : 0;
        }
    }
    EXPECT_GT(empty, 100u);
}

}  // namespace
}  // namespace swept::test
