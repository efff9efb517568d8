#pragma once

#include "../../shapes/real.h"

namespace swept::inline SWEPT_PRECISION {

struct WorldState;

/// Finds the chains anew, and `WorldState::activeJoints`: wherever `areCurrent` does not hold. In proportion to what is
/// awake.
/// @pre the traits of this step tell who is awake
void findJointChains(WorldState& world);

}  // namespace swept::inline SWEPT_PRECISION
