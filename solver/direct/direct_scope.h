#pragma once

#include <cstddef>
#include <cstdint>

#include "../../shapes/real.h"

namespace swept::inline SWEPT_PRECISION {

/// What is solved all at once.
enum class DirectScope : std::uint8_t {
    none,
    islands,            ///< islands of rigid joints and nothing else, each on its own (`JointIslands`)
    islandsWithDrives,  ///< likewise, where hinges, sliders and wheels may have springs, limits and motors, and
                        ///< welds springs that hold their angle
    softJoints,         ///< nothing, as long as there are no contacts; but drives are halved as with `freeJoints`
    freeJoints,         ///< what joints hold rigidly, as long as there are no contacts
    joints,             ///< what joints hold rigidly
    jointed,            ///< that, always: contacts are iterated on what answers as the joints hold it together
    all,                ///< what joints hold rigidly, and all contacts
};

/// Whether motors are rows of that solve.
constexpr bool holdsDrives(DirectScope scope) {
    return scope == DirectScope::freeJoints || scope == DirectScope::joints || scope == DirectScope::jointed;
}

/// Whether joints are solved all at once and contacts one by one, so that they take turns.
constexpr bool takesTurns(DirectScope scope, bool hasContacts) { return scope == DirectScope::joints && hasContacts; }

/// Whether scope `jointed` is worth its time: each contact is answered by every body, twice in a sub-step.
constexpr bool mayBeJointed(std::size_t contacts, std::size_t bodies) { return contacts * bodies <= 512; }

}  // namespace swept::inline SWEPT_PRECISION
