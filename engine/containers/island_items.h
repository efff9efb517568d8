#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace swept {

/// Things of one kind by the island that they belong to: within an island in the order in which they were added. Sorted
/// by counting, since there may be thousands of both. Kept for its capacity.
class IslandItems {
public:
    struct Added {
        std::uint32_t island = 0;
        std::uint32_t item = 0;
    };

    void clear() { added_.clear(); }
    void add(std::uint32_t island, std::uint32_t item) { added_.push_back({island, item}); }
    void add(std::span<const Added> some) { added_.insert(added_.end(), some.begin(), some.end()); }
    /// Of all that was added since `clear`. @param islands  how many there are
    void sort(std::size_t islands) {
        begins_.assign(islands + 1, 0);
        for (const Added& one : added_) { ++begins_[one.island]; }
        std::uint32_t sum = 0;
        for (std::uint32_t& begin : begins_) {
            sum += begin;
            begin = sum;
        }
        // Each begin is still where its island ends: filled from behind, it comes to where it begins.
        items_.resize(added_.size());
        for (auto one = added_.rbegin(); one != added_.rend(); ++one) { items_[--begins_[one->island]] = one->item; }
    }
    /// @pre sorted
    std::span<const std::uint32_t> of(std::size_t island) const {
        return std::span(items_).subspan(begins_[island], begins_[island + 1] - begins_[island]);
    }

    /// Island after island. @pre likewise
    std::span<const std::uint32_t> all() const { return items_; }

private:
    std::vector<Added> added_;
    std::vector<std::uint32_t> begins_;  ///< by island, and the end of the last one
    std::vector<std::uint32_t> items_;
};

}  // namespace swept
