#pragma once

#include <span>

#include "../body_state.h"

namespace swept::inline SWEPT_PRECISION {

/// Moves and turns bodies as fast as they are for h seconds, and finds their rotations.
using MoveBodies = void (*)(std::span<BodyState> bodies, Real h);

/// Body by body.
void moveBodies(std::span<BodyState> bodies, Real h);
/// The same to the bit, a register of bodies at once; null where there are no kernels, see `contactKernels`.
MoveBodies motionKernel();

/// Rotations of as many angles, radians.
using FindRotations = void (*)(std::span<const double> angles, std::span<Rotation> rotations);

/// `rotationFromAngle` of each.
void findRotations(std::span<const double> angles, std::span<Rotation> rotations);
/// The same to the bit, a register of angles at once; null where `motionKernel` is.
FindRotations rotationKernel();

}  // namespace swept::inline SWEPT_PRECISION
