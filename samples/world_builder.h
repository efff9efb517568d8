#pragma once

#include <span>
#include <string>
#include <vector>

#include "../engine/world.h"
#include "../shapes/chain.h"
#include "scene_definitions.h"
#include "scene_description.h"

namespace swept::inline SWEPT_PRECISION {

/// A world made from a scene, and which of its things belongs to which entry of the scene.
struct SceneWorld {
    World world;
    std::vector<BodyId> bodies;   ///< by body index
    std::vector<JointId> joints;  ///< by joint index
};

/// As the world takes them.
inline ChainNeighbours neighboursOf(const ChainGeometry& chain) {
    ChainNeighbours neighbours;
    if (chain.before) { neighbours.before = toReal(*chain.before); }
    if (chain.after) { neighbours.after = toReal(*chain.after); }
    return neighbours;
}

/// The convex pieces of a shape, frame of its body: one, or one for each edge of a chain. @pre `buildWorld` accepts it
std::vector<Polygon> polygonsOf(const ShapeDescription& shape);

/// @return whether all of it could be made; else `error` says what was refused, with its JSON pointer.
bool buildWorld(const SceneDescription& scene, SceneWorld& built, std::string& error);

/// Makes bodies anew that were destroyed since, and joints, by index; no gears on joints that stayed.
/// @return as of `buildWorld`
bool rebuildBodies(const SceneDescription& scene, std::span<const std::uint32_t> bodies,
                   std::span<const std::size_t> joints, SceneWorld& built, std::string& error);

}  // namespace swept::inline SWEPT_PRECISION
