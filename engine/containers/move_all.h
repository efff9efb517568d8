#pragma once

#include <vector>

namespace swept {

/// To the end of another list; the one that they come from keeps its capacity.
template <class T>
void moveAll(std::vector<T>& all, std::vector<T>& some) {
    all.insert(all.end(), some.begin(), some.end());
    some.clear();
}

}  // namespace swept
