#pragma once

#include <swept/samples/scene_description.h>

#include "finding.h"

namespace swept {

/// Reads a scene as an experienced user would, before anything runs: what lies outside the measured envelope
/// (`envelope.h`) and what would mend it; which features it can reach, and which it can do without. Deterministic;
/// looks at the initial state only, so it knows nothing of forces and changes that a program applies later.
/// @param scene  that `validateScene` accepts.
Inspection inspectScene(const SceneDescription& scene);

}  // namespace swept
