#include <atomic>

#include "any_order_tasks.h"
#include "filtered_crowd.h"

/// A contact filter is asked by all threads of a world, and the bits are the same for any number of them.

namespace swept::test {
namespace {

/// Also counts how often it is asked.
struct Counted final : ContactFilter {
    mutable std::atomic<std::size_t> asked = 0;
    bool mayTouch(const FilteredShape& a, const FilteredShape& b) const noexcept override {
        asked.fetch_add(1, std::memory_order_relaxed);
        return SameKind().mayTouch(a, b);
    }
};

TEST(ContactFilterParallel, GivesTheSameBits) {
    Crowds crowds;
    for (std::uint64_t seed = 1; seed <= 2; ++seed) {
        const Counted filter;
        FilteredCrowd alone(seed, filter);
        std::vector<FilteredCrowd> others;
        for (TaskSystem* const tasks : crowds.all) {
            others.emplace_back(seed, filter);
            others.back().world.setTaskSystem(tasks);
        }
        for (int i = 0; i < 90; ++i) {
            run(alone.world, 1);
            for (FilteredCrowd& other : others) {
                run(other.world, 1);
                ASSERT_EQ(other.world.stateHash(), alone.world.stateHash()) << "seed " << seed << " step " << i;
            }
        }
        EXPECT_GT(filter.asked, 1000U);
    }
    EXPECT_GT(crowds.three.chunksOfOthers(), 0U);
}

}  // namespace
}  // namespace swept::test
