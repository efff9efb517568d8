#pragma once

#include <algorithm>
#include <cstddef>
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

/// Speed of a row per impulse, of what one of its bodies adds to that.
/// @param moved  of the body, zero where it cannot be moved
inline double answerOf(const BodyInertia& body, const Block3& moved) {
    const auto linear = static_cast<double>(body.inverseMass);
    const auto angular = static_cast<double>(body.inverseInertia);
    return linear * (moved[0] * moved[0] + moved[1] * moved[1]) + angular * moved[2] * moved[2];
}

/// From a point to the centre of mass of the nearer body that can be moved, metres: what errors there are compared
/// with.
inline Real leverAt(const ContactConstraintPoint& point, bool movesA, bool movesB) {
    const Real a = length(point.anchorA);
    const Real b = length(point.anchorB);
    return movesA && movesB ? std::min(a, b) : (movesA ? a : b);
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
