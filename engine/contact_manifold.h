#pragma once

#include "world_state.h"

namespace swept::inline SWEPT_PRECISION {

inline Transform relativePoseOf(const WorldState& world, const Contact& contact) {
    return relativeTransform(world.motions[contact.bodyA].pose, world.motions[contact.bodyB].pose);
}

/// The manifold at this relative pose from what is known of it (`KeptManifold`). @return false where that is not
/// certain: it has to be made anew
/// @param reach  of points, metres
bool keepsManifold(Contact& contact, const Transform& bInA, ManifoldReach reach);
/// Makes it anew. Points that were there before keep their impulses.
void renewManifold(const WorldState& world, Contact& contact, const Transform& bInA, ManifoldReach reach);
/// The second half of that, of what it was found to be.
void takeManifold(Contact& contact, const Transform& bInA, const Manifold& manifold);

}  // namespace swept::inline SWEPT_PRECISION
