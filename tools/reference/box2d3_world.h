#pragma once

#include "peer_world.h"

namespace swept {

/// A scene in Box2D 3; see `makePeerWorld`.
std::unique_ptr<PeerWorld> makeBox2d3World(const SceneDescription& scene, const PeerSettings& settings);

}  // namespace swept
