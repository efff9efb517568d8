#include <gtest/gtest.h>

#include <string>

#include <swept/shapes/distance.h>
#include <swept/shapes/gjk.h>
#include <swept/shapes/penetration.h>

#include "pair_families.h"

namespace swept::test {
namespace {

constexpr int kCases = 20'000;

class DistanceFamilies : public testing::TestWithParam<PairFamily> {};

TEST_P(DistanceFamilies, AgreesWithBruteForce) {
    long double worst = 0;
    long double worstPoint = 0;
    int overlapping = 0;
    int apart = 0;
    int mostIterations = 0;
    for (std::uint64_t seed = 0; seed < kCases; ++seed) {
        const PairCase c = makePair(GetParam(), seed);
        const std::vector<Point> a = exactPoints(c.a);
        const std::vector<Point> b = placed(c.b, c.bInA);
        const long double core = coreSeparation(a, b);
        const long double radii = exact(c.a.radius) + exact(c.b.radius);
        const Distance d = distance(c.a, c.b, c.bInA);
        const long double unit = kEps * (scaleOf(c, core) + radii);
        const long double error =
            std::max(std::fabs(exact(d.coreDistance) - core), std::fabs(exact(d.distance) - (core - radii))) / unit;
        ASSERT_LE(error, kErrorBound) << "seed " << seed << ", exact " << core << "\n" << c;
        ASSERT_NEAR(static_cast<double>(length(exact(d.normal))), 1, 4 * static_cast<double>(kEps)) << c;
        ASSERT_GE(d.iterations, 1);
        ASSERT_LE(d.iterations, kMaxGjkIterations);

        // The witness points lie on the rounded surfaces and differ by distance · normal.
        const Point coreA = exact(d.pointA) - exact(c.a.radius) * exact(d.normal);
        const Point coreB = exact(d.pointB) + exact(c.b.radius) * exact(d.normal);
        const long double offSurface = std::max(distanceToOutline(a, coreA), distanceToOutline(b, coreB)) / unit;
        ASSERT_LE(offSurface, kErrorBound) << "seed " << seed << ", exact " << core << "\n" << c;
        const Point gap = exact(d.pointB) - exact(d.pointA) - exact(d.distance) * exact(d.normal);
        ASSERT_LE(length(gap) / unit, kErrorBound) << "seed " << seed << "\n" << c;

        worst = std::max(worst, error);
        worstPoint = std::max(worstPoint, offSurface);
        (core < 0 ? overlapping : apart) += 1;
        mostIterations = std::max(mostIterations, d.iterations);
    }
    RecordProperty("worstErrorInEps", std::to_string(worst));
    RecordProperty("worstPointInEps", std::to_string(worstPoint));
    RecordProperty("mostIterations", mostIterations);
    EXPECT_GT(apart, kCases / 8) << "too few pairs apart";
    const bool mayOverlap = GetParam() != PairFamily::farApart && GetParam() != PairFamily::circles;
    if (mayOverlap) { EXPECT_GT(overlapping, kCases / 50) << "too few overlaps"; }
}

TEST_P(DistanceFamilies, NormalSeparatesAsMuchAsTheDistance) {
    for (std::uint64_t seed = 0; seed < kCases / 4; ++seed) {
        const PairCase c = makePair(GetParam(), seed);
        const std::vector<Point> a = exactPoints(c.a);
        const std::vector<Point> b = placed(c.b, c.bInA);
        const Distance d = distance(c.a, c.b, c.bInA);
        const Point n = exact(d.normal);
        long double highest = -std::numeric_limits<long double>::infinity();
        long double lowest = std::numeric_limits<long double>::infinity();
        for (const Point p : a) { highest = std::max(highest, dot(n, p)); }
        for (const Point p : b) { lowest = std::min(lowest, dot(n, p)); }
        const long double unit = kEps * scaleOf(c, exact(d.coreDistance));
        ASSERT_LE(std::fabs(lowest - highest - exact(d.coreDistance)) / unit, kErrorBound) << "seed " << seed << "\n"
                                                                                           << c;
    }
}

TEST_P(DistanceFamilies, WarmStartGivesTheSameAnswer) {
    int shorter = 0;
    for (std::uint64_t seed = 0; seed < kCases / 4; ++seed) {
        PairCase c = makePair(GetParam(), seed);
        SimplexCache cache;
        const Distance first = distance(c.a, c.b, c.bInA, &cache);
        ASSERT_GE(cache.count, 1);
        ASSERT_LE(cache.count, 3);
        const long double unit = kEps * (scaleOf(c, exact(first.coreDistance)) + exact(c.a.radius) + exact(c.b.radius));
        const Distance again = distance(c.a, c.b, c.bInA, &cache);
        ASSERT_LE(std::fabs(exact(again.distance) - exact(first.distance)) / unit, kErrorBound)
            << "seed " << seed << "\n"
            << c;
        shorter += again.iterations < first.iterations ? 1 : 0;
        // A cache of another pose, and one that does not even fit, are hints and no more.
        Random random(seed);
        c.bInA.rotation = rotationFromAngle(random.range(-3, 3));
        const Distance cold = distance(c.a, c.b, c.bInA);
        const Distance moved = distance(c.a, c.b, c.bInA, &cache);
        for (std::size_t i = 0; i < 3; ++i) {
            cache.indexA[i] = static_cast<std::uint8_t>(random.bits());
            cache.indexB[i] = static_cast<std::uint8_t>(random.bits() & 7U);
        }
        cache.count = static_cast<std::uint8_t>(random.integer(0, 255));
        const Distance wild = distance(c.a, c.b, c.bInA, &cache);
        for (const Distance& d : {moved, wild}) {
            ASSERT_LE(std::fabs(exact(d.distance) - exact(cold.distance)) / unit, 2 * kErrorBound)
                << "seed " << seed << "\n"
                << c;
        }
    }
    const bool isOnePair = GetParam() == PairFamily::tinyAndHuge || GetParam() == PairFamily::farApart ||
                           GetParam() == PairFamily::circles;
    if (!isOnePair) { EXPECT_GT(shorter, kCases / 20) << "the cache saves nothing"; }
}

INSTANTIATE_TEST_SUITE_P(All, DistanceFamilies, testing::ValuesIn(kPairFamilies),
                         familyName<testing::TestParamInfo<PairFamily>>);

TEST(Distance, SwappedShapesGiveTheSameDistance) {
    for (const PairFamily family : kPairFamilies) {
        for (std::uint64_t seed = 0; seed < 2'000; ++seed) {
            const PairCase c = makePair(family, seed);
            const Distance ab = distance(c.a, c.b, c.bInA);
            const Distance ba = distance(c.b, c.a, inverse(c.bInA));
            // The inverse pose is itself rounded, and a rounded rotation is not quite of unit length.
            const long double unit =
                kEps * (scaleOf(c, exact(ab.coreDistance)) + exact(c.a.radius) + exact(c.b.radius));
            ASSERT_LE(std::fabs(exact(ab.distance) - exact(ba.distance)) / unit, 2 * kErrorBound)
                << "seed " << seed << "\n"
                << c;
        }
    }
}

Polygon mirrored(const Polygon& p) {
    Polygon m = p;
    for (int i = 0; i < p.count; ++i) {
        const Vec2 v = p.vertices[static_cast<std::size_t>(p.count - 1 - i)];
        m.vertices[static_cast<std::size_t>(i)] = {-v.x, v.y};
    }
    for (int i = 0; i < p.count && p.count > 1; ++i) {  // the edge from i to i + 1 was the one from count − 2 − i
        const Vec2 n = p.normals[static_cast<std::size_t>((2 * p.count - 2 - i) % p.count)];
        m.normals[static_cast<std::size_t>(i)] = {-n.x, n.y};
    }
    return m;
}

TEST(Distance, MirroredShapesGiveTheSameDistance) {
    for (const PairFamily family : kPairFamilies) {
        for (std::uint64_t seed = 0; seed < 2'000; ++seed) {
            const PairCase c = makePair(family, seed);
            const PairCase m{mirrored(c.a),
                             mirrored(c.b),
                             {{-c.bInA.translation.x, c.bInA.translation.y}, inverse(c.bInA.rotation)}};
            ASSERT_TRUE(c.a.count == 1 || validate(m.a).ok());
            const Distance d = distance(c.a, c.b, c.bInA);
            const Distance e = distance(m.a, m.b, m.bInA);
            const long double unit = kEps * (scaleOf(c, exact(d.coreDistance)) + exact(c.a.radius) + exact(c.b.radius));
            ASSERT_LE(std::fabs(exact(d.distance) - exact(e.distance)) / unit, kErrorBound) << "seed " << seed << "\n"
                                                                                            << c;
        }
    }
}

TEST(Distance, PowersOfTwoScaleTheAnswerAndNothingElse) {
    const int most = std::is_same_v<Real, double> ? 100 : 10;
    for (const PairFamily family : kPairFamilies) {
        for (std::uint64_t seed = 0; seed < 1'000; ++seed) {
            const PairCase c = makePair(family, seed);
            SimplexCache cache;
            const Distance d = distance(c.a, c.b, c.bInA, &cache);
            for (const int k : {-most, -7, 1, most}) {
                const auto up = [k](Real x) { return std::ldexp(x, k); };
                const Transform pose{{up(c.bInA.translation.x), up(c.bInA.translation.y)}, c.bInA.rotation};
                SimplexCache scaledCache;
                const Distance e = distance(scaled(c.a, k), scaled(c.b, k), pose, &scaledCache);
                ASSERT_EQ(e.distance, up(d.distance)) << "seed " << seed << "\n" << c;
                ASSERT_EQ(e.coreDistance, up(d.coreDistance));
                ASSERT_EQ(e.normal, d.normal);
                ASSERT_EQ(e.pointA, (Vec2{up(d.pointA.x), up(d.pointA.y)}));
                ASSERT_EQ(e.pointB, (Vec2{up(d.pointB.x), up(d.pointB.y)}));
                ASSERT_EQ(e.iterations, d.iterations);
                ASSERT_EQ(scaledCache.count, cache.count);
                ASSERT_EQ(scaledCache.indexA, cache.indexA);
                ASSERT_EQ(scaledCache.indexB, cache.indexB);
            }
        }
    }
}

TEST(Distance, ExhaustionAgreesAndResolvesWhatRoundingStops) {
    int stalled = 0;
    int apart = 0;
    for (const PairFamily family : kPairFamilies) {
        for (std::uint64_t seed = 0; seed < 5'000; ++seed) {
            const PairCase c = makePair(family, seed);
            const PairView pair(c.a, c.b, c.bInA);
            const GjkResult gjk = runGjk(pair, nullptr);
            stalled += gjk.outcome == GjkOutcome::stalled ? 1 : 0;
            ASSERT_NE(closestFeatures(pair, nullptr).outcome, GjkOutcome::stalled);
            if (gjk.outcome != GjkOutcome::apart) { continue; }
            ++apart;
            const GjkResult all = closestByExhaustion(pair);
            ASSERT_LE(std::fabs(gjk.distance - all.distance), 4 * gjk.resolution) << "seed " << seed << "\n" << c;
        }
    }
    EXPECT_GT(apart, 10'000);
    EXPECT_GT(stalled, 0) << "the way out is not tested";
}

TEST(Distance, CoincidentPointsHaveANormal) {
    const Polygon ball = makeCircle({}, 1).value();
    const Distance d = distance(ball, ball, Transform{});
    EXPECT_EQ(d.distance, -2);
    EXPECT_EQ(d.coreDistance, 0);
    EXPECT_EQ(lengthSquared(d.normal), 1);
}

TEST(Penetration, IsTheLeastOfTheFacesAndALowerBoundApart) {
    int overlapping = 0;
    for (const PairFamily family : kPairFamilies) {
        for (std::uint64_t seed = 0; seed < 4'000; ++seed) {
            const PairCase c = makePair(family, seed);
            const std::vector<Point> a = exactPoints(c.a);
            const std::vector<Point> b = placed(c.b, c.bInA);
            const long double core = coreSeparation(a, b);
            const Penetration p = penetration(c.a, c.b, c.bInA);
            const long double unit = kEps * scaleOf(c, core);
            ASSERT_NEAR(static_cast<double>(length(exact(p.normal))), 1, 4 * static_cast<double>(kEps)) << c;
            if (core >= 0) {
                ASSERT_LE(exact(p.separation), core + kErrorBound * unit) << "seed " << seed << "\n" << c;
                continue;
            }
            ++overlapping;
            ASSERT_LE(std::fabs(exact(p.separation) - core) / unit, kErrorBound) << "seed " << seed << "\n" << c;
        }
    }
    EXPECT_GT(overlapping, 5'000);
}

TEST(Distance, GarbageNeverGivesNaN) {
    const double most = std::is_same_v<Real, double> ? 300 : 30;
    for (std::uint64_t seed = 0; seed < 30'000; ++seed) {
        Random random(seed);
        const auto recipe = [&random, most] {
            ShapeRecipe r;
            r.size = std::pow(10.0, random.range(-most, most));
            r.flatness = tiny(random, 0, 8);
            r.count = random.integer(1, 4);
            return r;
        };
        PairCase c{cook(random, recipe()), cook(random, recipe()),
                   randomPose(random, std::pow(10.0, random.range(-most, most)))};
        c.a.radius = random.chance(0.5) ? 0 : real(std::pow(10.0, random.range(-most, most)));
        const Distance d = distance(c.a, c.b, c.bInA);
        ASSERT_TRUE(isFinite(d.distance) && isFinite(d.coreDistance)) << "seed " << seed << "\n" << c;
        ASSERT_TRUE(isFinite(d.pointA) && isFinite(d.pointB)) << "seed " << seed << "\n" << c;
        ASSERT_NEAR(static_cast<double>(length(exact(d.normal))), 1, 4 * static_cast<double>(kEps))
            << "seed " << seed << "\n"
            << c;
        const Penetration p = penetration(c.a, c.b, c.bInA);
        ASSERT_TRUE(isFinite(p.separation) && isFinite(p.pointA) && isFinite(p.pointB)) << "seed " << seed << "\n" << c;
        ASSERT_NEAR(static_cast<double>(length(exact(p.normal))), 1, 4 * static_cast<double>(kEps))
            << "seed " << seed << "\n"
            << c;
    }
}

}  // namespace
}  // namespace swept::test
