#include <gtest/gtest.h>

#include <string>

#include <swept/shapes/distance.h>
#include <swept/shapes/manifold.h>

#include "manifold_cases.h"
#include "pair_families.h"

/// Manifolds of random pairs: depth, places and names of the points by the distance of the same pair.

namespace swept::test {
namespace {

long double longestEdge(const Polygon& p) {
    long double most = 0;
    for (int i = 0; i < p.count; ++i) {
        most = std::max(most, length(exact(p.vertices[static_cast<std::size_t>(p.next(i))]) -
                                     exact(p.vertices[static_cast<std::size_t>(i)])));
    }
    return most;
}

class ManifoldFamilies : public testing::TestWithParam<PairFamily> {};

TEST_P(ManifoldFamilies, DeepestPointIsAsDeepAsTheDistanceSays) {
    int touching = 0;
    int two = 0;
    for (std::uint64_t seed = 0; seed < 10'000; ++seed) {
        const PairCase c = makePair(GetParam(), seed);
        const Distance d = distance(c.a, c.b, c.bInA);
        const long double size = scaleOf(c, exact(d.coreDistance)) + exact(c.a.radius) + exact(c.b.radius);
        const long double unit = kEps * size;
        const Real margin = real(static_cast<double>(0.1L * size));
        const Manifold m = collide(c.a, c.b, c.bInA, margin);
        if (exact(d.distance) > exact(margin) + unit) {
            ASSERT_EQ(m.count, 0) << "seed " << seed << "\n" << c;
            continue;
        }
        if (exact(d.distance) > exact(margin) - unit) { continue; }
        ASSERT_GE(m.count, 1) << "seed " << seed << "\n" << c;
        ASSERT_NEAR(static_cast<double>(length(exact(m.normal))), 1, 4 * static_cast<double>(kEps));
        // Overlapping cores may prefer a face of A by 2⁻¹⁰ of the shorter of two faces.
        const long double preferred = std::min(longestEdge(c.a), longestEdge(c.b)) / 1024;
        const long double slack = 16 * unit + (exact(d.coreDistance) > 16 * unit ? 0 : preferred);
        ASSERT_LE(std::fabs(exact(deepest(m)) - exact(d.distance)), slack)
            << "seed " << seed << ": " << deepest(m) << " against " << d.distance << "\n"
            << c;
        ++touching;
        two += m.count == 2 ? 1 : 0;
    }
    EXPECT_GT(touching, 500);
    RecordProperty("touching", touching);
    RecordProperty("twoPoints", two);
}

TEST_P(ManifoldFamilies, PointsLieHalfWayBetweenTheSurfaces) {
    int points = 0;
    for (std::uint64_t seed = 0; seed < 10'000; ++seed) {
        const PairCase c = makePair(GetParam(), seed);
        const std::vector<Point> a = exactPoints(c.a);
        const std::vector<Point> b = placed(c.b, c.bInA);
        const long double core = coreSeparation(a, b);
        const long double size = scaleOf(c, core) + exact(c.a.radius) + exact(c.b.radius);
        const Manifold m = collide(c.a, c.b, c.bInA, real(static_cast<double>(0.1L * size)));
        // A face normal may stand in for a closest direction that differs from it by √eps (see the contract).
        const long double slack = 16 * kEps * size + 2 * std::sqrt(kEps) * std::max(core, 0.0L);
        for (int i = 0; i < m.count; ++i) {
            const ManifoldPoint& p = m.points[static_cast<std::size_t>(i)];
            const Point half = (exact(p.separation) / 2) * exact(m.normal);
            // From the point, half the separation leads to each surface; the radius more, to each core.
            const Point onA = exact(p.point) - half - exact(c.a.radius) * exact(m.normal);
            const Point onB = exact(p.point) + half + exact(c.b.radius) * exact(m.normal);
            ASSERT_LE(distanceToOutline(a, onA), slack) << "seed " << seed << ", core " << core << "\n" << c;
            ASSERT_LE(distanceToOutline(b, onB), slack) << "seed " << seed << ", core " << core << "\n" << c;
            ++points;
        }
    }
    EXPECT_GT(points, 500);
}

/// Without the families of ties and touches, which have more than one right answer.
class UntiedFamilies : public testing::TestWithParam<PairFamily> {};

TEST_P(UntiedFamilies, SwappedShapesGiveTheSamePoints) {
    int compared = 0;
    for (std::uint64_t seed = 0; seed < 10'000; ++seed) {
        const PairCase c = makePair(GetParam(), seed);
        const Distance d = distance(c.a, c.b, c.bInA);
        const long double size = scaleOf(c, exact(d.coreDistance)) + exact(c.a.radius) + exact(c.b.radius);
        if (exact(d.coreDistance) < 0.01L * size) { continue; }  // overlapping: A's face is preferred by contract
        const Real margin = real(static_cast<double>(size));
        const Manifold ab = collide(c.a, c.b, c.bInA, margin);
        const Manifold ba = collide(c.b, c.a, inverse(c.bInA), margin);
        const Point n = exact(rotate(c.bInA.rotation, ba.normal));
        ASSERT_LE(length(exact(ab.normal) + n), 4 * std::sqrt(kEps)) << "seed " << seed << "\n" << c;
        ASSERT_LE(std::fabs(exact(deepest(ab)) - exact(deepest(ba))), 32 * kEps * size) << "seed " << seed << "\n" << c;
        if (ab.count != 2 || ba.count != 2) { continue; }
        ++compared;
        for (const ManifoldPoint& p : ab.points) {
            long double nearest = std::numeric_limits<long double>::infinity();
            for (const ManifoldPoint& q : ba.points) {
                nearest = std::min(nearest, length(exact(p.point) - exact(apply(c.bInA, q.point))));
            }
            ASSERT_LE(nearest, 8 * std::sqrt(kEps) * size) << "seed " << seed << "\n" << c;
        }
    }
    if (GetParam() == PairFamily::generic) { EXPECT_GT(compared, 500); }
}

INSTANTIATE_TEST_SUITE_P(All, ManifoldFamilies, testing::ValuesIn(kPairFamilies),
                         familyName<testing::TestParamInfo<PairFamily>>);
INSTANTIATE_TEST_SUITE_P(All, UntiedFamilies,
                         testing::Values(PairFamily::generic, PairFamily::rounded, PairFamily::sliver,
                                         PairFamily::shortEdge, PairFamily::tinyAndHuge, PairFamily::segments,
                                         PairFamily::circles, PairFamily::farApart),
                         familyName<testing::TestParamInfo<PairFamily>>);

}  // namespace
}  // namespace swept::test
