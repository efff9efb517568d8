#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include <swept/shapes/ray_cast.h>

#include "shape_families.h"

namespace swept::test {
namespace {

/// How far a point is outside the rounded shape; negative inside.
long double outside(const Polygon& polygon, Point point) {
    return signedDistanceToCore(polygon, point) - exact(polygon.radius);
}

struct Ray {
    Vec2 origin;
    Vec2 direction;

    Point at(long double t) const { return exact(origin) + t * exact(direction); }
};

/// Smallest value of `outside` along the ray up to `to`: the signed distance to a convex set is convex along a line.
struct Nearest {
    long double fraction;
    long double outside;
};

Nearest nearestOn(const Polygon& polygon, const Ray& ray, long double to) {
    long double low = 0;
    long double high = to;
    for (int i = 0; i < 100; ++i) {
        const long double a = low + (high - low) / 3;
        const long double b = high - (high - low) / 3;
        if (outside(polygon, ray.at(a)) <= outside(polygon, ray.at(b))) {
            high = b;
        } else {
            low = a;
        }
    }
    return {low, outside(polygon, ray.at(low))};
}

/// First fraction in the shape, between 0 (outside) and `inside`.
long double bisected(const Polygon& polygon, const Ray& ray, long double inside) {
    long double low = 0;
    long double high = inside;
    for (int i = 0; i < 80; ++i) {
        const long double middle = (low + high) / 2;
        (outside(polygon, ray.at(middle)) > 0 ? low : high) = middle;
    }
    return high;
}

Ray randomRay(Random& random, const Polygon& polygon) {
    const int index = random.integer(0, polygon.count - 1);
    const Vec2 target =
        polygon.vertices[static_cast<std::size_t>(index)] + real(random.range(0, 1.5)) * randomVec(random, -1, 1);
    const Vec2 origin = target + randomVec(random, -6, 6);
    return {origin, real(random.range(0.3, 3)) * (target - origin)};
}

TEST(RayCast, AgreesWithBisectionOnRandomShapes) {
    Random random(1);
    int hits = 0;
    int misses = 0;
    int unclear = 0;
    for (int i = 0; i < 6'000; ++i) {
        const Polygon polygon = randomShape(random);
        if (polygon.count == 2 && polygon.radius == 0) { continue; }  // has its own test
        const Ray ray = randomRay(random, polygon);
        const Real maxFraction = real(random.range(0.2, 2));
        const RayCastHit got = rayCast(polygon, ray.origin, ray.direction, maxFraction);
        const long double speed = length(exact(ray.direction));
        if (outside(polygon, exact(ray.origin)) <= 0) {
            ASSERT_TRUE(got.hit && got.fraction == 0 && got.normal == Vec2{} && got.point == ray.origin) << polygon;
            continue;
        }
        const Nearest nearest = nearestOn(polygon, ray, exact(maxFraction));
        if (std::fabs(nearest.outside) < 1e-9L) {
            ++unclear;
            continue;
        }
        ASSERT_EQ(got.hit, nearest.outside < 0) << "case " << i << ": " << polygon << " from " << ray.origin;
        if (!got.hit) {
            ++misses;
            continue;
        }
        ++hits;
        ASSERT_GE(got.fraction, 0);
        ASSERT_LE(got.fraction, maxFraction);
        const long double truth = bisected(polygon, ray, nearest.fraction);
        // A grazing ray amplifies the rounding of the shape's normal distance: judge by that distance.
        const long double slack = 8 * kEps * (10 + speed);
        const bool near = std::fabs(exact(got.fraction) - truth) * speed <= slack;
        ASSERT_TRUE(near || std::fabs(outside(polygon, ray.at(exact(got.fraction)))) <= slack)
            << "case " << i << ": " << polygon;
        ASSERT_LE(length(exact(got.point) - ray.at(exact(got.fraction))), slack) << "case " << i;
        ASSERT_NEAR(static_cast<double>(length(exact(got.normal))), 1, 4 * static_cast<double>(kEps)) << "case " << i;
        ASSERT_LE(dot(exact(got.normal), exact(ray.direction)), 8 * kEps * speed) << "case " << i;
        // Outward: a step along the normal leads away from the shape at full rate.
        const Point away = exact(got.point) + 0.01L * exact(got.normal);
        ASSERT_NEAR(static_cast<double>(outside(polygon, away)), 0.01, 1e-4) << "case " << i << ": " << polygon;
    }
    EXPECT_GT(hits, 2'000);
    EXPECT_GT(misses, 800);
    EXPECT_LT(unclear, 5);
}

TEST(RayCast, HitsACircleWhereTheClosedFormSays) {
    const Polygon circle = makeCircle({0, 0}, 5).value();
    const RayCastHit hit = rayCast(circle, {-10, 3}, {1, 0}, 100);
    ASSERT_TRUE(hit.hit);
    EXPECT_NEAR(static_cast<double>(hit.fraction), 6, 2e-6);
    EXPECT_NEAR(static_cast<double>(hit.normal.x), -0.8, 2e-7);
    EXPECT_NEAR(static_cast<double>(hit.normal.y), 0.6, 2e-7);
    EXPECT_FALSE(rayCast(circle, {-10, real(5.0001)}, {1, 0}, 100).hit);
    EXPECT_FALSE(rayCast(circle, {-10, 0}, {1, 0}, real(4.999)).hit) << "too short";
    EXPECT_FALSE(rayCast(circle, {-10, 0}, {-1, 0}, 100).hit) << "away";
}

TEST(RayCast, HitsFromFarAwayAsPreciselyAsFromNear) {
    // 10⁶ m away in f32: only the fraction is rounded to Real.
    const Polygon box = makeBox({1, 1}, {0, 0}, 0, real(0.5)).value();
    const RayCastHit edge = rayCast(box, {-1'000'000, 0}, {1'000'000, 0}, 1);
    ASSERT_TRUE(edge.hit);
    EXPECT_NEAR(static_cast<double>(edge.point.x), -1.5, 1e-6);
    EXPECT_EQ(edge.normal, (Vec2{-1, 0}));
    const Polygon circle = makeCircle({0, 0}, 1).value();
    const RayCastHit arc = rayCast(circle, {-1'000'000, real(0.5)}, {1'000'000, 0}, 1);
    ASSERT_TRUE(arc.hit);
    EXPECT_NEAR(static_cast<double>(arc.point.x), -std::sqrt(0.75), 1e-6);
}

TEST(RayCast, RoundsTheCornersOfARoundedBox) {
    const Polygon box = makeBox({1, 1}, {0, 0}, 0, 1).value();
    // Towards the corner along the diagonal: the arc of radius 1 about (1, 1).
    const RayCastHit diagonal = rayCast(box, {4, 4}, {-1, -1}, 10);
    ASSERT_TRUE(diagonal.hit);
    const double expected = 3 - std::sqrt(0.5);
    EXPECT_NEAR(static_cast<double>(diagonal.fraction), expected, 1e-6);
    EXPECT_NEAR(static_cast<double>(diagonal.normal.x), std::sqrt(0.5), 1e-6);
    // Through the sharp corner's region, past the arc.
    EXPECT_FALSE(rayCast(box, {real(2.5), real(1.3)}, {-1, 1}, 10).hit) << "x + y = 3.8 > 2 + √2";
    EXPECT_TRUE(rayCast(box, {real(2.5), real(0.9)}, {-1, 1}, 10).hit) << "x + y = 3.4 < 2 + √2";
}

TEST(RayCast, SegmentHasTwoSides) {
    const Polygon segment = makeSegment({-1, 0}, {1, 0}).value();
    const RayCastHit above = rayCast(segment, {0, 2}, {0, -4}, 1);
    const RayCastHit below = rayCast(segment, {0, -2}, {0, 4}, 1);
    ASSERT_TRUE(above.hit && below.hit);
    EXPECT_EQ(above.fraction, real(0.5));
    EXPECT_EQ(below.fraction, real(0.5));
    EXPECT_EQ(above.normal, (Vec2{0, 1}));
    EXPECT_EQ(below.normal, (Vec2{0, -1}));
    EXPECT_TRUE(rayCast(segment, {1, 2}, {0, -4}, 1).hit) << "its end belongs to it";
    EXPECT_FALSE(rayCast(segment, {real(1.0001), 2}, {0, -4}, 1).hit);
    EXPECT_FALSE(rayCast(segment, {0, 2}, {0, -1}, 1).hit);
    EXPECT_FALSE(rayCast(segment, {0, 2}, {0, 1}, 9).hit);
    EXPECT_FALSE(rayCast(segment, {-3, 1}, {1, 0}, 9).hit) << "parallel";
    const RayCastHit endOn = rayCast(segment, {-3, 0}, {1, 0}, 9);
    ASSERT_TRUE(endOn.hit);
    EXPECT_EQ(endOn.fraction, 2);
    EXPECT_EQ(endOn.normal, (Vec2{-1, 0}));
    EXPECT_FALSE(rayCast(segment, {3, 0}, {1, 0}, 9).hit) << "in line, but away";
    EXPECT_EQ(rayCast(segment, {real(0.5), 0}, {1, 1}, 9).fraction, 0) << "starts on it";
}

TEST(RayCast, SegmentAgreesWithTheClosedForm) {
    Random random(2);
    int hits = 0;
    for (int i = 0; i < 50'000; ++i) {
        const Polygon segment = makeSegment(randomVec(random, -1, 1), randomVec(random, -1, 1)).value();
        const Ray ray{randomVec(random, -2, 2), randomVec(random, -3, 3)};
        const Point p = exact(segment.vertices[0]);
        const Point edge = exact(segment.vertices[1]) - p;
        const long double rate = cross(exact(ray.direction), edge);
        const long double t = cross(p - exact(ray.origin), edge) / rate;
        const long double s = cross(p - exact(ray.origin), exact(ray.direction)) / rate;
        const long double margin = std::min(std::min(t, 1 - t), std::min(s, 1 - s));
        if (std::fabs(margin) < 1e-9L) { continue; }
        const RayCastHit got = rayCast(segment, ray.origin, ray.direction, 1);
        ASSERT_EQ(got.hit, margin > 0) << "case " << i << ": " << segment;
        if (!got.hit) { continue; }
        ++hits;
        ASSERT_NEAR(static_cast<double>(got.fraction), static_cast<double>(t), static_cast<double>(kEps) + 1e-10)
            << "case " << i;
        ASSERT_LT(dot(exact(got.normal), exact(ray.direction)), 0) << "case " << i;
    }
    EXPECT_GT(hits, 3'000);
}

TEST(RayCast, NothingLeaksBetweenEdgeAndArc) {
    // Rays aimed inwards at the exact ends of the moved edges, where one part of the outline hands over to the next.
    Random random(3);
    for (int i = 0; i < 20'000; ++i) {
        const Polygon polygon = randomPolygon(random, i % 4 == 0 ? 0 : std::pow(10.0, random.range(-9, 0)));
        const int side = random.integer(0, polygon.count - 1);
        const Vec2 vertex = polygon.vertices[static_cast<std::size_t>(random.chance(0.5) ? side : polygon.next(side))];
        const Vec2 joint = vertex + polygon.radius * polygon.normals[static_cast<std::size_t>(side)];
        Vec2 center{};
        for (const Vec2 v : polygon.points()) { center += real(1.0 / polygon.count) * v; }
        const Vec2 inward = center - joint;
        const Vec2 origin = joint - real(random.range(0.5, 3)) * inward;
        const RayCastHit got = rayCast(polygon, origin, joint - origin + inward, 1);
        ASSERT_TRUE(got.hit) << "case " << i << ": " << polygon << " from " << origin;
        ASSERT_LE(std::fabs(outside(polygon, exact(got.point))), 128 * kEps) << "case " << i << ": " << polygon;
        ASSERT_LT(dot(got.normal, inward), 0) << "case " << i << ": out of the far side of " << polygon;
    }
}

/// A side with vertices that lie on it to rounding, as hulls of placed points have: in f64 two of its edges are entered
/// at the same time, and either may seem to be the later one.
TEST(RayCast, NothingLeaksWhereEdgesAreParallelToRounding) {
    Random random(5);
    int split = 0;
    int rays = 0;
    for (int i = 0; i < 6'000; ++i) {
        const Vec2 center = randomVec(random, -100, 100);
        const double angle = random.range(0, 6.283);
        const auto at = [&](double x, double y) {
            return Vec2{center.x + real(std::cos(angle) * x - std::sin(angle) * y),
                        center.y + real(std::sin(angle) * x + std::cos(angle) * y)};
        };
        const std::array corners{
            at(-1, -1), at(random.range(-0.9, 0), -1), at(random.range(0.1, 0.9), -1), at(1, -1), at(1, 1), at(-1, 1)};
        const Result<Polygon> hull = convexHull(corners, real(std::pow(10.0, random.range(-3, -1))));
        if (!hull.ok() || hull.value().count == 4) { continue; }
        ++split;
        const Polygon& polygon = hull.value();
        for (int k = 0; k < 4; ++k) {
            const double x = random.range(-0.9, 0.9);
            const double far = std::pow(10.0, random.range(0, 3));
            const Vec2 origin = at(x + random.range(-1, 1) * far, -1 - far);
            const Vec2 target = at(x, -1);
            const RayCastHit got = rayCast(polygon, origin, target - origin, real(1.5));
            ASSERT_TRUE(got.hit) << "case " << i << ": " << polygon << " from " << origin << " to " << target;
            // The fraction, and the vertices beside each other, are rounded.
            const long double slack = 16 * kEps * (200 + exact(real(far)));
            ASSERT_LE(std::fabs(outside(polygon, exact(got.point))), slack) << "case " << i << ": " << polygon;
            ++rays;
        }
    }
    EXPECT_GT(split, 500);
    EXPECT_GT(rays, 2'000);
}

TEST(RayCast, DegenerateRaysHitOnlyWhatTheyStartIn) {
    const Polygon box = makeBox({1, 1}).value();
    EXPECT_TRUE(rayCast(box, {0, 0}, {0, 0}, 1).hit);
    EXPECT_FALSE(rayCast(box, {2, 0}, {0, 0}, 1).hit);
    EXPECT_TRUE(rayCast(box, {1, 0}, {1, 0}, 0).hit) << "on the outline";
    EXPECT_FALSE(rayCast(box, {2, 0}, {-1, 0}, 0).hit);
}

/// From where it starts, to rounding, it either starts inside or meets the surface at once; it never passes through.
TEST(RayCast, FromTheSurfaceOfARoundedShapeDoesNotPassIt) {
    std::mt19937 random(11);
    std::uniform_real_distribution<double> size(0.05, 3);
    for (int i = 0; i < 20'000; ++i) {
        const double half = size(random);
        const double radius = size(random);
        const Result<Polygon> capsule =
            makeCapsule({static_cast<Real>(-half), 0}, {static_cast<Real>(half), 0}, static_cast<Real>(radius));
        ASSERT_TRUE(capsule.ok());
        const Real r = capsule.value().radius;
        const Vec2 origin{static_cast<Real>(0.9 * half * (2 * (size(random) / 3) - 1)), -r};
        const RayCastHit hit = rayCast(capsule.value(), origin, {0, 5 * r}, 1);
        ASSERT_TRUE(hit.hit) << i << ": half " << half << ", radius " << r << ", from " << origin.x;
        ASSERT_LE(hit.fraction, Real(1e-5)) << i << ": half " << half << ", radius " << r << ", from " << origin.x;
    }
}

TEST(ContainsPoint, AgreesWithTheDistance) {
    Random random(4);
    int inside = 0;
    for (int i = 0; i < 50'000; ++i) {
        const Polygon polygon = randomShape(random);
        const Vec2 point = randomVec(random, -2, 2);
        const long double distance = outside(polygon, exact(point));
        if (std::fabs(distance) < 1e-12L) { continue; }
        ASSERT_EQ(containsPoint(polygon, point), distance < 0) << "case " << i << ": " << polygon << " and " << point;
        inside += distance < 0 ? 1 : 0;
    }
    EXPECT_GT(inside, 5'000);
    const Polygon box = makeBox({1, 1}).value();
    EXPECT_TRUE(containsPoint(box, {1, 1}));
    EXPECT_FALSE(containsPoint(box, {std::nextafter(Real(1), Real(2)), 1}));
    EXPECT_TRUE(containsPoint(makeSegment({0, 0}, {2, 2}).value(), {1, 1}));
    EXPECT_FALSE(containsPoint(makeSegment({0, 0}, {2, 2}).value(), {3, 3}));
}

}  // namespace
}  // namespace swept::test
