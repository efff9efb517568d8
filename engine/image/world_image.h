#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "../../shapes/status.h"
#include "../state/world_state.h"

/// A world as bytes: what `World::save` gives, and `World::load` reads.
///
/// | bytes | |
/// | --- | --- |
/// | 8 | `kImageMagic` |
/// | 8 | length of all, these included |
/// | 8 | bytes of a number of `Real`: 4 or 8 |
/// | 8 | hash of the layout of the state: kinds, widths and order of all members |
/// | 8 | checksum of all but these eight |
/// | | members of the broadphase, then of the world (world_members.h), as layout.h says |
///
/// Numbers are little-endian. Copies have equal images. (Worlds of the same calls on other numbers of threads may not:
/// which manifolds were found together, and so what is remembered of each, follows from these.)

namespace swept::inline SWEPT_PRECISION {

std::vector<std::uint8_t> imageOf(const WorldState& world);

/// Whether these are all bytes of an image of this build. Errors as of `World::load`.
Status checkImage(std::span<const std::uint8_t> bytes);
/// Reads it. Where what looks whole makes no sense, it is `damaged`, and nothing is to be done with that world.
/// @param world  as it was made @pre checkImage
Status readImage(std::span<const std::uint8_t> bytes, WorldState& world);

}  // namespace swept::inline SWEPT_PRECISION
