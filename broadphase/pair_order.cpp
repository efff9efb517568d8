#include "pair_order.h"

#include <algorithm>

namespace swept::inline SWEPT_PRECISION {
namespace {

/// First slots per block of a parallel loop.
constexpr std::size_t kSlotGrain = 1024;

}  // namespace

void PairOrder::sort(std::vector<ProxyPair>& pairs, std::uint32_t slotCount, TaskSystem& loops) {
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
    // A range of first slots ends where `starts_` of its last one says now.
    loops.run(slotCount, kSlotGrain, [&](std::size_t begin, std::size_t end, int) {
        std::uint32_t first = begin > 0 ? starts_[begin - 1] : 0;
        const std::uint32_t rangeBegin = first;
        for (std::size_t slot = begin; slot < end; ++slot) {
            const std::uint32_t last = starts_[slot];
            if (last - first > 1) {
                std::sort(sorted_.begin() + first, sorted_.begin() + last,
                          [](const ProxyPair& p, const ProxyPair& q) { return p.b < q.b; });
            }
            first = last;
        }
        std::copy(sorted_.begin() + rangeBegin, sorted_.begin() + first, pairs.begin() + rangeBegin);
    });
}

}  // namespace swept::inline SWEPT_PRECISION
