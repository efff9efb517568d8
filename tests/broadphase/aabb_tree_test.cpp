#include <gtest/gtest.h>

#include <swept/broadphase/aabb_tree.h>

#include "model.h"

namespace swept::test {
namespace {

/// Checks a subtree and counts its leaves.
std::size_t expectSound(const AabbTree& tree, NodeIndex index, NodeIndex parent) {
    const TreeNode& node = tree.node(index);
    EXPECT_EQ(node.parent, parent);
    if (node.isLeaf()) {
        EXPECT_EQ(node.height, 0);
        EXPECT_EQ(node.shallowest, 0);
        return 1;
    }
    const TreeNode& a = tree.node(node.child[0]);
    const TreeNode& b = tree.node(node.child[1]);
    EXPECT_EQ(node.box, hullOf(a.box, b.box)) << "inner boxes are exact hulls";
    EXPECT_EQ(node.height, 1 + std::max(a.height, b.height));
    EXPECT_EQ(node.shallowest, 1 + std::min(a.shallowest, b.shallowest));
    EXPECT_EQ(node.moved, a.moved || b.moved);
    return expectSound(tree, node.child[0], index) + expectSound(tree, node.child[1], index);
}

void expectSound(const AabbTree& tree, std::size_t leafCount) {
    if (leafCount == 0) {
        EXPECT_EQ(tree.root(), kNoTreeNode);
        return;
    }
    EXPECT_EQ(expectSound(tree, tree.root(), kNoTreeNode), leafCount);
    EXPECT_LE(int{tree.node(tree.root()).height}, kMaxTreeHeight);
    EXPECT_LE(tree.nodes().size(), 4 * leafCount + 1000) << "freed nodes are used again";
}

class Tree : public testing::TestWithParam<Family> {};

TEST_P(Tree, IsSoundAfterEveryCall) {
    Random random(400 + static_cast<std::uint64_t>(GetParam()));
    AabbTree tree;
    std::vector<NodeIndex> leaves;
    std::uint32_t nextSlot = 0;
    for (int i = 0; i < 3000; ++i) {
        const double choice = random.uniform();
        // Grows first, then shrinks to nothing again.
        const double insertShare = i < 1500 ? 0.4 : 0.1;
        if (choice < insertShare) {
            leaves.push_back(tree.insert(randomBox(GetParam(), random), nextSlot++, random.chance(0.5)));
        } else if (leaves.empty()) {
            continue;
        } else {
            const std::size_t at = below(random, static_cast<std::uint32_t>(leaves.size()));
            if (choice < insertShare + 0.2) {
                tree.erase(leaves[at]);
                leaves.erase(leaves.begin() + static_cast<std::ptrdiff_t>(at));
            } else if (choice < 0.9) {
                const std::uint32_t slot = tree.node(leaves[at]).slot();
                const Aabb box =
                    random.chance(0.2) ? randomBox(GetParam(), random) : shifted(tree.node(leaves[at]).box, random);
                tree.move(leaves[at], box);
                ASSERT_EQ(tree.node(leaves[at]).slot(), slot) << "a leaf keeps its index";
                ASSERT_EQ(tree.node(leaves[at]).box, box);
                ASSERT_TRUE(tree.node(leaves[at]).moved);
            } else {
                for (const NodeIndex leaf : leaves) { tree.clearMoved(leaf); }
                if (!leaves.empty()) { ASSERT_FALSE(tree.node(tree.root()).moved); }
            }
        }
        expectSound(tree, leaves.size());
        if (HasFailure()) { FAIL() << GetParam() << " call " << i; }
    }
}

INSTANTIATE_TEST_SUITE_P(AllFamilies, Tree, testing::ValuesIn(kFamilies),
                         [](const testing::TestParamInfo<Family>& family) { return nameOf(family.param); });

}  // namespace
}  // namespace swept::test
