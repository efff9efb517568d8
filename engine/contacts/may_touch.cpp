#include "may_touch.h"

#include "../state/body_joints.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

bool jointForbids(const WorldState& world, std::uint32_t bodyA, std::uint32_t bodyB) {
    for (const std::uint32_t slot : fewerJoints(world, bodyA, bodyB)) {
        const Joint& joint = world.joints[slot];
        const bool connects =
            (joint.bodyA == bodyA && joint.bodyB == bodyB) || (joint.bodyA == bodyB && joint.bodyB == bodyA);
        if (connects && joint.keepsApart()) { return true; }
    }
    return false;
}

}  // namespace

bool mayTouch(const WorldState& world, const Shape& a, const Shape& b) {
    if (a.body == b.body || !shouldCollide(a.def.filter, b.def.filter)) { return false; }
    const auto isFixed = [&world](const Shape& shape) { return world.bodies[shape.body].def.type == BodyType::fixed; };
    const bool isSensed = a.def.sensor || b.def.sensor;  // without, somebody asks for one that is dynamic
    if (isSensed && isFixed(a) && isFixed(b)) { return false; }
    return !jointForbids(world, a.body, b.body);
}

}  // namespace swept::inline SWEPT_PRECISION
