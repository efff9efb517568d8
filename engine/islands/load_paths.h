#pragma once

#include "../../shapes/real.h"

namespace swept::inline SWEPT_PRECISION {

struct WorldState;

/// Room for as many points as there may be, where a search may begin: the first one comes long after all else is warm.
void makeRoomForLoads(WorldState& world);

/// Gives the contacts of what is still, but not in balance, impulses that are: from the top down each body is held by
/// the points below it, which are changed as little as that takes (`ConeBalance`), and hands its load, with all that
/// lies on it, to the bodies there; the ground takes what arrives. One pass does for any height, where iteration takes
/// as many as its square: a pile that begins at rest is in balance before it moves. Points at the side keep what they
/// have, unless a body needs those against the ground. Where a body cannot be held so, its island stays as it is, and
/// is sought for again after a pause that grows.
/// @pre `IslandRest::isSought` of the islands that are meant. @return whether any was changed; those that were not are
/// sought no longer
bool handLoadsDown(WorldState& world, double dt);

}  // namespace swept::inline SWEPT_PRECISION
