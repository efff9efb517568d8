#pragma once

#include "../state/world_state.h"

namespace swept::inline SWEPT_PRECISION {

/// Energy that the springs of a joint hold, J, as sub-steps keep it: a step (x, v) → (x + h·v₁, v₁), v₁ = v − h·ω²·x
/// conserves v² + ω²·x·(x − h·v), the product of a stretch and the one before it, where ½·k·x² swings by ω·h/2 of
/// itself. 0 of a joint without springs, and of one that a motor drives or that follows a target.
/// @param h  length of a sub-step, s
/// @param a, b  how its bodies stand and move
double springEnergyOf(const WorldState& world, const Joint& joint, Real h, const BodyMotion& a, const BodyMotion& b);

}  // namespace swept::inline SWEPT_PRECISION
