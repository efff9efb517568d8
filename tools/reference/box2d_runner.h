#pragma once

#include <memory>
#include <string>

#include "peer_runner.h"

namespace swept {

using Box2dRunner = PeerRunner;

/// `makePeerRunner` with Box2D 2.4.1. @param iterations  of a step.
std::unique_ptr<Box2dRunner> makeBox2dRunner(const SceneDescription& scene, std::string& error,
                                             const Box2dIterations& iterations = {},
                                             const std::string& executable = "/proc/self/exe");

/// So many iterations for velocities, and positions in the proportion of Box2D's own advice, 8 to 3.
Box2dIterations iterationsOf(int velocity);

}  // namespace swept
