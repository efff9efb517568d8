#include "pair_order.h"

#include <algorithm>

namespace swept::inline SWEPT_PRECISION {

void PairOrder::sort(std::vector<ProxyPair>& pairs, std::uint32_t slotCount) {
    // Counting by the first slot is linear in pairs and slots: not worth it when there are far fewer pairs than slots.
    constexpr std::size_t kSlotsPerPair = 8;
    if (pairs.size() < slotCount / kSlotsPerPair) {
        std::sort(pairs.begin(), pairs.end());
        return;
    }
    starts_.assign(std::size_t{slotCount} + 1, 0);
    for (const ProxyPair& pair : pairs) { ++starts_[static_cast<std::size_t>(pair.a) + 1]; }
    for (std::size_t i = 1; i < starts_.size(); ++i) { starts_[i] += starts_[i - 1]; }
    if (sorted_.capacity() < pairs.capacity()) { sorted_.reserve(pairs.capacity()); }
    sorted_.resize(pairs.size());
    for (const ProxyPair& pair : pairs) { sorted_[starts_[static_cast<std::size_t>(pair.a)]++] = pair; }
    auto first = sorted_.begin();
    while (first != sorted_.end()) {
        const auto last = std::find_if(first, sorted_.end(), [&](const ProxyPair& pair) { return pair.a != first->a; });
        std::sort(first, last, [](const ProxyPair& p, const ProxyPair& q) { return p.b < q.b; });
        first = last;
    }
    std::copy(sorted_.begin(), sorted_.end(), pairs.begin());
}

}  // namespace swept::inline SWEPT_PRECISION
