#include <cmath>

#include <gtest/gtest.h>

#include <swept/shapes/obb.h>

#include "shape_families.h"

namespace swept::test {
namespace {

std::array<Point, 4> corners(const Obb& box) {
    const Point along{exact(box.pose.rotation.c), exact(box.pose.rotation.s)};
    const Point across{-along.y, along.x};
    const Point x = exact(box.half.x) * along;
    const Point y = exact(box.half.y) * across;
    const Point center = exact(box.pose.translation);
    return {center - x - y, center + x - y, center + x + y, center - x + y};
}

/// Largest gap between the projections of the corners on the face normals of both.
long double bruteSeparation(const Obb& a, const Obb& b) {
    long double largest = -1e30L;
    for (const Rotation q : {a.pose.rotation, b.pose.rotation}) {
        for (const Point axis : {Point{exact(q.c), exact(q.s)}, Point{-exact(q.s), exact(q.c)}}) {
            long double lowA = 1e30L, highA = -1e30L, lowB = 1e30L, highB = -1e30L;
            for (const Point p : corners(a)) {
                lowA = std::min(lowA, dot(axis, p));
                highA = std::max(highA, dot(axis, p));
            }
            for (const Point p : corners(b)) {
                lowB = std::min(lowB, dot(axis, p));
                highB = std::max(highB, dot(axis, p));
            }
            largest = std::max({largest, lowB - highA, lowA - highB});
        }
    }
    return largest;
}

Obb randomBox(Random& random, double spread) {
    const double angle = random.chance(0.2) ? 1.5707963267948966 * random.integer(-2, 2) : random.range(-4, 4);
    return {{randomVec(random, -spread, spread), rotationFromAngle(angle)},
            {real(random.range(0, 1)), real(random.range(0, 1))}};
}

TEST(Obb, AgreesWithTheProjectionOfAllCorners) {
    Random random(1);
    int apart = 0;
    for (int i = 0; i < 50'000; ++i) {
        const Obb a = randomBox(random, 1);
        const Obb b = randomBox(random, 1);
        const long double truth = bruteSeparation(a, b);
        const long double size = exact(a.half.x + a.half.y + b.half.x + b.half.y) +
                                 length(exact(b.pose.translation) - exact(a.pose.translation)) * 1.42L;
        ASSERT_LE(std::fabs(exact(separation(a, b)) - truth), 4 * kEps * size) << "case " << i;
        if (truth <= 0) { ASSERT_TRUE(overlaps(a, b)) << "case " << i; }
        if (truth > 8 * kEps * size) { ASSERT_FALSE(overlaps(a, b)) << "case " << i; }
        apart += truth > 0 ? 1 : 0;
    }
    EXPECT_GT(apart, 5'000);
    EXPECT_LT(apart, 45'000);
}

TEST(Obb, TouchingBoxesOverlapAtEveryAngle) {
    // B is put exactly beside A along a face normal of A, so the only gap is the rounding of the input.
    Random random(2);
    int reportedApart = 0;
    for (int i = 0; i < 20'000; ++i) {
        Obb a = randomBox(random, 1);
        Obb b = randomBox(random, 1);
        b.pose.rotation = a.pose.rotation;
        const Real across = a.half.x + b.half.x;
        b.pose.translation = a.pose.translation + rotate(a.pose.rotation, {across, 0});
        if (bruteSeparation(a, b) > 0) { continue; }
        reportedApart += overlaps(a, b) ? 0 : 1;
    }
    EXPECT_EQ(reportedApart, 0);
}

TEST(Obb, IsSymmetric) {
    Random random(3);
    for (int i = 0; i < 10'000; ++i) {
        const Obb a = randomBox(random, 1);
        const Obb b = randomBox(random, 1);
        ASSERT_NEAR(static_cast<double>(separation(a, b)), static_cast<double>(separation(b, a)),
                    16 * static_cast<double>(kEpsilon))
            << "case " << i;
    }
}

}  // namespace
}  // namespace swept::test
