#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <vector>

#include <swept/shapes/hull.h>
#include <swept/shapes/manifold.h>

#include "chance.h"

/// A query that remembers gives the manifold of one that does not, bit for bit, wherever the shapes go.

namespace swept {
namespace {

Polygon roundCloud(Chance& chance, int points, double size, double radius) {
    std::vector<Vec2> cloud;
    for (int i = 0; i < points; ++i) {
        const double angle = 2 * 3.14159265358979 * (i + chance.range(0, 0.7)) / points;
        cloud.push_back({static_cast<Real>(size * std::cos(angle)), static_cast<Real>(size * std::sin(angle))});
    }
    return convexHull(cloud, static_cast<Real>(radius)).value();
}

Polygon someKindOfShape(Chance& chance, double size) {
    const auto real = [size](double x) { return static_cast<Real>(size * x); };
    switch (chance.below(8)) {
        case 0:
        case 1:
            return makeBox({real(0.5), real(0.5)}).value();
        case 2:
            return makeBox({real(2), real(chance.range(0.001, 0.2))}, {real(0.3), 0}, chance.range(0, 3)).value();
        case 3:
            return roundCloud(chance, 3 + chance.below(6), size, 0);
        case 4:
            return roundCloud(chance, 3 + chance.below(6), size, 0.1 * size);
        case 5:
            return makeCircle({real(0.1), 0}, real(0.5)).value();
        case 6:
            return makeCapsule({real(-0.5), 0}, {real(0.5), real(0.1)}, real(0.2)).value();
        default:
            return makeSegment({real(-2), real(0.05)}, {real(2), 0}).value();
    }
}

bool isSame(const Manifold& p, const Manifold& q) {
    if (p.count != q.count) { return false; }
    for (std::size_t i = 0; i < static_cast<std::size_t>(p.count); ++i) {
        const ManifoldPoint& a = p.points[i];
        const ManifoldPoint& b = q.points[i];
        if (!(a.point == b.point) || std::memcmp(&a.separation, &b.separation, sizeof(Real)) != 0 || a.id != b.id) {
            return false;
        }
    }
    return p.count == 0 || p.normal == q.normal;
}

/// A place of B beside A: touching, or nearly, in some direction; flush every third time.
Transform besides(Chance& chance, const Polygon& a, const Polygon& b, double size) {
    Transform pose;
    pose.rotation = rotationFromAngle(chance.below(3) == 0 ? 1.5707963267948966 * chance.below(4) : chance.range(0, 7));
    const double angle = chance.below(3) == 0 ? 1.5707963267948966 * chance.below(4) : chance.range(0, 7);
    const DVec2 away{std::cos(angle), std::sin(angle)};
    double near = 0;
    double far = 8 * size;
    for (int i = 0; i < 40; ++i) {  // the distance at which they begin to touch
        const double middle = 0.5 * (near + far);
        pose.translation = toReal(middle * away);
        (collide(a, b, pose, 0).count > 0 ? near : far) = middle;
    }
    pose.translation = toReal((near + size * chance.range(-0.02, 0.02)) * away);
    return pose;
}

struct MemoryTally {
    int queries = 0;
    int kept = 0;  ///< answered without a new search
    int touching = 0;
};

/// With a nearer limit for the deepest point than for the others: the same points, or none.
void expectWithin(const Polygon& a, const Polygon& b, const Transform& pose, ManifoldReach reach, const Manifold& all,
                  ManifoldMemory& memory) {
    const Manifold some = collide(a, b, pose, reach, memory);
    const bool isNear = all.count > 0 && deepestSeparation(all) <= reach.nearest;
    ASSERT_TRUE(isSame(some, isNear ? all : Manifold{})) << some.count << " points of " << all.count;
}
void expectWithin(const ChainSegment&, const Polygon&, const Transform&, ManifoldReach, const Manifold&,
                  ManifoldMemory&) {}

template <class Shape>
void walk(Chance& chance, const Shape& a, const Polygon& b, Transform pose, double size, MemoryTally& tally) {
    constexpr int kSteps = 60;
    const double stride = size * std::pow(10, chance.range(-6, -1.5));
    ManifoldMemory memory;
    ManifoldMemory memoryWithin;
    double angle = std::atan2(static_cast<double>(pose.rotation.s), static_cast<double>(pose.rotation.c));
    for (int step = 0; step < kSteps; ++step) {
        const Real margin = static_cast<Real>(size * (chance.below(2) == 0 ? 0 : chance.range(0, 0.05)));
        const bool knew = memory.verdict != ManifoldMemory::Verdict::none;
        const Transform before = memory.bInA;
        const Manifold kept = collide(a, b, pose, margin, memory);
        const Manifold fresh = collide(a, b, pose, margin);
        ASSERT_TRUE(isSame(kept, fresh)) << "step " << step << ", stride " << stride << ": " << kept.count
                                         << " points, not " << fresh.count;
        const Real nearest = static_cast<Real>(0.5 * chance.range(0, 1)) * margin;
        expectWithin(a, b, pose, {margin, nearest}, fresh, memoryWithin);
        if (testing::Test::HasFatalFailure()) { return; }
        ++tally.queries;
        tally.kept += knew && before == memory.bInA ? 1 : 0;
        tally.touching += fresh.count > 0 ? 1 : 0;
        pose.translation +=
            Vec2{static_cast<Real>(stride * chance.range(-1, 1)), static_cast<Real>(stride * chance.range(-1, 1))};
        angle += stride / size * chance.range(-1, 1);
        pose.rotation = rotationFromAngle(angle);
        if (chance.below(40) == 0) {
            pose.translation.x += static_cast<Real>(size * chance.range(-1, 1));
        }  // teleported
    }
}

TEST(ManifoldMemory, ChangesNoBitOfAnyPair) {
    MemoryTally tally;
    for (std::uint32_t seed = 0; seed < 3000; ++seed) {
        SCOPED_TRACE(seed);
        Chance chance(seed);
        const double size = std::ldexp(1.0, chance.below(9) - 4);
        const Polygon a = someKindOfShape(chance, size);
        const Polygon b = someKindOfShape(chance, size);
        walk(chance, a, b, besides(chance, a, b, size), size, tally);
        if (testing::Test::HasFatalFailure()) { return; }
    }
    EXPECT_GT(tally.kept, tally.queries / 4) << "too little was kept to prove anything";
    EXPECT_GT(tally.touching, tally.queries / 4);
    EXPECT_LT(tally.touching, tally.queries * 3 / 4);
}

TEST(ManifoldMemory, ChangesNoBitOnChains) {
    MemoryTally tally;
    ChainSegment edge;
    edge.before = {3, Real(0.5)};
    edge.p = {1, 0};
    edge.q = {-1, 0};
    edge.after = {-2, Real(-0.5)};
    edge.hasBefore = edge.hasAfter = true;
    for (std::uint32_t seed = 0; seed < 400; ++seed) {
        SCOPED_TRACE(seed);
        Chance chance(seed);
        const Polygon b = someKindOfShape(chance, 0.5);
        walk(chance, edge, b, besides(chance, polygonOf(edge), b, 1), 1, tally);
        if (testing::Test::HasFatalFailure()) { return; }
    }
    EXPECT_GT(tally.kept, tally.queries / 10);
    EXPECT_GT(tally.touching, tally.queries / 10);
}

/// As near as the limit to rounding: clipping, in double, finds them within it, and the search for faces apart.
TEST(ManifoldMemory, ChangesNothingWhereRoundingDecides) {
    int apart = 0;
    int touching = 0;
    for (std::uint32_t seed = 0; seed < 4000; ++seed) {
        SCOPED_TRACE(seed);
        Chance chance(seed);
        const Polygon a = roundCloud(chance, 3 + chance.below(4), 1, 0);
        const Polygon b = roundCloud(chance, 3 + chance.below(4), 1, 0);
        Transform pose = besides(chance, a, b, 1);
        const Vec2 away = normalized(pose.translation).unit;
        Real near = 0;
        Real far = 8;
        const Real limit = chance.below(2) == 0 ? Real(0) : static_cast<Real>(chance.range(0, 0.05));
        for (int i = 0; i < 60; ++i) {
            const Real middle = Real(0.5) * (near + far);
            pose.translation = middle * away;
            (collide(a, b, pose, limit).count > 0 ? near : far) = middle;
        }
        ManifoldMemory memory;
        pose.translation = (near - Real(0.01)) * away;
        collide(a, b, pose, limit, memory);
        for (int ulps = -8; ulps <= 8; ++ulps) {
            pose.translation = (near + static_cast<Real>(ulps) * kEpsilon) * away;
            ManifoldMemory copy = memory;
            const Manifold fresh = collide(a, b, pose, limit);
            ASSERT_TRUE(isSame(collide(a, b, pose, limit, copy), fresh)) << ulps << " units, limit " << limit;
            (fresh.count > 0 ? touching : apart) += 1;
        }
    }
    EXPECT_GT(apart, 20000);
    EXPECT_GT(touching, 20000);
}

TEST(ManifoldMemory, BoxesAtRestAreNotSearchedAgain) {
    const Polygon box = makeBox({Real(0.5), Real(0.5)}).value();
    ManifoldMemory memory;
    Transform pose{{Real(0.25), Real(0.998)}, {}};
    const Manifold first = collide(box, box, pose, Real(0.01), memory);
    ASSERT_EQ(first.count, 2);
    const Transform searched = memory.bInA;
    for (int step = 1; step < 100; ++step) {
        pose.translation.x = Real(0.25) + static_cast<Real>(step % 7) * Real(1e-5);
        EXPECT_EQ(collide(box, box, pose, Real(0.01), memory).count, 2);
        EXPECT_EQ(memory.bInA, searched) << "step " << step;
    }
}

}  // namespace
}  // namespace swept
