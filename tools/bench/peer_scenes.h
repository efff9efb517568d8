#pragma once

#include <memory>

#include "broadphase_peer_scenes.h"
#include "peer_world.h"

namespace swept::bench {

/// Sets a scene up and does what its script does.
class PeerScript {
public:
    virtual ~PeerScript() = default;
    virtual void create(PeerWorld& world) = 0;
    /// @param step  0 before the first one
    virtual void beforeStep(PeerWorld& world, int step);
    /// Steps until the scene is what it is about.
    virtual int stepsToSkip() const = 0;
};

std::unique_ptr<PeerScript> makePeerScript(PeerScene scene);

}  // namespace swept::bench
