#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <vector>

#include "../../shapes/aabb.h"

namespace swept::inline SWEPT_PRECISION {

/// One of a few things in boxes. A box that is none must not be among them.
struct BoxedItem {
    Aabb box;
    std::uint32_t item = 0;
    bool asks = false;
};

/// Calls `visit(one, other)` for all pairs of items whose boxes overlap, if one of the two asks: that one first; if
/// both do, the lower one. Each pair once, in an order that the boxes and items tell. @param items  are sorted
template <class Visit>
void forEachOverlap(std::vector<BoxedItem>& items, const Visit& visit) {
    std::sort(items.begin(), items.end(), [](const BoxedItem& a, const BoxedItem& b) {
        return std::tie(a.box.lower.x, a.item) < std::tie(b.box.lower.x, b.item);
    });
    for (std::size_t i = 0; i < items.size(); ++i) {
        for (std::size_t j = i + 1; j < items.size() && items[j].box.lower.x <= items[i].box.upper.x; ++j) {
            const BoxedItem& a = items[i];
            const BoxedItem& b = items[j];
            if (!(a.asks || b.asks) || !overlaps(a.box, b.box)) { continue; }
            const bool isFirst = a.asks == b.asks ? a.item < b.item : a.asks;
            visit(isFirst ? a.item : b.item, isFirst ? b.item : a.item);
        }
    }
}

}  // namespace swept::inline SWEPT_PRECISION
