#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "../../shapes/manifold.h"
#include "touching.h"

namespace swept::inline SWEPT_PRECISION {

/// Two contacts of a body whose outermost points stand in one of them for a solve (flush_landings.h).
struct MergedContact {
    std::uint32_t contact = 0;     ///< the one in which both stand, place in `WorldState::contacts`
    std::uint32_t other = 0;       ///< whose point the second one is
    std::size_t point = 0;         ///< which of its points the first one is
    std::size_t pointOfOther = 0;  ///< likewise
    bool wasPressed = false;       ///< the contact, by the step before
    bool wasOtherPressed = false;
    Manifold before;  ///< of the contact
};

/// A point of a contact with ground, as seen along that.
struct LandingPoint {
    Real place = 0;       ///< along the ground, from the centre of the body, metres
    Real separation = 0;  ///< metres
    Real slack = 0;       ///< what makes no difference there, metres
    std::uint32_t contact = 0;
    std::uint32_t point = 0;  ///< of the contact
};

/// Of this step: what comes down on ground in several pieces (flush_landings.h).
struct Landings {
    std::vector<TouchingPair> meeting;    ///< a body and something that does not yield, which may meet in the step
    std::vector<TouchingPair> pairs;      ///< all such pairs of these bodies, as far as they may be merged
    std::vector<std::uint8_t> areTheirs;  ///< scratch, by slot: it is one of these bodies; none is between steps
    std::vector<MergedContact> merged;    ///< each contact once
    std::vector<std::uint32_t> leftOut;   ///< contacts that the solve does without, in order
    std::vector<LandingPoint> points;     ///< scratch
    std::size_t eventsBefore = 0;         ///< of the step, until the solve
};

}  // namespace swept::inline SWEPT_PRECISION
