#include <gtest/gtest.h>

#include <string>
#include <vector>

#include <swept/shapes/manifold_batch.h>
#ifdef SWEPT_SIMD
#include <swept/shapes/wide_targets.h>
// after it
#include <hwy/targets.h>

#include "chain_queries.h"
#include "same_bits.h"

/// Manifolds of a batch of chain segments are those of `collide`, one by one and bit for bit.

namespace swept {
namespace {

using chains::ChainQuery;

bool sameChainManifolds(const Manifold& p, const Manifold& q) {
    if (p.count != q.count || !sameBits(p.normal, q.normal) || p.isNormalOfB != q.isNormalOfB) { return false; }
    for (std::size_t i = 0; i < p.points.size(); ++i) {
        const ManifoldPoint& a = p.points[i];
        const ManifoldPoint& b = q.points[i];
        if (!sameBits(a.point, b.point) || !sameBits(a.separation, b.separation) || a.id != b.id) { return false; }
    }
    return true;
}

struct ChainTally {
    int queries = 0;
    int plain = 0;
    int withTwo = 0;
    int apart = 0;
    int left = 0;  ///< to the search
};

void compareChains(const std::vector<ChainQuery>& queries, ChainTally& tally) {
    std::vector<Polygon> cores;
    for (const ChainQuery& query : queries) { cores.push_back(polygonOf(query.segment)); }
    ManifoldBatch batch(PairKind::chain);
    ManifoldBatch other(PairKind::chain);
    for (std::size_t i = 0; i < queries.size(); ++i) {
        const ChainQuery& query = queries[i];
        const ManifoldBatch::Sizes sizes{cores[i].radius, query.shape.radius, 2,
                                         static_cast<std::uint8_t>(query.shape.count)};
        ManifoldBatch& half = i < (queries.size() + 1) / 2 ? batch : other;  // the second half comes from another batch
        half.add(query.segment, closedEndsOf(query.segment), cores[i], query.shape, sizes, query.pose,
                 {query.margin, query.margin});
    }
    batch.takeOver(other);
    ASSERT_EQ(batch.size(), queries.size());
    batch.collide();
    for (std::size_t i = 0; i < queries.size(); ++i) {
        const ChainQuery& query = queries[i];
        ManifoldMemory memoryOfOne;
        ManifoldMemory memory;
        const Manifold one = collide(query.segment, query.shape, query.pose, query.margin, memoryOfOne);
        Manifold lane;
        batch.takeManifold(i, memory, lane);
        ASSERT_TRUE(sameChainManifolds(lane, one))
            << "query " << i << ": " << lane.count << " points, not " << one.count;
        ASSERT_EQ(memory.verdict, memoryOfOne.verdict);
        const bool isApart = memory.verdict == ManifoldMemory::Verdict::apart;
        ASSERT_TRUE(!isApart || sameBits(memory.room, memoryOfOne.room));
        ++tally.queries;
        tally.plain += batch.isPlain(i) ? 1 : 0;
        tally.withTwo += batch.isPlain(i) && one.count == 2 ? 1 : 0;
        tally.apart += isApart ? 1 : 0;
        tally.left += batch.isLeft(i) ? 1 : 0;
    }
}

/// Makes Highway choose one instruction set.
class ChainBatches : public testing::TestWithParam<std::int64_t> {
protected:
    void SetUp() override { hwy::SetSupportedTargetsForTest(GetParam()); }
    void TearDown() override { hwy::SetSupportedTargetsForTest(0); }
};

TEST_P(ChainBatches, GiveTheBitsOfSegmentsOneByOne) {
    // manifold_batch_test.cpp says of which machines.
    if (!canCollideInBatches()) { GTEST_SKIP() << "this machine has none"; }
    for (const int most : {2, 4, kMaxPolygonVertices}) {
        ChainTally tally;
        for (std::uint32_t seed = 0; seed < 3000 && !HasFatalFailure(); ++seed) {
            Chance chance(seed);
            std::vector<ChainQuery> queries;
            const int size = 1 + chance.below(static_cast<int>(ManifoldBatch::kPairs));
            while (static_cast<int>(queries.size()) < size) {
                const ChainQuery query = chains::someChainQuery(chance);
                const bool isMeant = query.shape.count <= most && collidesInBatches(query.shape);
                if (isMeant && collidesInBatches(query.segment)) { queries.push_back(query); }
            }
            SCOPED_TRACE(seed);
            compareChains(queries, tally);
        }
        EXPECT_GT(tally.plain, tally.queries / 10) << "of at most " << most << " vertices";
        EXPECT_GT(tally.withTwo, tally.queries / 40);
        EXPECT_GT(tally.apart, tally.queries / 20);
        EXPECT_LT(tally.left, tally.queries / 2) << "cores that cross the segment, and open corners";
    }
}

INSTANTIATE_TEST_SUITE_P(OfThisMachine, ChainBatches, testing::ValuesIn(hwy::SupportedAndGeneratedTargets()),
                         [](const auto& target) { return std::string(hwy::TargetName(target.param)); });

}  // namespace
}  // namespace swept

#endif
