#include "shape_manifold.h"

#include <algorithm>
#include <cmath>

#include "../state/tolerances.h"
#include "ghosts.h"
#include "round_ground.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// The face whose normal is almost, but not exactly, this one; −1: none.
int faceBeside(const Polygon& polygon, Vec2 normal) {
    const int face = faceWithNormal(polygon, normal);
    return face >= 0 && cross(polygon.normals[static_cast<std::size_t>(face)], normal) != 0 ? face : -1;
}

}  // namespace

Manifold shapeManifold(const WorldState& world, const Shape& a, const Shape& b, const Transform& bInA, Real margin) {
    ManifoldMemory memory;
    return shapeManifold(world, a, b, bInA, {margin, margin}, memory);
}

Manifold shapeManifold(const WorldState& world, const Shape& a, const Shape& b, const Transform& bInA,
                       ManifoldReach reach, ManifoldMemory& memory) {
    if (a.isChainSegment) { return collide(a.segment, a.polygon, b.polygon, bInA, reach.points, memory); }
    return turnedToGround(world, a, b, bInA, reach.points, collide(a.polygon, b.polygon, bInA, reach, memory));
}

bool mayTurnToGround(const Polygon& a, Vec2 normal) { return a.count == 1 || faceBeside(a, normal) >= 0; }

Manifold turnedToGround(const WorldState& world, const Shape& a, const Shape& b, const Transform& bInA, Real margin,
                        const Manifold& closest) {
    if (closest.count == 0 || world.bodies[a.body].isDynamic()) { return closest; }
    const Real slop = kTargetRatio * extentOfPair(a, b);
    if (a.polygon.count == 1) { return lyingOnRound(a.polygon, b.polygon, bInA, margin, slop, closest); }
    const int face = faceBeside(a.polygon, closest.normal);
    if (face < 0) { return closest; }
    const Manifold onFace = collideOnFace(a.polygon, face, b.polygon, bInA, margin, kFaceSine);
    const bool agrees = onFace.count > 0 && std::fabs(deepestSeparation(onFace) - deepestSeparation(closest)) <= slop;
    return agrees ? onFace : closest;
}

}  // namespace swept::inline SWEPT_PRECISION
