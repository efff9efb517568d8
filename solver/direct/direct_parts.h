#pragma once

#include <cstdint>

#include "../contacts/contact_constraint.h"
#include "block33.h"
#include "direct_rows.h"

/// What the files of the direct solver share.

namespace swept::inline SWEPT_PRECISION {

inline constexpr std::uint32_t kNoNode = ~std::uint32_t{0};

inline double dot3(const Block3& a, const Block3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

inline void addScaled(Block3& to, double factor, const Block3& a) {
    for (std::size_t i = 0; i < 3; ++i) { to[i] += factor * a[i]; }
}

/// The rows of a contact point.
inline DirectRow normalRowOf(const ContactConstraint& contact, const ContactConstraintPoint& point, Real bias) {
    return {rowAlong(contact.normal, point.anchorA, point.anchorB), contact.slotA, contact.slotB, bias, nullptr};
}
inline DirectRow tangentRowOf(const ContactConstraint& contact, const ContactConstraintPoint& point) {
    return {rowAlong(rightPerp(contact.normal), point.anchorA, point.anchorB), contact.slotA, contact.slotB,
            -contact.surfaceSpeed, nullptr};
}

}  // namespace swept::inline SWEPT_PRECISION
