#pragma once

#include <cstring>
#include <span>

#include "contact.h"

namespace swept::inline SWEPT_PRECISION {

/// `overlaps` with all four comparisons at once: of tens of thousands of pairs in a step, most of whose boxes overlap
/// along one axis and not along the other, the branches after each of them were mispredicted.
inline bool overlapAtOnce(const Aabb& a, const Aabb& b) {
    typedef Real Lanes [[gnu::vector_size(4 * sizeof(Real))]];
    Lanes boxA;
    Lanes boxB;
    std::memcpy(&boxA, &a, sizeof(Lanes));
    std::memcpy(&boxB, &b, sizeof(Lanes));
    const auto isBelow =
        __builtin_shufflevector(boxA, boxB, 0, 1, 4, 5) <= __builtin_shufflevector(boxB, boxA, 2, 3, 6, 7);
    std::uint64_t words[sizeof(isBelow) / sizeof(std::uint64_t)];
    std::memcpy(words, &isBelow, sizeof(isBelow));
    std::uint64_t all = ~std::uint64_t{0};
    for (const std::uint64_t word : words) { all &= word; }
    return all == ~std::uint64_t{0};
}

/// Whether the boxes of a pair overlap. @param boxes  by proxy
inline bool boxesOverlap(std::span<const Aabb> boxes, const ContactPair& pair) {
    return overlapAtOnce(boxes[static_cast<std::size_t>(pair.proxyA)], boxes[static_cast<std::size_t>(pair.proxyB)]);
}

}  // namespace swept::inline SWEPT_PRECISION
