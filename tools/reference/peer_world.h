#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include <swept/samples/scene_description.h>

#include "peer_sample.h"
#include "peer_settings.h"

namespace swept {

/// Where the time of the last step went, seconds; 0 for what an engine does not tell or does not have.
struct PeerStages {
    double pairs = 0;
    double collide = 0;
    double islands = 0;     ///< with all that prepares the solver
    double solve = 0;
    double continuous = 0;
    double finish = 0;      ///< boxes, sleep, events
};

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
    /// Bodies that were taken away are at rest at the origin in it.
    virtual PeerSample sample() const = 0;
    /// Takes bodies away, with their joints. @param bodies  indices; all of them are there
    virtual void remove(std::span<const std::uint32_t> bodies) = 0;
    /// Puts back bodies that were taken away, as the scene describes them, and the joints that hold them.
    /// @pre the other bodies of those joints are there
    virtual void add(std::span<const std::uint32_t> bodies) = 0;
    virtual void setVelocity(std::uint32_t body, DVec2 velocity) = 0;
    /// Processor time of the last step, seconds.
    virtual double lastStepSeconds() const = 0;
    virtual PeerStages stages() const { return {}; }
};

/// @param scene  accepted by `validateScene`, and nothing in it that `peerLacks` names; outlives the world.
/// @return null when the engine is not part of this build.
std::unique_ptr<PeerWorld> makePeerWorld(const SceneDescription& scene, const PeerSettings& settings);

}  // namespace swept
