#include <cmath>

#include <gtest/gtest.h>

#include <swept/shapes/bounding_circle.h>

#include "shape_families.h"

/// Extent, bounds and enclosing circles.

namespace swept::test {
namespace {

/// Width of a polygon across the direction at `angle`, radii included.
long double widthAt(const std::vector<Point>& points, long double angle) {
    long double low = 1e30L;
    long double high = -1e30L;
    for (const Point p : points) {
        const long double along = std::cos(angle) * p.x + std::sin(angle) * p.y;
        low = std::min(low, along);
        high = std::max(high, along);
    }
    return high - low;
}

TEST(Extent, IsTheSmallestWidthOverAllDirections) {
    constexpr int kDirections = 720;
    const long double step = std::acos(-1.0L) / kDirections;
    Random random(1);
    for (int i = 0; i < 500; ++i) {
        const Polygon polygon = randomPolygon(random, random.chance(0.5) ? 0 : 0.25);
        const std::vector<Point> points = exactPoints(polygon);
        long double smallest = 1e30L;
        for (int k = 0; k < kDirections; ++k) { smallest = std::min(smallest, widthAt(points, step * k)); }
        smallest += 2 * exact(polygon.radius);
        const long double extent = exact(extentOf(polygon));
        ASSERT_LE(extent, smallest * (1 + 2 * kEps)) << "case " << i << ": " << polygon;
        // Between two directions a width changes by less than the diameter (below 2) times the angle.
        ASSERT_GE(extent, smallest - 2 * step) << "case " << i << ": " << polygon;
    }
}

TEST(Extent, OfTheSimpleShapes) {
    EXPECT_EQ(extentOf(makeCircle({5, 5}, real(0.25)).value()), real(0.5));
    EXPECT_EQ(extentOf(makeCapsule({0, 0}, {3, 4}, real(0.25)).value()), real(0.5));
    EXPECT_EQ(extentOf(makeSegment({0, 0}, {3, 4}).value()), 5);
    EXPECT_EQ(extentOf(makeBox({2, 1}).value()), 2);
    EXPECT_EQ(extentOf(makeBox({2, 1}, {0, 0}, 0, real(0.5)).value()), 3);
    const std::vector<Vec2> triangle = {{0, 0}, {4, 0}, {0, 3}};
    EXPECT_NEAR(static_cast<double>(extentOf(makePolygon(triangle).value())), 2.4, 1e-6);
}

/// Where the pose takes a body point, with the pose's own cosine and sine.
Point placedPoint(const WorldTransform& pose, Point v) {
    const long double c = exact(pose.rotation.c);
    const long double s = exact(pose.rotation.s);
    return exact(pose.position) + Point{c * v.x - s * v.y, s * v.x + c * v.y};
}

TEST(Bounds, ContainTheShapeWhereverItIs) {
    Random random(2);
    for (int i = 0; i < 20'000; ++i) {
        const Polygon polygon = randomShape(random, i % 3 == 0 ? 100 : 0);
        const double far = i % 4 == 0 ? 0 : std::pow(10.0, random.range(0, 12));
        const WorldTransform pose{{random.range(-far, far), random.range(-far, far)},
                                  rotationFromAngle(random.range(-4, 4))};
        const Aabb box = boundsOf(polygon, pose);
        const long double r = exact(polygon.radius);
        Point low{1e30L, 1e30L};
        Point high{-1e30L, -1e30L};
        for (const Vec2 v : polygon.points()) {
            const Point p = placedPoint(pose, exact(v));
            low = {std::min(low.x, p.x - r), std::min(low.y, p.y - r)};
            high = {std::max(high.x, p.x + r), std::max(high.y, p.y + r)};
            const DVec2 used = apply(pose, v);  // as a step computes it, rotated in Real
            ASSERT_LE(static_cast<double>(box.lower.x), used.x) << "case " << i;
            ASSERT_GE(static_cast<double>(box.upper.y), used.y) << "case " << i;
        }
        ASSERT_TRUE(isValid(box));
        ASSERT_LE(exact(box.lower).x, low.x) << "case " << i << ": " << polygon;
        ASSERT_LE(exact(box.lower).y, low.y) << "case " << i << ": " << polygon;
        ASSERT_GE(exact(box.upper).x, high.x) << "case " << i << ": " << polygon;
        ASSERT_GE(exact(box.upper).y, high.y) << "case " << i << ": " << polygon;
        const long double reach = 210;
        const long double slack = kEps * (5 * static_cast<long double>(far) + 8 * reach);
        ASSERT_GE(exact(box.lower).x, low.x - slack) << "case " << i << ": too wide";
        ASSERT_LE(exact(box.upper).y, high.y + slack) << "case " << i << ": too wide";
    }
}

TEST(Bounds, OfAWayContainBothItsEndsGrownByTheReach) {
    Random random(4);
    for (int i = 0; i < 5'000; ++i) {
        const Polygon polygon = randomShape(random, 0);
        const double far = std::pow(10.0, random.range(0, 12));
        const DVec2 from{random.range(-far, far), random.range(-far, far)};
        const DVec2 way{random.range(-far, far), random.range(-2, 2)};
        const Rotation rotation = rotationFromAngle(random.range(-4, 4));
        const Real reach = real(random.range(0, 3));
        const Aabb box = boundsOf(polygon, {from, rotation}, way, reach);
        const Point grown{exact(polygon.radius) + exact(reach), exact(polygon.radius) + exact(reach)};
        for (const Vec2 v : polygon.points()) {
            for (const Point end : {exact(from), exact(from) + exact(way)}) {
                const Point p = placedPoint({{}, rotation}, exact(v)) + end;
                ASSERT_LE(exact(box.lower).x, p.x - grown.x) << "case " << i << ": " << polygon;
                ASSERT_LE(exact(box.lower).y, p.y - grown.y) << "case " << i << ": " << polygon;
                ASSERT_GE(exact(box.upper).x, p.x + grown.x) << "case " << i << ": " << polygon;
                ASSERT_GE(exact(box.upper).y, p.y + grown.y) << "case " << i << ": " << polygon;
            }
        }
    }
}

/// Places, ways, shapes and reaches of any size, each by itself: what they lose in a sum differs most then.
TEST(Bounds, AreRoundedOutwardAtEveryScale) {
    constexpr long double kMost = static_cast<long double>(std::numeric_limits<Real>::max());
    Random random(6);
    const auto some = [&random](double share, double mostDecade = 30) {
        return random.chance(share) ? random.sign() * std::pow(10.0, random.range(-44, mostDecade)) : 0.0;
    };
    constexpr double kBeyond = 44;  // of float
    int within = 0;
    for (int i = 0; i < 50'000; ++i) {
        Polygon polygon;
        polygon.count = random.integer(1, kMaxPolygonVertices);
        for (int k = 0; k < polygon.count; ++k) {
            polygon.vertices[static_cast<std::size_t>(k)] = {real(some(0.8)), real(some(0.8))};
        }
        polygon.radius = real(std::fabs(some(0.5)));
        const WorldTransform pose{{some(0.8, kBeyond), some(0.8, kBeyond)}, rotationFromAngle(random.range(-4, 4))};
        const DVec2 way{some(0.5, kBeyond), some(0.5, kBeyond)};
        const Real reach = real(std::fabs(some(0.5)));
        const Aabb box = boundsOf(polygon, pose, way, reach);
        ASSERT_TRUE(isValid(box)) << "case " << i;
        const long double around = exact(polygon.radius) + exact(reach);
        for (const Vec2 v : polygon.points()) {
            for (const Point end : {exact(pose.position), exact(pose.position) + exact(way)}) {
                const Point p = placedPoint({{}, pose.rotation}, exact(v)) + end;
                ASSERT_LE(exact(box.lower).x, std::max(p.x - around, -kMost)) << "case " << i << ": " << polygon;
                ASSERT_LE(exact(box.lower).y, std::max(p.y - around, -kMost)) << "case " << i << ": " << polygon;
                ASSERT_GE(exact(box.upper).x, std::min(p.x + around, kMost)) << "case " << i << ": " << polygon;
                ASSERT_GE(exact(box.upper).y, std::min(p.y + around, kMost)) << "case " << i << ": " << polygon;
                within += std::fabs(p.x) + around < kMost ? 1 : 0;
            }
        }
    }
    EXPECT_GT(within, 100'000);
}

TEST(RadiusAbout, IsTheFarthestPointRoundedUp) {
    Random random(3);
    for (int i = 0; i < 20'000; ++i) {
        const Polygon polygon = randomShape(random, i % 2 == 0 ? 0 : 1000);
        const Vec2 center = randomVec(random, -2, 2);
        long double farthest = 0;
        for (const Point p : exactPoints(polygon)) { farthest = std::max(farthest, length(p - exact(center))); }
        farthest += exact(polygon.radius);
        const long double radius = exact(radiusAbout(polygon, center));
        ASSERT_GE(radius, farthest) << "case " << i << ": " << polygon;
        ASSERT_LE(radius, farthest * (1 + 6 * kEps)) << "case " << i << ": " << polygon;
    }
    EXPECT_EQ(radiusAbout(makeCircle({1, 2}, 3).value(), {1, 2}), 3) << "nothing to round";
}

/// Smallest radius over all centres, by descent towards the farthest vertex (Bădoiu, Clarkson 2003).
long double smallestRadius(const std::vector<Point>& points) {
    Point center = points[0];
    long double best = 1e30L;
    for (int i = 1; i < 4'000; ++i) {
        Point farthest = points[0];
        for (const Point p : points) {
            if (length(p - center) > length(farthest - center)) { farthest = p; }
        }
        best = std::min(best, length(farthest - center));
        center = center + (1.0L / (i + 1)) * (farthest - center);
    }
    return best;
}

TEST(BoundingCircle, ContainsAllAndIsTheSmallest) {
    Random random(4);
    for (int i = 0; i < 300; ++i) {
        const Polygon polygon = randomShape(random, i % 2 == 0 ? 0 : 50);
        const Circle circle = boundingCircle(polygon);
        const std::vector<Point> points = exactPoints(polygon);
        for (const Point p : points) {
            ASSERT_LE(length(p - exact(circle.center)) + exact(polygon.radius), exact(circle.radius)) << polygon;
        }
        const long double smallest = smallestRadius(points) + exact(polygon.radius);
        const long double rounding = 8 * kEps * (1 + length(exact(circle.center)));
        ASSERT_LE(exact(circle.radius), smallest * (1 + 1e-9L) + rounding) << "case " << i << ": " << polygon;
        ASSERT_GE(exact(circle.radius), smallest * (1 - 2e-3L)) << "case " << i << ": the oracle converges slowly";
    }
}

TEST(BoundingCircle, OfTheSimpleShapes) {
    const Circle square = boundingCircle(makeBox({3, 4}, {1, 1}).value());
    EXPECT_EQ(square.center, (Vec2{1, 1}));
    EXPECT_NEAR(static_cast<double>(square.radius), 5, 4e-6);
    const Circle obtuse = boundingCircle(makePolygon(std::vector<Vec2>{{-2, 0}, {2, 0}, {1, real(0.5)}}).value());
    EXPECT_EQ(obtuse.center, (Vec2{0, 0})) << "the long side is the diameter";
    const Circle circle = boundingCircle(makeCircle({1, 2}, 3).value());
    EXPECT_EQ(circle.center, (Vec2{1, 2}));
    EXPECT_EQ(circle.radius, 3);
    EXPECT_TRUE(overlaps(Circle{{0, 0}, 1}, Circle{{2, 0}, 1}));
    EXPECT_FALSE(overlaps(Circle{{0, 0}, 1}, Circle{{real(2.001), 0}, 1}));
}

}  // namespace
}  // namespace swept::test
