#include "moving_pair.h"

#include <algorithm>
#include <limits>
#include <type_traits>

#include "../shapes/distance.h"
#include "../shapes/gjk_run.h"

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

/// Beyond it, or below its inverse, products of four coordinates leave the range of double.
constexpr double kLargestProduct = 0x1p200;

Polygon withNormals(const Polygon& polygon) {
    Polygon result = polygon;
    if (polygon.count < 2) { return result; }
    for (int i = 0; i < polygon.count; ++i) {
        result.normals[static_cast<std::size_t>(i)] = edgeNormal(polygon.vertices[static_cast<std::size_t>(i)],
                                                                 polygon.vertices[static_cast<std::size_t>(polygon.next(i))]);
    }
    return result;
}

/// A simplex of one vertex of B and an edge of A holds a face of A, and the other way round; two edges are either's.
AxisOwner ownerOf(const GjkResult& gjk) {
    if (gjk.count < 2) { return AxisOwner::world; }
    return gjk.simplex[0].a == gjk.simplex[1].a ? AxisOwner::b : AxisOwner::a;
}

double largestAngle(const Sweep& sweep) { return std::max(std::fabs(sweep.a0), std::fabs(sweep.a1)); }

}  // namespace

CenteredPolygon::CenteredPolygon(const ToiPolygon& source, DVec2 center) {
    polygon.count = source.count;
    polygon.radius = source.radius;
    for (std::size_t i = 0; i < static_cast<std::size_t>(source.count); ++i) {
        const DVec2 r = source.vertices[i] - center;
        polygon.vertices[i] = {r.x, r.y};
        reach = std::max(reach, dot(r, r));
    }
    reach = (1 + 4 * kEpsilon) * std::sqrt(reach);
}

MovingPair::MovingPair(const ToiPolygon& polygonA, const Sweep& sweepA, const ToiPolygon& polygonB,
                       const Sweep& sweepB)
    : a(polygonA, sweepA.localCenter), b(polygonB, sweepB.localCenter), motion(sweepA, sweepB) {
    const double largest = std::max({a.reach, b.reach, sumNorm(motion.start), sumNorm(motion.change)});
    isExtreme_ = !(largest < kLargestProduct && largest > 1 / kLargestProduct);
}

PairPose MovingPair::emptyPose() const {
    PairPose pose;
    pose.turnedB.count = b.polygon.count;
    pose.turnedB.radius = b.polygon.radius;
    pose.rotationA = motion.rotationA(0);
    pose.rotationB = motion.rotationB(0);
    return pose;
}

void MovingPair::moveTo(double fraction, PairPose& pose, SimplexCache& cache) const {
    const auto inA = [&pose](DVec2 world) { return unrotate(pose.rotationA, Vec2{world.x, world.y}); };
    pose.fraction = fraction;
    if (motion.spinA != 0) { pose.rotationA = motion.rotationA(fraction); }
    if (motion.spinB != 0) { pose.rotationB = motion.rotationB(fraction); }
    pose.bInA.translation = inA(motion.offsetAt(fraction));
    pose.bInA.rotation = inverse(pose.rotationA) * pose.rotationB;
    pose.velocity = inA(motion.velocityAt(fraction));
    pose.curvature = inA(motion.curvature);
    for (std::size_t i = 0; i < static_cast<std::size_t>(b.polygon.count); ++i) {
        pose.turnedB.vertices[i] = rotate(pose.bInA.rotation, b.polygon.vertices[i]);
    }
    pose.gjk.outcome = GjkOutcome::stalled;
    pose.gjk.iterations = 0;
    pose.gjk.encloses = false;
    if (!isExtreme_) {
        gjk::run(PairView(a.polygon, pose.turnedB, {pose.bInA.translation, {}}), &cache, pose.gjk);
        remember(pose.gjk, cache);
    }
    if (pose.gjk.outcome == GjkOutcome::apart) {
        pose.distance = {pose.gjk.distance - radii(), pose.gjk.distance, {pose.gjk.normal.x, pose.gjk.normal.y}};
        pose.axisOwner = ownerOf(pose.gjk);
    } else {
        const Distance exact = distance(withNormals(a.polygon), withNormals(b.polygon), pose.bInA);
        pose.distance = {exact.distance, exact.coreDistance, exact.normal};
        pose.axisOwner = AxisOwner::world;
    }
}

PairPose MovingPair::poseAt(double fraction, SimplexCache& cache) const {
    PairPose pose = emptyPose();
    moveTo(fraction, pose, cache);
    return pose;
}

CorePoints MovingPair::witnessesOf(const PairPose& pose) const {
    if (pose.gjk.outcome != GjkOutcome::apart) {
        const Distance exact = distance(withNormals(a.polygon), withNormals(b.polygon), pose.bInA);
        return {toDouble(exact.pointA), toDouble(exact.pointB)};
    }
    const DVec2 normal = pose.gjk.normal;
    CorePoints points = witnessOf(PairView(a.polygon, pose.turnedB, {pose.bInA.translation, {}}), pose.gjk,
                                  pose.gjk.distance * normal);
    return {points.a + a.polygon.radius * normal, points.b + (-b.polygon.radius) * normal};
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
