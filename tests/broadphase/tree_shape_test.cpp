#include <gtest/gtest.h>

#include <swept/broadphase/aabb_tree.h>

#include <bit>

#include "model.h"

namespace swept::test {
namespace {

int heightOf(const AabbTree& tree) { return tree.node(tree.root()).height; }

/// Height of a perfectly balanced tree.
int leastHeight(std::size_t leafCount) { return static_cast<int>(std::bit_width(leafCount - 1)); }

/// Sum of inner perimeters over the root's: what a random query pays, up to a factor.
double relativeCost(const AabbTree& tree) {
    double sum = 0;
    std::vector<NodeIndex> open = {tree.root()};
    while (!open.empty()) {
        const TreeNode& node = tree.node(open.back());
        open.pop_back();
        if (node.isLeaf()) { continue; }
        sum += static_cast<double>(perimeter(node.box));
        open.insert(open.end(), node.child.begin(), node.child.end());
    }
    return sum / static_cast<double>(perimeter(tree.node(tree.root()).box));
}

TEST(TreeShape, StaysLowOverScatteredBoxes) {
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
        Random random(seed);
        AabbTree tree;
        constexpr std::size_t kCount = 4000;
        for (std::uint32_t i = 0; i < kCount; ++i) {
            tree.insert(boxAround(random.range(-100, 100), random.range(-100, 100), 0.5, 0.5), i, true);
        }
        EXPECT_LE(heightOf(tree), 2 * leastHeight(kCount)) << "seed " << seed;
    }
}

TEST(TreeShape, StaysLowOverARowInOrder) {
    // The order in which levels are written: the worst for a tree without rotations.
    AabbTree tree;
    constexpr std::size_t kCount = 4096;
    for (std::uint32_t i = 0; i < kCount; ++i) { tree.insert(boxAround(i, 0, 0.5, 0.5), i, true); }
    EXPECT_LE(heightOf(tree), 2 * leastHeight(kCount));
}

TEST(TreeShape, IsBalancedWhereAllBoxesAreTheSame) {
    AabbTree tree;
    constexpr std::size_t kCount = 4096;
    for (std::uint32_t i = 0; i < kCount; ++i) { tree.insert(boxAround(3, 4, 1, 1), i, true); }
    EXPECT_LE(heightOf(tree), leastHeight(kCount) * 3 / 2);
}

TEST(TreeShape, NeverExceedsTheBoundAndThereIsAlwaysRoom) {
    // Each box much larger than all before: on top of the root is the best place for every one of them.
    AabbTree tree;
    int highest = 0;
    for (std::uint32_t i = 0; i < 5000; ++i) {
        const double half = std::ldexp(1.0, static_cast<int>(i % 120) - 60);
        tree.insert(boxAround(0, 0, half, half), i, true);
        highest = std::max(highest, heightOf(tree));
        ASSERT_LE(heightOf(tree), kMaxTreeHeight);
    }
    EXPECT_EQ(highest, kMaxTreeHeight) << "the case should reach the bound";
}

TEST(TreeShape, DoesNotDecayWhileEverythingMoves) {
    Random random(9);
    constexpr std::size_t kCount = 2000;
    std::vector<Aabb> boxes;
    AabbTree drifted;
    std::vector<NodeIndex> leaves;
    for (std::uint32_t i = 0; i < kCount; ++i) {
        boxes.push_back(boxAround(random.range(-50, 50), random.range(-50, 50), 0.5, 0.5));
        leaves.push_back(drifted.insert(boxes.back(), i, true));
    }
    std::vector<DVec2> velocity;
    for (std::size_t i = 0; i < kCount; ++i) { velocity.push_back({random.range(-1, 1), random.range(-1, 1)}); }
    for (int step = 0; step < 200; ++step) {
        for (std::size_t i = 0; i < kCount; ++i) {
            const DVec2 by = velocity[i];
            const Aabb& box = boxes[i];
            boxes[i] = {{box.lower.x + static_cast<Real>(by.x), box.lower.y + static_cast<Real>(by.y)},
                        {box.upper.x + static_cast<Real>(by.x), box.upper.y + static_cast<Real>(by.y)}};
            drifted.move(leaves[i], boxes[i]);
        }
    }
    AabbTree fresh;
    for (std::uint32_t i = 0; i < kCount; ++i) { fresh.insert(boxes[i], i, true); }
    EXPECT_LE(relativeCost(drifted), 1.3 * relativeCost(fresh));
    EXPECT_LE(heightOf(drifted), 2 * leastHeight(kCount) + 4);
}

}  // namespace
}  // namespace swept::test
