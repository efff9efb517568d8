#pragma once

#include "../../shapes/real.h"

namespace swept::inline SWEPT_PRECISION {

struct WorldState;

/// Fills the lists, and the states of what is noted. @pre glances and boxes are those of this step
void listContacts(WorldState& world);

}  // namespace swept::inline SWEPT_PRECISION
