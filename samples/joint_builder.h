#pragma once

#include <cstddef>
#include <functional>
#include <map>
#include <string>

#include "../engine/world.h"
#include "scene_description.h"

namespace swept::inline SWEPT_PRECISION {

/// By the names of the scene.
using BodyNames = std::map<std::string, BodyId, std::less<>>;
using JointNames = std::map<std::string, JointId, std::less<>>;

/// Makes a joint of a scene.
/// @param index   of the joint in the scene
/// @param joints  those made so far: a gear needs both of its own
/// @return the engine's refusal, also where a name is none of those
Result<JointId> buildJoint(const JointDescription& given, std::size_t index, const BodyNames& bodies,
                           const JointNames& joints, World& world);

}  // namespace swept::inline SWEPT_PRECISION
