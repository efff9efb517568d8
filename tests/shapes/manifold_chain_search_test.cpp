#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <vector>

#include <swept/shapes/manifold_parts.h>

#include "chance.h"

/// What chain segments are asked without a search is what the search finds, bit for bit.

namespace swept {
namespace {

constexpr double kQuarter = 1.5707963267948966;

Real real(double x) { return static_cast<Real>(x); }
Vec2 real(DVec2 v) { return {real(v.x), real(v.y)}; }
double decade(Chance& chance, double least, double most) { return std::pow(10, chance.range(least, most)); }

/// Convex, concave, flat, or nearly so.
double someCorner(Chance& chance) {
    switch (chance.below(6)) {
        case 0:
            return 0;
        case 1:
            return chance.range(-2e-3, 2e-3);
        case 2:
            return chance.below(2) == 0 ? kQuarter : -kQuarter;
        default:
            return chance.range(-1.5, 1.5);
    }
}

Polygon someShape(Chance& chance, double size) {
    const Real radius = chance.below(2) == 0 ? Real(0) : real(size * chance.range(0, 0.5));
    const Real half = real(size * chance.range(0.2, 1));
    switch (chance.below(4)) {
        case 0:
            return makeCircle({real(size * chance.range(-0.2, 0.2)), 0}, real(size)).value();
        case 1:
            return makeSegment({-half, 0}, {half, 0}, radius).value();
        case 2:
            return makeBox({half, real(size * chance.range(0.2, 1))}, {}, 0, radius).value();
        default: {
            std::vector<Vec2> corners;
            const int count = 3 + chance.below(6);
            for (int i = 0; i < count; ++i) {
                const double angle = 4 * kQuarter * (i + chance.range(0, 0.4)) / count;
                corners.push_back(real(size * DVec2{std::cos(angle), std::sin(angle)}));
            }
            return makePolygon(corners, radius).value();
        }
    }
}

struct Query {
    ChainSegment segment;
    Polygon shape;
    Transform pose;
    Real margin = 0;
};

/// Over the segment or beside it; above, touching, nearly so, on both sides, or behind it.
Query someQuery(Chance& chance) {
    Query query;
    const double length = decade(chance, -1, 1);
    const double size = decade(chance, -1, 1);
    const double angle = chance.below(3) == 0 ? kQuarter * chance.below(4) : chance.range(0, 6.3);
    const auto along = [](double turned) { return DVec2{std::cos(turned), std::sin(turned)}; };
    const DVec2 start = chance.below(2) == 0 ? DVec2{} : DVec2{chance.range(-5, 5), chance.range(-5, 5)};
    const DVec2 end = start + length * along(angle);
    ChainSegment& s = query.segment;
    s.p = real(start);
    s.q = real(end);
    s.before = real(start - decade(chance, -1, 1) * along(angle - someCorner(chance)));
    s.after = real(end + decade(chance, -1, 1) * along(angle + someCorner(chance)));
    s.hasBefore = chance.below(5) > 0;
    s.hasAfter = chance.below(5) > 0;
    s.radius = chance.below(3) > 0 ? Real(0) : real(length * chance.range(0, 0.2));

    query.shape = someShape(chance, size);
    const double turn = chance.below(3) == 0 ? chance.range(0, 6.3) : angle + kQuarter * chance.below(4);
    const double tilt = chance.below(2) == 0 ? 0 : chance.range(-1, 1) * decade(chance, -9, -2);
    query.pose.rotation = rotationFromAngle(turn + tilt);
    const DVec2 up{std::sin(angle), -std::cos(angle)};
    double lowest = size;
    for (const Vec2 v : query.shape.points()) {
        lowest = std::min(lowest, dot(up, toDouble(rotate(query.pose.rotation, v))));
    }
    const double radii = static_cast<double>(s.radius) + static_cast<double>(query.shape.radius);
    const double off = chance.range(-1, 1) * size * decade(chance, -17, -1);
    const std::array<double, 4> heights{chance.range(-1, 3) * size, radii - lowest, radii - lowest + off, off - lowest};
    const DVec2 over = start + chance.range(-1.5, 2.5) * length * along(angle);
    query.pose.translation = real(over + heights[static_cast<std::size_t>(chance.below(4))] * up);
    query.margin = chance.below(4) == 0 ? Real(0) : real(size * chance.range(0, 0.3));
    return query;
}

bool sameBits(Real a, Real b) { return std::memcmp(&a, &b, sizeof(Real)) == 0; }
bool sameBits(Vec2 a, Vec2 b) { return sameBits(a.x, b.x) && sameBits(a.y, b.y); }

void expectSameBits(const Manifold& m, const Manifold& searched) {
    ASSERT_EQ(m.count, searched.count);
    if (m.count == 0) { return; }
    ASSERT_TRUE(sameBits(m.normal, searched.normal));
    ASSERT_EQ(m.isNormalOfB, searched.isNormalOfB);
    for (std::size_t i = 0; i < static_cast<std::size_t>(m.count); ++i) {
        ASSERT_EQ(m.points[i].id, searched.points[i].id);
        ASSERT_TRUE(sameBits(m.points[i].point, searched.points[i].point));
        ASSERT_TRUE(sameBits(m.points[i].separation, searched.points[i].separation));
    }
}

TEST(ChainWithoutSearch, GivesTheBitsOfTheSearch) {
    constexpr std::uint32_t kQueries = 60'000;
    constexpr std::uint32_t kOfOneSeed = 100;  // a seed takes longer than a query
    std::uint32_t withOne = 0;
    std::uint32_t withTwo = 0;
    std::uint32_t crossing = 0;
    Chance chance(0);
    for (std::uint32_t i = 0; i < kQueries; ++i) {
        if (i % kOfOneSeed == 0) { chance = Chance(i / kOfOneSeed); }
        const Query q = someQuery(chance);
        const Manifold m = collide(q.segment, q.shape, q.pose, q.margin);
        expectSameBits(m, collideChainBySearch(q.segment, q.shape, q.pose, q.margin));
        ASSERT_FALSE(testing::Test::HasFatalFailure()) << "query " << i;
        withOne += m.count == 1 ? 1U : 0U;
        withTwo += m.count == 2 ? 1U : 0U;
        crossing += m.count > 0 && deepestSeparation(m) < -q.segment.radius - q.shape.radius ? 1U : 0U;
    }
    EXPECT_GT(withOne, kQueries / 10);
    EXPECT_GT(withTwo, kQueries / 20);
    EXPECT_GT(crossing, kQueries / 20);
}

/// At a flat seam what is beyond the end by rounding counts as over the segment; not what is then out of reach.
TEST(ChainWithoutSearch, ReachesNoFartherThanTheSearchBeyondASeam) {
    const ChainSegment segment{.before = {-8, 0}, .p = {0, 0}, .q = {8, 0}, .after = {16, 0}, .hasBefore = true};
    // Leans over the seam at 45°: farther away than its lower end is high.
    const Polygon stick = makeSegment({0, 0}, {1, -1}, 8 * kEpsilon).value();
    for (const Real beyond : {Real(2), Real(10)}) {
        const Transform pose{{-beyond * kEpsilon, -4 * kEpsilon}, {}};
        const Manifold m = collide(segment, stick, pose, 0);
        EXPECT_EQ(m.count, beyond + 4 < 8 * std::sqrt(2.0) ? 1 : 0) << beyond << " roundings beyond the end";
        expectSameBits(m, collideChainBySearch(segment, stick, pose, 0));
    }
}

}  // namespace
}  // namespace swept
