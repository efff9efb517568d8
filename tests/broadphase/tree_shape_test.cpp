#include <gtest/gtest.h>

#include <swept/broadphase/aabb_tree.h>

#include <bit>
#include <initializer_list>
#include <span>
#include <vector>

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

/// Of a tree built of boxes: every one is there as it was, below boxes that hold it.
void expectHolds(const AabbTree& tree, std::span<const Aabb> boxes) {
    ASSERT_EQ(tree.nodes().size(), boxes.empty() ? 0 : 2 * boxes.size() - 1);
    for (std::uint32_t i = 0; i < boxes.size(); ++i) {
        const TreeNode& leaf = tree.node(i);
        ASSERT_TRUE(leaf.isLeaf());
        EXPECT_EQ(leaf.slot(), i);
        EXPECT_FALSE(leaf.moved);
        NodeIndex above = i;
        while (tree.node(above).parent != kNoNode) {
            const NodeIndex child = above;
            above = tree.node(above).parent;
            EXPECT_TRUE(tree.node(above).child[0] == child || tree.node(above).child[1] == child);
            EXPECT_TRUE(contains(tree.node(above).box, boxes[i])) << "box " << i;
        }
        EXPECT_EQ(above, tree.root());
    }
}

TEST(TreeShape, BuiltAtOnceIsBalancedAndAsGoodAsGrown) {
    for (const std::size_t count : std::initializer_list<std::size_t>{0, 1, 2, 3, 7, 64, 1000, 4000}) {
        Random random(count);
        std::vector<Aabb> boxes;
        AabbTree grown;
        for (std::uint32_t i = 0; i < count; ++i) {
            boxes.push_back(boxAround(random.range(-100, 100), random.range(-100, 100), 0.5, 0.5));
            grown.insert(boxes.back(), i, false);
        }
        AabbTree built;
        built.insert(boxAround(0, 0, 1, 1), 5, true);  // what was there before goes
        built.build(boxes);
        expectHolds(built, boxes);
        if (count < 2) { continue; }
        EXPECT_EQ(heightOf(built), leastHeight(count)) << count;
        EXPECT_LE(relativeCost(built), 1.25 * relativeCost(grown)) << count;
    }
}

TEST(TreeShape, BuiltAtOnceOfWhatIsAllInOnePlace) {
    const std::vector<Aabb> boxes(777, boxAround(3, 4, 1, 1));
    AabbTree tree;
    tree.build(boxes);
    expectHolds(tree, boxes);
    EXPECT_EQ(heightOf(tree), leastHeight(boxes.size()));
    // It lives on like any other.
    tree.move(5, boxAround(50, 4, 1, 1));
    tree.erase(6);
    EXPECT_TRUE(tree.node(5).moved);
    EXPECT_TRUE(contains(tree.node(tree.root()).box, boxAround(50, 4, 1, 1)));
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
