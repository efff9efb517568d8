#pragma once

#include <cstdint>
#include <vector>

#include "../../shapes/cache_line.h"
#include "../../shapes/listed_members.h"

namespace swept {

/// Set of pairs of shape slots: open addressing, linear probing, backward-shift deletion. Only looked up, never
/// iterated, so its order cannot leak into results. Grows to the largest number of pairs seen and stays there.
class PairTable {
public:
    /// @return false when it was there already. Order of the two does not matter.
    bool insert(std::uint32_t a, std::uint32_t b) {
        if (2 * (size_ + 1) > keys_.size()) { grow(); }
        std::size_t place = home(keyOf(a, b));
        while (keys_[place] != kEmpty) {
            if (keys_[place] == keyOf(a, b)) { return false; }
            place = (place + 1) & mask();
        }
        keys_[place] = keyOf(a, b);
        ++size_;
        return true;
    }

    void erase(std::uint32_t a, std::uint32_t b) {
        if (keys_.empty()) { return; }
        std::size_t hole = home(keyOf(a, b));
        while (keys_[hole] != keyOf(a, b)) {
            if (keys_[hole] == kEmpty) { return; }
            hole = (hole + 1) & mask();
        }
        --size_;
        for (std::size_t next = (hole + 1) & mask(); keys_[next] != kEmpty; next = (next + 1) & mask()) {
            const std::size_t wanted = home(keys_[next]);
            // An entry may fill the hole unless its home lies cyclically behind the hole.
            if (((next - wanted) & mask()) >= ((next - hole) & mask())) {
                keys_[hole] = keys_[next];
                hole = next;
            }
        }
        keys_[hole] = kEmpty;
    }

    /// Before one of the others: asks for the memory where the pair would be.
    void fetch(std::uint32_t a, std::uint32_t b) const {
        if (!keys_.empty()) { prefetch(&keys_[home(keyOf(a, b))]); }
    }

    std::size_t size() const { return size_; }

    /// The same number for either order of the two, and another one for each pair.
    static std::uint64_t keyOf(std::uint32_t a, std::uint32_t b) {
        return a < b ? (std::uint64_t{a} << 32) | b : (std::uint64_t{b} << 32) | a;
    }

    /// All of it (shapes/listed_members.h).
    template <class Self>
    static constexpr auto allMembers(Self& self) {
        return listed(self.keys_, self.size_);
    }

private:
    static constexpr std::uint64_t kEmpty = ~std::uint64_t{0};
    static constexpr std::size_t kFirstCapacity = 64;

    std::size_t mask() const { return keys_.size() - 1; }
    /// Multiplicative hashing by the golden ratio (Knuth).
    std::size_t home(std::uint64_t key) const {
        return static_cast<std::size_t>((key * 0x9E3779B97F4A7C15ULL) >> 32) & mask();
    }
    void grow() {
        std::vector<std::uint64_t> old(keys_.empty() ? kFirstCapacity : 2 * keys_.size(), kEmpty);
        old.swap(keys_);
        for (const std::uint64_t key : old) {
            if (key == kEmpty) { continue; }
            std::size_t place = home(key);
            while (keys_[place] != kEmpty) { place = (place + 1) & mask(); }
            keys_[place] = key;
        }
    }

    std::vector<std::uint64_t> keys_;  ///< size is a power of two, at most half full
    std::size_t size_ = 0;
};

}  // namespace swept
