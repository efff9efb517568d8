#pragma once

#include <cstdint>
#include <span>

#include "wide_contacts.h"

namespace swept::inline SWEPT_PRECISION {

/// A contact as far as it must be known before its place in a block is.
struct ContactLink {
    BodySlot slotA = kFixedSlot;
    BodySlot slotB = kFixedSlot;
    std::uint32_t source = 0;  ///< the store's name for the contact
    std::uint8_t points = 0;   ///< 1 or 2
    bool isAlone = false;      ///< it is asked for as a constraint

    /// As many as its block has; 0: it stands in none.
    std::size_t pointsInBlock() const { return isAlone ? 0 : points; }
};
static_assert(sizeof(ContactLink) == 16, "four links a cache line: colouring does little else than to read them");

/// Where a contact of a solve stands.
struct ContactPlace {
    std::uint32_t index = 0;  ///< of the block, or of the constraint
    std::uint8_t lane = 0;
    std::uint8_t points = 0;  ///< of the contacts of the block; 0: a constraint on its own
};

/// All places of a solve.
struct ContactArrays {
    std::span<WideContact<1>> one;
    std::span<WideContact<2>> two;
    std::span<ContactConstraint> rest;
};

/// Who keeps the contacts of a solve. They go straight from there into the blocks of the kernels and back, in the order
/// in which they are kept: to write each down as a constraint first, and to read it again from there in the order of
/// colours, takes longer than the kernels do.
class ContactStore {
public:
    virtual ~ContactStore() = default;

    /// Blocks are empty before, and closed after (`closeBlock`). Parts of the links may be filled at the same time.
    /// @param places  of the links of the batch from the first one on, in their order
    virtual void fill(std::size_t first, std::span<const ContactPlace> places, const ContactArrays& to) = 0;
    /// Takes the impulses back from there. Likewise.
    virtual void take(std::size_t first, std::span<const ContactPlace> places, const ContactArrays& from) = 0;
    /// All were taken back.
    virtual void end() {}

protected:
    ContactStore() = default;
    ContactStore(const ContactStore&) = default;
    ContactStore& operator=(const ContactStore&) = default;
};

}  // namespace swept::inline SWEPT_PRECISION
