#pragma once

#include <cstdint>
#include <span>

#include "../graph/block_layout.h"
#include "../joints/revolute_constraint.h"
#include "../wide/wide_revolutes.h"

namespace swept::inline SWEPT_PRECISION {

/// A hinge as far as it must be known before its place in a block is.
struct HingeLink {
    BodySlot slotA = kFixedSlot;
    BodySlot slotB = kFixedSlot;
    std::uint32_t source = 0;  ///< the store's name for the joint
    HingeParts parts;

    bool operator==(const HingeLink&) const = default;
};
static_assert(sizeof(HingeLink) == 16, "four links a cache line: colouring does little else than to read them");

/// All places of a solve.
struct HingeArrays {
    std::span<WideRevolute> blocks;
    std::span<RevoluteConstraint> rest;
};

/// Who keeps the hinges of a solve: they go straight from there into the blocks of the kernels and back, see
/// `ContactStore`.
class HingeStore {
public:
    virtual ~HingeStore() = default;

    /// Blocks are empty before, and closed after (`closeBlock`). Parts of the links may be filled at the same time.
    /// @param places  of the links of the batch from the first one on, in their order
    virtual void fill(std::size_t first, std::span<const BlockPlace> places, const HingeArrays& to) = 0;
    /// Takes impulses and totals back from there. Likewise.
    virtual void take(std::size_t first, std::span<const BlockPlace> places, const HingeArrays& from) = 0;

protected:
    HingeStore() = default;
    HingeStore(const HingeStore&) = default;
    HingeStore& operator=(const HingeStore&) = default;
};

inline std::array<BodySlot, 2> bodySlots(const HingeLink& link) { return {link.slotA, link.slotB}; }

}  // namespace swept::inline SWEPT_PRECISION
