#pragma once

#include <memory>
#include <optional>
#include <string>

#include <swept/samples/runner.h>

#include "peer_settings.h"

namespace swept {

/// A scene in another engine, which runs in a child process. When the engine aborts, that is a result: the runner then
/// stays at its last state, further steps do nothing, and `aborted` tells of it.
class PeerRunner : public Runner {
public:
    /// One sentence, "Box2D aborted at step 12 (…)"; nothing while all is well.
    virtual const std::optional<std::string>& aborted() const = 0;
    /// Processor time that the child spent in the engine's own step so far, seconds.
    virtual double stepSeconds() const = 0;
};

/// @param scene       accepted by `validateScene`.
/// @param executable  a program that calls `runPeerChild` when its argument is `kPeerChildCommand`; by default this
/// one.
/// @return null, and a reason in `error`, when the engine lacks what the scene needs or no child can be started. An
///         abort while the world is built is told by `aborted`, with the bodies at their initial poses.
std::unique_ptr<PeerRunner> makePeerRunner(const SceneDescription& scene, const PeerSettings& settings,
                                           std::string& error, const std::string& executable = "/proc/self/exe");

}  // namespace swept
