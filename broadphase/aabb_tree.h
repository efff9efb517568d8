#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "../shapes/aabb.h"
#include "../shapes/listed_members.h"

namespace swept::inline SWEPT_PRECISION {

/// Place of a node in its tree.
using NodeIndex = std::uint32_t;
inline constexpr NodeIndex kNoTreeNode = (std::numeric_limits<NodeIndex>::max)();

/// No tree is ever higher, whatever is put into it in whatever order, so that walks need no more than a fixed stack.
/// The shallowest leaf of 2³² leaves lies at most 32 deep: there is always a place for one more.
inline constexpr int kMaxTreeHeight = 62;

struct TreeNode {
    Aabb box;
    NodeIndex parent = kNoTreeNode;
    std::array<NodeIndex, 2> child = {kNoTreeNode, 0};  ///< a leaf has no first child; its second is the proxy slot
    std::uint8_t height = 0;                            ///< edges to the deepest leaf below
    std::uint8_t shallowest = 0;                        ///< edges to the shallowest leaf below
    bool moved = false;                                 ///< whether some leaf below has moved

    bool isLeaf() const { return child[0] == kNoTreeNode; }
    std::uint32_t slot() const { return child[1]; }
};
static_assert(sizeof(TreeNode) <= 64, "a node is read in one cache line");

/// A dynamic tree of boxes. Each inner box is exactly the hull of its two children's; leaves hold the boxes as given.
///
/// Insertion descends to where the sum of perimeters grows least (the surface area heuristic in two dimensions:
/// Goldsmith and Salmon, "Automatic creation of object hierarchies for ray tracing", 1987), and on the way back up
/// swaps a node with a grandchild where that makes the sum smaller (tree rotations: Kopta et al., "Fast, effective BVH
/// updates for animated scenes", 2012). Both only choose among shapes that keep `kMaxTreeHeight`.
///
/// Leaves keep their index until they are erased.
class AabbTree {
public:
    /// @param moved  whether the leaf starts marked as moved.
    NodeIndex insert(const Aabb& box, std::uint32_t slot, bool moved);
    void erase(NodeIndex leaf);
    /// Keeps its capacity.
    void clear();
    /// Replaces the box of a leaf and marks it as moved.
    void move(NodeIndex leaf, const Aabb& box);
    /// Takes the mark from a leaf, and from all above that have no marked leaf left if this is called for every one.
    void clearMoved(NodeIndex leaf);

    NodeIndex root() const { return root_; }
    const TreeNode& node(NodeIndex index) const { return nodes_[index]; }
    /// All nodes, free ones included.
    std::span<const TreeNode> nodes() const { return nodes_; }
    std::size_t memoryBytes() const { return nodes_.capacity() * sizeof(TreeNode); }

    /// All of it (shapes/listed_members.h).
    template <class Self>
    static constexpr auto allMembers(Self& self) {
        return listed(self.nodes_, self.root_, self.firstFree_);
    }

private:
    NodeIndex allocate();
    void release(NodeIndex index);
    void attach(NodeIndex leaf);
    void detach(NodeIndex leaf);
    NodeIndex chooseSibling(const Aabb& box) const;
    void replaceChild(NodeIndex parent, NodeIndex before, NodeIndex after);
    void pull(NodeIndex index);
    void rotate(NodeIndex index);
    void repairUpward(NodeIndex index);
    void markUpward(NodeIndex leaf);

    std::vector<TreeNode> nodes_;
    NodeIndex root_ = kNoTreeNode;
    NodeIndex firstFree_ = kNoTreeNode;  // free nodes are chained through `parent`
};

}  // namespace swept::inline SWEPT_PRECISION
