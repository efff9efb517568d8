#include "solved_pair.h"

#include <algorithm>

#include "../contacts/ghosts.h"
#include "../state/tolerances.h"
#include "sweep_obstacles.h"
#include "sweep_tolerances.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

WorldTransform poseAt(const Sweep& path, double fraction) {
    return motionAt(path, fraction, toReal(path.localCenter)).pose;
}

}  // namespace

void allowTouch(const WorldState& world, FlightObstacle& shapes, const Sweep& own, const Sweep& other) {
    const Real margin = kEndRatio * extentOfPair(world.shapes[shapes.own], world.shapes[shapes.other]);
    const WorldTransform otherStart = poseAt(other, 0);
    const Manifold manifold = obstacleManifold(world, shapes, otherStart, poseAt(own, 0), margin);
    if (manifold.count == 0) { return; }
    shapes.lift = slackOf(world, shapes) * toDouble(rotate(otherStart.rotation, manifold.normal));
}

bool endsBeyond(const WorldState& world, const FlightObstacle& shapes, const Sweep& own, const Sweep& other,
                double fraction) {
    const Shape& ownShape = world.shapes[shapes.own];
    const Shape& otherShape = world.shapes[shapes.other];
    const WorldTransform otherMet = poseAt(other, fraction);
    const WorldTransform ownMet = poseAt(own, fraction);
    const Real margin = extentOfPair(ownShape, otherShape);
    const Manifold manifold = obstacleManifold(world, shapes, otherMet, ownMet, margin);
    if (manifold.count == 0) { return true; }
    // Along the normal as it turns with the longer one: that has the face.
    const Vec2 met = rotate(otherMet.rotation, manifold.normal);
    const WorldTransform otherEnd = poseAt(other, 1);
    const WorldTransform ownEnd = poseAt(own, 1);
    const bool isOnOther = otherShape.radius >= ownShape.radius;
    const Vec2 normal = isOnOther ? rotate(otherEnd.rotation, manifold.normal)
                                  : rotate(ownEnd.rotation, unrotate(ownMet.rotation, met));
    const Real before = separationAlong(otherShape.polygon, otherMet, ownShape.polygon, ownMet, met);
    const Real after = separationAlong(otherShape.polygon, otherEnd, ownShape.polygon, ownEnd, normal);
    return static_cast<double>(after) < std::min(static_cast<double>(before), 0.0) - slackOf(world, shapes);
}

}  // namespace swept::inline SWEPT_PRECISION
