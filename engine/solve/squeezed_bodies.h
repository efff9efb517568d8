#pragma once

#include "../state/solve_desk.h"
#include "tied_group.h"

namespace swept::inline SWEPT_PRECISION {

/// What is squeezed: something kinematic that moves, or something far heavier than what it touches, presses an island
/// that presses on other ground, too. Where that leaves no way out, rigid bodies that do not yield ask for impulses
/// without bounds, which have nothing to do with any momentum, and cancel each other but for what rounding, friction
/// and the turn of a normal within a step leave: of 10⁸ N·s on a cone of a kilogram that was thousands of metres a
/// second. What gets out of a wedge of angle φ goes as fast as cot φ times the presser, and in one of less than 7°
/// friction of 1/16 holds it. So nothing in such an island leaves a solve faster than `kMostSqueezed` times what
/// presses, unless it, or something else of the island, was as fast before: the press goes over it instead, as it does
/// over what has no way out. Whoever was slowed down so begins the next solve without the impulses of this one.
inline constexpr Real kMostSqueezed = 8;

/// The fastest that something squeezed gets. @param before  m/s, whatever squeezes it @param lead  of that
constexpr Real mostSqueezedSpeed(Real before, Real lead) {
    const Real led = kMostSqueezed * lead;
    return before < led ? led : before;
}

/// After a solve, before its bodies are read. @pre contacts were read @param time  that was solved for, s
void limitSqueezed(WorldState& world, const TiedGroup& group, Real time);

}  // namespace swept::inline SWEPT_PRECISION
