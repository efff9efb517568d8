#pragma once

#include "../crowd.h"

namespace swept::bench {

/// An installed Box2D 3.x with its defaults: 4 sub-steps, one thread, continuous collision between fast and static
/// bodies.
std::unique_ptr<CrowdEngine> makeBox2d3Crowd();

}  // namespace swept::bench
