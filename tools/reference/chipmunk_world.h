#pragma once

#include "peer_world.h"

namespace swept {

/// A scene in Chipmunk 7; see `makePeerWorld`.
std::unique_ptr<PeerWorld> makeChipmunkWorld(const SceneDescription& scene, const PeerSettings& settings);

}  // namespace swept
