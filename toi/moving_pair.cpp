#include "moving_pair.h"

#include <algorithm>
#include <limits>
#include <type_traits>

#include "../shapes/distance.h"
#include "../shapes/gjk_enclosure.h"

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

/// Beyond it, or below its inverse, products of four coordinates leave the
/// range of double.
constexpr double kLargestProduct = 0x1p200;

Polygon withNormals(const Polygon& polygon) {
    Polygon result;
    result.count = polygon.count;
    result.radius = polygon.radius;
    std::copy_n(polygon.vertices.begin(), polygon.count, result.vertices.begin());
    if (polygon.count < 2) { return result; }
    for (int i = 0; i < polygon.count; ++i) {
        result.normals[static_cast<std::size_t>(i)] = edgeNormal(
            polygon.vertices[static_cast<std::size_t>(i)], polygon.vertices[static_cast<std::size_t>(polygon.next(i))]);
    }
    return result;
}

/// Squared, beyond which ratio of their lengths an edge is lost beside another: rounding then picks any of its ends as
/// the closest one, so both turn up in a simplex, and its normal has nothing to do with the closest direction.
constexpr double kLostEdge = 0x1p52;

bool isLostBeside(Vec2 edge, Vec2 other) { return dot(edge, edge) * kLostEdge < dot(other, other); }

/// A simplex of one vertex of B and an edge of A holds a face of A, and the other way round; two edges are parallel,
/// and either's.
AxisOwner ownerOf(const MovingPair& pair, const GjkResult& gjk) {
    if (gjk.count < 2) { return AxisOwner::world; }
    const SupportPair& p = gjk.simplex[0];
    const SupportPair& q = gjk.simplex[1];
    if (p.a == q.a) { return AxisOwner::b; }
    if (p.b == q.b) { return AxisOwner::a; }
    const bool isLost = isLostBeside(pair.a.vertex(q.a) - pair.a.vertex(p.a), pair.b.vertex(q.b) - pair.b.vertex(p.b));
    return isLost ? AxisOwner::b : AxisOwner::a;
}

/// Whether it pays to look for a proof of overlap before the distance: shapes of like size with their centres near each
/// other. Beside a wide floor centres are near without any overlap, and the look would be in vain.
bool mayOverlapDeeply(const MovingPair& pair, DVec2 offset) {
    constexpr double kLikeSize = 3;
    const double smaller = std::min(pair.a.reach(), pair.b.reach());
    const double larger = std::max(pair.a.reach(), pair.b.reach());
    return larger < kLikeSize * smaller && dot(offset, offset) < smaller * smaller;
}

double largestAngle(const Sweep& sweep) { return std::max(std::fabs(sweep.a0), std::fabs(sweep.a1)); }

}  // namespace

CenteredPolygon::CenteredPolygon(const ToiPolygon& source, DVec2 center) {
    Polygon& polygon = *std::launder(reinterpret_cast<Polygon*>(storage_.data()));
    polygon.count = source.count;
    polygon.radius = source.radius;
    // GJK's first look multiplies all places at once: without value they could underflow, or be slow subnormals.
    polygon.vertices = {};
    double farthest = 0;
    DVec2 sum{};
    for (std::size_t i = 0; i < static_cast<std::size_t>(source.count); ++i) {
        const DVec2 r = source.vertices[i] - center;
        polygon.vertices[i] = {r.x, r.y};
        farthest = std::max(farthest, dot(r, r));
        sum += r;
    }
    middle_ = (1.0 / source.count) * sum;
    reach_ = (1 + 4 * kEpsilon) * std::sqrt(farthest);
}

MovingPair::MovingPair(const ToiPolygon& polygonA, const Sweep& sweepA, const ToiPolygon& polygonB, const Sweep& sweepB)
    : a(polygonA, sweepA.localCenter),
      b(polygonB, sweepB.localCenter),
      motion(sweepA, sweepB),
      radii(polygonA.radius + polygonB.radius),
      fastest(length(motion.change) + (motion.curvature != DVec2{} ? length(motion.curvature) : 0)) {
    const double largest = std::max({a.reach(), b.reach(), sumNorm(motion.start), sumNorm(motion.change)});
    isExtreme_ = !(largest < kLargestProduct && largest > 1 / kLargestProduct);
}

PairPose MovingPair::poseAt(double fraction) const {
    const DVec2 offset = motion.offsetAt(fraction);
    return {fraction, motion.rotationA(fraction), motion.rotationB(fraction), {offset.x, offset.y}};
}

void MovingPair::moveTo(double fraction, PairPose& pose) const {
    const DVec2 offset = motion.offsetAt(fraction);
    pose.fraction = fraction;
    pose.offset = {offset.x, offset.y};
    if (motion.spinA != 0) { pose.rotationA = motion.rotationA(fraction); }
    if (motion.spinB != 0) { pose.rotationB = motion.rotationB(fraction); }
}

Transform MovingPair::bInA(const PairPose& pose) const {
    return {unrotate(pose.rotationA, pose.offset), inverse(pose.rotationA) * pose.rotationB};
}

void MovingPair::findClosest(const PairPose& pose, SimplexCache& cache, Closest& closest) const {
    GjkResult& gjk = closest.gjk;
    gjk.outcome = GjkOutcome::stalled;
    gjk.iterations = 0;
    gjk.encloses = false;
    closest.owner = AxisOwner::world;
    if (!isExtreme_) {
        const PairView view(a.polygon(), b.polygon(), bInA(pose));
        const gjk::Features begin = gjk::start(view, &cache);
        const double extent = 2 * (a.reach() + b.reach()) + sumNorm(view.translation);
        if (cache.count == 0 && mayOverlapDeeply(*this, view.translation) &&
            gjk::provesOverlap(view, begin, a.middle(), b.middle(), extent)) {
            gjk.outcome = GjkOutcome::touching;
            gjk.encloses = true;
            closest.separation = 0;
            return;
        }
        gjk::runFrom(view, begin, &cache, gjk);
        remember(gjk, cache);
    }
    if (gjk.outcome == GjkOutcome::apart) {
        closest.separation = gjk.distance - radii;
        closest.coreSeparation = gjk.distance;
        closest.normal = {gjk.normal.x, gjk.normal.y};
        closest.owner = ownerOf(*this, gjk);
    } else if (gjk.encloses) {
        closest.separation = 0;
    } else {
        measureOverlap(pose, closest);
    }
}

void MovingPair::measureOverlap(const PairPose& pose, Closest& closest) const {
    const Distance exact = distance(withNormals(a.polygon()), withNormals(b.polygon()), bInA(pose));
    closest.separation = exact.distance;
    closest.coreSeparation = exact.coreDistance;
    closest.normal = exact.normal;
    closest.exactPoints = {toDouble(exact.pointA), toDouble(exact.pointB)};
}

CorePoints MovingPair::witnessesOf(const PairPose& pose, const Closest& closest) const {
    if (!closest.isApart()) { return closest.exactPoints; }
    const DVec2 normal = closest.gjk.normal;
    CorePoints points =
        witnessOf(PairView(a.polygon(), b.polygon(), bInA(pose)), closest.gjk, closest.gjk.distance * normal);
    return {points.a + a.polygon().radius * normal, points.b + (-b.polygon().radius) * normal};
}

double roundingSlack(const ToiPolygon& a, const Sweep& sweepA, const ToiPolygon& b, const Sweep& sweepB) {
    // A coordinate goes through at most some 20 roundings of half an epsilon:
    // differences, the turn into the frame of A (cosine, sine, two products, a
    // sum; twice for B), the distance's own 8, the projection on the axis.
    constexpr double kRoundings = 16;
    const RelativeMotion motion(sweepA, sweepB);
    const double centers = length(motion.start) + length(sweepB.c1 - sweepA.c1) + length(sweepA.k) + length(sweepB.k);
    // An angle of many radians is uncertain by its own last place, and moves a
    // vertex by that much times its reach.
    const double reachA = largestCoordinate(a, sweepA.localCenter) * (1 + largestAngle(sweepA) / 4);
    const double reachB = largestCoordinate(b, sweepB.localCenter) * (1 + largestAngle(sweepB) / 4);
    return kRoundings * std::numeric_limits<double>::epsilon() * (centers + reachA + reachB + a.radius + b.radius);
}

}  // namespace swept::inline SWEPT_PRECISION
