#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "../shapes/aabb.h"
#include "../shapes/copied_atomic.h"
#include "../shapes/short_lock.h"
#include "wide_tree.h"

namespace swept::inline SWEPT_PRECISION {

/// A copy of a tree in disorder (`WideTree::isDisordered`), rebuilt: made by the first query that comes before the
/// rebuild that is due, so that a level that was just loaded is not searched box by box. The tree itself stays as it
/// is: no query changes what a world goes on with. Queries may run at the same time; who comes while the copy is being
/// made waits, so that each makes the same tests whoever is first.
class OrderedTree {
public:
    OrderedTree() = default;
    /// Copies make their own. (The other one may be at work just now.)
    OrderedTree(const OrderedTree& /*other*/) {}
    OrderedTree& operator=(const OrderedTree&) = delete;
    ~OrderedTree() = default;

    /// Where queries look for what is in a tree: there itself, unless it is in disorder.
    /// @param slots  more than any of its proxies has
    const WideTree& of(const WideTree& tree, std::size_t slots) const {
        return tree.isDisordered() ? made(tree, slots) : tree;
    }

    // What changes in the tree changes here too, if anything is: who asks after each of many calls has it made anew as
    // rarely as the tree would be rebuilt.
    void insert(std::uint32_t slot, const Aabb& box) {
        if (isMade()) { insertHere(slot, box); }
    }
    void remove(std::uint32_t slot) {
        if (isMade()) { tree_.remove(places_[slot]); }
        noteChange();
    }
    void move(std::uint32_t slot, const Aabb& box) {
        if (isMade()) { moveHere(slot, box); }
    }
    /// That is nothing to queries.
    void noteChange() { isChanged_ = true; }
    /// Before others.
    void drop() {
        if (isMade()) { clear(); }
    }
    /// The tree is about to be rebuilt: that was done already where nothing changed since.
    /// @return whether the tree is in order now
    bool giveTo(WideTree& tree, std::span<std::uint32_t> places) { return isMade() && give(tree, places); }
    std::size_t memoryBytes() const;

private:
    bool isMade() const { return isMade_.load(std::memory_order_relaxed); }
    const WideTree& made(const WideTree& tree, std::size_t slots) const;
    void insertHere(std::uint32_t slot, const Aabb& box);
    void moveHere(std::uint32_t slot, const Aabb& box);
    bool give(WideTree& tree, std::span<std::uint32_t> places);
    void clear();

    mutable ShortLock making_;
    mutable CopiedAtomic<bool> isMade_ = false;
    mutable bool isChanged_ = false;  // since it was made
    mutable WideTree tree_;
    mutable std::vector<std::uint32_t> places_;  // in it, by slot
};

}  // namespace swept::inline SWEPT_PRECISION
