#pragma once

#include <vector>

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

/// Boxes in a row, each on a slider along it with the one before. `setUp(slider, i)` adds to that of the i-th.
template <class SetUp>
std::vector<BodyId> addSliderRow(World& world, int boxes, const SetUp& setUp) {
    std::vector<BodyId> bodies;
    for (int i = 0; i < boxes; ++i) {
        const DVec2 place = i * DVec2{1, 0.3};
        bodies.push_back(addBody(world, dynamicAt(place), box(0.3, 0.2)));
        if (i == 0) { continue; }
        PrismaticJointDef slider;
        slider.base = between(bodies[bodies.size() - 2], bodies.back());
        slider.anchor = place;
        slider.axis = {1, 0.3};
        setUp(slider, i);
        must(world.createJoint(slider));
    }
    return bodies;
}

}  // namespace swept::test
