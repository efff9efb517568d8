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
    LaneArray extent;    ///< `ContactRow::extent`
    LaneArray approach;  ///< is found: how fast the points come near each other, m/s, at least 0
    std::array<const ContactRow*, kBlockLanes> rows;
    bool wantsApproach = false;  ///< else nobody asks for `approach`
};

/// What all contacts of a solve have in common.
struct ContactTerms {
    Real scale = 1;        ///< of the impulses that are kept
    Real pushRatio = 0;    ///< overlap of this part of its extent is pushed out in `closingTime`, at most
    Real closingTime = 0;  ///< s
    Real bounceSpeed = std::numeric_limits<Real>::infinity();  ///< of those with more than `kLivelyRestitution`, m/s
    Softness softness{};
    bool settled = false;  ///< `SolverSettings::settled`
};

/// Of one block each. Lanes in use are filled to the bit as by `fillLane`, others as contacts of the fixed world with
/// itself; then `closeBlock` and `prepareContact` are done, too.
struct ContactRowKernels {
    void (*fillOne)(WideContact<1>& block, ContactSources& from, const SolverBodies& bodies, const ContactTerms& terms);
    void (*fillTwo)(WideContact<2>& block, ContactSources& from, const SolverBodies& bodies, const ContactTerms& terms);
    /// Impulses of the last sub-step, not the totals. @param rows  of the lanes in use
    /// @return one bit per lane whose totals are not all 0
    std::uint32_t (*takeOne)(const WideContact<1>& block, std::span<ContactRow* const> rows, Real scale);
    std::uint32_t (*takeTwo)(const WideContact<2>& block, std::span<ContactRow* const> rows, Real scale);
};

/// Null where `contactKernels` is.
const ContactRowKernels* contactRowKernels();

}  // namespace swept::inline SWEPT_PRECISION
