#include "moving_pair.h"

#include <algorithm>
#include <limits>
#include <type_traits>

namespace swept::inline SWEPT_PRECISION {
namespace {

static_assert(std::is_same_v<Real, double>, "a float fraction cannot express the certificate");

/// Largest length of coordinates that the centred vertices are made from.
double largestCoordinate(const ToiPolygon& polygon, DVec2 center) {
    double largest = 0;
    for (int i = 0; i < polygon.count; ++i) {
        largest = std::max(largest, length(polygon.vertices[static_cast<std::size_t>(i)]));
    }
    return largest + length(center);
}

double largestAngle(const Sweep& sweep) { return std::max(std::fabs(sweep.a0), std::fabs(sweep.a1)); }

}  // namespace

CenteredPolygon::CenteredPolygon(const ToiPolygon& source, DVec2 center) {
    polygon.count = source.count;
    polygon.radius = source.radius;
    for (std::size_t i = 0; i < static_cast<std::size_t>(source.count); ++i) {
        const DVec2 r = source.vertices[i] - center;
        polygon.vertices[i] = {r.x, r.y};
        reach[i] = length(r);
    }
    if (polygon.count < 2) { return; }
    for (int i = 0; i < polygon.count; ++i) {
        const Vec2 from = polygon.vertices[static_cast<std::size_t>(i)];
        const Vec2 to = polygon.vertices[static_cast<std::size_t>(polygon.next(i))];
        polygon.normals[static_cast<std::size_t>(i)] = normalized(rightPerp(to - from)).unit;
    }
}

PairPose MovingPair::poseAt(double fraction, SimplexCache& cache) const {
    const auto inA = [](Rotation q, DVec2 world) { return unrotate(q, Vec2{world.x, world.y}); };
    PairPose pose;
    pose.fraction = fraction;
    pose.rotationA = motion.rotationA(fraction);
    pose.bInA.translation = inA(pose.rotationA, motion.offsetAt(fraction));
    pose.bInA.rotation = inverse(pose.rotationA) * motion.rotationB(fraction);
    pose.velocity = inA(pose.rotationA, motion.velocityAt(fraction));
    pose.curvature = inA(pose.rotationA, motion.curvature);
    pose.distance = distance(a.polygon, b.polygon, pose.bInA, &cache);
    return pose;
}

double roundingSlack(const ToiPolygon& a, const Sweep& sweepA, const ToiPolygon& b, const Sweep& sweepB) {
    // A coordinate goes through at most some 20 roundings of half an epsilon: differences, the turn into the frame of A
    // (cosine, sine, two products, a sum; twice for B), the distance's own 8, the projection on the axis.
    constexpr double kRoundings = 16;
    const RelativeMotion motion(sweepA, sweepB);
    const double centers =
        length(motion.start) + length(sweepB.c1 - sweepA.c1) + length(sweepA.k) + length(sweepB.k);
    // An angle of many radians is uncertain by its own last place, and moves a vertex by that much times its reach.
    const double reachA = largestCoordinate(a, sweepA.localCenter) * (1 + largestAngle(sweepA) / 4);
    const double reachB = largestCoordinate(b, sweepB.localCenter) * (1 + largestAngle(sweepB) / 4);
    return kRoundings * std::numeric_limits<double>::epsilon() * (centers + reachA + reachB + a.radius + b.radius);
}

}  // namespace swept::inline SWEPT_PRECISION
