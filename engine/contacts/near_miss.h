#pragma once

#include "../state/contact.h"

namespace swept::inline SWEPT_PRECISION {

struct WorldState;

/// Contacts are made ahead of time, with the normal that they have as the step begins: what flies past a corner would
/// be turned away by a plane through it. So what the solver would stop, as far as normals and speeds at the start tell,
/// but what gets through the step without meeting, has no points in it.
/// @return whether this one of two bodies that do not touch yet, at least one of them awake and dynamic, is such a near
/// miss: their free paths do not meet, or only graze each other
bool isNearMiss(const WorldState& world, const Contact& contact, Real dt);

}  // namespace swept::inline SWEPT_PRECISION
