#pragma once

#include <array>
#include <cstdint>

#include "../../shapes/manifold.h"

namespace swept::inline SWEPT_PRECISION {

/// A contact as its store keeps it, as far as a solve is about it: two lines of a cache in `Real` float. The order of
/// the numbers is that in which they are loaded together.
struct ContactRow {
    std::uint32_t shapeA = 0;  ///< names that are the store's own, like those of the bodies
    std::uint32_t shapeB = 0;
    std::uint32_t bodyA = 0;
    std::uint32_t bodyB = 0;
    Manifold manifold;  ///< at the start of the present step, frame of body A

    std::array<Real, 2> normalImpulse{};   ///< warm start, by point of the manifold
    std::array<Real, 2> tangentImpulse{};  ///< likewise; of one point that rolls the second one is that of rolling
    std::array<Real, 2> totalImpulse{};    ///< normal impulse over the last step, N·s
    Real friction = 0;
    Real restitution = 0;
    Real radiusA = 0;
    Real radiusB = 0;
    Real extent = 0;  ///< of the pair
};

}  // namespace swept::inline SWEPT_PRECISION
