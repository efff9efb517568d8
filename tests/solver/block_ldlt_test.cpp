#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>
#include <vector>

#include <swept/solver/direct/block_ldlt.h>

namespace swept::test {
namespace {

/// A random sparse matrix M + Σ k·jᵀj, whole and in blocks.
struct Sample {
    std::uint32_t nodes = 0;
    std::vector<BlockEdge> edges;
    std::vector<std::vector<double>> dense;

    std::size_t size() const { return 3 * std::size_t{nodes}; }
};

/// Every edge is a row over six coordinates, `stiffness` times as strong as the masses.
Sample makeSample(std::uint32_t nodes, const std::vector<BlockEdge>& edges, double stiffness, std::mt19937& random) {
    std::uniform_real_distribution<double> uniform(-1, 1);
    Sample sample{nodes, edges, {}};
    sample.dense.assign(sample.size(), std::vector<double>(sample.size(), 0));
    for (std::size_t i = 0; i < sample.size(); ++i) { sample.dense[i][i] = 1 + 0.5 * uniform(random); }
    for (const BlockEdge& edge : edges) {
        std::vector<std::pair<std::size_t, double>> row;
        for (std::size_t k = 0; k < 3; ++k) {
            row.emplace_back(3 * edge.a + k, uniform(random));
            row.emplace_back(3 * edge.b + k, uniform(random));
        }
        for (const auto& [i, x] : row) {
            for (const auto& [j, y] : row) { sample.dense[i][j] += stiffness * x * y; }
        }
    }
    return sample;
}

void fill(BlockLdlt& matrix, const Sample& sample) {
    const auto copy = [&](Block33& block, std::uint32_t row, std::uint32_t column) {
        for (std::size_t i = 0; i < 9; ++i) { block[i] = sample.dense[3 * row + i / 3][3 * column + i % 3]; }
    };
    matrix.clear();
    for (std::uint32_t i = 0; i < sample.nodes; ++i) { copy(matrix.diagonal(i), i, i); }
    for (const BlockEdge& edge : sample.edges) {
        const BlockLdlt::OffDiagonal off = matrix.offDiagonal(edge.a, edge.b);
        copy(off.block, off.rowIsB ? edge.b : edge.a, off.rowIsB ? edge.a : edge.b);
    }
}

/// Largest part of the right-hand side that the solution leaves, against what its terms add up to.
double residualOf(const Sample& sample, const std::vector<Block3>& solution, const std::vector<Block3>& right) {
    double worst = 0;
    for (std::size_t i = 0; i < sample.size(); ++i) {
        double sum = -right[i / 3][i % 3];
        double scale = std::fabs(sum);
        for (std::size_t j = 0; j < sample.size(); ++j) {
            const double term = sample.dense[i][j] * solution[j / 3][j % 3];
            sum += term;
            scale += std::fabs(term);
        }
        worst = std::max(worst, std::fabs(sum) / scale);
    }
    return worst;
}

std::vector<BlockEdge> randomEdges(std::uint32_t nodes, std::uint32_t count, std::mt19937& random) {
    std::vector<BlockEdge> edges;
    for (std::uint32_t i = 0; i < count; ++i) {
        const auto a = static_cast<std::uint32_t>(random() % nodes);
        const auto b = static_cast<std::uint32_t>(random() % nodes);
        if (a != b) { edges.push_back({a, b}); }
    }
    return edges;
}

TEST(BlockLdlt, SolvesRandomSystems) {
    std::mt19937 random(5);
    std::uniform_real_distribution<double> uniform(-1, 1);
    for (int i = 0; i < 200; ++i) {
        const auto nodes = static_cast<std::uint32_t>(1 + random() % 24);
        const double stiffness = std::exp2(static_cast<double>(random() % 30));
        const Sample sample = makeSample(nodes, randomEdges(nodes, 2 * nodes, random), stiffness, random);
        BlockLdlt matrix;
        ASSERT_TRUE(matrix.analyse(nodes, sample.edges, nodes * nodes));
        fill(matrix, sample);
        std::vector<Block3> right(nodes);
        for (Block3& block : right) { block = {uniform(random), uniform(random), uniform(random)}; }
        std::vector<Block3> solution = right;
        matrix.factorise();
        matrix.solve(solution);
        EXPECT_LE(residualOf(sample, solution, right), 1e-13) << "sample " << i << ", " << nodes << " nodes";
    }
}

TEST(BlockLdlt, TreesHaveNoFill) {
    std::mt19937 random(6);
    for (int i = 0; i < 50; ++i) {
        const auto nodes = static_cast<std::uint32_t>(2 + random() % 200);
        std::vector<BlockEdge> edges;
        for (std::uint32_t node = 1; node < nodes; ++node) {
            edges.push_back({node, static_cast<std::uint32_t>(random() % node)});
        }
        BlockLdlt matrix;
        ASSERT_TRUE(matrix.analyse(nodes, edges, nodes - 1)) << "sample " << i;
        EXPECT_EQ(matrix.blockCount(), nodes - 1) << "sample " << i;
    }
}

TEST(BlockLdlt, ARingHasOneBlockOfFillForEachNodeButThree) {
    constexpr std::uint32_t kNodes = 50;
    std::vector<BlockEdge> edges;
    for (std::uint32_t i = 0; i < kNodes; ++i) { edges.push_back({i, (i + 1) % kNodes}); }
    BlockLdlt matrix;
    ASSERT_TRUE(matrix.analyse(kNodes, edges, 10 * kNodes));
    EXPECT_EQ(matrix.blockCount(), kNodes + kNodes - 3);
}

TEST(BlockLdlt, RefusesMoreBlocksThanAllowedAndRecovers) {
    std::vector<BlockEdge> all;
    for (std::uint32_t i = 0; i < 10; ++i) {
        for (std::uint32_t k = 0; k < i; ++k) { all.push_back({i, k}); }
    }
    BlockLdlt matrix;
    EXPECT_FALSE(matrix.analyse(10, all, 44));
    EXPECT_FALSE(matrix.analyse(10, all, 44)) << "asked again";
    EXPECT_TRUE(matrix.analyse(10, all, 45)) << "as many as it takes";
    EXPECT_FALSE(matrix.analyse(10, all, 44));
    EXPECT_TRUE(matrix.analyse(10, std::vector<BlockEdge>(all.begin(), all.begin() + 9), 44));
    EXPECT_EQ(matrix.blockCount(), 9U);
}

}  // namespace
}  // namespace swept::test
