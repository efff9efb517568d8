#pragma once

#include <cstdint>
#include <span>

#include "../wide/wide_contacts.h"

namespace swept::inline SWEPT_PRECISION {

/// A contact as far as it must be known before its place in a block is.
struct ContactLink {
    BodySlot slotA = kFixedSlot;
    BodySlot slotB = kFixedSlot;
    std::uint32_t source = 0;  ///< the store's name for the contact
    std::uint8_t points = 0;   ///< 1 or 2
    bool isAlone = false;      ///< it is asked for as a constraint
    bool bounces = false;      ///< has restitution

    bool operator==(const ContactLink&) const = default;
};
static_assert(sizeof(ContactLink) == 16, "four links a cache line: colouring does little else than to read them");

/// As many as its block has; 0: it stands in none.
inline std::size_t pointsInBlock(const ContactLink& link) { return link.isAlone ? 0 : link.points; }

/// Who keeps the contacts of a solve. They go straight from there into the blocks of the kernels and back: to write
/// each down as a constraint first, and to read it again from there in the order of colours, takes longer than the
/// kernels do.
class ContactStore {
public:
    /// Those of the batch, in another order: of contacts on their own, or of the lanes of blocks, `kBlockLanes` of each
    /// block; where a lane is not in use that of any contact.
    using Links = std::span<const ContactLink>;

    virtual ~ContactStore() = default;

    /// Blocks are empty before (`emptyBlock`), closed (`closeBlock`) and prepared after. Different ones may be filled
    /// at the same time.
    virtual void fill(std::span<WideContact<1>> blocks, Links links) = 0;
    virtual void fill(std::span<WideContact<2>> blocks, Links links) = 0;
    virtual void fill(std::span<ContactConstraint> alone, Links links) = 0;
    /// Takes the impulses back from there. Likewise.
    virtual void take(std::span<const WideContact<1>> blocks, Links links) = 0;
    virtual void take(std::span<const WideContact<2>> blocks, Links links) = 0;
    virtual void take(std::span<const ContactConstraint> alone, Links links) = 0;

protected:
    ContactStore() = default;
    ContactStore(const ContactStore&) = default;
    ContactStore& operator=(const ContactStore&) = default;
};

}  // namespace swept::inline SWEPT_PRECISION
