#pragma once

#include <array>

#include "../support/random.h"
#include "world_support.h"

/// Small bodies of three kinds that are thrown about in a closed chamber, and that nothing may leave it.

namespace swept::test {

/// @param finish  called with the number, definition and surface of each body before it is made
template <class Finish>
std::vector<BodyId> throwCrowd(World& world, Random& random, int count, const Finish& finish) {
    std::vector<BodyId> bodies;
    for (int i = 0; i < count; ++i) {
        const std::array shapes{circle(random.range(0.05, 0.5)), box(random.range(0.05, 0.5), random.range(0.05, 0.5)),
                                capsule(0.3, random.range(0.05, 0.2))};
        BodyDef def = dynamicAt({random.range(-8, 8), random.range(-8, 8)},
                                vec(random.range(-100, 100), random.range(-100, 100)), random.range(-10, 10));
        ShapeDef surface = material(0.5);
        finish(i, def, surface);
        bodies.push_back(addBody(world, def, shapes[static_cast<std::size_t>(i) % 3], surface));
    }
    return bodies;
}

/// Of a chamber whose sides are that far from the origin.
inline bool areInside(const World& world, std::span<const BodyId> bodies, double half) {
    return std::all_of(bodies.begin(), bodies.end(), [&](BodyId body) {
        const DVec2 place = world.position(body);
        return std::max(std::abs(place.x), std::abs(place.y)) < half;
    });
}

}  // namespace swept::test
