#include <gtest/gtest.h>
#include <swept/solver/graph/island_finder.h>

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

#include "../support/random.h"

namespace swept::test {
namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

/// Lowest member that can be reached, by spreading it along all edges until nothing changes.
std::vector<std::uint32_t> lowestReachable(std::size_t count, const std::vector<Edge>& edges) {
    std::vector<std::uint32_t> lowest(count);
    for (std::size_t i = 0; i < count; ++i) { lowest[i] = static_cast<std::uint32_t>(i); }
    for (bool changed = true; changed;) {
        changed = false;
        for (const auto& [a, b] : edges) {
            const std::uint32_t least = std::min(lowest[a], lowest[b]);
            changed = changed || lowest[a] != least || lowest[b] != least;
            lowest[a] = lowest[b] = least;
        }
    }
    return lowest;
}

TEST(IslandFinder, RootIsTheLowestReachableMemberInAnyOrder) {
    IslandFinder finder;
    std::size_t islands = 0;
    std::size_t joined = 0;
    for (std::uint64_t seed = 0; seed < 2'000; ++seed) {
        Random random(seed);
        const int count = random.integer(1, 80);
        const int edgeCount = random.integer(0, 80);
        std::vector<Edge> edges;
        for (int i = 0; i < edgeCount; ++i) {
            edges.emplace_back(static_cast<std::uint32_t>(random.integer(0, count - 1)),
                               static_cast<std::uint32_t>(random.integer(0, count - 1)));
        }
        const std::vector<std::uint32_t> wanted = lowestReachable(static_cast<std::size_t>(count), edges);
        for (int order = 0; order < 3; ++order) {
            finder.reset(static_cast<std::size_t>(count));
            for (const auto& [a, b] : edges) { finder.unite(a, b); }
            for (std::size_t i = 0; i < wanted.size(); ++i) {
                ASSERT_EQ(finder.find(static_cast<std::uint32_t>(i)), wanted[i])
                    << "seed " << seed << " order " << order;
            }
            for (std::size_t i = edges.size(); i > 1; --i) {
                std::swap(edges[i - 1], edges[static_cast<std::size_t>(random.integer(0, static_cast<int>(i) - 1))]);
            }
            for (Edge& edge : edges) {
                if (random.chance(0.5)) { std::swap(edge.first, edge.second); }
            }
        }
        islands += std::set<std::uint32_t>(wanted.begin(), wanted.end()).size();
        joined += wanted.size();
    }
    EXPECT_GT(islands, 10'000U);
    EXPECT_GT(joined, 2 * islands);
}

/// Whether few or most are united, and whoever was the time before.
TEST(IslandFinder, ResetForFewForgetsAll) {
    IslandFinder finder;
    IslandFinder other;
    std::size_t count = 0;
    std::size_t few = 0;
    for (std::uint64_t seed = 0; seed < 3'000; ++seed) {
        Random random(seed);
        count += static_cast<std::size_t>(random.integer(0, 2));
        std::vector<std::uint32_t> united;
        const double share = random.chance(0.5) ? 0.01 : 0.3;
        for (std::uint32_t i = 0; i < count; ++i) {
            if (random.chance(share)) { united.push_back(i); }
        }
        const int edgeCount = united.empty() ? 0 : random.integer(0, 40);
        std::vector<Edge> edges;
        const auto anyone = [&] {
            return united[static_cast<std::size_t>(random.integer(0, static_cast<int>(united.size()) - 1))];
        };
        for (int i = 0; i < edgeCount; ++i) { edges.emplace_back(anyone(), anyone()); }
        finder.reset(count, united);
        for (const auto& [a, b] : edges) { finder.unite(a, b); }
        other.reset(count, united);
        other.uniteAs(finder);
        const std::vector<std::uint32_t> wanted = lowestReachable(count, edges);
        for (std::uint32_t i = 0; i < count; ++i) {
            ASSERT_EQ(finder.find(i), wanted[i]) << "seed " << seed;
            ASSERT_EQ(other.find(i), wanted[i]) << "seed " << seed;
        }
        few += !edges.empty() && 8 * united.size() < count ? 1 : 0;
    }
    EXPECT_GT(few, 1'000U);
    EXPECT_LT(few, 2'000U);
}

TEST(IslandFinder, ResetForgets) {
    IslandFinder finder;
    finder.reset(3);
    finder.unite(2, 0);
    EXPECT_EQ(finder.find(2), 0U);
    finder.reset(3);
    EXPECT_EQ(finder.find(2), 2U);
}

}  // namespace
}  // namespace swept::test
