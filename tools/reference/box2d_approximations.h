#pragma once

#include <string>
#include <vector>

#include <swept/samples/scene_description.h>

namespace swept {

/// What Box2D 2.4.1, as our adapter drives it, does otherwise than the scene format says: one sentence each. The ways
/// of the engine itself come first, then what this very scene asks for and does not get.
std::vector<std::string> box2dApproximations(const SceneDescription& scene);

}  // namespace swept
