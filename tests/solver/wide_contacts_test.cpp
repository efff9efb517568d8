#include <gtest/gtest.h>
#include <swept/solver/wide_contacts.h>

#ifdef SWEPT_SIMD
#include <hwy/targets.h>
#endif

#include "batch_fields.h"

/// Blocks of contacts against contacts one by one: the same bits with every instruction set of this machine.

namespace swept::test {
namespace {

/// @return contacts of blocks
int expectSameBits(int times, std::uint64_t seeds) {
    int blocks = 0;
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
        RandomSolve narrow(seed, times);
        RandomSolve wide(seed, times);
        narrow.settings.wide = false;
        const SolveReport ofNarrow = Solver().solve(narrow.batch, narrow.settings);
        const SolveReport ofWide = Solver().solve(wide.batch, wide.settings);
        EXPECT_EQ(ofNarrow.contactBlocks, 0);
        EXPECT_EQ(ofNarrow.bounceRounds, ofWide.bounceRounds) << "seed " << seed;
        EXPECT_EQ(bitsOf(narrow.batch), bitsOf(wide.batch)) << "seed " << seed;
        if (testing::Test::HasFailure()) {
            break;
        }
        blocks += ofWide.contactBlocks;
    }
    return blocks;
}

#ifdef SWEPT_SIMD

/// Makes Highway choose one instruction set.
class WideContacts : public testing::TestWithParam<std::int64_t> {
protected:
    void SetUp() override { hwy::SetSupportedTargetsForTest(GetParam()); }
    void TearDown() override { hwy::SetSupportedTargetsForTest(0); }
};

TEST_P(WideContacts, GiveTheBitsOfContactsOneByOne) {
    if (contactKernels() == nullptr) {  // of the plain processor
        EXPECT_EQ(expectSameBits(1, 10), 0);
        return;
    }
    ASSERT_STREQ(contactKernels()->name, hwy::TargetName(GetParam()));
    EXPECT_GT(expectSameBits(1, 300), 300) << "too few blocks to prove anything";
    EXPECT_GT(expectSameBits(16, 60), 1'000);
}

INSTANTIATE_TEST_SUITE_P(OfThisMachine, WideContacts, testing::ValuesIn(hwy::SupportedAndGeneratedTargets()),
                         [](const auto& target) { return std::string(hwy::TargetName(target.param)); });

#endif

TEST(WideContact, BlocksAreLaidOutAlikeEverywhere) {
    EXPECT_EQ(sizeof(LaneArray), 32U);
    EXPECT_EQ(sizeof(WideContact<2>) - sizeof(WideContact<1>), sizeof(WideContactPoint));
    EXPECT_EQ(expectSameBits(4, 20) > 0, contactKernels() != nullptr);
}

}  // namespace
}  // namespace swept::test
