#pragma once

#include <string>

#include "../measures/reference.h"
#include "row.h"

namespace swept::tune {

struct Run {
    Row row;
    measures::Recording recording;
    std::string refusal;  ///< why the engine does not take the scene; empty: it does
};

/// Runs a scene with these settings, once to measure errors and a few times more for its cost.
/// @param scene    what is run: that of the subject, or one changed in ways that keep its bodies
/// @param subject  what it is judged as
Run runScene(const SceneDescription& scene, const Subject& subject, const Config& config,
             const measures::Reference& reference);

/// The same of the subject's own scene.
Row runConfig(const Subject& subject, const Config& config, const measures::Reference& reference);

}  // namespace swept::tune
