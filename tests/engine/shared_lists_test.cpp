#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

#include <swept/engine/crew/join_blocks.h>
#include <swept/engine/crew/shared_choice.h>

#include "../support/random.h"
#include "../support/thread_tasks.h"

/// Lists that several workers make together are those that one would make.

namespace swept::test {
namespace {

TEST(SharedLists, WhatIsMeantIsTakenInOrder) {
    for (const int workers : {1, 2, 3}) {
        ThreadTasks threads(workers);
        for (std::uint64_t seed = 0; seed < 30; ++seed) {
            Random random(seed);
            std::vector<std::uint32_t> items(static_cast<std::size_t>(random.integer(0, 500)));
            for (std::uint32_t& item : items) { item = static_cast<std::uint32_t>(random.integer(0, 1000)); }
            const int share = random.integer(0, 4);
            const auto isMeant = [share](std::uint32_t item) { return static_cast<int>(item % 4) < share; };
            std::vector<std::uint32_t> expected;
            for (const std::uint32_t item : items) {
                if (isMeant(item)) { expected.push_back(item); }
            }
            RawVector<std::uint8_t> answers;
            std::vector<std::uint32_t> taken;
            forEachMeant(threads, items, static_cast<std::size_t>(random.integer(1, 64)), answers, isMeant,
                         [&taken](std::uint32_t item) { taken.push_back(item); });
            ASSERT_EQ(taken, expected) << "seed " << seed << ", " << workers << " workers";
        }
    }
}

TEST(SharedLists, BlocksAreJoinedInOrder) {
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        Random random(seed);
        const auto perBlock = static_cast<std::size_t>(random.integer(1, 20));
        const auto blocks = static_cast<std::size_t>(random.integer(0, 12));
        const int fill = random.integer(0, 2);  // none of a block, any number, all
        RawVector<std::uint32_t> list;
        list.assign(blocks * perBlock, ~std::uint32_t{0});
        std::vector<std::size_t> counts;
        std::vector<std::uint32_t> expected;
        for (std::size_t block = 0; block < blocks; ++block) {
            const int any = random.integer(0, static_cast<int>(perBlock));
            counts.push_back(fill == 1 ? static_cast<std::size_t>(any) : fill == 2 ? perBlock : 0);
            for (std::size_t i = 0; i < counts.back(); ++i) {
                expected.push_back(static_cast<std::uint32_t>(expected.size()));
                list[block * perBlock + i] = expected.back();
            }
        }
        joinBlocks(list, blocks, perBlock, [&counts](std::size_t block) { return counts[block]; });
        ASSERT_EQ(std::vector<std::uint32_t>(list.begin(), list.end()), expected) << "seed " << seed;
    }
}

}  // namespace
}  // namespace swept::test
