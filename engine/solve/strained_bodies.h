#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

#include "tied_group.h"

/// Bodies whose contacts and joints cannot all hold: something kinematic presses them to what does not yield, from
/// opposite sides, or a torn joint pulls at what touches something. What passes beside a body, without a push, squeezes
/// nothing; nor does a wall at right angles to the floor, or a floor that is kinematic in part. Impulses then grow with
/// each relaxation, until springs give as much of them back: ones of four times the stiffness give back half, so all
/// pushes, and what friction makes of them, are twice as strong. So ground is no stiffer for those than all else is,
/// whatever the profile. (Else an arm that something kinematic turned against a post, and then beyond it, trembled, and
/// was at 14 m/s where it was led at 3; and two crates on a hinge that a plate squeezed to the floor went at up to 8
/// times its speed, instead of 3.)

namespace swept::inline SWEPT_PRECISION {

inline constexpr std::uint32_t kStrained = std::numeric_limits<std::uint32_t>::max();

/// Notes them at the desk. @pre the bodies of the group have their slots
void findStrained(const WorldState& world, const TiedGroup& group);

/// Whether one of them is.
inline bool areStrained(const SolveDesk& desk, BodySlot a, BodySlot b) {
    const auto isStrained = [&desk](BodySlot slot) {
        return std::size_t{slot} < desk.grounds.size() && desk.grounds[slot] == kStrained;
    };
    return isStrained(a) || isStrained(b);
}

}  // namespace swept::inline SWEPT_PRECISION
