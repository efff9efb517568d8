#pragma once

#include <algorithm>
#include <vector>

namespace swept {

/// Keeps the order of equals. For few items, or such as are nearly in order: std::stable_sort asks for memory.
template <class Item, class IsLess>
void sortFew(std::vector<Item>& items, const IsLess& isLess) {
    for (auto at = items.begin(); at != items.end(); ++at) {
        std::rotate(std::upper_bound(items.begin(), at, *at, isLess), at, at + 1);
    }
}

}  // namespace swept
