#pragma once

#include <cmath>

#include "../../shapes/branchless.h"
#include "../state/tolerances.h"
#include "../state/world_state.h"

namespace swept::inline SWEPT_PRECISION {

inline Transform relativePoseOf(const WorldState& world, const Contact& contact) {
    return relativeTransform(world.motions[contact.bodyA].pose, world.motions[contact.bodyB].pose);
}

/// The manifold at this relative pose from what is known of it (`KeptManifold`). @return false where that is not
/// certain: it has to be made anew
/// @param reach  of points, metres
bool keepsManifold(Contact& contact, const Transform& bInA, ManifoldReach reach);
/// What has turned too far for that, as most of what moves has. (That is asked first, so that the branch on it is
/// foretold: whether there are two points is not.)
inline bool mayKeepManifold(const Contact& contact, const Transform& bInA) {
    const Rotation turn = bInA.rotation * inverse(contact.kept.bInA.rotation);
    return std::fabs(turn.s) <= kKeepRatio && turn.c > 0 && contact.isKept;
}
/// Makes it anew. Points that were there before keep their impulses.
void renewManifold(const WorldState& world, Contact& contact, const Transform& bInA, ManifoldReach reach);
/// Writes down where the manifold was found that a contact has by now, so that the next step may keep it. Points that
/// it has not have no impulses.
inline void keepManifold(Contact& contact, const Transform& bInA) {
    const Manifold& manifold = contact.manifold;
    contact.kept.bInA.translation.x = bInA.translation.x;
    contact.kept.bInA.translation.y = bInA.translation.y;
    contact.kept.bInA.rotation.c = bInA.rotation.c;
    contact.kept.bInA.rotation.s = bInA.rotation.s;
    contact.kept.normal.x = manifold.normal.x;
    contact.kept.normal.y = manifold.normal.y;
    contact.kept.separations[0] = manifold.points[0].separation;
    contact.kept.separations[1] = manifold.points[1].separation;
    contact.isKept = manifold.count == 2;
    // No branch would foretell whether there is one point or two.
    contact.normalImpulse[1] = orZero(manifold.count > 1, contact.normalImpulse[1]);
    const bool hasOther = (int{manifold.count > 1} | int{contact.resistsRolling}) != 0;
    contact.tangentImpulse[1] = orZero(hasOther, contact.tangentImpulse[1]);
    if (manifold.count < 1) { contact.normalImpulse[0] = contact.tangentImpulse[0] = contact.tangentImpulse[1] = 0; }
}
/// The second half of that, of what it was found to be.
void takeManifold(Contact& contact, const Transform& bInA, const Manifold& manifold);

/// What there was of a contact before its manifold was renewed.
struct OldPoints {
    Manifold manifold;
    std::array<Real, 2> normalImpulse;
    std::array<Real, 2> tangentImpulse;
    Real extent;
};
/// Copies what is to be carried over.
inline OldPoints oldPointsOf(const Contact& contact) {
    return {contact.manifold, contact.normalImpulse, contact.tangentImpulse, contact.extent};
}
/// To a contact that has other points now: each has the impulses of the one that it continues.
void carryImpulses(const OldPoints& before, Contact& now);

}  // namespace swept::inline SWEPT_PRECISION
