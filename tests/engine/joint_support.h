#pragma once

#include "world_support.h"

/// What the suites of joints share.

namespace swept::test {

inline JointDef between(BodyId a, BodyId b) {
    JointDef def;
    def.bodyA = a;
    def.bodyB = b;
    return def;
}

/// A static body at the origin.
inline BodyId anchorOf(World& world) { return must(world.createBody(bodyAt(BodyType::fixed, {}))); }

}  // namespace swept::test
