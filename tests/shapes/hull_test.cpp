#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "shape_families.h"

namespace swept::test {
namespace {

using Cloud = std::vector<Vec2>;

StatusCode codeOf(const Cloud& cloud, Real radius = 0) { return convexHull(cloud, radius).status().code; }

long double sizeOfCloud(const Cloud& cloud) {
    long double size = 0;
    for (const Vec2 a : cloud) { size = std::max(size, length(exact(a) - exact(cloud.front()))); }
    return size;
}

void shuffle(Cloud& cloud, Random& random) {
    for (std::size_t k = cloud.size() - 1; k > 0; --k) {
        std::swap(cloud[k], cloud[static_cast<std::size_t>(random.integer(0, static_cast<int>(k)))]);
    }
}

/// Every claim of hull.h about one accepted cloud.
void expectHull(const Cloud& cloud, const Polygon& hull) {
    ASSERT_TRUE(validate(hull).ok()) << hull;
    const long double tolerance = 40 * kEps * sizeOfCloud(cloud);
    for (const Vec2 point : cloud) {
        ASSERT_LE(distanceToCore(hull, exact(point)), tolerance) << point << " / " << hull;
    }
    for (const Vec2 vertex : hull.points()) {
        ASSERT_NE(std::find(cloud.begin(), cloud.end(), vertex), cloud.end()) << vertex << " is no input";
        const Vec2 first = hull.vertices[0];
        ASSERT_TRUE(first.y < vertex.y || (first.y == vertex.y && first.x <= vertex.x)) << hull;
    }
}

/// Vertices of the hull by brute force: a point is one unless some triangle or segment of other points holds it.
std::size_t bruteVertexCount(const Cloud& cloud) {
    std::size_t vertices = 0;
    for (const Vec2 p : cloud) {
        bool extreme = false;  // some line through p has all other points strictly on one side
        for (const Vec2 q : cloud) {
            if (p == q) { continue; }
            bool allRight = true;
            const Point edge = exact(q) - exact(p);
            for (const Vec2 r : cloud) {
                const long double side = cross(edge, exact(r) - exact(p));
                // Points on the edge itself must lie beyond p, else p is inside an edge.
                allRight = allRight && (side < 0 || (side == 0 && dot(edge, exact(r) - exact(p)) >= 0));
            }
            extreme = extreme || allRight;
        }
        vertices += extreme ? 1 : 0;
    }
    return vertices;
}

TEST(Hull, AgreesWithBruteForceOnRandomClouds) {
    Random random(1);
    int accepted = 0;
    int tooMany = 0;
    for (int i = 0; i < 3'000; ++i) {
        Cloud cloud;
        const int count = random.integer(3, 24);
        const bool grid = i % 3 == 0;  // small integers: many repeated and collinear points
        for (int k = 0; k < count; ++k) {
            cloud.push_back(grid ? Vec2{real(random.integer(-3, 3)), real(random.integer(-3, 3))}
                                 : randomVec(random, -1, 1));
        }
        const Result<Polygon> hull = convexHull(cloud);
        Cloud distinct = cloud;
        std::sort(distinct.begin(), distinct.end(),
                  [](Vec2 a, Vec2 b) { return a.x < b.x || (a.x == b.x && a.y < b.y); });
        distinct.erase(std::unique(distinct.begin(), distinct.end()), distinct.end());
        const std::size_t vertices = bruteVertexCount(distinct);
        if (vertices > 8) {
            ASSERT_EQ(hull.status().code, StatusCode::tooManyVertices) << "case " << i;
            ++tooMany;
        } else if (vertices < 3) {
            ASSERT_EQ(hull.status().code, StatusCode::degenerate) << "case " << i;
        } else {
            ASSERT_TRUE(hull.ok()) << "case " << i;
            expectHull(cloud, hull.value());
            ASSERT_EQ(static_cast<std::size_t>(hull.value().count), vertices) << "case " << i << ": " << hull.value();
            ++accepted;
        }
    }
    EXPECT_GT(accepted, 1'500);
    EXPECT_GT(tooMany, 100);
}

TEST(Hull, DoesNotDependOnTheOrderOfTheInput) {
    Random random(2);
    for (int i = 0; i < 2'000; ++i) {
        Cloud cloud;
        for (int k = random.integer(3, 12); k > 0; --k) {
            cloud.push_back(i % 2 == 0
                                ? randomVec(random, -1, 1)
                                : Vec2{real(random.integer(-2, 2) * random.sign()), real(random.integer(-2, 2))});
        }
        const Result<Polygon> one = convexHull(cloud);
        shuffle(cloud, random);
        const Result<Polygon> other = convexHull(cloud);
        ASSERT_EQ(one.status().code, other.status().code) << "case " << i;
        for (std::size_t k = 0; k < 8; ++k) {
            ASSERT_EQ(one.value().vertices[k], other.value().vertices[k]) << "case " << i;
            ASSERT_EQ(std::signbit(one.value().vertices[k].x), std::signbit(other.value().vertices[k].x))
                << "case " << i;
        }
    }
}

TEST(Hull, OfAHullIsItself) {
    Random random(3);
    for (int i = 0; i < 2'000; ++i) {
        const Polygon polygon = randomPolygon(random, 0);
        const Cloud cloud(polygon.points().begin(), polygon.points().end());
        const Result<Polygon> hull = convexHull(cloud, real(0.5));
        if (!hull.ok()) { continue; }
        EXPECT_EQ(hull.value().radius, real(0.5));
        const Cloud vertices(hull.value().points().begin(), hull.value().points().end());
        const Polygon again = convexHull(vertices).value();
        ASSERT_TRUE(std::equal(vertices.begin(), vertices.end(), again.points().begin(), again.points().end()));
    }
}

TEST(Hull, RefusesDegenerateClouds) {
    const Real nan = std::numeric_limits<Real>::quiet_NaN();
    EXPECT_EQ(codeOf({}), StatusCode::tooFewVertices);
    EXPECT_EQ(codeOf({{1, 2}}), StatusCode::degenerate);
    EXPECT_EQ(codeOf({{1, 2}, {1, 2}, {1, 2}, {1, 2}}), StatusCode::degenerate);
    EXPECT_EQ(codeOf({{1, 2}, {3, 4}}), StatusCode::degenerate);
    EXPECT_EQ(codeOf({{0, 0}, {1, 1}, {2, 2}, {1, 1}}), StatusCode::degenerate);
    EXPECT_EQ(codeOf({{0, 0}, {-0.0F, 0}, {0, -0.0F}}), StatusCode::degenerate);
    EXPECT_EQ(codeOf({{0, 0}, {1, 0}, {0, nan}}), StatusCode::notFinite);
    EXPECT_EQ(codeOf({{0, 0}, {1, 0}, {0, 1}}, -1), StatusCode::negative);
    EXPECT_EQ(codeOf({{0, 0}, {1, 0}, {0, 1}}, nan), StatusCode::notFinite);
}

TEST(Hull, RefusesLinesInAnyDirectionAndPlace) {
    // Points p + t·d rounded to Real: collinear but for rounding, at the origin and far away.
    Random random(4);
    int notExact = 0;
    for (int i = 0; i < 5'000; ++i) {
        const Vec2 direction = randomVec(random, -1, 1);
        Cloud cloud;
        for (int k = 0; k < 12; ++k) { cloud.push_back(real(random.range(-1, 1)) * direction); }
        for (std::size_t k = 2; k < cloud.size(); ++k) {
            if (cross(exact(cloud[1]) - exact(cloud[0]), exact(cloud[k]) - exact(cloud[0])) != 0) { ++notExact; }
        }
        ASSERT_EQ(codeOf(cloud), StatusCode::degenerate) << "case " << i;
    }
    EXPECT_GT(notExact, 10'000) << "exactly collinear points would prove nothing";
}

TEST(Hull, DropsPointsWithinRoundingOfAnEdge) {
    Random random(5);
    for (int i = 0; i < 3'000; ++i) {
        const Polygon triangle = makePolygon(Cloud{{0, 0}, {3, real(random.range(-1, 1))}, {1, 2}}).value();
        Cloud cloud(triangle.points().begin(), triangle.points().end());
        for (int k = 0; k < 30; ++k) {
            const int side = random.integer(0, 2);
            const Vec2 p = triangle.vertices[static_cast<std::size_t>(side)];
            const Vec2 q = triangle.vertices[static_cast<std::size_t>(triangle.next(side))];
            cloud.push_back(p + real(random.uniform()) * (q - p));
        }
        const Result<Polygon> hull = convexHull(cloud);
        ASSERT_TRUE(hull.ok()) << "case " << i;
        EXPECT_EQ(hull.value().count, 3) << "case " << i << ": " << hull.value();
    }
}

TEST(Hull, WorksFarFromTheOrigin) {
    // Coordinates near 10⁶ m; near-collinear sides by the rounding of the coordinates themselves are real turns there.
    Random random(6);
    int accepted = 0;
    for (int i = 0; i < 3'000; ++i) {
        const Vec2 far{1'000'000, -1'000'000};
        Cloud cloud;
        const double scale = std::pow(10.0, random.range(-2, 2));
        for (int k = 0; k < 7; ++k) { cloud.push_back(far + randomVec(random, -scale, scale)); }
        const Result<Polygon> hull = convexHull(cloud);
        if (hull.ok()) {
            expectHull(cloud, hull.value());
            ++accepted;
        } else {
            ASSERT_EQ(hull.status().code, StatusCode::degenerate) << "case " << i;
        }
    }
    EXPECT_GT(accepted, 1'500);
}

TEST(Hull, KeepsAFinelySteppedArcRound) {
    // A circle of many points has too many vertices, however small each turn is: it must not collapse.
    for (const int count : {9, 100, 3'000, 20'000}) {
        Cloud cloud;
        for (int i = 0; i < count; ++i) {
            const double angle = 6.283185307179586 * i / count;
            cloud.push_back({real(std::cos(angle)), real(std::sin(angle))});
        }
        EXPECT_EQ(codeOf(cloud), StatusCode::tooManyVertices) << count;
    }
    // Flat enough to vanish within rounding: a square whose sides bulge by less than an ulp.
    Cloud cushion;
    for (int i = 0; i <= 100; ++i) {
        const Real t = real(i / 50.0 - 1);
        const Real bulge = 1 + kEpsilon * (1 - t * t);
        for (const Vec2 p : {Vec2{t, -bulge}, Vec2{bulge, t}, Vec2{t, bulge}, Vec2{-bulge, t}}) {
            cushion.push_back(p);
        }
    }
    const Result<Polygon> hull = convexHull(cushion);
    ASSERT_TRUE(hull.ok());
    EXPECT_EQ(hull.value().count, 4);
}

TEST(Hull, ThinTrianglesAreEitherValidOrRefused) {
    Random random(7);
    int accepted = 0;
    for (int i = 0; i < 20'000; ++i) {
        const Real thickness =
            std::ldexp(real(random.range(0.5, 1)), -random.integer(0, std::numeric_limits<Real>::digits + 6));
        const double tilt = random.range(0, 7);
        Cloud cloud;
        for (int k = 0; k < 6; ++k) {
            const double x = random.range(-1, 1);
            const double y = static_cast<double>(thickness) * random.range(-1, 1);
            cloud.push_back(
                {real(x * std::cos(tilt) - y * std::sin(tilt)), real(x * std::sin(tilt) + y * std::cos(tilt))});
        }
        const Result<Polygon> hull = convexHull(cloud);
        if (hull.ok()) {
            expectHull(cloud, hull.value());
            ++accepted;
        } else {
            ASSERT_EQ(hull.status().code, StatusCode::degenerate) << "case " << i;
        }
    }
    EXPECT_GT(accepted, 10'000);
    EXPECT_LT(accepted, 19'500) << "the thinnest are lines";
}

}  // namespace
}  // namespace swept::test
