#pragma once

#include "../../shapes/vec2.h"

namespace swept::inline SWEPT_PRECISION {

/// What a contact carried whose points slid along the ground since its manifold was found last (slides.h). Frame of A.
struct Slide {
    Vec2 normal{};
    Real impulse = 0;         ///< along the normal, N·s; 0: it did not slide, or carried nothing
    Real tangentImpulse = 0;  ///< N·s
    Real moment = 0;          ///< of the normal impulses about the origin of body B, N·s·m
};

}  // namespace swept::inline SWEPT_PRECISION
