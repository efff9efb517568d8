#pragma once

#include <cstring>
#include <span>

#include "../../shapes/lanes.h"
#include "../state/contact.h"

namespace swept::inline SWEPT_PRECISION {

/// `overlaps` with all four comparisons at once: of tens of thousands of pairs in a step, most of whose boxes overlap
/// along one axis and not along the other, the branches after each of them were mispredicted. A template, since only
/// one of the two layouts compiles.
template <typename T>
bool overlapAtOnce(const Aabb& a, const Aabb& b) {
    using Lanes = LanesOf<T, 16 / sizeof(T)>;
    if constexpr (sizeof(Lanes) == sizeof(Aabb)) {
        Lanes boxA;
        Lanes boxB;
        std::memcpy(&boxA, &a, sizeof(Lanes));
        std::memcpy(&boxB, &b, sizeof(Lanes));
        return holdsInAll(shuffled<0, 1, 4, 5>(boxA, boxB) <= shuffled<2, 3, 6, 7>(boxB, boxA));
    } else {
        Lanes lowerA;
        Lanes upperA;
        Lanes lowerB;
        Lanes upperB;
        std::memcpy(&lowerA, &a.lower, sizeof(Lanes));
        std::memcpy(&upperA, &a.upper, sizeof(Lanes));
        std::memcpy(&lowerB, &b.lower, sizeof(Lanes));
        std::memcpy(&upperB, &b.upper, sizeof(Lanes));
        return holdsInAll((lowerA <= upperB) & (lowerB <= upperA));
    }
}

/// Whether the boxes of a pair overlap. @param boxes  by proxy
inline bool boxesOverlap(std::span<const Aabb> boxes, const ContactPair& pair) {
    return overlapAtOnce<Real>(boxes[static_cast<std::size_t>(pair.proxyA)],
                               boxes[static_cast<std::size_t>(pair.proxyB)]);
}

}  // namespace swept::inline SWEPT_PRECISION
