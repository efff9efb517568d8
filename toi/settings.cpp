#include <algorithm>
#include <cmath>

#include "moving_pair.h"
#include "time_of_impact.h"

namespace swept {
namespace {

constexpr double kTargetRatio = 1.0 / 1024;  // of the pair's extent
constexpr double kToleranceRatio = 1.0 / 4;  // of the target
constexpr double kTolerancePerSlack = 4;     // half the tolerance holds the slack of a bound and that of a distance

DVec2 vertex(const ToiPolygon& polygon, int i) { return polygon.vertices[static_cast<std::size_t>(i)]; }

DVec2 edge(const ToiPolygon& polygon, int i) {
    return vertex(polygon, i + 1 < polygon.count ? i + 1 : 0) - vertex(polygon, i);
}

/// Width of a core of three or more vertices: the smallest, over the edges, of the farthest vertex's distance.
double widthOf(const ToiPolygon& polygon) {
    double width = 0;
    for (int i = 0; i < polygon.count; ++i) {
        double farthest = 0;
        for (int j = 0; j < polygon.count; ++j) {
            farthest = std::max(farthest, cross(edge(polygon, i), vertex(polygon, j) - vertex(polygon, i)));
        }
        const double height = farthest / length(edge(polygon, i));
        width = i == 0 ? height : std::min(width, height);
    }
    return width;
}

double largestOf(const ToiPolygon& polygon) {
    double largest = 0;
    for (int i = 0; i < polygon.count; ++i) {
        const DVec2 v = vertex(polygon, i);
        largest = std::max({largest, std::fabs(v.x), std::fabs(v.y)});
    }
    return largest;
}

/// Where products of two coordinates, and with them widths, keep all their digits.
bool productsFit(double size) {
    constexpr double kLargest = 0x1p200;
    return size <= kLargest && size >= 1 / kLargest;
}

/// What is huge or tiny, near 1. @return and the exponent of the power of two by which it was larger
ToiPolygon nearOne(ToiPolygon polygon, int& exponent) {
    (void)std::frexp(largestOf(polygon), &exponent);
    for (DVec2& v : polygon.vertices) { v = {std::ldexp(v.x, -exponent), std::ldexp(v.y, -exponent)}; }
    return polygon;
}

double coreExtentOf(const ToiPolygon& polygon) {
    const double width = widthOf(polygon);
    if (productsFit(width) || !(largestOf(polygon) > 0)) { return width; }
    int exponent = 0;
    const ToiPolygon near = nearOne(polygon, exponent);
    return std::ldexp(widthOf(near), exponent);
}

/// Smallest non-zero width, radius included; 0 for a point without radius.
double extentOf(const ToiPolygon& polygon) {
    const double core = polygon.count > 2 ? coreExtentOf(polygon) : 0;
    if (core > 0 || polygon.radius > 0) { return core + 2 * polygon.radius; }
    return polygon.count == 2 ? length(edge(polygon, 0)) : 0;
}

/// Strictly convex and counter-clockwise, once around: every vertex lies to the left of every edge it is not on.
bool turnsLeft(const ToiPolygon& polygon) {
    for (int i = 0; i < polygon.count; ++i) {
        for (int ahead = 2; ahead < polygon.count; ++ahead) {
            const int j = (i + ahead) % polygon.count;
            if (!(cross(edge(polygon, i), vertex(polygon, j) - vertex(polygon, i)) > 0)) { return false; }
        }
    }
    return true;
}

/// Only signs are asked for, so the size of the polygon does not matter, once products are numbers.
bool isConvex(const ToiPolygon& polygon) {
    if (turnsLeft(polygon)) { return true; }
    if (productsFit(largestOf(polygon))) { return false; }
    int exponent = 0;
    return turnsLeft(nearOne(polygon, exponent));
}

bool isFinite(const Sweep& sweep) {
    return isFinite(sweep.localCenter) && isFinite(sweep.c0) && isFinite(sweep.c1) && isFinite(sweep.k) &&
           std::isfinite(sweep.a0) && std::isfinite(sweep.a1);
}

Status validateSettings(const ToiSettings& settings, double radii) {
    if (!std::isfinite(settings.target)) { return {StatusCode::notFinite, "target"}; }
    if (!std::isfinite(settings.tolerance)) { return {StatusCode::notFinite, "tolerance"}; }
    if (!std::isfinite(settings.tMax)) { return {StatusCode::notFinite, "tMax"}; }
    if (!(settings.tMax > 0)) { return {StatusCode::notPositive, "tMax"}; }
    if (settings.tMax > 1) { return {StatusCode::outOfRange, "tMax"}; }
    if (!(settings.tolerance > 0)) { return {StatusCode::notPositive, "tolerance"}; }
    if (settings.target + radii < 0) { return {StatusCode::outOfRange, "target"}; }
    return Status::success();
}

}  // namespace

ToiSettings defaultToiSettings(const ToiPolygon& a, const ToiPolygon& b) {
    const double extentA = extentOf(a);
    const double extentB = extentOf(b);
    const double smaller = std::min(extentA, extentB);
    const double extent = smaller > 0 ? smaller : std::max(extentA, extentB);
    ToiSettings settings;
    settings.target = kTargetRatio * extent;
    settings.tolerance = kToleranceRatio * settings.target;
    return settings;
}

Status validateToiPolygon(const ToiPolygon& polygon) {
    if (polygon.count < 1) { return {StatusCode::tooFewVertices, "vertices"}; }
    if (polygon.count > static_cast<int>(polygon.vertices.size())) { return {StatusCode::tooManyVertices, "vertices"}; }
    for (int i = 0; i < polygon.count; ++i) {
        if (!isFinite(vertex(polygon, i))) { return {StatusCode::notFinite, "vertices"}; }
    }
    if (!std::isfinite(polygon.radius)) { return {StatusCode::notFinite, "radius"}; }
    if (polygon.radius < 0) { return {StatusCode::negative, "radius"}; }
    if (polygon.count == 2 && vertex(polygon, 0) == vertex(polygon, 1)) { return {StatusCode::degenerate, "vertices"}; }
    if (!isConvex(polygon)) { return {StatusCode::notConvex, "vertices"}; }
    return Status::success();
}

Status validateToi(const ToiPolygon& a, const Sweep& sweepA, const ToiPolygon& b, const Sweep& sweepB,
                   const ToiSettings& settings) {
    if (const Status status = validateToiPolygon(a); !status.ok()) { return status; }
    if (const Status status = validateToiPolygon(b); !status.ok()) { return status; }
    if (!isFinite(sweepA)) { return {StatusCode::notFinite, "sweepA"}; }
    if (!isFinite(sweepB)) { return {StatusCode::notFinite, "sweepB"}; }
    if (const Status status = validateSettings(settings, a.radius + b.radius); !status.ok()) { return status; }
    const double slack = roundingSlack(a, sweepA, b, sweepB);
    if (!std::isfinite(slack)) { return {StatusCode::outOfRange, "sweep"}; }  // differences overflow
    if (settings.tolerance < kTolerancePerSlack * slack) { return {StatusCode::outOfRange, "tolerance"}; }
    return Status::success();
}

}  // namespace swept
