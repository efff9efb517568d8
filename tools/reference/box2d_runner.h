#pragma once

#include <memory>
#include <optional>
#include <string>

#include <swept/samples/runner.h>

#include "box2d_sample.h"

namespace swept {

/// A scene in Box2D 2.4.1, which runs in a child process. When Box2D aborts, that is a result: the runner then stays at
/// its last state, further steps do nothing, and `aborted` tells of it.
class Box2dRunner : public Runner {
public:
    /// One sentence, "Box2D aborted at step 12 (…)"; nothing while all is well.
    virtual const std::optional<std::string>& aborted() const = 0;
    /// Processor time that the child spent in Box2D's own step so far, seconds.
    virtual double stepSeconds() const = 0;
};

/// @param scene       accepted by `validateScene`.
/// @param iterations  of a step.
/// @param executable  a program that calls `runBox2dChild` when its argument is `kBox2dChildCommand`; by default this
/// one.
/// @return null, and a reason in `error`, when no child can be started. An abort while the world is built is told by
///         `aborted`, with the bodies at their initial poses.
std::unique_ptr<Box2dRunner> makeBox2dRunner(const SceneDescription& scene, std::string& error,
                                             const Box2dIterations& iterations = {},
                                             const std::string& executable = "/proc/self/exe");

/// So many iterations for velocities, and positions in the proportion of Box2D's own advice, 8 to 3.
Box2dIterations iterationsOf(int velocity);

}  // namespace swept
