#include "may_touch.h"

#include "../bodies/body_joints.h"

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

FilteredShape toldOf(const WorldState& world, const Shape& shape) {
    return {.shape = world.shapes.idOf(shape.head),
            .body = world.bodies.idOf(shape.body),
            .userData = shape.def.userData,
            .bodyUserData = world.bodies[shape.body].def.userData};
}

/// What the game says. In one order whoever asks, so that a filter that treats A and B differently says one thing.
bool gameForbids(const WorldState& world, const Shape& a, const Shape& b) {
    const bool inOrder = a.head < b.head;
    return !world.contactFilter->mayTouch(toldOf(world, inOrder ? a : b), toldOf(world, inOrder ? b : a));
}

}  // namespace

bool mayTouch(const WorldState& world, const Shape& a, const Shape& b) {
    if (a.body == b.body || !shouldCollide(a.def.filter, b.def.filter)) { return false; }
    const auto isFixed = [&world](const Shape& shape) { return world.bodies[shape.body].def.type == BodyType::fixed; };
    const bool isSensed = a.def.sensor || b.def.sensor;  // without, somebody asks for one that is dynamic
    if (isSensed ? isFixed(a) && isFixed(b) : jointForbids(world, a.body, b.body)) { return false; }
    return world.contactFilter == nullptr || !gameForbids(world, a, b);
}

}  // namespace swept::inline SWEPT_PRECISION
