#pragma once

#include <span>

#include "bench_scene.h"

namespace swept::worlds {

/// A hundred machines each, of one sort of joint, that move and meet nothing: what a joint costs.
std::span<const SceneEntry> jointScenes();

}  // namespace swept::worlds
