#pragma once

#include <vector>

#include "peer_world.h"

namespace swept::bench {

/// Eleven capsules held by ten hinges, and two feet.
/// @param position  between the soles
/// @param group     > 0; its bones do not collide, nor do those of others of the same group
/// @return its bodies
std::vector<std::uint32_t> addRagdoll(PeerWorld& world, DVec2 position, int group);

}  // namespace swept::bench
