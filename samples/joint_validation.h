#pragma once

#include <optional>

#include "field_check.h"
#include "scene_description.h"

namespace swept {

/// The first fault of the joints of a scene, in the order of the format. @param bodies  of the scene, by name
std::optional<SceneError> faultOfJoints(const SceneDescription& scene, const NameIndex& bodies, double largest);

}  // namespace swept
