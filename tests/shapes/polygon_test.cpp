#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "shape_families.h"

/// Makers and `validate`: what they accept, what they refuse.

namespace swept::test {
namespace {

constexpr Real kNan = std::numeric_limits<Real>::quiet_NaN();
constexpr Real kEndless = std::numeric_limits<Real>::infinity();

StatusCode codeOfResult(const Result<Polygon>& result) { return result.status().code; }
StatusCode polygonCode(const std::vector<Vec2>& vertices, Real radius = 0) {
    return codeOfResult(makePolygon(vertices, radius));
}

void expectOutwardUnitNormals(const Polygon& polygon) {
    for (int i = 0; i < polygon.count; ++i) {
        const Point p = exact(polygon.vertices[static_cast<std::size_t>(i)]);
        const Point edge = exact(polygon.vertices[static_cast<std::size_t>(polygon.next(i))]) - p;
        const Point normal = exact(polygon.normals[static_cast<std::size_t>(i)]);
        const Point wanted = (1 / length(edge)) * Point{edge.y, -edge.x};
        ASSERT_LE(length(normal - wanted), 3 * kEps) << polygon;
        ASSERT_NEAR(static_cast<double>(length(normal)), 1.0, 2 * static_cast<double>(kEps)) << polygon;
    }
}

TEST(Makers, ProduceWhatValidateAccepts) {
    Random random(1);
    std::array<int, kMaxPolygonVertices + 1> seen{};
    for (int i = 0; i < 20'000; ++i) {
        const Polygon polygon = randomShape(random, i % 2 == 0 ? 0 : 100);
        ASSERT_TRUE(validate(polygon).ok()) << "case " << i << ": " << polygon << ' ' << validate(polygon).field;
        if (polygon.count > 1) { expectOutwardUnitNormals(polygon); }
        ++seen[static_cast<std::size_t>(polygon.count)];
    }
    for (std::size_t count = 1; count < seen.size(); ++count) { EXPECT_GT(seen[count], 100) << count << " vertices"; }
}

TEST(MakeCircle, RefusesPointsAndNonsense) {
    EXPECT_EQ(codeOfResult(makeCircle({0, 0}, 1)), StatusCode::ok);
    EXPECT_EQ(codeOfResult(makeCircle({0, 0}, 0)), StatusCode::degenerate);
    EXPECT_EQ(codeOfResult(makeCircle({0, 0}, -1)), StatusCode::negative);
    EXPECT_EQ(codeOfResult(makeCircle({0, 0}, kNan)), StatusCode::notFinite);
    EXPECT_EQ(codeOfResult(makeCircle({kEndless, 0}, 1)), StatusCode::notFinite);
    EXPECT_STREQ(makeCircle({kNan, 0}, 1).status().field, "center");
    EXPECT_EQ(makeCircle({0, 0}, 0).value().count, 0) << "a refused shape is an empty one";
}

TEST(MakeCapsule, RefusesWhatHasNoLength) {
    EXPECT_EQ(codeOfResult(makeCapsule({0, 0}, {1, 0}, 1)), StatusCode::ok);
    EXPECT_EQ(codeOfResult(makeCapsule({0, 0}, {1, 0}, 0)), StatusCode::degenerate);
    EXPECT_EQ(codeOfResult(makeCapsule({1, 2}, {1, 2}, 1)), StatusCode::degenerate);
    EXPECT_EQ(codeOfResult(makeCapsule({0, 0}, {1, 0}, -1)), StatusCode::negative);
    EXPECT_EQ(codeOfResult(makeCapsule({0, 0}, {1, kNan}, 1)), StatusCode::notFinite);
    EXPECT_EQ(codeOfResult(makeSegment({0, 0}, {1, 0})), StatusCode::ok);
    EXPECT_EQ(codeOfResult(makeSegment({1, 0}, {1, 0})), StatusCode::degenerate);
    EXPECT_EQ(codeOfResult(makeSegment({0, 0}, {1, 0}, kEndless)), StatusCode::notFinite);
    const Real huge = std::numeric_limits<Real>::max();
    EXPECT_EQ(codeOfResult(makeSegment({-huge, 0}, {huge, 0})), StatusCode::notFinite) << "its length is not finite";
}

TEST(MakeBox, IsExactWhenUpright) {
    const Polygon box = makeBox({2, 1}, {10, 20}).value();
    ASSERT_EQ(box.count, 4);
    EXPECT_EQ(box.vertices[0], (Vec2{8, 19}));
    EXPECT_EQ(box.vertices[1], (Vec2{12, 19}));
    EXPECT_EQ(box.vertices[2], (Vec2{12, 21}));
    EXPECT_EQ(box.vertices[3], (Vec2{8, 21}));
    EXPECT_EQ(box.normals[0], (Vec2{0, -1}));
    EXPECT_EQ(box.normals[1], (Vec2{1, 0}));
    EXPECT_EQ(box.normals[2], (Vec2{0, 1}));
    EXPECT_EQ(box.normals[3], (Vec2{-1, 0}));
}

TEST(MakeBox, TurnsAboutItsCentre) {
    Random random(2);
    for (int i = 0; i < 5'000; ++i) {
        const Vec2 half = randomVec(random, 0.1, 2);
        const Vec2 center = randomVec(random, -1, 1);
        const double angle = random.range(-10, 10);
        const Polygon box = makeBox(half, center, angle, real(0.1)).value();
        const long double c = std::cos(static_cast<long double>(angle));
        const long double s = std::sin(static_cast<long double>(angle));
        const std::array<Vec2, 4> signs = {Vec2{-1, -1}, Vec2{1, -1}, Vec2{1, 1}, Vec2{-1, 1}};
        for (std::size_t k = 0; k < 4; ++k) {
            const long double x = exact(signs[k].x) * exact(half.x);
            const long double y = exact(signs[k].y) * exact(half.y);
            const Point wanted = exact(center) + Point{c * x - s * y, s * x + c * y};
            ASSERT_LE(length(exact(box.vertices[k]) - wanted), 4 * kEps) << "case " << i;
        }
        EXPECT_EQ(box.radius, real(0.1));
    }
}

TEST(MakeBox, RefusesNonsense) {
    EXPECT_EQ(codeOfResult(makeBox({0, 1})), StatusCode::degenerate);
    EXPECT_EQ(codeOfResult(makeBox({1, -1})), StatusCode::negative);
    EXPECT_EQ(codeOfResult(makeBox({kNan, 1})), StatusCode::notFinite);
    EXPECT_EQ(codeOfResult(makeBox({1, 1}, {kEndless, 0})), StatusCode::notFinite);
    EXPECT_EQ(codeOfResult(makeBox({1, 1}, {0, 0}, std::nan(""))), StatusCode::notFinite);
    EXPECT_EQ(codeOfResult(makeBox({1, 1}, {0, 0}, 0, -1)), StatusCode::negative);
    EXPECT_STREQ(makeBox({1, -1}).status().field, "half");
}

TEST(MakeBox, RefusesABoxThatVanishesFarFromTheOrigin) {
    const Real far = 1 / kEpsilon;  // the spacing of numbers here is 1 (and ½ below)
    EXPECT_EQ(codeOfResult(makeBox({real(0.2), real(0.2)}, {2 * far, 0})), StatusCode::degenerate);
    EXPECT_EQ(codeOfResult(makeBox({real(0.2), 8}, {0, 2 * far})), StatusCode::ok)
        << "8 m are enough where 1 m is resolved";
    EXPECT_EQ(codeOfResult(makeBox({8, real(0.2)}, {0, 2 * far})), StatusCode::degenerate);
    EXPECT_EQ(codeOfResult(makeBox({8, 8}, {2 * far, 2 * far}, 0.5)), StatusCode::ok);
    // A turned sliver rounds to anything; it is accepted only as a valid polygon.
    Random random(3);
    int refused = 0;
    for (int i = 0; i < 5'000; ++i) {
        const Result<Polygon> box =
            makeBox({real(random.range(1, 9)), real(random.range(0.1, 4))}, {far, far}, random.range(0, 7));
        if (box.ok()) {
            ASSERT_TRUE(validate(box.value()).ok()) << "case " << i;
        } else {
            ASSERT_EQ(codeOfResult(box), StatusCode::degenerate) << "case " << i;
            ++refused;
        }
    }
    EXPECT_GT(refused, 100);
    EXPECT_LT(refused, 4'000);
}

TEST(MakeBox, AcceptsVeryThinOnes) {
    const Result<Polygon> floor = makeBox({100'000, real(0.001)});
    ASSERT_TRUE(floor.ok());
    EXPECT_EQ(floor.value().normals[2], (Vec2{0, 1}));
    EXPECT_NEAR(static_cast<double>(extentOf(floor.value())), 0.002, 1e-9);
}

TEST(MakePolygon, RefusesWhatIsNotStrictlyConvex) {
    EXPECT_EQ(polygonCode({{0, 0}, {1, 0}, {0, 1}}), StatusCode::ok);
    EXPECT_EQ(polygonCode({{0, 0}, {0, 1}, {1, 0}}), StatusCode::notConvex) << "clockwise";
    EXPECT_EQ(polygonCode({{0, 0}, {1, 0}, {2, 0}, {2, 2}}), StatusCode::notConvex) << "a point on an edge";
    EXPECT_EQ(polygonCode({{0, 0}, {1, 0}, {1, 0}, {1, 1}}), StatusCode::notConvex) << "a repeated vertex";
    EXPECT_EQ(polygonCode({{0, 0}, {1, 0}, {1, 1}, {0, 0}}), StatusCode::notConvex) << "first and last repeated";
    EXPECT_EQ(polygonCode({{0, 0}, {2, 0}, {1, 1}, {2, 2}, {0, 2}}), StatusCode::notConvex) << "a dent";
    EXPECT_EQ(polygonCode({{0, 0}, {1, 1}, {1, 0}, {0, 1}}), StatusCode::notConvex) << "a bow tie";
    EXPECT_EQ(polygonCode({{0, 0}, {1, 1}, {2, 2}}), StatusCode::degenerate);
    EXPECT_EQ(polygonCode({{5, 5}, {5, 5}, {5, 5}}), StatusCode::degenerate);
    EXPECT_EQ(polygonCode({{0, 0}, {1, 0}}), StatusCode::tooFewVertices);
    EXPECT_EQ(polygonCode(std::vector<Vec2>(9)), StatusCode::tooManyVertices);
    EXPECT_EQ(polygonCode({{0, 0}, {1, 0}, {0, kNan}}), StatusCode::notFinite);
    EXPECT_EQ(polygonCode({{0, 0}, {1, 0}, {0, 1}}, -1), StatusCode::negative);
}

TEST(MakePolygon, RefusesStars) {
    // Every turn of a pentagram is to the left: only the number of turns gives it away.
    std::vector<Vec2> star;
    for (int i = 0; i < 5; ++i) { star.push_back({real(std::cos(2.513274 * i)), real(std::sin(2.513274 * i))}); }
    EXPECT_EQ(polygonCode(star), StatusCode::notConvex);
    std::vector<Vec2> twice;
    for (int i = 0; i < 8; ++i) { twice.push_back({real(std::cos(1.6 * i)), real(std::sin(1.6 * i))}); }
    EXPECT_EQ(polygonCode(twice), StatusCode::notConvex);
}

TEST(MakePolygon, AnyOrderOfAConvexPolygonButItsRotationsIsRefused) {
    Random random(4);
    int accepted = 0;
    for (int i = 0; i < 5'000; ++i) {
        const Polygon polygon = randomPolygon(random, 0);
        std::vector<Vec2> shuffled(polygon.points().begin(), polygon.points().end());
        for (std::size_t k = shuffled.size() - 1; k > 0; --k) {
            std::swap(shuffled[k], shuffled[static_cast<std::size_t>(random.integer(0, static_cast<int>(k)))]);
        }
        std::vector<Vec2> rotated = shuffled;
        std::rotate(rotated.begin(), std::find(rotated.begin(), rotated.end(), polygon.vertices[0]), rotated.end());
        const bool isRotation = std::equal(rotated.begin(), rotated.end(), polygon.points().begin());
        ASSERT_EQ(makePolygon(shuffled).ok(), isRotation) << "case " << i << ": " << polygon;
        accepted += isRotation ? 1 : 0;
    }
    EXPECT_GT(accepted, 100);
}

TEST(MakePolygon, JudgesRelativeToTheSizeOfThePolygon) {
    // A bump on the long side: refused where rounding would decide, accepted well above, at any scale and place.
    for (const int exponent : {-20, 0, 20}) {
        const Real unit = std::ldexp(Real(1), exponent);
        const auto withBump = [&](Real height) {
            return polygonCode({{0, 0}, {unit, -height * unit}, {2 * unit, 0}, {unit, unit}});
        };
        EXPECT_EQ(withBump(kEpsilon), StatusCode::notConvex);
        EXPECT_EQ(withBump(16 * kEpsilon), StatusCode::ok);
        EXPECT_EQ(withBump(0), StatusCode::notConvex);
        EXPECT_EQ(withBump(-16 * kEpsilon), StatusCode::notConvex);
    }
    // Around 10⁶ m, f32 coordinates are multiples of 1/16 m; a triangle of that grid is as good as any.
    const Real far = 1'000'000;
    EXPECT_EQ(polygonCode({{far, far}, {far + 1, far}, {far, far + 1}}), StatusCode::ok);
}

TEST(Validate, RefusesWhatTheMakersCannotProduce) {
    const Polygon box = makeBox({1, 1}).value();
    const auto codeAfter = [&](auto change) {
        Polygon changed = box;
        change(changed);
        return validate(changed);
    };
    EXPECT_EQ(validate(Polygon{}).code, StatusCode::tooFewVertices);
    EXPECT_EQ(codeAfter([](Polygon& p) { p.count = -1; }).code, StatusCode::tooFewVertices);
    EXPECT_EQ(codeAfter([](Polygon& p) { p.count = 9; }).code, StatusCode::tooManyVertices);
    EXPECT_EQ(codeAfter([](Polygon& p) { p.count = 1; }).code, StatusCode::degenerate) << "a point";
    EXPECT_EQ(codeAfter([](Polygon& p) { p.count = 3; }).code, StatusCode::outOfRange) << "the third normal is wrong";
    EXPECT_EQ(codeAfter([](Polygon& p) { p.radius = -1; }).code, StatusCode::negative);
    EXPECT_EQ(codeAfter([](Polygon& p) { p.radius = kNan; }).code, StatusCode::notFinite);
    EXPECT_EQ(codeAfter([](Polygon& p) { p.vertices[3].x = kNan; }).code, StatusCode::notFinite);
    EXPECT_EQ(codeAfter([](Polygon& p) { p.normals[3].x = kNan; }).code, StatusCode::notFinite);
    EXPECT_EQ(codeAfter([](Polygon& p) { p.normals[0] = -p.normals[0]; }).code, StatusCode::outOfRange);
    EXPECT_EQ(codeAfter([](Polygon& p) { p.normals[1].x = real(1.001); }).code, StatusCode::outOfRange);
    EXPECT_EQ(codeAfter([](Polygon& p) { std::swap(p.vertices[0], p.vertices[1]); }).code, StatusCode::notConvex);
    EXPECT_EQ(codeAfter([](Polygon& p) { p.vertices[1] = p.vertices[0]; }).code, StatusCode::notConvex);
    EXPECT_STREQ(codeAfter([](Polygon& p) { p.count = 9; }).field, "count");
    EXPECT_STREQ(codeAfter([](Polygon& p) { p.normals[0] = {}; }).field, "normals");
    EXPECT_STREQ(codeAfter([](Polygon& p) { p.vertices[0].y = kEndless; }).field, "vertices");
}

TEST(SupportIndex, FindsTheFarthestVertexAndTheLowestOnATie) {
    Random random(5);
    for (int i = 0; i < 10'000; ++i) {
        const Polygon polygon = randomShape(random);
        const Vec2 direction = randomVec(random, -1, 1);
        const int index = supportIndex(polygon, direction);
        ASSERT_GE(index, 0);
        ASSERT_LT(index, polygon.count);
        const Point chosen = exact(polygon.vertices[static_cast<std::size_t>(index)]);
        for (const Point p : exactPoints(polygon)) {
            ASSERT_LE(dot(p - chosen, exact(direction)), 8 * kEps) << "case " << i << ": " << polygon;
        }
    }
    const Polygon box = makeBox({1, 1}).value();
    EXPECT_EQ(supportIndex(box, {0, -1}), 0);
    EXPECT_EQ(supportIndex(box, {0, 1}), 2);
    EXPECT_EQ(supportIndex(box, {-1, 0}), 0);
    EXPECT_EQ(supportIndex(box, {0, 0}), 0);
}

}  // namespace
}  // namespace swept::test
