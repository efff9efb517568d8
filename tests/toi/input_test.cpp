#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <utility>

#include "families.h"

/// What may be asked, and what is refused.

namespace swept::test {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

Query good() {
    Query q;
    q.a = {{DVec2{0, 0}, DVec2{1, 0}, DVec2{0, 1}}, 3, 0.25};
    q.b = {{DVec2{0, 0}, DVec2{1, 0}}, 2, 0};
    q.sweepB.c0 = {5, 0};
    q.settings = defaultToiSettings(q.a, q.b);
    return q;
}

Status check(const Query& q) { return validateToi(q.a, q.sweepA, q.b, q.sweepB, q.settings); }

template <class Change>
Status refusalOf(Change change) {
    Query q = good();
    change(q);
    return check(q);
}

TEST(ToiInput, AcceptsWhatIsGood) { EXPECT_TRUE(check(good()).ok()); }

TEST(ToiInput, RefusesNumbersThatAreNone) {
    for (const double bad : {kNan, kInfinity, -kInfinity}) {
        const auto code = [](const Status& status) { return status.code; };
        EXPECT_EQ(code(refusalOf([bad](Query& q) { q.a.vertices[2].y = bad; })), StatusCode::notFinite);
        EXPECT_EQ(code(refusalOf([bad](Query& q) { q.b.radius = bad; })), StatusCode::notFinite);
        EXPECT_EQ(code(refusalOf([bad](Query& q) { q.sweepA.localCenter.x = bad; })), StatusCode::notFinite);
        EXPECT_EQ(code(refusalOf([bad](Query& q) { q.sweepA.c0.x = bad; })), StatusCode::notFinite);
        EXPECT_EQ(code(refusalOf([bad](Query& q) { q.sweepB.c1.y = bad; })), StatusCode::notFinite);
        EXPECT_EQ(code(refusalOf([bad](Query& q) { q.sweepB.k.y = bad; })), StatusCode::notFinite);
        EXPECT_EQ(code(refusalOf([bad](Query& q) { q.sweepB.a0 = bad; })), StatusCode::notFinite);
        EXPECT_EQ(code(refusalOf([bad](Query& q) { q.sweepB.a1 = bad; })), StatusCode::notFinite);
        EXPECT_EQ(code(refusalOf([bad](Query& q) { q.settings.target = bad; })), StatusCode::notFinite);
        EXPECT_EQ(code(refusalOf([bad](Query& q) { q.settings.tolerance = bad; })), StatusCode::notFinite);
        EXPECT_EQ(code(refusalOf([bad](Query& q) { q.settings.tMax = bad; })), StatusCode::notFinite);
    }
    // Finite numbers whose differences are not.
    EXPECT_EQ(refusalOf([](Query& q) { q.sweepA.c0.x = 1.5e308, q.sweepB.c0.x = -1.5e308; }).code,
              StatusCode::outOfRange);
}

/// Also where products of two coordinates are no numbers.
TEST(ToiInput, AcceptsPolygonsOfEverySize) {
    const Query q = good();
    ToiPolygon turned = q.a;  // no edge along an axis, so that products are differences
    turned.vertices = {DVec2{0.1, 0}, DVec2{1, 0.3}, DVec2{-0.2, 1}};
    for (const ToiPolygon& polygon : {q.a, turned}) {
        const ToiSettings near = defaultToiSettings(polygon, polygon);
        for (const int exponent : {-1000, -900, -520, -400, 400, 505, 520, 900, 1000}) {
            ToiPolygon far = polygon;
            for (DVec2& v : far.vertices) { v = {std::ldexp(v.x, exponent), std::ldexp(v.y, exponent)}; }
            far.radius = std::ldexp(far.radius, exponent);
            EXPECT_TRUE(validateToiPolygon(far).ok()) << exponent;
            EXPECT_EQ(defaultToiSettings(far, far).target, std::ldexp(near.target, exponent)) << exponent;
            std::swap(far.vertices[0], far.vertices[1]);
            EXPECT_EQ(validateToiPolygon(far).code, StatusCode::notConvex) << exponent;
        }
    }
}

TEST(ToiInput, RefusesBadPolygons) {
    EXPECT_EQ(refusalOf([](Query& q) { q.a.count = 0; }).code, StatusCode::tooFewVertices);
    EXPECT_EQ(refusalOf([](Query& q) { q.a.count = -3; }).code, StatusCode::tooFewVertices);
    EXPECT_EQ(refusalOf([](Query& q) { q.a.count = 9; }).code, StatusCode::tooManyVertices);
    EXPECT_EQ(refusalOf([](Query& q) { q.a.radius = -0.1; }).code, StatusCode::negative);
    EXPECT_EQ(refusalOf([](Query& q) { q.b.vertices[1] = q.b.vertices[0]; }).code, StatusCode::degenerate);
    EXPECT_EQ(refusalOf([](Query& q) { std::swap(q.a.vertices[1], q.a.vertices[2]); }).code, StatusCode::notConvex);
    EXPECT_EQ(refusalOf([](Query& q) { q.a.vertices[2] = {2, 0}; }).code, StatusCode::notConvex);  // on a line
    EXPECT_EQ(refusalOf([](Query& q) { q.a.vertices[2] = q.a.vertices[1]; }).code, StatusCode::notConvex);
    // A pentagram turns left at every vertex, and twice around.
    ToiPolygon star;
    star.count = 5;
    for (int i = 0; i < 5; ++i) {
        const double angle = 2 * i * 2 * 3.14159265358979 / 5;
        star.vertices[static_cast<std::size_t>(i)] = {std::cos(angle), std::sin(angle)};
    }
    EXPECT_EQ(validateToiPolygon(star).code, StatusCode::notConvex);
}

TEST(ToiInput, ConvexityHasNoScale) {
    for (const double size : {1e-90, 1e-9, 1.0, 1e9, 1e90}) {
        ToiPolygon polygon{{DVec2{0, 0}, DVec2{size, 0}, DVec2{size, 1e-5 * size}}, 3, 0};
        EXPECT_TRUE(validateToiPolygon(polygon).ok()) << size;
        polygon.vertices[2].y = -polygon.vertices[2].y;
        EXPECT_EQ(validateToiPolygon(polygon).code, StatusCode::notConvex) << size;
    }
}

TEST(ToiInput, RefusesBadSettings) {
    EXPECT_EQ(refusalOf([](Query& q) { q.settings.tMax = 0; }).code, StatusCode::notPositive);
    EXPECT_EQ(refusalOf([](Query& q) { q.settings.tMax = 1.5; }).code, StatusCode::outOfRange);
    EXPECT_EQ(refusalOf([](Query& q) { q.settings.tolerance = 0; }).code, StatusCode::notPositive);
    EXPECT_EQ(refusalOf([](Query& q) { q.settings.target = -0.3; }).code, StatusCode::outOfRange);
    EXPECT_TRUE(refusalOf([](Query& q) { q.settings.target = -0.25; }).ok());  // the cores just touch
    const Status fine = refusalOf([](Query& q) { q.settings.tolerance = 1e-16; });
    EXPECT_EQ(fine.code, StatusCode::outOfRange);
    EXPECT_STREQ(fine.field, "tolerance");
}

TEST(ToiInput, RefusesATolerancePerRelativeCoordinates) {
    // Only what is relative counts: far away together is fine, far apart is not.
    EXPECT_TRUE(refusalOf([](Query& q) { q.sweepA.c0.x = q.sweepA.c1.x = q.sweepB.c0.x = q.sweepB.c1.x = 1e15; }).ok());
    EXPECT_EQ(refusalOf([](Query& q) { q.sweepB.c1.x = 1e15; }).code, StatusCode::outOfRange);
}

TEST(ToiInput, DefaultsComeFromTheSmallerExtent) {
    ToiPolygon box{{DVec2{-1, -0.5}, DVec2{1, -0.5}, DVec2{1, 0.5}, DVec2{-1, 0.5}}, 4, 0};
    ToiPolygon point{{DVec2{}}, 1, 0};
    ToiPolygon ball{{DVec2{}}, 1, 0.25};
    ToiPolygon segment{{DVec2{0, 0}, DVec2{3, 4}}, 2, 0};
    ToiPolygon capsule{{DVec2{0, 0}, DVec2{3, 4}}, 2, 0.125};
    EXPECT_EQ(defaultToiSettings(box, segment).target, 1.0 / 1024);
    EXPECT_EQ(defaultToiSettings(box, segment).tolerance, 0.25 / 1024);
    EXPECT_EQ(defaultToiSettings(box, ball).target, 0.5 / 1024);
    EXPECT_EQ(defaultToiSettings(capsule, box).target, 0.25 / 1024);
    EXPECT_EQ(defaultToiSettings(segment, point).target, 5.0 / 1024);  // a point takes its partner's
    box.radius = 1;
    EXPECT_EQ(defaultToiSettings(box, segment).target, 3.0 / 1024);
}

TEST(ToiInput, OverlapAndTouchAtTheStart) {
    Query q = good();
    q.sweepB.c0 = {0.2, 0.2};
    Toi toi = ask(q);
    EXPECT_EQ(toi.state, ToiState::overlapped);
    EXPECT_EQ(toi.fraction, 0);
    EXPECT_NEAR(toi.separation, static_cast<double>(trueSeparation(q, 0)), 1e-12);
    q.sweepB.c0 = {1.1, 0};  // only the rounding reaches it
    toi = ask(q);
    EXPECT_EQ(toi.state, ToiState::hit);
    EXPECT_EQ(toi.fraction, 0);
    EXPECT_NEAR(toi.separation, 0.1 - 0.25, 1e-12);
    EXPECT_EQ(toi.iterations, 1);
}

/// libFuzzer found a pair that parted within a tolerance of 5·10³⁰³, and was not answered.
TEST(ToiInput, AnswersWithinAnyTolerance) {
    for (const double tolerance : {1.0, 1e10, 1e100, 1e200, 5e303, std::numeric_limits<double>::max() / 4}) {
        for (const double speed : {-3.0, 0.0, 3.0}) {
            for (const double spin : {0.0, 2.0, 40.0}) {
                Query q = good();
                q.settings.tolerance = tolerance;
                q.sweepB.c0 = {4, 0.1};
                q.sweepB.c1 = {4 + speed, 0.3};
                q.sweepB.a1 = q.sweepB.a0 + spin;
                ASSERT_TRUE(validateToi(q.a, q.sweepA, q.b, q.sweepB, q.settings).ok());
                const Toi toi = ask(q);
                EXPECT_NE(toi.state, ToiState::failed) << tolerance << ", " << speed << " m, " << spin << " rad";
                EXPECT_TRUE(std::isfinite(toi.separation));
            }
        }
    }
}

}  // namespace
}  // namespace swept::test
