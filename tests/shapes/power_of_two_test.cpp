#include <cfenv>
#include <cmath>

#include <gtest/gtest.h>

#include <swept/shapes/bounding_circle.h>
#include <swept/shapes/mass.h>
#include <swept/shapes/obb.h>
#include <swept/shapes/ray_cast.h>

#include "shape_families.h"

/// The unit of length is arbitrary: scaling every length by 2^k scales every result by its power of 2^k, bit for bit.

namespace swept::test {
namespace {

constexpr int kLargestExponent = std::is_same_v<Real, float> ? 10 : 100;

/// One unit of length against another.
struct Scale {
    int exponent;

    Real operator()(Real x) const { return std::ldexp(x, exponent); }
    double operator()(double x, int power) const { return std::ldexp(x, power * exponent); }
    Vec2 operator()(Vec2 v) const { return {(*this)(v.x), (*this)(v.y)}; }
    DVec2 operator()(DVec2 v) const { return {(*this)(v.x, 1), (*this)(v.y, 1)}; }
    Polygon operator()(Polygon polygon) const {
        for (Vec2& v : polygon.vertices) { v = (*this)(v); }
        polygon.radius = (*this)(polygon.radius);
        return polygon;
    }
};

Scale randomScale(Random& random) { return {random.integer(-kLargestExponent, kLargestExponent)}; }

void expectSame(const Polygon& a, const Polygon& b, int i) {
    ASSERT_EQ(a.count, b.count) << "case " << i;
    ASSERT_EQ(a.radius, b.radius) << "case " << i;
    ASSERT_EQ(a.vertices, b.vertices) << "case " << i << ": " << a << " / " << b;
    ASSERT_EQ(a.normals, b.normals) << "case " << i << ": " << a << " / " << b;
}

void expectSame(const Result<Polygon>& a, const Result<Polygon>& b, const Scale& scale, int i) {
    ASSERT_EQ(a.status().code, b.status().code) << "case " << i;
    expectSame(scale(a.value()), b.value(), i);
}

class PowerOfTwo : public testing::Test {
protected:
    void SetUp() override { std::feclearexcept(FE_ALL_EXCEPT); }
    void TearDown() override { EXPECT_FALSE(std::fetestexcept(FE_UNDERFLOW | FE_OVERFLOW)) << "the law ends there"; }
};

TEST_F(PowerOfTwo, Makers) {
    Random random(1);
    for (int i = 0; i < 5'000; ++i) {
        const Scale scale = randomScale(random);
        const Vec2 p = randomVec(random, -2, 2);
        const Vec2 q = randomVec(random, -2, 2);
        const Vec2 half = randomVec(random, 0.01, 2);
        const Real r = real(random.range(0, 1));
        const double angle = random.range(-4, 4);
        expectSame(makeCircle(p, r), makeCircle(scale(p), scale(r)), scale, i);
        expectSame(makeCapsule(p, q, r), makeCapsule(scale(p), scale(q), scale(r)), scale, i);
        expectSame(makeSegment(p, q), makeSegment(scale(p), scale(q)), scale, i);
        expectSame(makeBox(half, p, angle, r), makeBox(scale(half), scale(p), angle, scale(r)), scale, i);
        const Polygon polygon = randomPolygon(random, 0.5);
        expectSame(polygon, makePolygon(polygon.points(), polygon.radius), {0}, i);
        const Polygon scaled = scale(polygon);
        expectSame(polygon, makePolygon(scaled.points(), scaled.radius), scale, i);
    }
}

TEST_F(PowerOfTwo, MakersRefuseTheSame) {
    Random random(2);
    int refused = 0;
    for (int i = 0; i < 20'000; ++i) {
        const Scale scale = randomScale(random);
        // Bumps around the limit of convexity.
        const Real bump = kEpsilon * real(random.range(0, 12));
        const std::array<Vec2, 4> vertices = {Vec2{0, 0}, Vec2{1, -bump}, Vec2{2, 0}, Vec2{1, 1}};
        const std::array<Vec2, 4> scaled = {scale(vertices[0]), scale(vertices[1]), scale(vertices[2]),
                                            scale(vertices[3])};
        const Result<Polygon> one = makePolygon(vertices);
        expectSame(one, makePolygon(scaled), scale, i);
        expectSame(convexHull(vertices), convexHull(scaled), scale, i);
        refused += one.ok() ? 0 : 1;
    }
    EXPECT_GT(refused, 2'000);
    EXPECT_LT(refused, 18'000);
}

TEST_F(PowerOfTwo, Hulls) {
    Random random(3);
    for (int i = 0; i < 5'000; ++i) {
        const Scale scale = randomScale(random);
        std::vector<Vec2> cloud;
        std::vector<Vec2> scaled;
        for (int k = random.integer(3, 14); k > 0; --k) {
            cloud.push_back(randomVec(random, -1, 1));
            scaled.push_back(scale(cloud.back()));
        }
        expectSame(convexHull(cloud, 1), convexHull(scaled, scale(Real(1))), scale, i);
    }
}

TEST_F(PowerOfTwo, Measures) {
    Random random(4);
    for (int i = 0; i < 10'000; ++i) {
        const Scale scale = randomScale(random);
        const Polygon polygon = randomShape(random);
        const Polygon scaled = scale(polygon);
        ASSERT_TRUE(validate(scaled).ok()) << "case " << i;
        ASSERT_EQ(scale(extentOf(polygon)), extentOf(scaled)) << "case " << i << ": " << polygon;
        const Vec2 center = randomVec(random, -2, 2);
        ASSERT_EQ(scale(radiusAbout(polygon, center)), radiusAbout(scaled, scale(center))) << "case " << i;
        const Circle circle = boundingCircle(polygon);
        const Circle scaledCircle = boundingCircle(scaled);
        ASSERT_EQ(scale(circle.center), scaledCircle.center) << "case " << i << ": " << polygon;
        ASSERT_EQ(scale(circle.radius), scaledCircle.radius) << "case " << i << ": " << polygon;
        const WorldTransform pose{{random.range(-9, 9), random.range(-9, 9)}, rotationFromAngle(random.range(-4, 4))};
        const Aabb box = boundsOf(polygon, pose);
        const Aabb scaledBox = boundsOf(scaled, {scale(pose.position), pose.rotation});
        ASSERT_EQ((Aabb{scale(box.lower), scale(box.upper)}), scaledBox) << "case " << i << ": " << polygon;
        const Aabb fat = grown(box, real(0.1));
        ASSERT_EQ((Aabb{scale(fat.lower), scale(fat.upper)}), grown(scaledBox, scale(real(0.1)))) << "case " << i;
    }
}

TEST_F(PowerOfTwo, Mass) {
    Random random(5);
    for (int i = 0; i < 10'000; ++i) {
        const Scale scale = randomScale(random);
        const Polygon polygon = randomShape(random);
        const MassProperties one = massOf(polygon, 3);
        const MassProperties other =
            massOf(scale(polygon), 3);  // the same density: mass grows with L², inertia with L⁴
        ASSERT_EQ(scale(one.mass, 2), other.mass) << "case " << i << ": " << polygon;
        ASSERT_EQ(scale(one.center), other.center) << "case " << i << ": " << polygon;
        ASSERT_EQ(scale(one.inertia, 4), other.inertia) << "case " << i << ": " << polygon;
    }
}

TEST_F(PowerOfTwo, RayCasts) {
    Random random(6);
    int hits = 0;
    for (int i = 0; i < 20'000; ++i) {
        const Scale scale = randomScale(random);
        const Polygon polygon = randomShape(random);
        const Vec2 origin = randomVec(random, -4, 4);
        const Vec2 direction = randomVec(random, -1, 1) - origin;
        const RayCastHit one = rayCast(polygon, origin, direction, 2);
        const RayCastHit other = rayCast(scale(polygon), scale(origin), scale(direction), 2);
        ASSERT_EQ(one.hit, other.hit) << "case " << i << ": " << polygon;
        ASSERT_EQ(one.fraction, other.fraction) << "case " << i << ": " << polygon;
        ASSERT_EQ(one.normal, other.normal) << "case " << i << ": " << polygon;
        ASSERT_EQ(scale(one.point), other.point) << "case " << i << ": " << polygon;
        hits += one.hit ? 1 : 0;
        const WorldTransform pose{{1, 2}, {}};
        const DVec2 start = toDouble(origin);
        const RayHit box = rayCast(boundsOf(polygon, pose), start, toDouble(direction), 2);
        const Aabb scaledBox = boundsOf(scale(polygon), {scale(pose.position), pose.rotation});
        const RayHit otherBox = rayCast(scaledBox, scale(start), scale(toDouble(direction)), 2);
        ASSERT_EQ(box.hit, otherBox.hit) << "case " << i;
        ASSERT_EQ(box.fraction, otherBox.fraction) << "case " << i;
    }
    EXPECT_GT(hits, 5'000);
}

TEST_F(PowerOfTwo, OrientedBoxes) {
    Random random(7);
    for (int i = 0; i < 20'000; ++i) {
        const Scale scale = randomScale(random);
        const auto box = [&] {
            return Obb{{randomVec(random, -1, 1), rotationFromAngle(random.range(-4, 4))}, randomVec(random, 0.01, 1)};
        };
        const auto scaledBox = [&](const Obb& b) {
            return Obb{{scale(b.pose.translation), b.pose.rotation}, scale(b.half)};
        };
        const Obb a = box();
        const Obb b = box();
        ASSERT_EQ(scale(separation(a, b)), separation(scaledBox(a), scaledBox(b))) << "case " << i;
        ASSERT_EQ(overlaps(a, b), overlaps(scaledBox(a), scaledBox(b))) << "case " << i;
    }
}

}  // namespace
}  // namespace swept::test
