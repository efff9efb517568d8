#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "../../shapes/raw_vector.h"
#include "../../shapes/real.h"

namespace swept::inline SWEPT_PRECISION {

/// The contacts that a step has something to do for, as found in one pass over their probes: all others, most of them,
/// are not asked again. Each list is ascending, however many threads found it.
struct ContactLists {
    /// Filled by `listContacts`: indices of probes that are near, passing, asleep with points, or whose boxes are
    /// apart. `listTouching` goes through them.
    RawVector<std::uint32_t> noted;
    /// By `listContacts`: those of `noted` that are near. Their contacts get new manifolds.
    RawVector<std::uint32_t> near;
    /// By `listContacts`: indices of the contacts (not probes) of those of `near` that are not `isPlain`, in their
    /// order. Chains let them through (chain_passage.h), and ghosts are dropped among them (ghosts.h).
    RawVector<std::uint32_t> ground;
    /// By `noticeContacts`: those of `noted` that `collideContacts` found to pass each other. For hemmed_pairs.h.
    std::vector<std::uint32_t> passing;
    /// By `listContacts`: those of `noted` whose boxes are apart. Their contacts end.
    RawVector<std::uint32_t> apart;

    /// Of a block of probes: how many are in each list.
    struct Counts {
        std::uint32_t noted = 0;
        std::uint32_t near = 0;
        std::uint32_t ground = 0;
        std::uint32_t apart = 0;
    };
    std::vector<Counts> counts;  ///< scratch, by block

    /// Of the noted ones, one whose probe does not tell all, so that its contact has to be asked. By `listTouching`,
    /// for `noticeContacts`.
    struct Other {
        std::uint32_t probe = 0;  ///< index
        std::uint32_t place = 0;  ///< in `WorldState::touching`, that waits for it while these are listed by block
    };
    RawVector<Other> others;
    /// Of a block of noted ones: how many are listed.
    struct Listed {
        std::uint32_t pairs = 0;
        std::uint32_t others = 0;
    };
    std::vector<Listed> listed;      ///< scratch, by block
    std::size_t listedPerBlock = 1;  ///< noted ones
    bool isAnyFree = false;          ///< some place that waited has no points

    /// Of all lists that are made of the noted ones. A step that has nothing to list must not find those of another.
    void clear() {
        near.clear();
        ground.clear();
        passing.clear();
        apart.clear();
    }
};

}  // namespace swept::inline SWEPT_PRECISION
