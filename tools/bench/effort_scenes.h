#pragma once

#include <span>

#include <swept/samples/scene_description.h>

namespace swept::bench {

/// A scene that never settles, and is demanding for a short time only, or in one place only: a fixed number of
/// sub-steps that keeps the budget costs all the time, and everywhere.
struct EffortScene {
    const char* name;
    const char* about;
    double seconds;  ///< that it runs
    /// With its error budgets set; without sub-steps.
    SceneDescription (*make)();
};

std::span<const EffortScene> effortScenes();

}  // namespace swept::bench
