#pragma once

#include <cstdint>

#include "../body_def.h"

namespace swept::inline SWEPT_PRECISION {

struct WorldState;

/// A body becomes static, kinematic or dynamic: it loses its contacts, what acts on it and, if it is static now, its
/// motion; its shapes are weighed, and get the skin that they have there (line_skin.h). Mass, joints and boxes are
/// brought up to date by the caller.
/// @pre it is awake, if it can be
void changeType(WorldState& world, std::uint32_t body, BodyType type);

}  // namespace swept::inline SWEPT_PRECISION
