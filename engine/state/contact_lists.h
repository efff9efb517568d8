#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "../../shapes/raw_vector.h"

namespace swept::inline SWEPT_PRECISION {

/// The contacts that a step has something to do for, as found in one pass over their probes: all others, most of them,
/// are not asked again. Each list is ascending, however many threads found it.
struct ContactLists {
    RawVector<std::uint32_t> noted;      ///< probes: near, passing, asleep with points, or boxes apart
    RawVector<std::uint32_t> near;       ///< of these, probes whose contacts get manifolds
    RawVector<std::uint32_t> ground;     ///< contacts of these, in the same order, that are not `isPlain`
    std::vector<std::uint32_t> passing;  ///< of these, probes of pairs that pass each other (told by `collideContacts`)
    RawVector<std::uint32_t> apart;      ///< of these, probes whose boxes are apart

    /// Of a block of probes: how many are in each list.
    struct Counts {
        std::uint32_t noted = 0;
        std::uint32_t near = 0;
        std::uint32_t ground = 0;
        std::uint32_t apart = 0;
    };
    std::vector<Counts> counts;  ///< scratch, by block

    /// Of the noted ones, one whose probe does not tell all.
    struct Other {
        std::uint32_t probe = 0;
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
