#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "../contacts/contact_constraint.h"

namespace swept::inline SWEPT_PRECISION {

/// Constraints side by side in a block: as many as fill the widest register there is, whatever there is on this
/// machine, so that blocks are laid out alike on each. Narrower ones go through those lanes that are in use.
inline constexpr std::size_t kBlockBytes = 64;
inline constexpr std::size_t kBlockLanes = kBlockBytes / sizeof(Real);
using LaneArray = std::array<Real, kBlockLanes>;

/// One point of each contact of a block; see `ContactConstraintPoint`.
struct alignas(kBlockBytes) WideContactPoint {
    LaneArray normalArmA;   ///< until the block is prepared: the anchor's x
    LaneArray tangentArmA;  ///< likewise its y
    LaneArray normalArmB;
    LaneArray tangentArmB;
    LaneArray baseSeparation;
    LaneArray normalMass;
    LaneArray tangentMass;
    LaneArray normalImpulse;
    LaneArray tangentImpulse;
    LaneArray totalNormalImpulse;
    LaneArray separation;  ///< now: changes only when bodies move, so one pass finds it and the others read it
};

/// As many contacts as there are lanes, all with the same number of points, no movable body in two of them. Lanes that
/// are left over hold contacts of the fixed world with itself, without masses.
template <std::size_t kPoints>
struct alignas(kBlockBytes) WideContact {
    std::array<StateOffset, kBlockLanes> stateA;
    std::array<StateOffset, kBlockLanes> stateB;
    std::uint32_t lanes = 0;     ///< in use
    std::uint32_t movableA = 0;  ///< one bit per lane: the body is to be written
    std::uint32_t movableB = 0;
    Real mostRestitution = 0;  ///< of its contacts; where it is 0 nothing bounces
    /// By point, one bit per lane: it carried nothing before the solve. Of blocks that row kernels fill; nobody else
    /// asks.
    std::array<std::uint32_t, kPoints> unloaded;
    alignas(kBlockBytes) LaneArray normalX;
    LaneArray normalY;
    LaneArray friction;
    LaneArray maxPushSpeed;
    LaneArray radiusA;
    LaneArray radiusB;
    LaneArray bounceSpeed;
    LaneArray biasRate;
    LaneArray massScale;
    LaneArray impulseScale;
    LaneArray inverseMassA;
    LaneArray inverseMassB;
    LaneArray inverseInertiaA;
    LaneArray inverseInertiaB;
    LaneArray sharedResponse;  ///< of two points
    LaneArray pairGain;        ///< likewise
    LaneArray begins;          ///< likewise; 1 or 0
    LaneArray restitution;
    std::array<WideContactPoint, kPoints> points;
};

/// Kernels over blocks of one colour: what `warmStartContacts`, `bounceContacts` and `solveContacts` do, to the bit.
struct ContactKernels {
    const char* name;  ///< of the instruction set
    /// Anchors become arms, and masses are found: `prepareContact`. Once for each block.
    void (*prepareOne)(std::span<WideContact<1>> blocks);
    void (*prepareTwo)(std::span<WideContact<2>> blocks);
    void (*warmStartOne)(std::span<WideContact<1>> blocks, const SolverBodies& bodies);
    void (*warmStartTwo)(std::span<WideContact<2>> blocks, const SolverBodies& bodies);
    void (*bounceOne)(std::span<WideContact<1>> blocks, const SolverBodies& bodies, const ContactPass& pass);
    void (*bounceTwo)(std::span<WideContact<2>> blocks, const SolverBodies& bodies, const ContactPass& pass);
    void (*solveOne)(std::span<WideContact<1>> blocks, const SolverBodies& bodies, const ContactPass& pass);
    void (*solveTwo)(std::span<WideContact<2>> blocks, const SolverBodies& bodies, const ContactPass& pass);
};

/// For the widest registers that this machine has; null where built without `SWEPT_SIMD`: contacts are then solved one
/// by one.
const ContactKernels* contactKernels();

}  // namespace swept::inline SWEPT_PRECISION
