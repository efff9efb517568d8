#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

namespace swept {

/// Lets a vector hold `count` items without asking for memory, and grows it as `push_back` does, so that many calls
/// cost little. What has to happen as a whole, or not at all when memory runs out, asks for all its room first.
template <class T>
void makeRoom(std::vector<T>& items, std::size_t count) {
    if (count > items.capacity()) { items.reserve((std::max)(count, 2 * items.capacity())); }
}

}  // namespace swept
