#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include <swept/engine/containers/key_sort.h>
#include <swept/shapes/bit_cast.h>

#include "../support/random.h"

/// Sorting by keys of 64 bits, against the standard library.

namespace swept::test {
namespace {

struct KeyedItem {
    std::uint64_t key;
    std::uint32_t index;
    bool operator==(const KeyedItem&) const = default;
};

/// The kinds of keys that the engine has, and the ends of the range.
std::uint64_t keyOfKind(Random& random, int kind) {
    switch (kind) {
        case 0:
            return 42;
        case 1:
            return static_cast<std::uint64_t>(random.integer(0, 9));
        case 2:
            return random.bits();
        case 3:
            return bitCast<std::uint64_t>(random.uniform());
        case 4:
            return static_cast<std::uint64_t>(random.integer(0, 2000)) << 11U | random.bits() >> 53U;
        default:
            return random.chance(0.5) ? random.bits() >> 60U : ~(random.bits() >> 60U);
    }
}

TEST(KeySort, DoesAsTheStandardLibrary) {
    Random random(20'261'122);
    std::vector<KeyedItem> spare;
    for (const int count : {0, 1, 2, 63, 64, 65, 300, 5000}) {
        for (int kind = 0; kind < 6; ++kind) {
            std::vector<KeyedItem> items;
            for (int i = 0; i < count; ++i) {
                items.push_back({keyOfKind(random, kind), static_cast<std::uint32_t>(random.bits() >> 32U)});
            }
            std::vector<KeyedItem> expected = items;
            const auto isLess = [](const KeyedItem& a, const KeyedItem& b) { return a.index > b.index; };
            std::sort(expected.begin(), expected.end(), [&](const KeyedItem& a, const KeyedItem& b) {
                return a.key != b.key ? a.key < b.key : isLess(a, b);
            });
            sortByKeys(items, spare, isLess);
            EXPECT_TRUE(items == expected) << count << " items, keys of kind " << kind;
        }
    }
}

}  // namespace
}  // namespace swept::test
