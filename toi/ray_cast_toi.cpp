#include "ray_cast_toi.h"

#include <algorithm>

#include "../shapes/ray_cast.h"
#include "method_pair.h"

namespace swept {
namespace {

/// Mean of the vertices, from the centre of mass.
Vec2 middleOf(const Polygon& polygon) {
    Vec2 sum;
    for (const Vec2 vertex : polygon.points()) { sum += vertex; }
    return (1.0 / polygon.count) * sum;
}

/// What part of the path the other body's middle covers before it runs into the shape; 2 when it does not.
/// @param path  of the middle, world axes, metres.
double castAgainst(const MethodBody& shape, Rotation rotation, double radius, Vec2 from, Vec2 path) {
    Polygon grown = shape.polygon;
    grown.radius = radius;
    const Vec2 origin = unrotate(rotation, from);
    const Vec2 direction = unrotate(rotation, path);
    if (direction == Vec2{}) { return containsPoint(grown, origin) ? 0 : 2; }
    const RayCastHit hit = rayCast(grown, origin, direction, 1);
    return hit.hit ? hit.fraction : 2;
}

}  // namespace

Toi rayCastToi(const ToiPolygon& a, const Sweep& sweepA, const ToiPolygon& b, const Sweep& sweepB,
               const ToiSettings& settings) {
    const MethodPair pair(a, sweepA, b, sweepB);
    const Rotation rotationA = pair.motion.rotationA(0);
    const Rotation rotationB = pair.motion.rotationB(0);
    const DVec2 chord = pair.motion.offsetAt(settings.tMax) - pair.motion.start;
    const Vec2 path{chord.x, chord.y};
    const Vec2 offset{pair.motion.start.x, pair.motion.start.y};
    const Vec2 middleA = rotate(rotationA, middleOf(pair.a.polygon));
    const Vec2 middleB = rotate(rotationB, middleOf(pair.b.polygon));

    const double radius = pair.radii() + settings.target;
    const double ofB = castAgainst(pair.a, rotationA, radius, offset + middleB, path);
    const double ofA = castAgainst(pair.b, rotationB, radius, middleA - offset, -path);
    const double part = std::min(ofA, ofB);
    const bool hit = part <= 1;

    SimplexCache cache;
    const MethodPose pose = pair.poseAt(hit ? part * settings.tMax : settings.tMax, cache);
    return answerFrom(pose, sweepA, settings, hit ? ToiState::hit : ToiState::separated, 2);
}

}  // namespace swept
