#pragma once

#include <array>
#include <cstddef>
#include <utility>

#include "aabb_tree.h"
#include "table_broadphase.h"

namespace swept::inline SWEPT_PRECISION {

/// A stack of fixed size for walks through trees.
template <class T, std::size_t kCapacity>
class WalkStack {
public:
    bool empty() const { return size_ == 0; }
    void push(const T& item) { items_[size_++] = item; }
    T pop() { return items_[--size_]; }

private:
    std::array<T, kCapacity> items_;  // not cleared: a walk pays only for what it uses
    std::size_t size_ = 0;
};

// Walks pop one entry and push at most two that lie one level lower: at most one entry per level stays behind.
inline constexpr std::size_t kOneTreeStack = kMaxTreeHeight + 2;
inline constexpr std::size_t kTwoTreeStack = 2 * kMaxTreeHeight + 2;

/// Calls `visit(slot)` for each leaf whose box overlaps, until it returns false. Returns the number of box tests;
/// `goOn` tells whether the walk came to its end.
template <class Visit>
std::uint64_t walkOverlaps(const AabbTree& tree, const Aabb& box, bool& goOn, const Visit& visit) {
    if (tree.root() == kNoTreeNode) { return 0; }
    std::uint64_t tests = 1;
    WalkStack<NodeIndex, kOneTreeStack> stack;
    if (overlaps(tree.node(tree.root()).box, box)) { stack.push(tree.root()); }
    while (!stack.empty()) {
        const TreeNode& node = tree.node(stack.pop());
        if (node.isLeaf()) {
            goOn = visit(node.slot());
            if (!goOn) { return tests; }
            continue;
        }
        tests += 2;
        for (const NodeIndex child : node.child) {
            if (overlaps(tree.node(child).box, box)) { stack.push(child); }
        }
    }
    return tests;
}

/// Shows each leaf that the sweep meets, near subtrees first, until the visit is over.
inline void walkSweep(const AabbTree& tree, SweepVisit& visit) {
    struct Entry {
        NodeIndex index;
        double touch;
    };
    if (tree.root() == kNoTreeNode) { return; }
    WalkStack<Entry, kOneTreeStack> stack;
    const auto entryOf = [&](NodeIndex i) { return Entry{i, visit.touch(tree.node(i).box)}; };
    if (const Entry root = entryOf(tree.root()); root.touch != BoxSweep::kNever) { stack.push(root); }
    while (!stack.empty()) {
        const Entry entry = stack.pop();
        if (entry.touch > visit.limit()) { continue; }  // the limit has become smaller since
        const TreeNode& node = tree.node(entry.index);
        if (node.isLeaf()) {
            visit.show(node.slot());
            if (visit.isOver()) { return; }
            continue;
        }
        Entry closer = entryOf(node.child[0]);
        Entry farther = entryOf(node.child[1]);
        if (farther.touch < closer.touch) { std::swap(closer, farther); }
        if (farther.touch != BoxSweep::kNever) { stack.push(farther); }
        if (closer.touch != BoxSweep::kNever) { stack.push(closer); }
    }
}

/// Calls `report(slot, slot)` for each pair of overlapping leaves, one below `a`, the other below `b` (nodes of two
/// trees, or of one tree and neither above the other), of which at least one has moved. Returns the number of box
/// tests.
template <class Report>
std::uint64_t joinNodes(const AabbTree& treeA, NodeIndex a, const AabbTree& treeB, NodeIndex b, const Report& report) {
    struct Entry {
        NodeIndex a;
        NodeIndex b;
    };
    std::uint64_t tests = 0;
    WalkStack<Entry, kTwoTreeStack> stack;
    const auto consider = [&](NodeIndex i, NodeIndex j) {
        const TreeNode& nodeA = treeA.node(i);
        const TreeNode& nodeB = treeB.node(j);
        if (!nodeA.moved && !nodeB.moved) { return; }
        ++tests;
        if (!overlaps(nodeA.box, nodeB.box)) { return; }
        if (nodeA.isLeaf() && nodeB.isLeaf()) {
            report(nodeA.slot(), nodeB.slot());
        } else {
            stack.push({i, j});
        }
    };
    consider(a, b);
    while (!stack.empty()) {
        const Entry entry = stack.pop();
        const TreeNode& nodeA = treeA.node(entry.a);
        const TreeNode& nodeB = treeB.node(entry.b);
        if (nodeA.height >= nodeB.height) {  // the higher one is not a leaf
            for (const NodeIndex child : nodeA.child) { consider(child, entry.b); }
        } else {
            for (const NodeIndex child : nodeB.child) { consider(entry.a, child); }
        }
    }
    return tests;
}

/// Calls `report(slot, slot)` for each pair of overlapping leaves of one tree of which at least one has moved: they
/// part at just one inner node, so each is found by joining that node's two children.
template <class Report>
std::uint64_t joinWithin(const AabbTree& tree, const Report& report) {
    if (tree.root() == kNoTreeNode) { return 0; }
    std::uint64_t tests = 0;
    WalkStack<NodeIndex, kOneTreeStack> stack;
    stack.push(tree.root());
    while (!stack.empty()) {
        const TreeNode& node = tree.node(stack.pop());
        if (!node.moved || node.isLeaf()) { continue; }
        tests += joinNodes(tree, node.child[0], tree, node.child[1], report);
        for (const NodeIndex child : node.child) { stack.push(child); }
    }
    return tests;
}

}  // namespace swept::inline SWEPT_PRECISION
