#include "method_pair.h"

#include <algorithm>

namespace swept::inline SWEPT_PRECISION {

MethodBody::MethodBody(const ToiPolygon& source, DVec2 center) {
    polygon.count = source.count;
    polygon.radius = source.radius;
    for (std::size_t i = 0; i < static_cast<std::size_t>(source.count); ++i) {
        polygon.vertices[i] = toReal(source.vertices[i] - center);
        reach[i] = length(polygon.vertices[i]);
    }
    if (polygon.count < 2) { return; }
    for (int i = 0; i < polygon.count; ++i) {
        const Vec2 from = polygon.vertices[static_cast<std::size_t>(i)];
        const Vec2 to = polygon.vertices[static_cast<std::size_t>(polygon.next(i))];
        polygon.normals[static_cast<std::size_t>(i)] = edgeNormal(from, to);
    }
}

double MethodBody::farthest() const { return *std::max_element(reach.begin(), reach.begin() + polygon.count); }

MethodPose MethodPair::poseAt(double fraction, SimplexCache& cache) const {
    MethodPose pose;
    pose.fraction = fraction;
    pose.rotationA = motion.rotationA(fraction);
    pose.bInA.translation = unrotate(pose.rotationA, toReal(motion.offsetAt(fraction)));
    pose.bInA.rotation = inverse(pose.rotationA) * motion.rotationB(fraction);
    pose.distance = distance(a.polygon, b.polygon, pose.bInA, &cache);
    return pose;
}

Toi answerFrom(const MethodPose& pose, const Sweep& sweepA, const ToiSettings& settings, ToiState state,
               int iterations) {
    const DVec2 origin = centerAt(sweepA, pose.fraction);
    const auto toWorld = [&pose](Vec2 v) { return toDouble(rotate(pose.rotationA, v)); };
    Toi toi;
    toi.state = state;
    toi.fraction = pose.fraction;
    toi.separation = pose.distance.distance;
    toi.normal = toWorld(pose.distance.normal);
    toi.pointA = origin + toWorld(pose.distance.pointA);
    toi.pointB = origin + toWorld(pose.distance.pointB);
    toi.target = settings.target;
    toi.fractionLower = toi.fraction;
    toi.separationLower = toi.separation;
    toi.iterations = iterations;
    return toi;
}

Toi hitAfter(const MethodLook& before, const MethodPose& pose, const Sweep& sweepA, const ToiSettings& settings,
             int iterations) {
    Toi toi = answerFrom(pose, sweepA, settings, ToiState::hit, iterations);
    if (before.fraction < toi.fraction) {
        toi.fractionLower = before.fraction;
        toi.separationLower = before.separation;
    }
    return toi;
}

std::optional<Toi> answerAtStart(const MethodPose& pose, const Sweep& sweepA, const ToiSettings& settings) {
    if (pose.distance.coreDistance <= 0) { return answerFrom(pose, sweepA, settings, ToiState::overlapped, 1); }
    if (pose.distance.distance <= settings.target) { return answerFrom(pose, sweepA, settings, ToiState::hit, 1); }
    return std::nullopt;
}

}  // namespace swept::inline SWEPT_PRECISION
