#include <algorithm>
#include <limits>
#include <vector>

#include <swept/shapes/hull.h>

#include "fuzz_targets.h"

namespace swept::test {
namespace {

constexpr int kMostPoints = 40;
// The hull drops points within rounding of an edge; normals and products are rounded once more each.
constexpr double kSlack = 32 * static_cast<double>(std::numeric_limits<Real>::epsilon());

}  // namespace

void fuzzHull(Bytes bytes) {
    FuzzInput input(bytes);
    std::vector<Vec2> points;
    const auto radius = static_cast<Real>(input.flag() ? input.number() : 0.0);
    const int count = input.below(kMostPoints);
    for (int i = 0; i < count; ++i) {
        const double x = input.number();
        points.push_back({static_cast<Real>(x), static_cast<Real>(input.number())});
    }
    const Result<Polygon> hull = convexHull(points, radius);
    if (!hull.ok()) {
        demand(hull.status().field[0] != '\0', "an error names what is wrong");
        return;
    }
    const Polygon& polygon = hull.value();
    demand(validate(polygon).ok(), "a hull is a valid polygon");
    double size = 0;
    for (const Vec2 p : points) { size = std::max({size, std::fabs(toDouble(p).x), std::fabs(toDouble(p).y)}); }
    for (int i = 0; i < polygon.count; ++i) {
        const auto edge = static_cast<std::size_t>(i);
        for (const Vec2 p : points) {
            const double outside = dot(toDouble(polygon.normals[edge]), toDouble(p) - toDouble(polygon.vertices[edge]));
            demand(!(outside > kSlack * size), "a hull holds its points");
        }
    }
}

}  // namespace swept::test
