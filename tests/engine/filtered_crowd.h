#pragma once

#include <array>

#include "thrown_crowd.h"

/// A crowd in a chamber, of kinds that a contact filter tells apart.

namespace swept::test {

inline constexpr std::uint64_t kOfAnyKind = 99;

/// Lets those touch whose shapes have the same user data, and whatever is of any kind.
struct SameKind final : ContactFilter {
    bool mayTouch(const FilteredShape& a, const FilteredShape& b) const noexcept override {
        return a.userData == b.userData || a.userData == kOfAnyKind || b.userData == kOfAnyKind;
    }
};

/// Three kinds, some of each bullets, some bouncing, one with a sensor; the walls are for all.
struct FilteredCrowd {
    World world;
    std::vector<BodyId> bodies;

    FilteredCrowd(std::uint64_t seed, const ContactFilter& filter) {
        world = makeWorld(awakeSettings());
        world.setContactFilter(&filter);
        const BodyId walls = must(world.createBody({}));
        const std::array corners{vec(-9, -9), vec(-9, 9), vec(9, 9), vec(9, -9)};  // clockwise: solid outside
        ShapeDef surface = material(0.5);
        surface.userData = kOfAnyKind;
        must(world.addChain(walls, corners, true, surface));
        Random random(seed);
        bodies = throwCrowd(world, random, 90, [](int i, BodyDef& def, ShapeDef& shape) {
            def.bullet = i % 4 == 0;
            shape.restitution = i % 5 == 0 ? real(0.8) : real(0);
            shape.userData = static_cast<std::uint64_t>(i % 3);
        });
        ShapeDef sensor = material(0, 0, 0);
        sensor.sensor = true;
        must(world.addShape(bodies[0], circle(1.5), sensor));
    }

    bool areAlike(ShapeId a, ShapeId b) const { return SameKind().mayTouch(told(a), told(b)); }

private:
    FilteredShape told(ShapeId shape) const { return {.shape = shape, .userData = world.userData(shape)}; }
};

}  // namespace swept::test
