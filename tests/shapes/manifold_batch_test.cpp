#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include <swept/shapes/hull.h>
#include <swept/shapes/manifold_batch.h>
#include <swept/shapes/manifold_parts.h>
#ifdef SWEPT_SIMD
#include <swept/shapes/wide_targets.h>
// after it
#include <hwy/targets.h>
#endif

#include "chance.h"
#include "same_bits.h"

/// Manifolds of a batch are those of `collide`, pair by pair and bit for bit.

namespace swept {
namespace {

Real real(double x) { return static_cast<Real>(x); }

Polygon cloud(Chance& chance, int points, double size) {
    std::vector<Vec2> corners;
    for (int i = 0; i < points; ++i) {
        const double angle = 2 * 3.14159265358979 * (i + chance.range(0, 0.6)) / points;
        corners.push_back({real(size * std::cos(angle)), real(size * std::sin(angle))});
    }
    return convexHull(corners).value();
}

/// At most `most` vertices.
Polygon someShape(Chance& chance, double size, int most) {
    switch (chance.below(4)) {
        case 0:
            return makeBox({real(0.5 * size), real(0.5 * size)}).value();
        case 1:
            return makeBox({real(2 * size), real(size * chance.range(0.01, 0.2))}, {real(0.3 * size), 0},
                           chance.range(0, 3))
                .value();
        case 2:
            return cloud(chance, 3, size);
        default:
            return cloud(chance, 3 + chance.below(most - 2), size);
    }
}

/// At most `most` vertices, with a radius or less than three of them.
Polygon someRoundShape(Chance& chance, double size, int most) {
    const Real radius = real(size * std::pow(10, -chance.range(0, 3)));
    const Vec2 at = chance.below(2) == 0 ? Vec2{} : Vec2{real(0.3 * size), real(-0.1 * size)};
    const int kind = chance.below(most > 2 ? 5 : 3);
    if (kind == 0 || most == 1) { return makeCircle(at, radius).value(); }
    if (kind < 3) {
        const Vec2 half{real(size * chance.range(0.1, 1)), chance.below(2) == 0 ? Real(0) : real(0.5 * size)};
        return makeSegment(at - half, at + half, chance.below(4) == 0 ? Real(0) : radius).value();
    }
    Polygon polygon = someShape(chance, size, most);
    polygon.radius = radius;
    return polygon;
}

struct Query {
    Polygon a;
    Polygon b;
    Transform bInA;
    ManifoldReach reach;
};

/// Vertices of any A, and of any B.
struct Most {
    int ofA;
    int ofB;
};

/// Touching, nearly so, deep in each other or apart; flush every third time.
Query someQuery(Chance& chance, PairKind kind, Most sides) {
    const double size = std::ldexp(1.0, chance.below(9) - 4);
    const auto shape = [&chance, kind, size](bool mayBeSharp, int most) {
        const bool isRound = kind == PairKind::round && (!mayBeSharp || most < 3 || chance.below(3) > 0);
        return isRound ? someRoundShape(chance, size, most) : someShape(chance, size, most);
    };
    Query query;
    query.a = shape(true, sides.ofA);
    query.b = shape(!isSharp(query.a) || kind == PairKind::sharp, sides.ofB);
    const bool isFlush = chance.below(3) == 0;
    const double turn = isFlush ? 1.5707963267948966 * chance.below(4) : chance.range(0, 7);
    const double angle = chance.below(3) == 0 ? 1.5707963267948966 * chance.below(4) : chance.range(0, 7);
    query.bInA.rotation = rotationFromAngle(turn);
    double near = 0;
    double far = 8 * size;
    for (int i = 0; i < 30; ++i) {  // the distance at which they begin to touch
        const double middle = 0.5 * (near + far);
        query.bInA.translation = {real(middle * std::cos(angle)), real(middle * std::sin(angle))};
        (collide(query.a, query.b, query.bInA, 0).count > 0 ? near : far) = middle;
    }
    const double away = isFlush && chance.below(2) == 0
                            ? near
                            : std::max(0.0, near + size * chance.range(-1, 1) * std::pow(10, -chance.below(5)));
    query.bInA.translation = {real(away * std::cos(angle)), real(away * std::sin(angle))};
    query.reach.points = chance.below(4) == 0 ? Real(0) : real(size * chance.range(0, 0.2));
    query.reach.nearest =
        chance.below(2) == 0 ? std::numeric_limits<Real>::infinity() : real(chance.range(0, 1)) * query.reach.points;
    return query;
}

bool sameManifolds(const Manifold& p, const Manifold& q) {
    if (p.count != q.count || (p.count > 0 && (!sameBits(p.normal, q.normal) || p.isNormalOfB != q.isNormalOfB))) {
        return false;
    }
    for (std::size_t i = 0; i < static_cast<std::size_t>(p.count); ++i) {
        const ManifoldPoint& a = p.points[i];
        const ManifoldPoint& b = q.points[i];
        if (!sameBits(a.point, b.point) || !sameBits(a.separation, b.separation) || a.id != b.id) { return false; }
    }
    return true;
}

struct Tally {
    int pairs = 0;
    int withTwo = 0;
    int ofB = 0;
    int apart = 0;
    int left = 0;  ///< to a search, though they touch or nearly do
};

void compare(const std::vector<Query>& queries, PairKind kind, Tally& tally) {
    ManifoldBatch batch(kind);
    ManifoldBatch other(kind);
    for (std::size_t i = 0; i < queries.size(); ++i) {  // the second half comes from another batch
        ManifoldBatch& half = i < (queries.size() + 1) / 2 ? batch : other;
        half.add(queries[i].a, queries[i].b, queries[i].bInA, queries[i].reach);
    }
    batch.takeOver(other);
    ASSERT_EQ(other.size(), 0U);
    ASSERT_EQ(batch.size(), queries.size());
    batch.collide();
    for (std::size_t i = 0; i < queries.size(); ++i) {
        const Query& query = queries[i];
        ManifoldMemory memoryOfOne;
        ManifoldMemory memory;
        const Manifold one = collide(query.a, query.b, query.bInA, query.reach, memoryOfOne);
        Manifold lane;
        batch.takeManifold(i, memory, lane);
        ASSERT_TRUE(sameManifolds(lane, one))
            << "pair " << i << ": " << lane.count << " points, not " << one.count << ", normals " << lane.normal.x
            << ", " << lane.normal.y << " and " << one.normal.x << ", " << one.normal.y;
        const bool isApart = memory.verdict == ManifoldMemory::Verdict::apart;
        ASSERT_EQ(isApart, memoryOfOne.verdict == ManifoldMemory::Verdict::apart);
        if (isApart) {  // a bound of the distance
            ASSERT_EQ(collide(query.a, query.b, query.bInA, std::max(memory.room, Real(0))).count, 0);
        }
        ++tally.pairs;
        tally.withTwo += one.count == 2 ? 1 : 0;
        tally.ofB += one.count > 0 && one.isNormalOfB ? 1 : 0;
        tally.apart += isApart ? 1 : 0;
        tally.left += batch.isLeft(i) ? 1 : 0;
    }
}

Tally compareAll(PairKind kind, Most most, std::uint32_t batches) {
    Tally tally;
    for (std::uint32_t seed = 0; seed < batches && !testing::Test::HasFatalFailure(); ++seed) {
        Chance chance(seed);
        std::vector<Query> queries;
        const int size = 1 + chance.below(static_cast<int>(ManifoldBatch::kPairs));
        while (static_cast<int>(queries.size()) < size) {
            Query query = someQuery(chance, kind, most);
            if (!collidesInBatches(query.a) || !collidesInBatches(query.b)) { continue; }
            queries.push_back(query);
        }
        SCOPED_TRACE(seed);
        compare(queries, kind, tally);
    }
    return tally;
}

#ifdef SWEPT_SIMD

/// Makes Highway choose one instruction set.
class ManifoldBatches : public testing::TestWithParam<std::int64_t> {
protected:
    void SetUp() override { hwy::SetSupportedTargetsForTest(GetParam()); }
    void TearDown() override { hwy::SetSupportedTargetsForTest(0); }
};

TEST_P(ManifoldBatches, GiveTheBitsOfPairsOneByOne) {
    if (!canCollideInBatches()) {
        EXPECT_TRUE(GetParam() == HWY_SCALAR || GetParam() == HWY_WASM)
            << "only what has no doubles side by side collides pairs one by one";
        return;
    }
    for (const int most : {kFewVertices, kMaxPolygonVertices}) {
        const Tally tally = compareAll(PairKind::sharp, {most, most}, 1000);
        if (HasFatalFailure()) { return; }
        EXPECT_GT(tally.withTwo, tally.pairs / 8) << "of at most " << most << " vertices";
        EXPECT_GT(tally.ofB, tally.pairs / 20);
        EXPECT_GT(tally.apart, tally.pairs / 20);
    }
}

TEST_P(ManifoldBatches, GiveTheBitsOfTheSearchToRoundPairs) {
    if (!canCollideInBatches()) { return; }
    constexpr int kFew = kFewVertices;
    constexpr int kMany = kMaxPolygonVertices;
    for (const Most most : {Most{1, 1}, Most{1, kFew}, Most{kFew, 1}, Most{2, 2}, Most{2, kFew}, Most{kFew, 2},
                            Most{kFew, kFew}, Most{kMany, kMany}}) {
        SCOPED_TRACE(testing::Message() << "at most " << most.ofA << " and " << most.ofB << " vertices");
        const Tally tally = compareAll(PairKind::round, most, 1000);
        if (HasFatalFailure()) { return; }
        if (most.ofA > 1 && most.ofB > 1) { EXPECT_GT(tally.withTwo, tally.pairs / 40); }
        if (most.ofB > 1) { EXPECT_GT(tally.ofB, tally.pairs / 20); }
        EXPECT_GT(tally.apart, tally.pairs / 20);
        EXPECT_LT(tally.left, tally.pairs / 5) << "cores overlap, and little else";
    }
}

/// Cores that all but touch at vertices: what is closest there is hardly more than rounding.
Query vertexQuery(Chance& chance) {
    const auto core = [&chance] {
        const double angle = chance.range(0, 7);
        const Vec2 half{real(std::cos(angle)), real(std::sin(angle))};
        return chance.below(2) == 0 ? makeSegment(-half, half).value() : makeBox({1, real(0.25)}, {}, angle).value();
    };
    Query query;
    query.a = makeSegment({-1, 0}, {1, 0}).value();
    query.b = core();
    if (isSharp(query.b) && chance.below(2) == 0) { std::swap(query.a, query.b); }
    query.bInA.rotation = rotationFromAngle(chance.range(0, 7));
    const auto some = [&chance](int count) { return static_cast<std::size_t>(chance.below(count)); };
    const std::size_t i = some(query.a.count);
    // Along a face's normal, a little turned towards the vertex.
    const DVec2 normal = toDouble(query.a.normals[i]);
    const double turn = std::pow(10, -chance.range(2, 8)) * (chance.below(2) == 0 ? 1 : -1);
    const DVec2 direction = normal + turn * DVec2{-normal.y, normal.x};
    const DVec2 corner = PairView(query.a, query.b, query.bInA).toA(toDouble(query.b.vertices[some(query.b.count)]));
    const double gap = std::pow(10, -chance.range(6, 14));
    query.bInA.translation = toReal(toDouble(query.a.vertices[i]) + gap * direction - corner);
    query.reach = {real(0.1), std::numeric_limits<Real>::infinity()};
    return query;
}

/// Batches of what is made at random.
Tally compareRound(Query (*make)(Chance&)) {
    Tally tally;
    for (std::uint32_t seed = 0; seed < 2000 && !testing::Test::HasFatalFailure(); ++seed) {
        Chance chance(seed);
        std::vector<Query> queries;
        while (queries.size() < ManifoldBatch::kPairs) {
            const Query query = make(chance);
            if (collidesInBatches(query.a) && collidesInBatches(query.b)) { queries.push_back(query); }
        }
        SCOPED_TRACE(seed);
        compare(queries, PairKind::round, tally);
    }
    return tally;
}

TEST_P(ManifoldBatches, LeaveVerticesThatAllButTouchToTheSearch) {
    if (!canCollideInBatches()) { return; }
    const Tally tally = compareRound(vertexQuery);
    EXPECT_LT(tally.left, tally.pairs) << "not all of them are that near";
}

/// Rounded slats whose ends face each other, at about the angle up to which they count as parallel: the ends are so
/// short that to place their corners turns them as much as that angle is doubtful. In double, where they are 10⁻⁹ to
/// 10⁻⁶ long, a batch had other points than the search in one pair of a thousand.
Query slatQuery(Chance& chance) {
    const auto slat = [&chance] {
        const Vec2 corner{real(chance.range(-1, 1)), real(chance.range(-1, 1))};
        const double angle = chance.range(0, 7);
        const DVec2 along{std::cos(angle), std::sin(angle)};
        const double width = kFaceAngle * std::pow(2, chance.range(-4, 5));
        const Vec2 side = toReal(std::pow(10, -chance.range(0, 2)) * along);
        const Vec2 end = toReal(width * DVec2{-along.y, along.x});
        const std::vector<Vec2> corners{corner, corner + side, corner + side + end, corner + end};
        return makePolygon(corners, real(std::pow(10, -chance.range(0, 3))));
    };
    auto a = slat();
    auto b = slat();
    while (!a.ok()) { a = slat(); }
    while (!b.ok()) { b = slat(); }
    Query query;
    query.a = a.value();
    query.b = b.value();
    const auto angleOf = [](Vec2 v) { return std::atan2(static_cast<double>(v.y), static_cast<double>(v.x)); };
    const double skew = kFaceAngle * (1 + 0.01 * chance.range(-1, 1)) * (chance.below(2) == 0 ? 1 : -1);
    query.bInA.rotation = rotationFromAngle(angleOf(-query.a.normals[1]) - angleOf(query.b.normals[1]) + skew);
    const auto some = [&chance] { return static_cast<std::size_t>(1 + chance.below(2)); };
    const Vec2 corner = rotate(query.bInA.rotation, query.b.vertices[some()]);
    const double gap = chance.range(0, 1) * static_cast<double>(query.a.radius + query.b.radius);
    query.bInA.translation = query.a.vertices[some()] + toReal(gap * toDouble(query.a.normals[1])) - corner;
    query.reach = {real(1), std::numeric_limits<Real>::infinity()};
    return query;
}

TEST_P(ManifoldBatches, LeaveShortEdgesThatMayBeParallelToTheSearch) {
    if (!canCollideInBatches()) { return; }
    const Tally tally = compareRound(slatQuery);
    EXPECT_GT(tally.withTwo, tally.pairs / 20);
}

/// Numbers that a search found, where the radius is a hundred times as large as all that lies between the cores.
TEST_P(ManifoldBatches, LeaveDeepPairsOfWhichTheRadiusHidesTheDistance) {
    if (!canCollideInBatches()) { return; }
    const Vec2 start{real(-0.0013740882709447949), real(-0.0038991044605414986)};
    Query query;
    query.a = makeSegment(start, -start).value();
    query.b = makeCircle({}, real(0.57248610544837308)).value();
    query.bInA = {{real(-0.0006892172660407413), real(-0.0019557184354439499)},
                  {real(-0.35224275598048432), real(-0.93590867121705468)}};
    query.reach = {real(0.001), std::numeric_limits<Real>::infinity()};
    Tally tally;
    compare({query}, PairKind::round, tally);
}

INSTANTIATE_TEST_SUITE_P(OfThisMachine, ManifoldBatches, testing::ValuesIn(hwy::SupportedAndGeneratedTargets()),
                         [](const auto& target) { return std::string(hwy::TargetName(target.param)); });

#endif

TEST(ManifoldBatch, TakesPolygonsOfOrdinarySizeOnly) {
    EXPECT_TRUE(collidesInBatches(makeBox({1, 2}).value()));
    EXPECT_TRUE(collidesInBatches(makeCircle({0, 0}, 1).value()));
    EXPECT_TRUE(collidesInBatches(makeSegment({0, 0}, {1, 0}).value()));
    EXPECT_TRUE(collidesInBatches(makeBox({1, 1}, {}, 0, Real(0.1)).value()));
    const Real huge = std::numeric_limits<Real>::max() / 16;
    EXPECT_FALSE(collidesInBatches(makeBox({huge, huge}).value()));
    EXPECT_FALSE(collidesInBatches(makeCircle({0, 0}, huge).value()));
    const std::vector<Vec2> flat{{-1, 0}, {1, 0}, {1, 1}, {0, Real(1.001)}, {-1, 1}};
    EXPECT_FALSE(collidesInBatches(makePolygon(flat).value())) << "two faces are nearly parallel";
}

}  // namespace
}  // namespace swept
