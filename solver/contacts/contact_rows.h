#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <span>

#include "../wide/wide_contacts.h"
#include "contact_row.h"

/// How contacts are laid into blocks, and impulses taken back from there, as many at a time as a register holds.

namespace swept::inline SWEPT_PRECISION {

/// What a block is filled from: its contacts, and where their bodies are. Of lanes that are not in use all is zero.
/// Slots and masses are in the block before.
struct alignas(kBlockBytes) ContactSources {
    LaneArray rotationC;  ///< of A
    LaneArray rotationS;
    LaneArray localCenterX;  ///< of A
    LaneArray localCenterY;
    LaneArray fromAToBX;  ///< from centre to centre, world
    LaneArray fromAToBY;
    LaneArray extent;  ///< `ContactRow::extent`
    std::array<const ContactRow*, kBlockLanes> rows;
};

/// What all contacts of a solve have in common.
struct ContactTerms {
    Real scale = 1;        ///< of the impulses that are kept
    Real pushRatio = 0;    ///< overlap of this part of its extent is pushed out in `closingTime`, at most
    Real closingTime = 0;  ///< s
    Real bounceSpeed = std::numeric_limits<Real>::infinity();  ///< of those with more than `kLivelyRestitution`, m/s
    Softness softness{};                                       ///< between two bodies that can be moved
    Softness groundSoftness{};                                 ///< of others
    bool settled = false;                                      ///< `SolverSettings::settled`
};

/// By point, one bit per lane. Of one point the second is 0.
using LanesByPoint = std::array<std::uint32_t, 2>;

/// Of one block each. Lanes in use are filled to the bit as by `fillLane`, others as contacts of the fixed world with
/// itself; then `closeBlock` and `prepareContact` are done, too.
struct ContactRowKernels {
    void (*fillOne)(WideContact<1>& block, const ContactSources& from, const ContactTerms& terms);
    void (*fillTwo)(WideContact<2>& block, const ContactSources& from, const ContactTerms& terms);
    /// Impulses of the last sub-step, not the totals. @param rows  of the lanes in use
    /// @return points whose totals are not 0
    LanesByPoint (*takeOne)(const WideContact<1>& block, std::span<ContactRow* const> rows, Real scale);
    LanesByPoint (*takeTwo)(const WideContact<2>& block, std::span<ContactRow* const> rows, Real scale);
};

/// Null where `contactKernels` is.
const ContactRowKernels* contactRowKernels();

}  // namespace swept::inline SWEPT_PRECISION
