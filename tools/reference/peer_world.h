#pragma once

#include <cstdint>
#include <memory>
#include <span>

#include <swept/samples/scene_description.h>

#include "../bench/stopwatch.h"
#include "peer_sample.h"
#include "peer_settings.h"

namespace swept {

/// Where the time of the last step went, seconds; 0 for what an engine does not tell or does not have.
struct PeerStages {
    double pairs = 0;
    double collide = 0;
    double islands = 0;  ///< with all that prepares the solver
    double solve = 0;
    double continuous = 0;
    double finish = 0;  ///< boxes, sleep, events
};

/// A scene in another engine. Lives in the child process only: the engines assert, and so end the process, on some
/// input.
class PeerWorld {
public:
    /// @param scene  outlives the world
    explicit PeerWorld(const SceneDescription& scene) : scene_(scene) {}
    virtual ~PeerWorld() = default;
    PeerWorld(const PeerWorld&) = delete;
    PeerWorld& operator=(const PeerWorld&) = delete;

    /// One step of the scene's dt.
    void step() {
        const bench::Stopwatch watch;
        advance();
        last_ = watch.times();
        seconds_ += last_.own;
        ++steps_;
        afterStep();
    }
    /// Bodies that were taken away are at rest at the origin in it.
    PeerSample sample() const {
        PeerSample sample;
        sample.frame.step = steps_;
        sample.frame.time = static_cast<double>(steps_) * scene_.settings.dt;
        sample.stepSeconds = seconds_;
        for (std::size_t i = 0; i < scene_.bodies.size(); ++i) {
            if (isThere(i)) {
                readBody(i, sample);
            } else {
                sample.frame.bodies.emplace_back();
            }
        }
        readRest(sample);
        return sample;
    }
    /// Takes bodies away, with their joints. @param bodies  indices; all of them are there
    virtual void remove(std::span<const std::uint32_t> bodies) = 0;
    /// Puts back bodies that were taken away, as the scene describes them, and the joints that hold them.
    /// @pre the other bodies of those joints are there
    virtual void add(std::span<const std::uint32_t> bodies) = 0;
    virtual void setVelocity(std::uint32_t body, DVec2 velocity) = 0;
    /// Processor time of the last step, seconds.
    double lastStepSeconds() const { return last_.own; }
    /// The same by the wall clock: for steps on several threads.
    double lastStepWallSeconds() const { return last_.wall; }
    virtual PeerStages stages() const { return {}; }

protected:
    const SceneDescription& scene() const { return scene_; }

private:
    /// What is timed of a step, and what is not.
    virtual void advance() = 0;
    virtual void afterStep() {}
    /// False while a body is taken away.
    virtual bool isThere(std::size_t body) const = 0;
    /// Appends the state of a body that is there, and adds its motion to the sums.
    virtual void readBody(std::size_t body, PeerSample& sample) const = 0;
    /// What an engine tells beyond its bodies.
    virtual void readRest(PeerSample& /*sample*/) const {}

    const SceneDescription& scene_;
    std::int64_t steps_ = 0;
    double seconds_ = 0;
    bench::Stopwatch::Times last_;
};

/// @param scene  accepted by `validateScene`, and nothing in it that `peerLacks` names; outlives the world.
/// @return null when the engine is not part of this build.
std::unique_ptr<PeerWorld> makePeerWorld(const SceneDescription& scene, const PeerSettings& settings);

}  // namespace swept
