#include "contact_manifold.h"

#include <algorithm>
#include <cmath>

#include "../state/tolerances.h"
#include "shape_manifold.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

int pointWithId(const Manifold& manifold, FeatureId id) {
    for (int i = 0; i < manifold.count; ++i) {
        if (manifold.points[static_cast<std::size_t>(i)].id == id) { return i; }
    }
    return -1;
}

/// Of the same features, in the same order.
bool hasSamePoints(const Manifold& a, const Manifold& b) {
    if (a.count != b.count) { return false; }
    if (a.count == 2) {
        return a.points[0].id == b.points[0].id && a.points[1].id == b.points[1].id && a.points[0].id != a.points[1].id;
    }
    return a.count == 0 || a.points[0].id == b.points[0].id;
}

/// The old point that a new one continues: of the same features, else the nearest within a part of the extent (clipping
/// may name a point after either of two vertices that stand at the same place). One that another new point has by name,
/// or that lies nearer to the other one, is not free: two points must not take over the same impulse.
int predecessorOf(const Manifold& now, std::size_t index, const OldPoints& before) {
    const ManifoldPoint& point = now.points[index];
    const int same = pointWithId(before.manifold, point.id);
    if (same >= 0) { return same; }
    int nearest = -1;
    Real least = square(kSamePlaceRatio * before.extent);
    for (int i = 0; i < before.manifold.count; ++i) {
        const ManifoldPoint& old = before.manifold.points[static_cast<std::size_t>(i)];
        const Real away = lengthSquared(old.point - point.point);
        if (!(away < least) || pointWithId(now, old.id) >= 0) { continue; }
        if (now.count > 1) {
            const Real fromOther = lengthSquared(old.point - now.points[1 - index].point);
            if (fromOther < away || (fromOther == away && index > 0)) { continue; }
        }
        nearest = i;
        least = away;
    }
    return nearest;
}

}  // namespace

void carryImpulses(const OldPoints& before, Contact& now) {
    now.normalImpulse = {};
    now.tangentImpulse = {};
    if (before.manifold.count == 0) { return; }
    for (std::size_t i = 0; i < static_cast<std::size_t>(now.manifold.count); ++i) {
        const int old = predecessorOf(now.manifold, i, before);
        if (old < 0) { continue; }
        now.normalImpulse[i] = before.normalImpulse[static_cast<std::size_t>(old)];
        now.tangentImpulse[i] = before.tangentImpulse[static_cast<std::size_t>(old)];
    }
}

bool keepsManifold(Contact& contact, const Transform& bInA, ManifoldReach reach) {
    const KeptManifold& kept = contact.kept;
    if (!contact.isKept || contact.manifold.count != 2) { return false; }  // ghosts and passers lose their points
    const Rotation turn = bInA.rotation * inverse(kept.bInA.rotation);
    if (!(turn.c > 0) || !(std::fabs(turn.s) <= kKeepRatio)) { return false; }
    const Vec2 shift = bInA.translation - kept.bInA.translation;
    const Real farthest = kKeepRatio * contact.extent;
    std::array<Real, 2> separations;
    for (std::size_t i = 0; i < separations.size(); ++i) {
        // Of the point of B that was there; the rest of its way is the square of an angle.
        const Vec2 moved = shift + cross(turn.s, contact.manifold.points[i].point - kept.bInA.translation);
        if (!(std::fabs(moved.x) + std::fabs(moved.y) <= farthest)) { return false; }
        separations[i] = kept.separations[i] + dot(kept.normal, moved);
        if (separations[i] > reach.points) { return false; }
    }
    if (std::min(separations[0], separations[1]) > reach.nearest) { return false; }
    contact.manifold.points[0].separation = separations[0];
    contact.manifold.points[1].separation = separations[1];
    if (contact.manifold.isNormalOfB) { contact.manifold.normal = kept.normal + cross(turn.s, kept.normal); }
    return true;
}

void takeManifold(Contact& contact, const Transform& bInA, const Manifold& manifold) {
    if (hasSamePoints(contact.manifold, manifold)) {
        contact.manifold = manifold;
    } else {
        const OldPoints before = oldPointsOf(contact);
        contact.manifold = manifold;
        carryImpulses(before, contact);
    }
    keepManifold(contact, bInA);
}

void renewManifold(const WorldState& world, Contact& contact, const Transform& bInA, ManifoldReach reach) {
    const Shape& a = world.shapes[contact.shapeA];
    const Shape& b = world.shapes[contact.shapeB];
    takeManifold(contact, bInA, shapeManifold(world, a, b, bInA, reach, contact.memory));
}

}  // namespace swept::inline SWEPT_PRECISION
