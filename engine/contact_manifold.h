#pragma once

#include "world_state.h"

namespace swept::inline SWEPT_PRECISION {

inline Transform relativePoseOf(const WorldState& world, const Contact& contact) {
    return relativeTransform(world.motions[contact.bodyA].pose, world.motions[contact.bodyB].pose);
}

/// The manifold at this relative pose: what is known of it (`KeptManifold`) if that is certain, else made anew. Points
/// that were there before keep their impulses.
/// @param reach  of points, metres
void updateManifold(const WorldState& world, Contact& contact, const Transform& bInA, ManifoldReach reach);
/// The first half of that. @return false where it has to be made anew
bool keepsManifold(Contact& contact, const Transform& bInA, ManifoldReach reach);
/// The second half, of what it was found to be.
void takeManifold(Contact& contact, const Transform& bInA, const Manifold& manifold);

}  // namespace swept::inline SWEPT_PRECISION
