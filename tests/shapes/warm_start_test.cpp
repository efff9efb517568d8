#include <gtest/gtest.h>

#include <string>

#include <swept/shapes/distance.h>

#include "pair_families.h"

/// A cache is a hint and no more: whatever features it names, the answer is that of brute force.

namespace swept::test {
namespace {

SimplexCache cacheOf(int a, int b, int nextA, int nextB) {
    SimplexCache cache;
    cache.count = nextA == a && nextB == b ? 1 : 2;
    cache.indexA = {static_cast<std::uint8_t>(a), static_cast<std::uint8_t>(nextA), 0};
    cache.indexB = {static_cast<std::uint8_t>(b), static_cast<std::uint8_t>(nextB), 0};
    return cache;
}

/// Starts at every pair of vertices, of an edge and a vertex (both ways round), and of two edges.
/// @return the longest search, in iterations.
int expectNoFeaturesMislead(const PairCase& c, const std::string& name) {
    const long double core = coreSeparation(exactPoints(c.a), placed(c.b, c.bInA));
    const long double unit = kEps * scaleOf(c, core);
    int most = 0;
    for (int a = 0; a < c.a.count; ++a) {
        for (int b = 0; b < c.b.count; ++b) {
            for (const int endA : {a, c.a.next(a), c.a.previous(a)}) {
                for (const int endB : {b, c.b.next(b), c.b.previous(b)}) {
                    SimplexCache cache = cacheOf(a, b, endA, endB);
                    const Distance d = distance(c.a, c.b, c.bInA, &cache);
                    EXPECT_LE(std::fabs(exact(d.coreDistance) - core) / unit, kErrorBound)
                        << name << " from " << a << '-' << endA << ", " << b << '-' << endB << "\n"
                        << c;
                    most = std::max(most, d.iterations);
                }
            }
        }
    }
    return most;
}

TEST(WarmStart, NoFeaturesMislead) {
    int most = 0;
    for (const PairFamily family : kPairFamilies) {
        for (std::uint64_t seed = 0; seed < 100; ++seed) {
            const std::string name =
                std::string(kPairFamilyNames[static_cast<std::size_t>(family)]) + " seed " + std::to_string(seed);
            most = std::max(most, expectNoFeaturesMislead(makePair(family, seed), name));
            ASSERT_FALSE(HasFailure());
        }
    }
    EXPECT_LE(most, 24) << "searches have become long";
}

/// A corner so flat that rounding sees both neighbours level with it: held against the far side, it must not pass for
/// the vertex that is nearest.
TEST(WarmStart, FlatCornersAreNotTakenForSupports) {
    int flat = 0;
    for (std::uint64_t seed = 0; seed < 4'000; ++seed) {
        Random random(seed);
        const double bump = std::ldexp(static_cast<double>(kEpsilon), random.integer(-4, 6));
        const double middle = random.range(-0.9, 0.9);
        const double tilt = random.range(0, 6.283);
        PairCase c;
        c.a = makeBox({1, 1}).value();
        c.b.count = 5;
        // Not by makePolygon, which refuses the flattest: a polygon rotated by the caller, as in toi/, may be as flat.
        const std::array<DVec2, 5> corners{DVec2{0.1, -1}, {1, 0}, {middle, bump}, {-1, 0}, {-0.1, -1}};
        for (std::size_t i = 0; i < 5; ++i) {
            c.b.vertices[i] = toReal(DVec2{std::cos(tilt) * corners[i].x - std::sin(tilt) * corners[i].y,
                                           std::sin(tilt) * corners[i].x + std::cos(tilt) * corners[i].y});
        }
        for (std::size_t i = 0; i < 5; ++i) { c.b.normals[i] = edgeNormal(c.b.vertices[i], c.b.vertices[(i + 1) % 5]); }
        const bool isValid = validate(c.b).ok();
        if (!isValid && std::is_same_v<Real, float>) { continue; }  // computed in double, a dent is a dent
        flat += isValid ? 0 : 1;
        // The flat side faces away from A's upper side.
        c.bInA = {randomVec(random, -0.5, 0.5), rotationFromAngle(-tilt + random.range(-1, 1) * bump)};
        c.bInA.translation.y = real(3);
        expectNoFeaturesMislead(c, "seed " + std::to_string(seed));
        ASSERT_FALSE(HasFailure());
    }
    if (std::is_same_v<Real, double>) { EXPECT_GT(flat, 1'000); }
}

}  // namespace
}  // namespace swept::test
