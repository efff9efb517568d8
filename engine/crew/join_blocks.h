#pragma once

#include <algorithm>
#include <cstddef>

#include "../../shapes/raw_vector.h"

namespace swept {

/// Puts what several workers listed by blocks side by side: each wrote the items of its block from where the first one
/// would be if all blocks were full.
/// @param perBlock  items of a full block
/// @param countOf  called with the number of a block: how many items it has
template <class Item, class CountOf>
void joinBlocks(RawVector<Item>& list, std::size_t blocks, std::size_t perBlock, const CountOf& countOf) {
    auto end = list.begin();
    for (std::size_t block = 0; block < blocks; ++block) {
        const auto first = list.begin() + static_cast<std::ptrdiff_t>(block * perBlock);
        const auto count = static_cast<std::ptrdiff_t>(countOf(block));
        end = first == end ? first + count : std::copy_n(first, count, end);
    }
    list.erase(end, list.end());
}

}  // namespace swept
