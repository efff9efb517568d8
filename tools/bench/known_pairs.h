#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace swept::bench {

/// The set in which other engines remember the pairs they have reported: open addressing with linear probing.
class KnownPairs {
public:
    bool contains(std::uint32_t a, std::uint32_t b) const {
        return !keys_.empty() && keys_[placeOf(keyOf(a, b))] != kEmpty;
    }

    /// @return false when it was there already
    bool insert(std::uint32_t a, std::uint32_t b) {
        if (2 * (size_ + 1) > keys_.size()) { grow(); }
        std::uint64_t& key = keys_[placeOf(keyOf(a, b))];
        if (key != kEmpty) { return false; }
        key = keyOf(a, b);
        ++size_;
        return true;
    }

    void erase(std::uint32_t a, std::uint32_t b) {
        if (!contains(a, b)) { return; }
        std::size_t hole = placeOf(keyOf(a, b));
        --size_;
        for (std::size_t next = (hole + 1) & mask(); keys_[next] != kEmpty; next = (next + 1) & mask()) {
            // An entry may fill the hole unless its home lies cyclically behind the hole.
            if (((next - home(keys_[next])) & mask()) >= ((next - hole) & mask())) {
                keys_[hole] = keys_[next];
                hole = next;
            }
        }
        keys_[hole] = kEmpty;
    }

    std::size_t memoryBytes() const { return keys_.capacity() * sizeof(std::uint64_t); }

private:
    static constexpr std::uint64_t kEmpty = ~std::uint64_t{0};
    static constexpr std::size_t kFirstCapacity = 64;

    static std::uint64_t keyOf(std::uint32_t a, std::uint32_t b) {
        return a < b ? (std::uint64_t{a} << 32) | b : (std::uint64_t{b} << 32) | a;
    }
    std::size_t mask() const { return keys_.size() - 1; }
    /// Multiplicative hashing by the golden ratio (Knuth).
    std::size_t home(std::uint64_t key) const {
        return static_cast<std::size_t>((key * 0x9E3779B97F4A7C15ULL) >> 32) & mask();
    }
    /// Where a key is, or would be.
    std::size_t placeOf(std::uint64_t key) const {
        std::size_t place = home(key);
        while (keys_[place] != kEmpty && keys_[place] != key) { place = (place + 1) & mask(); }
        return place;
    }
    void grow() {
        std::vector<std::uint64_t> old(keys_.empty() ? kFirstCapacity : 2 * keys_.size(), kEmpty);
        old.swap(keys_);
        for (const std::uint64_t key : old) {
            if (key != kEmpty) { keys_[placeOf(key)] = key; }
        }
    }

    std::vector<std::uint64_t> keys_;  // a power of two of them, at most half full
    std::size_t size_ = 0;
};

}  // namespace swept::bench
