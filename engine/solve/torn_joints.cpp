#include "torn_joints.h"

#include <algorithm>
#include <limits>

namespace swept::inline SWEPT_PRECISION {

Real errorRatio(const WorldState& world, const Joint& joint, const JointErrors& errors) {
    Real smallest = std::numeric_limits<Real>::infinity();
    for (const std::uint32_t slot : joint.allBodies()) {
        const Body& body = world.bodies[slot];
        if (body.isDynamic() && body.extent > 0) { smallest = std::min(smallest, body.extent); }
    }
    return std::max(errors.length / smallest, errors.angle);
}

}  // namespace swept::inline SWEPT_PRECISION
