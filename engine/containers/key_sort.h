#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "../../shapes/real.h"

namespace swept::inline SWEPT_PRECISION {

/// Sorts items by `key` (64 bits), and those of the same key by `isLess`. Radix sort by the upper 16 of the bits in
/// which keys differ (two passes of counting), which parts nearly all; a comparison sort ends it among what has these
/// in common. Processors cannot foresee comparisons of what is in no order: each that goes wrong costs as much as
/// fifteen instructions.
/// @param spare  scratch, kept by the caller for its capacity
template <class Item, class IsLess>
void sortByKeys(std::vector<Item>& items, std::vector<Item>& spare, const IsLess& isLess) {
    constexpr std::size_t kFew = 64;  // to count in 512 counters takes longer
    constexpr int kDigitBits = 8;
    constexpr std::size_t kDigits = std::size_t{1} << kDigitBits;
    const auto isBefore = [&isLess](const Item& a, const Item& b) {
        return a.key != b.key ? a.key < b.key : isLess(a, b);
    };
    if (items.size() < kFew) {
        std::sort(items.begin(), items.end(), isBefore);
        return;
    }
    std::uint64_t differences = 0;
    for (const Item& item : items) { differences |= item.key ^ items.front().key; }
    const int shift = std::max(0, static_cast<int>(std::bit_width(differences)) - 2 * kDigitBits);
    const auto digit = [shift](const Item& item, int place) {
        return static_cast<std::size_t>(item.key >> (shift + place * kDigitBits)) % kDigits;
    };
    std::array<std::array<std::uint32_t, kDigits>, 2> places{};
    for (const Item& item : items) {
        ++places[0][digit(item, 0)];
        ++places[1][digit(item, 1)];
    }
    spare.resize(items.size());
    for (int place = 0; place < 2; ++place) {
        std::uint32_t begin = 0;
        for (std::uint32_t& count : places[static_cast<std::size_t>(place)]) {
            const std::uint32_t next = begin + count;
            count = begin;
            begin = next;
        }
        for (const Item& item : items) { spare[places[static_cast<std::size_t>(place)][digit(item, place)]++] = item; }
        items.swap(spare);
    }
    for (auto first = items.begin(); first != items.end();) {
        auto last = first + 1;
        while (last != items.end() && last->key >> shift == first->key >> shift) { ++last; }
        if (last - first > 1) { std::sort(first, last, isBefore); }
        first = last;
    }
}

}  // namespace swept::inline SWEPT_PRECISION
