#include "ordered_tree.h"

#include <new>
#include <utility>

#include "proxy_table.h"

namespace swept::inline SWEPT_PRECISION {

const WideTree& OrderedTree::made(const WideTree& tree, std::size_t slots) const {
    if (isMade_.load(std::memory_order_acquire)) { return tree_; }
    const HeldLock lock(making_);
    if (isMade_.load(std::memory_order_relaxed)) { return tree_; }
    try {
        places_.resize(slots);
        tree_ = tree;
        tree_.putInOrder(places_);
    } catch (const std::bad_alloc&) {
        return tree;  // slow, but a query refuses nothing
    }
    isChanged_ = false;
    isMade_.store(true, std::memory_order_release);
    return tree_;
}

void OrderedTree::insertHere(std::uint32_t slot, const Aabb& box) {
    if (tree_.isDisordered()) { return clear(); }
    try {
        if (slot >= places_.size()) { places_.resize(slot + 1); }
        tree_.insert(slot, box, places_);
        isChanged_ = true;
    } catch (const std::bad_alloc&) { clear(); }
}

void OrderedTree::moveHere(std::uint32_t slot, const Aabb& box) {
    try {
        tree_.move(places_[slot], box);
        isChanged_ = true;
    } catch (const std::bad_alloc&) { clear(); }
}

bool OrderedTree::give(WideTree& tree, std::span<std::uint32_t> places) {
    const bool isGood = !isChanged_;
    if (isGood) {
        std::swap(tree, tree_);
        for (const std::uint32_t slot : tree.allSlots()) {
            if (slot != kNoSlot) { places[slot] = places_[slot]; }
        }
    }
    clear();
    return isGood;
}

void OrderedTree::clear() {
    isMade_.store(false, std::memory_order_relaxed);
    tree_ = {};
    places_ = {};
}

std::size_t OrderedTree::memoryBytes() const {
    const HeldLock lock(making_);
    return tree_.memoryBytes() + bytesOf(places_);
}

}  // namespace swept::inline SWEPT_PRECISION
