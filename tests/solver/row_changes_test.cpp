#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>
#include <random>
#include <vector>

#include <swept/solver/direct/row_changes.h>

namespace swept::test {
namespace {

/// A damper between two nodes.
struct Row {
    std::uint32_t a = 0;
    std::uint32_t b = 0;
    Block3 ofA{};
    Block3 ofB{};
};

double within(std::mt19937& random, double most) {
    std::uniform_real_distribution<double> uniform(-most, most);
    return uniform(random);
}

Block3 anyBlock(std::mt19937& random) {
    const double x = within(random, 1);
    const double y = within(random, 1);
    return {x, y, within(random, 1)};
}

/// Bricks of a wall, each tied to the next one and to two above.
std::vector<Row> wallRows(std::uint32_t width, std::uint32_t height, std::mt19937& random) {
    std::vector<Row> rows;
    const auto tie = [&](std::uint32_t a, std::uint32_t b) {
        const Block3 ofA = anyBlock(random);
        rows.push_back({a, b, ofA, anyBlock(random)});
    };
    for (std::uint32_t y = 0; y < height; ++y) {
        for (std::uint32_t x = 0; x < width; ++x) {
            const std::uint32_t brick = y * width + x;
            if (x + 1 < width) { tie(brick, brick + 1); }
            if (y + 1 < height) { tie(brick, brick + width); }
            if (y + 1 < height && x + 1 < width) { tie(brick, brick + width + 1); }
        }
    }
    return rows;
}

/// Unit masses and the rows that are held.
void factorise(BlockLdlt& matrix, std::uint32_t nodes, const std::vector<Row>& rows, const std::vector<bool>& held,
               double k) {
    matrix.clear();
    for (std::uint32_t i = 0; i < nodes; ++i) { matrix.diagonal(i) = {1, 0, 0, 0, 1, 0, 0, 0, 1}; }
    for (std::size_t i = 0; i < rows.size(); ++i) {
        if (!held[i]) { continue; }
        const Row& row = rows[i];
        addOuter(matrix.diagonal(row.a), k, row.ofA, row.ofA);
        addOuter(matrix.diagonal(row.b), k, row.ofB, row.ofB);
        const BlockLdlt::OffDiagonal off = matrix.offDiagonal(row.a, row.b);
        addOuter(off.block, k, off.rowIsB ? row.ofB : row.ofA, off.rowIsB ? row.ofA : row.ofB);
    }
    matrix.factorise();
}

/// Rows come and go: the factor of before, and what changed, solve what a new factor does, up to 1e-12.
TEST(RowChanges, SolveAsANewFactorDoes) {
    std::mt19937 random(11);
    constexpr double kStrength = 1024;
    RowChanges changes;
    for (int sample = 0; sample < 60; ++sample) {
        const auto width = static_cast<std::uint32_t>(2 + random() % 8);
        const auto height = static_cast<std::uint32_t>(2 + random() % 8);
        const std::uint32_t nodes = width * height;
        const std::vector<Row> rows = wallRows(width, height, random);
        std::vector<BlockEdge> edges;
        std::vector<bool> held;
        for (const Row& row : rows) {
            edges.push_back({row.a, row.b});
            held.push_back(random() % 3 != 0);
        }
        BlockLdlt before;
        BlockLdlt after;
        const std::size_t most = std::size_t{nodes} * nodes;
        ASSERT_TRUE(before.analyse(nodes, edges, most) && after.analyse(nodes, edges, most));
        factorise(before, nodes, rows, held, kStrength);
        const NodeRange all{0, nodes};
        changes.clear();
        std::vector<std::size_t> places(rows.size());
        std::iota(places.begin(), places.end(), std::size_t{0});
        std::shuffle(places.begin(), places.end(), random);
        places.resize(std::min<std::size_t>(places.size(), 16));
        for (const std::size_t place : places) {
            held[place] = !held[place];
            const RowChanges::End ends[] = {{rows[place].a, rows[place].ofA}, {rows[place].b, rows[place].ofB}};
            changes.add(before, all, ends, held[place] ? kStrength : -kStrength);
        }
        factorise(after, nodes, rows, held, kStrength);
        std::vector<Block3> expected(nodes);
        for (Block3& block : expected) { block = anyBlock(random); }
        std::vector<Block3> found = expected;
        after.solve(expected);
        changes.solve(before, found, all);
        double largest = 0;
        double error = 0;
        for (std::uint32_t i = 0; i < nodes; ++i) {
            for (std::size_t c = 0; c < 3; ++c) {
                largest = std::max(largest, std::fabs(expected[i][c]));
                error = std::max(error, std::fabs(expected[i][c] - found[i][c]));
            }
        }
        EXPECT_LE(error, 1e-11 * largest) << "sample " << sample << ": " << width << " by " << height;
    }
}

}  // namespace
}  // namespace swept::test
