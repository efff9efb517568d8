#pragma once

#include <memory>

#include <swept/samples/scene_description.h>

#include "peer_sample.h"
#include "peer_settings.h"

namespace swept {

/// A scene in another engine. Lives in the child process only: the engines assert, and so end the process, on some
/// input.
class PeerWorld {
public:
    PeerWorld() = default;
    virtual ~PeerWorld() = default;
    PeerWorld(const PeerWorld&) = delete;
    PeerWorld& operator=(const PeerWorld&) = delete;

    /// One step of the scene's dt.
    virtual void step() = 0;
    virtual PeerSample sample() const = 0;
};

/// @param scene  accepted by `validateScene`, and nothing in it that `peerLacks` names; outlives the world.
/// @return null when the engine is not part of this build.
std::unique_ptr<PeerWorld> makePeerWorld(const SceneDescription& scene, const PeerSettings& settings);

}  // namespace swept
