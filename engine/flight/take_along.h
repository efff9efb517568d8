#pragma once

#include "flight.h"

namespace swept::inline SWEPT_PRECISION {

/// What is held at its impact goes nowhere by itself for the rest of the step. A kinematic body that moves on meanwhile
/// takes it along from where it gets to it, as if they were one, until it meets something else: else it would go
/// through it.
/// @param motion  of the body, standing; its velocities stay as they are
/// @param from, to  seconds after the poses that kinematic bodies have now
void takeAlong(const WorldState& world, std::uint32_t body, BodyMotion& motion, double from, double to,
               FlightScratch& scratch);

}  // namespace swept::inline SWEPT_PRECISION
