#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "../../shapes/status.h"
#include "../shape_def.h"
#include "../state/world_state.h"

namespace swept::inline SWEPT_PRECISION {

Status checkSurface(const Surface& surface);
/// @param count  that there are to be: else `outOfRange` with "surfaces"
Status checkSurfaces(std::span<const Surface> surfaces, std::size_t count);

/// Whether what touches them cannot tell them apart: their materials are the game's alone.
bool actAlike(Surface a, const Surface& b);

/// Gives a shape that has a slot another definition. What touches it does not know yet.
/// @pre there is room for one more of `WorldState::sensors`, if it becomes one
void setDefinition(WorldState& world, std::uint32_t slot, const ShapeDef& def);

/// What contacts make of the surfaces of their shapes, anew. What is near only may have no contact yet.
/// @param places  of pairs, ascending (contacts/pairs_of_shapes.h)
void mixSurfacesOf(WorldState& world, std::span<const std::uint32_t> places);

}  // namespace swept::inline SWEPT_PRECISION
