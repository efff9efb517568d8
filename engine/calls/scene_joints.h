#pragma once

#include <string>

#include "../state/world_state.h"
#include "scene_places.h"

/// The joints of a world as those of a scene (world_scene.h).

namespace swept::inline SWEPT_PRECISION {

/// Whether a scene can have it.
bool isInScene(const WorldState& world, const Joint& joint);

/// Appends its object. @pre `isInScene`
void appendJoint(std::string& text, const WorldState& world, JointId id, const ScenePlaces& places);

}  // namespace swept::inline SWEPT_PRECISION
