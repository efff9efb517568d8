#pragma once

#include <memory>

#include <swept/samples/scene_description.h>

#include "../threads_bench.h"

namespace swept::bench {

/// Boxes, circles and capsules of a scene in Box2D 3 with its defaults, its tasks on oneTBB. Null for several threads
/// where there is no oneTBB.
std::unique_ptr<TimedWorld> makeBox2d3Threads(const SceneDescription& scene, int threads);

}  // namespace swept::bench
