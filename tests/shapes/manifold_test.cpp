#include <gtest/gtest.h>

#include <set>

#include <swept/shapes/distance.h>
#include <swept/shapes/manifold.h>

#include "manifold_cases.h"
#include "pair_families.h"

/// Manifolds whose points are known, and laws of all.

namespace swept::test {
namespace {

std::set<FeatureId> idsOf(const Manifold& m) {
    std::set<FeatureId> ids;
    for (int i = 0; i < m.count; ++i) { ids.insert(m.points[static_cast<std::size_t>(i)].id); }
    return ids;
}

struct FlatCase {
    const char* name;
    Polygon top;  ///< its lower side at y = −bottom
    double bottom;
    int points;
};

std::vector<FlatCase> flatCases() {
    const std::array<Vec2, 3> triangle = {Vec2{real(-0.5), real(-0.25)}, Vec2{real(0.5), real(-0.25)}, Vec2{0, 1}};
    return {{"box", makeBox({real(0.5), real(0.5)}).value(), 0.5, 2},
            {"rounded box", makeBox({real(0.5), real(0.25)}, {}, 0, real(0.25)).value(), 0.5, 2},
            {"capsule", makeCapsule({real(-0.5), 0}, {real(0.5), 0}, real(0.25)).value(), 0.25, 2},
            {"segment", makeSegment({real(-0.5), 0}, {real(0.5), 0}).value(), 0, 2},
            {"circle", makeCircle({}, real(0.5)).value(), 0.5, 1},
            {"triangle", makePolygon(triangle).value(), 0.25, 2},
            {"upright capsule", makeCapsule({0, 0}, {0, 1}, real(0.25)).value(), 0.25, 1}};
}

TEST(Manifold, FacesTouchAlongTheirOverlap) {
    const Polygon ground = makeBox({2, 1}).value();
    for (const FlatCase& flat : flatCases()) {
        for (std::uint64_t seed = 0; seed < 2'000; ++seed) {
            Random random(seed);
            // A segment has no thickness: it is on the other side once it is through.
            const double gap = random.range(flat.bottom > 0 ? -0.01 : 0.001, 0.01);
            const double x = random.range(-1.4, 1.4);
            const Transform pose = poseAt(x, 1 + flat.bottom + gap, 0);
            const Manifold m = collide(ground, flat.top, pose, real(0.02));
            ASSERT_EQ(m.count, flat.points) << flat.name << ", seed " << seed;
            EXPECT_EQ(m.normal, (Vec2{0, 1})) << flat.name << ", seed " << seed;
            for (int i = 0; i < m.count; ++i) {
                const ManifoldPoint& p = m.points[static_cast<std::size_t>(i)];
                EXPECT_NEAR(static_cast<double>(p.separation), gap, 8 * static_cast<double>(kEps));
                EXPECT_NEAR(static_cast<double>(p.point.y), 1 + gap / 2, 8 * static_cast<double>(kEps));
            }
            if (flat.points == 2) {
                const double width = std::fabs(static_cast<double>(m.points[0].point.x - m.points[1].point.x));
                EXPECT_NEAR(width, 1, 0.0001) << flat.name << ", seed " << seed;
                // Ids tell the points apart and survive a small move, also a small turn.
                EXPECT_EQ(idsOf(m).size(), 2U);
                const Transform moved =
                    poseAt(x + random.range(-0.01, 0.01), 1 + flat.bottom + gap, random.range(-1e-3, 1e-3));
                EXPECT_EQ(idsOf(collide(ground, flat.top, moved, real(0.02))), idsOf(m))
                    << flat.name << ", seed " << seed;
            }
        }
    }
}

TEST(Manifold, OverhangIsClippedToTheFace) {
    const Polygon ground = makeBox({1, 1}).value();
    const Polygon box = makeBox({1, 1}).value();
    for (const double y : {1.99, 2.01}) {
        const Manifold m = collide(ground, box, poseAt(1.25, y, 0), real(0.05));
        ASSERT_EQ(m.count, 2);
        const auto [left, right] = std::minmax(m.points[0].point.x, m.points[1].point.x);
        EXPECT_NEAR(static_cast<double>(left), 0.25, 1e-6);
        EXPECT_NEAR(static_cast<double>(right), 1, 1e-6);
    }
}

TEST(Manifold, CornersBesideEachOtherMakeOnePoint) {
    const Polygon box = makeBox({1, 1}).value();
    for (const double dx : {2.1, 2.4, 2.0 + 1e-3}) {
        const Manifold m = collide(box, box, poseAt(dx, 2.2, 0), 1);
        ASSERT_EQ(m.count, 1) << dx;
        const double gap = std::hypot(dx - 2, 0.2);
        EXPECT_NEAR(static_cast<double>(m.points[0].separation), gap, 1e-6);
        EXPECT_NEAR(static_cast<double>(m.normal.x), (dx - 2) / gap, 1e-5);
    }
}

TEST(Manifold, CornersOfEqualBoxesStackOnTwoPoints) {
    const Polygon box = makeBox({real(0.5), real(0.5)}).value();
    for (const double gap : {-0.001, 0.0, 0.001}) {
        const Manifold m = collide(box, box, poseAt(0, 1 + gap, 0), real(0.01));
        EXPECT_EQ(m.count, 2) << gap;
        EXPECT_EQ(m.normal, (Vec2{0, 1})) << gap;
    }
}

/// A shape above another, both with flat sides 1 m wide, the upper one shifted, turned and raised a little. Of the ids,
/// high bits name edges: without any, both points lie between vertices.
/// @param side  lower side of the core of `upper`, below its origin, m.
void expectTwoPoints(const Polygon& lower, const Polygon& upper, double height, double side, const char* name) {
    int vertices = 0;
    for (std::uint64_t seed = 0; seed < 5'000; ++seed) {
        Random random(seed);
        const double hair = random.sign() * std::pow(10.0, random.range(-9, -2.5));
        // The corner that hangs over is closest to a corner when it turns down by more than hair/gap.
        const double turn = std::min(std::fabs(hair) * std::pow(10.0, random.range(0, 2)), 0.02);
        const double angle = random.chance(0.25) ? 0 : random.sign() * turn;
        const double gap = random.range(-0.01, 0.01);
        const Transform pose = poseAt(hair - side * std::sin(angle), height + gap, angle);
        const Manifold m = collide(lower, upper, pose, real(0.05));
        ASSERT_EQ(m.count, 2) << name << ", seed " << seed << ": hair " << hair << " angle " << angle;
        const Distance d = distance(lower, upper, pose);
        ASSERT_NEAR(static_cast<double>(deepest(m)), static_cast<double>(d.distance), 16 * static_cast<double>(kEps))
            << name << ", seed " << seed;
        vertices += (m.points[0].id & 0x8080) == 0 && (m.points[1].id & 0x8080) == 0 ? 1 : 0;
        EXPECT_EQ(idsOf(m).size(), 2U) << name << ", seed " << seed;
        EXPECT_NEAR(static_cast<double>(std::fabs(m.points[0].point.x - m.points[1].point.x)), 1, 0.02)
            << name << ", seed " << seed;
    }
    EXPECT_GT(vertices, 100) << name << ": too few closest vertices";
}

TEST(Manifold, RoundedShapesThatHangOverByAHairKeepTwoPoints) {
    const Polygon box = makeBox({real(0.5), real(0.5)}, {}, 0, real(0.125)).value();
    const Polygon capsule = makeCapsule({real(-0.5), 0}, {real(0.5), 0}, real(0.25)).value();
    expectTwoPoints(box, box, 1.25, 0.5, "rounded boxes");
    expectTwoPoints(capsule, capsule, 0.5, 0, "capsules");
    expectTwoPoints(box, capsule, 0.875, 0, "capsule on rounded box");
    expectTwoPoints(capsule, box, 0.875, 0.5, "rounded box on capsule");
}

TEST(Manifold, WhatHasNoSecondEdgeAboveMakesOnePoint) {
    const Polygon box = makeBox({real(0.5), real(0.5)}, {}, 0, real(0.125)).value();
    const Polygon capsule = makeCapsule({real(-0.5), 0}, {real(0.5), 0}, real(0.125)).value();
    const Polygon upright = makeCapsule({0, 0}, {0, 1}, real(0.25)).value();
    const Polygon ball = makeCircle({}, real(0.25)).value();
    for (std::uint64_t seed = 0; seed < 2'000; ++seed) {
        Random random(seed);
        const double end = random.sign() * (0.5 + random.sign() * std::pow(10.0, random.range(-17, -1)));
        const double gap = random.range(-0.01, 0.01);
        for (const Polygon& lower : {box, capsule}) {
            const double top = lower.count > 2 ? 0.625 : 0.125;
            for (const Polygon& upper : {upright, ball}) {
                const Transform pose = poseAt(end, top + 0.25 + gap, 0);
                const Manifold m = collide(lower, upper, pose, real(0.05));
                ASSERT_EQ(m.count, 1) << "seed " << seed;
                const Distance d = distance(lower, upper, pose);
                ASSERT_NEAR(static_cast<double>(m.points[0].separation), static_cast<double>(d.distance),
                            16 * static_cast<double>(kEps))
                    << "seed " << seed;
            }
            // Side by side, the edges run away from each other: only the ends are near.
            const Transform beside = poseAt(end + std::copysign(0.5, end) + std::copysign(0.001, end), 2 * top, 0);
            if (std::fabs(end) > 0.5) {
                const Manifold m = collide(lower, lower, beside, 1);
                ASSERT_EQ(m.count, 1) << "seed " << seed;
            }
        }
    }
}

/// A capsule, hardly tilted, on a box or beside its end: along the box's normal, whatever is closest.
TEST(Manifold, OnAFaceSeparationsAreHeightsAboveIt) {
    const Polygon box = makeBox({1, 1}).value();
    const Polygon capsule = makeCapsule({-1, 0}, {1, 0}, real(0.25)).value();
    int top = 0;
    while (box.normals[static_cast<std::size_t>(top)].y < real(0.5)) { ++top; }
    int both = 0;
    for (std::uint64_t seed = 0; seed < 5'000; ++seed) {
        Random random(seed);
        const double angle = random.range(-1e-3, 1e-3);
        const double x = random.range(-2.5, 2.5);
        const double height = random.range(-0.01, 0.01);
        const Transform pose = poseAt(x, 1.25 + height, angle);
        const Manifold m = collideOnFace(box, top, capsule, pose, real(0.05), real(1) / 1024);
        const double outside = std::fabs(x) - 1 - std::cos(angle);  // of the core, beyond the end of the face
        if (std::fabs(outside) < 1e-6 || (outside > 0 && outside < 0.26 / 1024)) { continue; }
        ASSERT_EQ(m.count > 0, outside < 0) << "seed " << seed;
        both += m.count == 2 ? 1 : 0;
        for (std::size_t i = 0; i < static_cast<std::size_t>(m.count); ++i) {
            const ManifoldPoint& point = m.points[i];
            const double line = height + (static_cast<double>(point.point.x) - x) * std::tan(angle);
            ASSERT_EQ(m.normal, (Vec2{0, 1}));
            ASSERT_NEAR(static_cast<double>(point.separation), line, 8 * static_cast<double>(kEps)) << "seed " << seed;
            ASSERT_NEAR(static_cast<double>(point.point.y), 1 + line / 2, 8 * static_cast<double>(kEps))
                << "seed " << seed;
        }
    }
    EXPECT_GT(both, 1000);
}

/// One capsule upright on the end of the other, whose line ends exactly there: over the face or not by rounding alone.
TEST(Manifold, UprightOnTheEndOfAFaceIsAsDeepAsItIs) {
    for (const double half : {0.1, 0.2, 0.25, 0.3, 0.5, 0.7}) {
        for (const double other : {0.1, 0.2, 0.3, 0.35, 0.5}) {
            for (const double radius : {0.05, 0.1, 0.25, 0.3}) {
                for (const double side : {-1.0, 1.0}) {
                    for (const double turn : {-1.0, 1.0}) {
                        const Polygon flat = makeCapsule({real(-half), 0}, {real(half), 0}, real(radius)).value();
                        const Polygon upright = makeCapsule({real(-other), 0}, {real(other), 0}, real(radius)).value();
                        const Transform pose = poseAt(side * half, -other, turn * 1.5707963267948966);
                        const Manifold m = collide(flat, upright, pose, real(1));
                        ASSERT_GT(m.count, 0);
                        EXPECT_NEAR(deepest(m), distance(flat, upright, pose).distance, 1e-5)
                            << half << ' ' << other << ' ' << radius << ' ' << side << ' ' << turn;
                    }
                }
            }
        }
    }
}

TEST(Manifold, CrossingSegmentsMakeOnePointAtTheShallowEnd) {
    const Polygon segment = makeSegment({-1, 0}, {1, 0}).value();
    const Polygon upright = makeSegment({0, real(-0.25)}, {0, 3}).value();
    const Manifold m = collide(segment, upright, Transform{}, 0);
    ASSERT_EQ(m.count, 1);
    EXPECT_EQ(m.normal, (Vec2{0, 1}));
    EXPECT_EQ(m.points[0].separation, real(-0.25));
    EXPECT_EQ(m.points[0].point, (Vec2{0, real(-0.125)}));
}

TEST(Manifold, ParallelSegmentsTouchAlongTheirOverlap) {
    const Polygon segment = makeSegment({-1, 0}, {1, 0}).value();
    const Manifold m = collide(segment, segment, poseAt(0.5, 0.125, 0), real(0.25));
    ASSERT_EQ(m.count, 2);
    EXPECT_EQ(std::fabs(m.points[0].point.x - m.points[1].point.x), real(1.5));
    EXPECT_EQ(m.points[0].separation, real(0.125));
}

TEST(Manifold, ConcentricCirclesHaveANormal) {
    const Polygon ball = makeCircle({}, 1).value();
    const Manifold m = collide(ball, ball, Transform{}, 0);
    ASSERT_EQ(m.count, 1);
    EXPECT_EQ(m.points[0].separation, -2);
    EXPECT_EQ(lengthSquared(m.normal), 1);
}

TEST(Manifold, PowersOfTwoScaleThePointsAndNothingElse) {
    const int most = std::is_same_v<Real, double> ? 100 : 10;
    for (const PairFamily family : kPairFamilies) {
        for (std::uint64_t seed = 0; seed < 1'000; ++seed) {
            const PairCase c = makePair(family, seed);
            const Real margin = real(0.1);
            const Manifold m = collide(c.a, c.b, c.bInA, margin);
            for (const int k : {-most, -7, 1, most}) {
                const auto up = [k](Real x) { return std::ldexp(x, k); };
                const Transform pose{{up(c.bInA.translation.x), up(c.bInA.translation.y)}, c.bInA.rotation};
                const Manifold s = collide(scaled(c.a, k), scaled(c.b, k), pose, up(margin));
                ASSERT_EQ(s.count, m.count) << "seed " << seed << "\n" << c;
                ASSERT_EQ(s.normal, m.normal);
                for (std::size_t i = 0; i < static_cast<std::size_t>(m.count); ++i) {
                    ASSERT_EQ(s.points[i].separation, up(m.points[i].separation));
                    ASSERT_EQ(s.points[i].point, (Vec2{up(m.points[i].point.x), up(m.points[i].point.y)}));
                    ASSERT_EQ(s.points[i].id, m.points[i].id);
                }
            }
        }
    }
}

TEST(Manifold, GarbageNeverGivesNaN) {
    const double most = std::is_same_v<Real, double> ? 300 : 30;
    int touching = 0;
    for (std::uint64_t seed = 0; seed < 20'000; ++seed) {
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
        const Real margin = real(std::pow(10.0, random.range(-most, most)));
        const ChainSegment segment{{},         c.a.vertices[0],    c.a.vertices[1],   c.b.vertices[0],
                                   c.a.radius, random.chance(0.5), random.chance(0.5)};
        const bool isSegment = c.a.count > 1;
        for (const Manifold& m :
             {collide(c.a, c.b, c.bInA, margin), isSegment ? collide(segment, c.b, c.bInA, margin) : Manifold{}}) {
            ASSERT_TRUE(isFinite(m.normal)) << "seed " << seed << "\n" << c;
            for (std::size_t i = 0; i < static_cast<std::size_t>(m.count); ++i) {
                ASSERT_TRUE(isFinite(m.points[i].point) && isFinite(m.points[i].separation)) << "seed " << seed << "\n"
                                                                                             << c;
                ++touching;
            }
            if (m.count > 0) {
                ASSERT_NEAR(static_cast<double>(length(exact(m.normal))), 1, 4 * static_cast<double>(kEps)) << c;
            }
        }
    }
    EXPECT_GT(touching, 5'000);
}

}  // namespace
}  // namespace swept::test
