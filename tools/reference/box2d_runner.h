#pragma once

#include <memory>
#include <optional>
#include <string>

#include <swept/samples/runner.h>

namespace swept {

/// A scene in Box2D 2.4.1, which runs in a child process. When Box2D aborts, that is a result: the runner then stays at
/// its last state, further steps do nothing, and `aborted` tells of it.
class Box2dRunner : public Runner {
public:
    /// One sentence, "Box2D aborted at step 12 (…)"; nothing while all is well.
    virtual const std::optional<std::string>& aborted() const = 0;
};

/// @param scene       accepted by `validateScene`.
/// @param executable  a program that calls `runBox2dChild` when its argument is `kBox2dChildCommand`; by default this
/// one.
/// @return null, and a reason in `error`, when no child can be started. An abort while the world is built is told by
///         `aborted`, with the bodies at their initial poses.
std::unique_ptr<Box2dRunner> makeBox2dRunner(const SceneDescription& scene, std::string& error,
                                             const std::string& executable = "/proc/self/exe");

}  // namespace swept
