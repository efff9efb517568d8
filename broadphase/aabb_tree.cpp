#include "aabb_tree.h"

#include <algorithm>
#include <cassert>

namespace swept::inline SWEPT_PRECISION {

namespace {

/// An eighth of the perimeter, which cannot overflow for any finite box; the unit of all costs here.
Real costOf(const Aabb& box) {
    constexpr Real kEighth = Real(0.125);
    return (kEighth * box.upper.x - kEighth * box.lower.x) + (kEighth * box.upper.y - kEighth * box.lower.y);
}

std::uint8_t oneMoreThan(std::uint8_t height) { return static_cast<std::uint8_t>(height + 1); }

}  // namespace

NodeIndex AabbTree::insert(const Aabb& box, std::uint32_t slot, bool moved) {
    const NodeIndex leaf = allocate();
    TreeNode& node = nodes_[leaf];
    node.box = box;
    node.child = {kNoTreeNode, slot};
    node.moved = moved;
    attach(leaf);
    return leaf;
}

void AabbTree::erase(NodeIndex leaf) {
    detach(leaf);
    release(leaf);
}

void AabbTree::clear() {
    nodes_.clear();
    root_ = firstFree_ = kNoTreeNode;
}

void AabbTree::move(NodeIndex leaf, const Aabb& box) {
    TreeNode& node = nodes_[leaf];
    const NodeIndex parent = node.parent;
    const NodeIndex grandparent = parent == kNoTreeNode ? kNoTreeNode : nodes_[parent].parent;
    // A short way leaves the leaf where it is: cheaper than a search, and the rotations above keep the tree good. What
    // leaves its grandparent's box is at home somewhere else.
    if (parent == kNoTreeNode || (grandparent != kNoTreeNode && contains(nodes_[grandparent].box, box)) ||
        contains(nodes_[parent].box, box)) {
        node.box = box;
        markUpward(leaf);
        repairUpward(parent);
        return;
    }
    detach(leaf);
    nodes_[leaf].box = box;
    nodes_[leaf].moved = true;
    attach(leaf);
}

void AabbTree::clearMoved(NodeIndex leaf) {
    for (NodeIndex i = leaf; i != kNoTreeNode && nodes_[i].moved; i = nodes_[i].parent) { nodes_[i].moved = false; }
}

NodeIndex AabbTree::allocate() {
    if (firstFree_ == kNoTreeNode) {
        nodes_.emplace_back();
        return static_cast<NodeIndex>(nodes_.size() - 1);
    }
    const NodeIndex index = firstFree_;
    firstFree_ = nodes_[index].parent;
    nodes_[index] = TreeNode{};
    return index;
}

void AabbTree::release(NodeIndex index) {
    nodes_[index].parent = firstFree_;
    firstFree_ = index;
}

void AabbTree::attach(NodeIndex leaf) {
    if (root_ == kNoTreeNode) {
        root_ = leaf;
        nodes_[leaf].parent = kNoTreeNode;
        return;
    }
    const NodeIndex sibling = chooseSibling(nodes_[leaf].box);
    const NodeIndex joined = allocate();
    const NodeIndex above = nodes_[sibling].parent;
    nodes_[joined].parent = above;
    nodes_[joined].child = {sibling, leaf};
    nodes_[sibling].parent = joined;
    nodes_[leaf].parent = joined;
    replaceChild(above, sibling, joined);
    repairUpward(joined);
    assert(nodes_[root_].height <= kMaxTreeHeight && "chooseSibling keeps the height");
}

void AabbTree::detach(NodeIndex leaf) {
    const NodeIndex parent = nodes_[leaf].parent;
    if (parent == kNoTreeNode) {
        root_ = kNoTreeNode;
        return;
    }
    const std::array<NodeIndex, 2> children = nodes_[parent].child;
    const NodeIndex sibling = children[0] == leaf ? children[1] : children[0];
    const NodeIndex above = nodes_[parent].parent;
    nodes_[sibling].parent = above;
    replaceChild(above, parent, sibling);
    release(parent);
    repairUpward(above);
}

void AabbTree::replaceChild(NodeIndex parent, NodeIndex before, NodeIndex after) {
    if (parent == kNoTreeNode) {
        root_ = after;
        return;
    }
    std::array<NodeIndex, 2>& child = nodes_[parent].child;
    child[child[0] == before ? 0 : 1] = after;
}

/// Where a new leaf adds least to the sum of perimeters. A greedy walk: it goes down as long as the lower bound of what
/// can be found below is not worse than stopping here. Where bounds are equal (all boxes in one place), the lower
/// subtree is taken, which keeps the tree balanced.
NodeIndex AabbTree::chooseSibling(const Aabb& box) const {
    const Real boxCost = costOf(box);
    NodeIndex index = root_;
    Real inherited = 0;  // what the ancestors of `index` grow by
    for (int depth = 0; !nodes_[index].isLeaf(); ++depth) {
        const TreeNode& node = nodes_[index];
        const Real joinedCost = costOf(hullOf(node.box, box));
        const Real stopHere = inherited + joinedCost;
        inherited += joinedCost - costOf(node.box);

        std::array<Real, 2> bound = {};
        std::array<bool, 2> hasRoom = {};
        for (std::size_t side = 0; side < 2; ++side) {
            const TreeNode& child = nodes_[node.child[side]];
            const Real childJoined = costOf(hullOf(child.box, box));
            bound[side] = inherited + (child.isLeaf() ? childJoined : boxCost + (childJoined - costOf(child.box)));
            hasRoom[side] = depth + 1 + child.shallowest + 1 <= kMaxTreeHeight;
        }
        std::size_t best = 0;
        if (hasRoom[0] != hasRoom[1]) {
            best = hasRoom[1] ? 1 : 0;
        } else if (bound[0] != bound[1]) {
            best = bound[1] < bound[0] ? 1 : 0;
        } else {
            best = nodes_[node.child[1]].height < nodes_[node.child[0]].height ? 1 : 0;
        }
        const bool mayStop = depth + node.height + 1 <= kMaxTreeHeight;
        if (mayStop && (stopHere < bound[best] || !hasRoom[best])) { break; }
        index = node.child[best];
    }
    return index;
}

/// Makes a node the sum of its children.
void AabbTree::pull(NodeIndex index) {
    TreeNode& node = nodes_[index];
    const TreeNode& a = nodes_[node.child[0]];
    const TreeNode& b = nodes_[node.child[1]];
    node.box = hullOf(a.box, b.box);
    node.height = oneMoreThan(std::max(a.height, b.height));
    node.shallowest = oneMoreThan(std::min(a.shallowest, b.shallowest));
    node.moved = a.moved || b.moved;
}

/// Swaps a child (`outer`) with a grandchild below the other child (`inner`) where that shrinks `inner` most, or leaves
/// its perimeter as it is and makes the tree lower. Never makes it higher.
///
///     node ── outer                      node ── leaving
///       └─── inner ── leaving     →        └─── inner ── outer
///              └───── staying                     └───── staying
void AabbTree::rotate(NodeIndex index) {
    const TreeNode& node = nodes_[index];
    Real bestSaving = 0;
    int bestHeight = node.height;
    std::array<std::size_t, 2> best = {2, 2};  // side of inner, side of leaving
    for (std::size_t side = 0; side < 2; ++side) {
        const TreeNode& inner = nodes_[node.child[side]];
        if (inner.isLeaf()) { continue; }
        const TreeNode& outer = nodes_[node.child[1 - side]];
        const Real innerCost = costOf(inner.box);
        for (std::size_t leavingSide = 0; leavingSide < 2; ++leavingSide) {
            const TreeNode& leaving = nodes_[inner.child[leavingSide]];
            const TreeNode& staying = nodes_[inner.child[1 - leavingSide]];
            const Real saving = innerCost - costOf(hullOf(outer.box, staying.box));
            const int newHeight = 1 + std::max<int>(leaving.height, 1 + std::max(outer.height, staying.height));
            if (newHeight > node.height) { continue; }
            if (saving > bestSaving || (saving == bestSaving && newHeight < bestHeight)) {
                bestSaving = saving;
                bestHeight = newHeight;
                best = {side, leavingSide};
            }
        }
    }
    if (best[0] == 2) { return; }
    const NodeIndex innerIndex = node.child[best[0]];
    const NodeIndex outerIndex = node.child[1 - best[0]];
    const NodeIndex leavingIndex = nodes_[innerIndex].child[best[1]];
    nodes_[index].child[1 - best[0]] = leavingIndex;
    nodes_[leavingIndex].parent = index;
    nodes_[innerIndex].child[best[1]] = outerIndex;
    nodes_[outerIndex].parent = innerIndex;
    pull(innerIndex);
    pull(index);
}

/// Brings a node and all above it up to date; ends early where nothing changes any more.
void AabbTree::repairUpward(NodeIndex index) {
    while (index != kNoTreeNode) {
        const TreeNode before = nodes_[index];
        pull(index);
        rotate(index);
        const TreeNode& after = nodes_[index];
        if (before.box == after.box && before.height == after.height && before.shallowest == after.shallowest &&
            before.moved == after.moved) {
            return;
        }
        index = after.parent;
    }
}

/// A marked node has only marked ones above it, so the walk ends at the first.
void AabbTree::markUpward(NodeIndex leaf) {
    for (NodeIndex i = leaf; i != kNoTreeNode && !nodes_[i].moved; i = nodes_[i].parent) { nodes_[i].moved = true; }
}

}  // namespace swept::inline SWEPT_PRECISION
