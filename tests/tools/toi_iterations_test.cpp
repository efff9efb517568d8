#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include <swept/tools/toi/toi_families.h>

namespace swept {
namespace {

double turnOf(const ToiQuery& query) {
    return std::max(std::fabs(query.sweepA.a1 - query.sweepA.a0), std::fabs(query.sweepB.a1 - query.sweepB.a0));
}

int percentile(std::vector<int>& sorted, double part) {
    return sorted[static_cast<std::size_t>(part * static_cast<double>(sorted.size()))];
}

// What bounds the work of a step: distances per query, over all families together, by how far the bodies turn.
TEST(ToiIterations, StayFewHoweverFarTheBodiesTurn) {
    constexpr std::uint64_t kSeed = 5;
    constexpr std::uint64_t kCount = 2000;
    std::array<std::vector<int>, 2> counts;  // up to π/4; up to π
    int turning = 0;
    int beyond = 0;
    for (const ToiFamily family : kToiFamilies) {
        for (std::uint64_t i = 0; i < kCount; ++i) {
            ToiQuery query = makeToiCase(family, kSeed, i);
            query.settings.detail = ToiDetail::event;
            const Toi toi = timeOfImpact(query.a, query.sweepA, query.b, query.sweepB, query.settings);
            const double turn = turnOf(query);
            if (turn <= std::numbers::pi) {
                counts[turn <= std::numbers::pi / 4 ? 0 : 1].push_back(toi.iterations);
            } else {
                ++turning;
                beyond += toi.iterations > 6 + 4 * turn / (2 * std::numbers::pi) ? 1 : 0;
            }
        }
    }
    for (std::vector<int>& bucket : counts) {
        ASSERT_GT(bucket.size(), 5000u);
        std::sort(bucket.begin(), bucket.end());
    }
    EXPECT_LE(percentile(counts[0], 0.99), 5) << "seed " << kSeed;
    EXPECT_LE(percentile(counts[0], 0.999), 15) << "seed " << kSeed;
    EXPECT_LE(percentile(counts[1], 0.99), 10) << "seed " << kSeed;
    EXPECT_LE(percentile(counts[1], 0.999), 20) << "seed " << kSeed;
    ASSERT_GT(turning, 2000);
    EXPECT_LE(beyond, turning / 1000) << "seed " << kSeed;
}

}  // namespace
}  // namespace swept
