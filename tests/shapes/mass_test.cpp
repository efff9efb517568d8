#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

#include <swept/shapes/mass.h>

#include "shape_families.h"

namespace swept::test {
namespace {

constexpr long double kPi = std::numbers::pi_v<long double>;

void expectMass(const MassProperties& got, long double mass, Point center, long double inertia,
                double tolerance = 1e-14) {
    EXPECT_NEAR(got.mass, static_cast<double>(mass), tolerance * static_cast<double>(mass));
    EXPECT_LE(length(exact(got.center) - center), static_cast<long double>(tolerance) * (1 + length(center)));
    EXPECT_NEAR(got.inertia, static_cast<double>(inertia), tolerance * static_cast<double>(inertia));
}

TEST(Mass, OfABox) {
    expectMass(massOf(makeBox({2, real(0.5)}, {3, 4}).value(), 3), 12, {3, 4}, 12 * (16.0L + 1) / 12);
}

TEST(Mass, OfACircle) { expectMass(massOf(makeCircle({3, 4}, 2).value(), 5), 20 * kPi, {3, 4}, 20 * kPi * 2); }

TEST(Mass, OfACapsule) {
    // A rectangle 4 × 2 and two half disks whose centroids are 4r/(3π) from their flat sides.
    const long double rectangle = 8;
    const long double half = kPi / 2;
    const long double centroid = 4 / (3 * kPi);
    const long double halfInertia = half * (0.5L - centroid * centroid);
    const long double offset = 2 + centroid;
    const long double inertia = rectangle * (16 + 4) / 12 + 2 * (halfInertia + half * offset * offset);
    expectMass(massOf(makeCapsule({-1, 5}, {3, 5}, 1).value(), 1), rectangle + 2 * half, {1, 5}, inertia);
}

TEST(Mass, OfATriangle) {
    const Polygon triangle = makePolygon(std::vector<Vec2>{{0, 0}, {6, 0}, {0, 3}}).value();
    const long double mass = 9;
    // Right-angled with legs a, b: m (a² + b²)/18 about the centroid.
    expectMass(massOf(triangle, 1), mass, {2, 1}, mass * (36.0L + 9) / 18);
}

TEST(Mass, OfARoundedBox) {
    // Core 2a × 2b, radius r: core, four rectangles, four quarter disks.
    const long double a = 2, b = 1, r = 0.5L;
    const long double core = 4 * a * b;
    const long double wide = 2 * a * r, tall = 2 * b * r;
    const long double quarter = kPi * r * r / 4;
    const long double g = 4 * r / (3 * kPi);  // centroid of a quarter disk along either axis
    const long double quarterInertia = quarter * (r * r / 2 - 2 * g * g);
    const long double inertia = core * (4 * a * a + 4 * b * b) / 12 +
                                2 * (wide * (4 * a * a + r * r) / 12 + wide * (b + r / 2) * (b + r / 2)) +
                                2 * (tall * (4 * b * b + r * r) / 12 + tall * (a + r / 2) * (a + r / 2)) +
                                4 * (quarterInertia + quarter * ((a + g) * (a + g) + (b + g) * (b + g)));
    const long double mass = core + 2 * wide + 2 * tall + 4 * quarter;
    expectMass(massOf(makeBox({2, 1}, {-1, 2}, 0, real(0.5)).value(), 1), mass, {-1, 2}, inertia);
    const MassProperties turned = massOf(makeBox({2, 1}, {-1, 2}, 0.7, real(0.5)).value(), 1);
    const double rounding = 16 * static_cast<double>(kEpsilon);
    expectMass(turned, mass, {-1, 2}, inertia, rounding);
}

TEST(Mass, OfShapesWithoutAreaOrDensity) {
    const MassProperties segment = massOf(makeSegment({1, 1}, {3, 5}).value(), 7);
    EXPECT_EQ(segment.mass, 0);
    EXPECT_EQ(segment.inertia, 0);
    EXPECT_EQ(segment.center, (DVec2{2, 3}));
    const MassProperties weightless = massOf(makeBox({1, 1}, {2, 3}).value(), 0);
    EXPECT_EQ(weightless.mass, 0);
    EXPECT_EQ(weightless.inertia, 0);
    EXPECT_EQ(weightless.center, (DVec2{2, 3}));
}

/// Part of the line at height y inside the rounded shape, as [from, to]; empty if from > to.
struct Chord {
    long double from;
    long double to;
};

Chord chordAt(const Polygon& polygon, long double y) {
    Chord chord{1e30L, -1e30L};
    const auto widen = [&](long double a, long double b) { chord = {std::min(chord.from, a), std::max(chord.to, b)}; };
    const long double r = exact(polygon.radius);
    const std::vector<Point> v = exactPoints(polygon);
    for (std::size_t i = 0; i < v.size(); ++i) {
        const long double h = y - v[i].y;
        if (std::fabs(h) <= r) { widen(v[i].x - std::sqrt(r * r - h * h), v[i].x + std::sqrt(r * r - h * h)); }
        if (v.size() == 1) { break; }
        const Point edge = v[(i + 1) % v.size()] - v[i];
        const Point start = v[i] + (r / length(edge)) * Point{edge.y, -edge.x};  // the edge moved outwards
        if (edge.y == 0) { continue; }
        const long double t = (y - start.y) / edge.y;
        if (t >= 0 && t <= 1) { widen(start.x + t * edge.x, start.x + t * edge.x); }
    }
    return chord;
}

TEST(Mass, AgreesWithNumericalIntegration) {
    constexpr int kSlices = 4'000;
    Random random(1);
    for (int i = 0; i < 150; ++i) {
        const Polygon polygon = randomShape(random, i % 2 == 0 ? 0 : 10);
        if (polygon.radius == 0 && polygon.count == 2) { continue; }
        long double low = 1e30L;
        long double high = -1e30L;
        for (const Point p : exactPoints(polygon)) {
            low = std::min(low, p.y - exact(polygon.radius));
            high = std::max(high, p.y + exact(polygon.radius));
        }
        const Point origin = exact(polygon.vertices[0]);
        long double area = 0;
        Point first;
        long double second = 0;
        for (int k = 0; k < kSlices; ++k) {
            // Midpoints in an angle that slows down at both ends, where the chord grows like a square root.
            const long double angle = kPi * (k + 0.5L) / kSlices;
            const long double y = (low + high) / 2 - (high - low) / 2 * std::cos(angle);
            const long double thickness = (high - low) / 2 * std::sin(angle) * kPi / kSlices;
            const Chord chord = chordAt(polygon, y);
            if (chord.from > chord.to) { continue; }
            const long double from = chord.from - origin.x, to = chord.to - origin.x, h = y - origin.y;
            area += thickness * (to - from);
            first = first + thickness * Point{(to * to - from * from) / 2, (to - from) * h};
            second += thickness * ((to * to * to - from * from * from) / 3 + (to - from) * h * h);
        }
        const Point center = (1 / area) * first;
        const long double inertia = second - area * dot(center, center);
        const MassProperties got = massOf(polygon, 2);
        ASSERT_NEAR(got.mass, static_cast<double>(2 * area), 1e-5 * got.mass) << "case " << i << ": " << polygon;
        ASSERT_NEAR(got.inertia, static_cast<double>(2 * inertia), 4e-5 * got.inertia)
            << "case " << i << ": " << polygon;
        ASSERT_LE(length(exact(got.center) - (origin + center)), 1e-5L) << "case " << i << ": " << polygon;
    }
}

TEST(Mass, DoesNotSufferFromDistance) {
    // The second moment about a far origin would lose all digits of the inertia (Box2D issue 1006).
    const MassProperties here = massOf(makeBox({8, 4}).value(), 1);
    const MassProperties there = massOf(makeBox({8, 4}, {1'000'000, -1'000'000}).value(), 1);
    EXPECT_EQ(here.mass, there.mass);
    EXPECT_EQ(here.inertia, there.inertia);
    EXPECT_EQ(there.center, (DVec2{1e6, -1e6}));
    Random random(2);
    for (int i = 0; i < 5'000; ++i) {
        const Vec2 far{1'000'000, 1'000'000};
        std::vector<Vec2> cloud;
        for (int k = 0; k < 6; ++k) { cloud.push_back(far + randomVec(random, -1, 1)); }
        const Result<Polygon> hull = convexHull(cloud, i % 2 == 0 ? 0 : real(0.1));
        if (!hull.ok()) { continue; }
        const MassProperties got = massOf(hull.value(), 1);
        ASSERT_GT(got.mass, 0) << "case " << i;
        ASSERT_GT(got.inertia, 0) << "case " << i << ": " << hull.value();
        // No flat shape has a smaller inertia than the disk of its area.
        ASSERT_GE(got.inertia, got.mass * got.mass / (2 * std::numbers::pi) * (1 - 1e-12)) << "case " << i;
    }
}

TEST(Combine, OfTwoPartsIsTheWhole) {
    // A box cut in two at any grid line; on this grid all coordinates are exact also at 10⁶ m in f32.
    Random random(3);
    for (int i = 0; i < 1'000; ++i) {
        const Real far = i % 2 == 0 ? Real(0) : Real(1'000'000);
        const Real left = real(0.25 * random.integer(1, 40));
        const Real right = real(0.25 * random.integer(1, 40));
        const Real height = real(0.25 * random.integer(1, 40));
        const std::array<MassProperties, 2> parts = {massOf(makeBox({left, height}, {far - left, far}).value(), 2),
                                                     massOf(makeBox({right, height}, {far + right, far}).value(), 2)};
        const MassProperties whole = massOf(makeBox({left + right, height}, {far + right - left, far}).value(), 2);
        const MassProperties sum = combine(parts);
        ASSERT_NEAR(sum.mass, whole.mass, 1e-15 * whole.mass) << "case " << i;
        ASSERT_NEAR(sum.inertia, whole.inertia, 4e-15 * whole.inertia + 1e-9 * (far > 0 ? 1 : 0)) << "case " << i;
        ASSERT_LE(length(exact(sum.center) - exact(whole.center)), far > 0 ? 4e-10L : 1e-14L) << "case " << i;
    }
}

TEST(Combine, OfNothingAndOfTheWeightless) {
    EXPECT_EQ(combine({}).mass, 0);
    const std::array<MassProperties, 2> parts = {MassProperties{0, {5, 5}, 0}, MassProperties{2, {1, 1}, 3}};
    const MassProperties sum = combine(parts);
    EXPECT_EQ(sum.mass, 2);
    EXPECT_EQ(sum.center, (DVec2{1, 1}));
    EXPECT_EQ(sum.inertia, 3);
}

}  // namespace
}  // namespace swept::test
