#pragma once

#include <cstdint>

#include "../shapes/vec2.h"
#include "ids.h"
#include "shape_def.h"

namespace swept {

/// Which shapes a query sees: those whose category is in `mask` and whose mask has `category`, but for sensors and one
/// body.
struct QueryFilter {
    std::uint32_t category = 1;
    std::uint32_t mask = 0xFFFFFFFFu;
    bool sensors = false;  ///< whether it sees sensors, too
    BodyId ignore{};       ///< no shape of this body: of whom looks around, say
};

}  // namespace swept

namespace swept::inline SWEPT_PRECISION {

/// The first thing that a ray or a cast shape meets.
struct CastHit {
    bool hit = false;
    ShapeId shape{};
    BodyId body{};
    std::uint32_t segment = 0;  ///< of a chain, from 0 in the order of its points; of other shapes 0
    Real fraction = 0;          ///< of the translation, 0 … 1
    DVec2 point{};              ///< world
    Vec2 normal{};  ///< unit, outward from the shape that was hit; (0, 0) where a cast or ray starts inside it
    /// Of a shape that is cast from inside of it: the shortest translation that takes it out, metres; else (0, 0).
    Vec2 wayOut{};

    constexpr explicit operator bool() const { return hit; }
};

/// The shape that is nearest to a point or polygon.
struct NearestShape {
    bool found = false;
    ShapeId shape{};
    BodyId body{};
    std::uint32_t segment = 0;  ///< as of `CastHit`
    Real distance = 0;          ///< metres, radii included; negative: how deep they overlap
    DVec2 point{};              ///< on the surface of the shape, world: that is where it is nearest
    Vec2 normal{};              ///< unit, outward from the shape there, towards what asks

    constexpr explicit operator bool() const { return found; }
};

/// One contact as the world sees it now.
struct ContactView {
    ShapeId shapeA{};
    ShapeId shapeB{};
    BodyId bodyA{};
    BodyId bodyB{};
    std::uint32_t segmentA = 0;  ///< of a chain, from 0 in the order of its points; of other shapes 0
    std::uint32_t segmentB = 0;
    DVec2 point{};        ///< world, half way between the two surfaces
    Vec2 normal{};        ///< unit, from A to B
    Real separation = 0;  ///< metres along the normal; negative where they overlap
    Real impulse = 0;  ///< along the normal, N·s: of the last step, or of the last one that solved it, before it slept
};

}  // namespace swept::inline SWEPT_PRECISION
