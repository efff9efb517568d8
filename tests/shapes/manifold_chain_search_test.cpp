#include <gtest/gtest.h>

#include <cmath>

#include <swept/shapes/manifold_parts.h>

#include "chain_queries.h"
#include "same_bits.h"

/// What chain segments are asked without a search is what the search finds, bit for bit.

namespace swept {
namespace {

void expectSameBits(const Manifold& m, const Manifold& searched) {
    ASSERT_EQ(m.count, searched.count);
    if (m.count == 0) { return; }
    ASSERT_TRUE(sameBits(m.normal, searched.normal));
    ASSERT_EQ(m.isNormalOfB, searched.isNormalOfB);
    for (std::size_t i = 0; i < static_cast<std::size_t>(m.count); ++i) {
        ASSERT_EQ(m.points[i].id, searched.points[i].id);
        ASSERT_TRUE(sameBits(m.points[i].point, searched.points[i].point));
        ASSERT_TRUE(sameBits(m.points[i].separation, searched.points[i].separation));
    }
}

TEST(ChainWithoutSearch, GivesTheBitsOfTheSearch) {
    constexpr std::uint32_t kQueries = 60'000;
    constexpr std::uint32_t kOfOneSeed = 100;  // a seed takes longer than a query
    std::uint32_t withOne = 0;
    std::uint32_t withTwo = 0;
    std::uint32_t crossing = 0;
    Chance chance(0);
    for (std::uint32_t i = 0; i < kQueries; ++i) {
        if (i % kOfOneSeed == 0) { chance = Chance(i / kOfOneSeed); }
        const chains::ChainQuery q = chains::someChainQuery(chance);
        const Manifold m = collide(q.segment, q.shape, q.pose, q.margin);
        expectSameBits(m, collideChainBySearch(q.segment, q.shape, q.pose, q.margin));
        ASSERT_FALSE(testing::Test::HasFatalFailure()) << "query " << i;
        withOne += m.count == 1 ? 1U : 0U;
        withTwo += m.count == 2 ? 1U : 0U;
        crossing += m.count > 0 && deepestSeparation(m) < -q.segment.radius - q.shape.radius ? 1U : 0U;
    }
    EXPECT_GT(withOne, kQueries / 10);
    EXPECT_GT(withTwo, kQueries / 20);
    EXPECT_GT(crossing, kQueries / 20);
}

/// At a flat seam what is beyond the end by rounding counts as over the segment; not what is then out of reach.
TEST(ChainWithoutSearch, ReachesNoFartherThanTheSearchBeyondASeam) {
    const ChainSegment segment{.before = {-8, 0}, .p = {0, 0}, .q = {8, 0}, .after = {16, 0}, .hasBefore = true};
    // Leans over the seam at 45°: farther away than its lower end is high.
    const Polygon stick = makeSegment({0, 0}, {1, -1}, 8 * kEpsilon).value();
    for (const Real beyond : {Real(2), Real(10)}) {
        const Transform pose{{-beyond * kEpsilon, -4 * kEpsilon}, {}};
        const Manifold m = collide(segment, stick, pose, 0);
        EXPECT_EQ(m.count, beyond + 4 < 8 * std::sqrt(2.0) ? 1 : 0) << beyond << " roundings beyond the end";
        expectSameBits(m, collideChainBySearch(segment, stick, pose, 0));
    }
}

}  // namespace
}  // namespace swept
