#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "../engine/task_system.h"
#include "frame.h"
#include "scene_description.h"

namespace swept {

/// A scene being run by some engine. Made by `makeRunner` (ours) or `makeBox2dRunner` (tools/).
class Runner {
public:
    virtual ~Runner() = default;
    /// Advances by the scene's dt.
    /// @return false when the engine refused the step: nothing has changed then, and the report has the reason
    virtual bool step() = 0;
    /// Writes the present state; capacity is reused. Contacts are filled only when asked for.
    virtual void read(Frame& frame, bool withContacts) const = 0;
    /// Events of the last step, sorted by time, then ids; empty unless `collectEvents` was set.
    virtual const std::vector<SceneEvent>& events() const = 0;
    virtual RunReport report() const = 0;
    /// What this engine cannot do of the scene and does instead, one sentence each; empty for ours.
    virtual std::vector<std::string> approximations() const = 0;
    /// The scene as it is now, to be begun from there, as JSON; empty of engines that cannot tell it.
    virtual std::string sceneNow() const { return {}; }
};

enum class Precision : std::uint8_t { f32, f64 };

struct RunnerOptions {
    Precision precision = Precision::f32;
    bool collectEvents = false;
    bool measure = false;         ///< deepest penetration, joint error and energies for the report
    bool ways = false;            ///< `Frame::ways`, `hits` and `work`: what happened within the last step
    TaskSystem* tasks = nullptr;  ///< of our world; null: the calling thread. Must outlive the runner
    /// The report tells what happens after so many steps; if a run does not come so far, all of it.
    std::int64_t reportFrom = 0;
};

/// Builds our world from a scene that `validateScene` accepts.
/// @return null, and a reason in `error` (with a JSON pointer to the culprit), when the engine refuses something.
std::unique_ptr<Runner> makeRunner(const SceneDescription& scene, const RunnerOptions& options, std::string& error);

/// A whole run in memory: frame 0 is the initial state.
struct Trace {
    std::vector<Frame> frames;
    std::vector<SceneEvent> events;
    RunReport report;
};

/// Runs `steps` steps and keeps every `every`-th frame (and the last). Ends before a step that is refused.
Trace runTrace(Runner& runner, std::int64_t steps, std::int64_t every = 1, bool withContacts = false);

}  // namespace swept
