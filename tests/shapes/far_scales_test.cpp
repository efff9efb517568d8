#include <cmath>
#include <limits>
#include <type_traits>
#include <vector>

#include <gtest/gtest.h>

#include <swept/shapes/chain.h>
#include <swept/shapes/hull.h>
#include <swept/shapes/mass.h>
#include <swept/shapes/ray_cast.h>

#include "shape_families.h"

/// Lengths whose products leave the range of double give the same answers as those near 1, scaled, bit for bit. (In f32
/// there are none, and the law holds over the whole range.)

namespace swept::test {
namespace {

constexpr bool kHasDoubles = std::is_same_v<Real, double>;
constexpr int kFarthestExponent = kHasDoubles ? 900 : 90;

Real atScale(Real x, int exponent) { return std::ldexp(x, exponent); }
Vec2 atScale(Vec2 v, int exponent) { return {atScale(v.x, exponent), atScale(v.y, exponent)}; }
Polygon atScale(Polygon polygon, int exponent) {
    for (Vec2& v : polygon.vertices) { v = atScale(v, exponent); }
    polygon.radius = atScale(polygon.radius, exponent);
    return polygon;
}

TEST(FarScales, MakersTakeTheSameShapes) {
    Random random(1);
    for (int i = 0; i < 4'000; ++i) {
        const int exponent = random.integer(-kFarthestExponent, kFarthestExponent);
        SCOPED_TRACE(testing::Message() << "case " << i << ", exponent " << exponent);
        const Polygon polygon = randomPolygon(random, 0.5);
        const Polygon far = atScale(polygon, exponent);
        const Result<Polygon> made = makePolygon(far.points(), far.radius);
        ASSERT_TRUE(made.ok()) << polygon;
        ASSERT_EQ(made.value().normals, polygon.normals) << polygon;
        ASSERT_TRUE(validate(far).ok()) << polygon;
        ASSERT_EQ(extentOf(far), atScale(extentOf(polygon), exponent)) << polygon;
        const Result<Polygon> hull = convexHull(polygon.points(), polygon.radius);
        const Result<Polygon> farHull = convexHull(far.points(), far.radius);
        ASSERT_EQ(hull.status().code, farHull.status().code) << polygon;
        ASSERT_TRUE(!hull.ok() || atScale(hull.value(), exponent).vertices == farHull.value().vertices) << polygon;
        const Vec2 half = randomVec(random, 0.01, 2);
        const double angle = random.range(-4, 4);
        const Result<Polygon> box = makeBox(atScale(half, exponent), {}, angle);
        ASSERT_TRUE(box.ok());
        ASSERT_EQ(box.value().vertices, atScale(makeBox(half, {}, angle).value(), exponent).vertices);
    }
    EXPECT_EQ(extentOf(makeSegment({0, 0}, atScale(Vec2{3, 4}, kFarthestExponent)).value()),
              atScale(Real(5), kFarthestExponent));
}

TEST(FarScales, MakersRefuseTheSameShapes) {
    for (const int exponent : {-kFarthestExponent, 0, kFarthestExponent}) {
        const auto codeOf = [exponent](std::vector<Vec2> vertices) {
            for (Vec2& v : vertices) { v = atScale(v, exponent); }
            return makePolygon(vertices).status().code;
        };
        EXPECT_EQ(codeOf({{0, 0}, {1, 0}, {2, 0}}), StatusCode::degenerate);
        EXPECT_EQ(codeOf({{0, 0}, {0, 1}, {1, 0}}), StatusCode::notConvex) << "clockwise";
        EXPECT_EQ(codeOf({{0, 0}, {0, 0}, {0, 0}}), StatusCode::degenerate);
    }
}

TEST(FarScales, RaysHitTheSame) {
    Random random(2);
    int hits = 0;
    int starts = 0;
    for (int i = 0; i < 20'000; ++i) {
        const int exponent = random.integer(-kFarthestExponent, kFarthestExponent);
        const int quicker = random.integer(-20, 20);  // what the direction is scaled by more
        const Polygon polygon = randomShape(random);
        const Vec2 origin = randomVec(random, -4, 4);
        const Vec2 direction = randomVec(random, -1, 1) - origin;
        const RayCastHit one = rayCast(polygon, origin, direction, 2);
        const Polygon far = atScale(polygon, exponent);
        const Vec2 farOrigin = atScale(origin, exponent);
        const RayCastHit other =
            rayCast(far, farOrigin, atScale(direction, exponent + quicker), atScale(Real(2), -quicker));
        ASSERT_EQ(one.hit, other.hit) << "case " << i << ", exponent " << exponent << ": " << polygon;
        ASSERT_EQ(atScale(one.fraction, -quicker), other.fraction) << "case " << i << ", exponent " << exponent;
        ASSERT_EQ(one.normal, other.normal) << "case " << i << ", exponent " << exponent << ": " << polygon;
        ASSERT_EQ(atScale(one.point, exponent), other.point) << "case " << i << ", exponent " << exponent;
        ASSERT_EQ(containsPoint(polygon, origin), containsPoint(far, farOrigin)) << "case " << i;
        hits += one.hit ? 1 : 0;
        starts += containsPoint(polygon, origin) ? 1 : 0;
    }
    EXPECT_GT(hits, 5'000);
    EXPECT_GT(starts, 100);
}

TEST(FarScales, RaysMayBeMuchLongerThanTheShape) {
    const Polygon circle = makeCircle({0, 0}, 1).value();
    for (const double size : {1e30, 1e155, 1e300}) {
        if (size > static_cast<double>(std::numeric_limits<Real>::max())) { continue; }
        const RayCastHit hit = rayCast(circle, {-5, 0}, {static_cast<Real>(size), 0}, 1);
        ASSERT_TRUE(hit.hit) << size;
        EXPECT_EQ(hit.point, (Vec2{-1, 0})) << size;
        EXPECT_EQ(hit.normal, (Vec2{-1, 0})) << size;
        EXPECT_NEAR(static_cast<double>(hit.fraction) * size, 4, 1e-5) << size;
        EXPECT_FALSE(rayCast(circle, {-5, 0}, {-static_cast<Real>(size), 0}, 1).hit) << size;
    }
    EXPECT_FALSE(rayCast(circle, {-5, 0}, {std::numeric_limits<Real>::denorm_min(), 0}, 1).hit) << "ends before it";
}

TEST(FarScales, MassesTellWhetherTheyAreNumbers) {
    for (const double size : {1e-140, 1e-90, 1e-30, 1.0, 1e18, 1e90, 1e120, 1e150}) {
        const auto half = static_cast<Real>(size);
        if (!(half > 0) || !isFinite(half)) { continue; }
        const bool isNear = size > 1e-75 && size < 1e75;
        for (const Polygon& polygon : {makeBox({half, half}).value(), makeCircle({0, 0}, half).value(),
                                       makeCapsule({-half, 0}, {half, 0}, half).value()}) {
            const MassProperties mass = massOf(polygon, 1);
            EXPECT_TRUE(isWeighable(massOf(polygon, 0))) << size;
            EXPECT_EQ(isWeighable(mass), isNear) << size << ": " << mass.mass << " kg, " << mass.inertia << " kg·m²";
        }
    }
    EXPECT_TRUE(isWeighable(massOf(makeSegment({0, 0}, {1, 0}).value(), 1))) << "no mass is a mass, too";
    EXPECT_TRUE(isWeighable(massOf(makeCircle({0, 0}, 1).value(), 0)));
}

TEST(FarScales, ChainsRefuseWhatIsFartherApartThanNumbersGo) {
    const Real far = std::numeric_limits<Real>::max() * real(0.9);
    const auto codeOf = [](std::vector<Vec2> points, bool loop, const ChainNeighbours& neighbours = {}) {
        return validateChain(points, loop, 0, neighbours).code;
    };
    EXPECT_EQ(codeOf({{far, 0}, {-far, 0}}, false), StatusCode::notFinite);
    EXPECT_EQ(codeOf({{far, 0}, {0, 0}, {-far, 0}}, false), StatusCode::ok);
    EXPECT_EQ(codeOf({{far, 0}, {0, 0}, {-far, 0}}, true), StatusCode::notFinite);
    EXPECT_EQ(codeOf({{far, 0}, {0, 0}}, false, {.before = Vec2{-far, 0}, .after = {}}), StatusCode::notFinite);
    EXPECT_EQ(codeOf({{0, 0}, {far, 0}}, false, {.before = {}, .after = Vec2{-far, 0}}), StatusCode::notFinite);
    EXPECT_EQ(codeOf({{0, 0}, {far, 0}}, false, {.before = Vec2{-far, 0}, .after = Vec2{0, 1}}), StatusCode::ok);
}

}  // namespace
}  // namespace swept::test
