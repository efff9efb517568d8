#pragma once

#include <cstdint>

#include "../../shapes/vec2.h"

namespace swept::inline SWEPT_PRECISION {

/// How a chain of joints that drifts turns, before a solve and after it (adrift_chains.h).
struct ChainSpin {
    /// Of all of it. Relative to where its lowest body was before the solve.
    struct Whole {
        DVec2 center{};  ///< of mass, metres
        DVec2 velocity{};
    };
    bool isKept = true;         ///< nothing outside of it turns it
    bool touches = false;       ///< some of it touches something
    std::uint32_t members = 0;  ///< bodies of the chain, all of which have to be in the solve
    std::uint32_t bodies = 0;   ///< that are
    Vec2 acceleration{};        ///< of all of them alike
    double mass = 0;
    Whole before;
    Whole after;
    double inertia = 0;  ///< about its centre, after the solve
    double gained = 0;   ///< angular momentum about that, from nothing
};

}  // namespace swept::inline SWEPT_PRECISION
