#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include <swept/shapes/manifold.h>

#include "manifold_cases.h"
#include "pair_families.h"

namespace swept::test {
namespace {

struct Slider {
    const char* name;
    Polygon shape;
    double angle;
};

std::vector<Slider> sliders() {
    const std::array<Vec2, 3> triangle = {Vec2{real(-0.25), real(-0.25)}, Vec2{real(0.25), real(-0.25)},
                                          Vec2{0, real(0.5)}};
    const Polygon box = makeBox({real(0.25), real(0.25)}).value();
    const Polygon capsule = makeCapsule({real(-0.25), 0}, {real(0.25), 0}, real(0.1)).value();
    const Polygon segment = makeSegment({real(-0.25), 0}, {real(0.25), 0}).value();
    return {{"box", box, 0},
            {"box, slightly turned", box, 1e-3},
            {"box, turned", box, 0.3},
            {"box on its corner", box, 0.78539816339744831},
            {"large box", makeBox({3, 1}).value(), 0},
            {"rounded box", makeBox({real(0.2), real(0.2)}, {}, 0, real(0.05)).value(), 0},
            {"rounded box, turned", makeBox({real(0.2), real(0.2)}, {}, 0, real(0.05)).value(), -0.2},
            {"circle", makeCircle({}, real(0.25)).value(), 0},
            {"small circle", makeCircle({}, real(0.03)).value(), 0},
            {"capsule", capsule, 0},
            {"capsule, turned", capsule, 0.2},
            {"upright capsule", capsule, 1.5707963267948966},
            {"segment", segment, 0.1},
            {"triangle", makePolygon(triangle).value(), 0},
            {"triangle on its tip", makePolygon(triangle).value(), 3.1415926535897931}};
}

/// How far a shape reaches below its origin.
double reachBelow(const Slider& s) {
    double lowest = 0;
    const Rotation q = rotationFromAngle(s.angle);
    for (const Vec2 v : s.shape.points()) { lowest = std::min(lowest, static_cast<double>(rotate(q, v).y)); }
    return static_cast<double>(s.shape.radius) - lowest;
}

/// Ground from right to left, collides upwards.
std::vector<Vec2> flatGround(double angle) {
    std::vector<Vec2> points;
    const Rotation q = rotationFromAngle(angle);
    for (const double x : {5.0, 3.0, 2.9, 2.0, 1.3, 1.0, 0.2, 0.0, -0.4, -1.0, -2.0, -3.3, -5.0}) {
        points.push_back(rotate(q, Vec2{real(x), 0}));
    }
    return points;
}

TEST(ChainManifold, NothingCatchesOnFlatSeams) {
    const std::vector<Vec2> ground = flatGround(0);
    for (const Slider& s : sliders()) {
        const double reach = reachBelow(s);
        for (const double height : {-0.01, -0.001, 0.0, 0.005}) {
            for (int step = -3000; step <= 3000; ++step) {
                const Transform pose = poseAt(step * 1e-3, reach + height, s.angle);
                int points = 0;
                Real deepest = std::numeric_limits<Real>::max();
                for (int i = 0; i < chainSegmentCount(static_cast<int>(ground.size()), false); ++i) {
                    const Manifold m = collide(chainSegment(ground, false, 0, i), s.shape, pose, real(0.01));
                    if (m.count > 0) {
                        ASSERT_EQ(m.normal, (Vec2{0, 1})) << s.name << " at " << step << ", height " << height;
                    }
                    for (std::size_t k = 0; k < static_cast<std::size_t>(m.count); ++k) {
                        ++points;
                        deepest = std::min(deepest, m.points[k].separation);
                        ASSERT_NEAR(static_cast<double>(m.points[k].point.y),
                                    static_cast<double>(m.points[k].separation) / 2, 16 * static_cast<double>(kEps));
                    }
                }
                ASSERT_GE(points, 1) << s.name << " at " << step << ", height " << height;
                ASSERT_NEAR(static_cast<double>(deepest), height, 16 * static_cast<double>(kEps))
                    << s.name << " at " << step;
            }
        }
    }
}

TEST(ChainManifold, NothingCatchesOnSlopes) {
    for (const double angle : {0.1, -0.7, 2.5}) {  // the points round differently: the seams are only nearly flat
        const std::vector<Vec2> ground = flatGround(angle);
        const Rotation q = rotationFromAngle(angle);
        for (const Slider& s : sliders()) {
            const double reach = reachBelow(s);
            for (int step = -1500; step <= 1500; ++step) {
                const Vec2 position = rotate(q, Vec2{real(step * 2e-3), real(reach - 0.002)});
                const Transform pose{position, rotationFromAngle(angle + s.angle)};
                int points = 0;
                for (int i = 0; i < chainSegmentCount(static_cast<int>(ground.size()), false); ++i) {
                    const ChainSegment segment = chainSegment(ground, false, 0, i);
                    const Manifold m = collide(segment, s.shape, pose, real(0.01));
                    points += m.count;
                    if (m.count == 0) { continue; }
                    ASSERT_LE(length(m.normal - normalOf(segment)), 2 * kEpsilon) << s.name << " at " << step;
                }
                ASSERT_GE(points, 1) << s.name << " at " << step;
            }
        }
    }
}

TEST(ChainManifold, NormalsAtAConvexCornerStayBetweenTheFaces) {
    const std::array<Vec2, 5> hill = {Vec2{4, -1}, Vec2{1, 0}, Vec2{-1, 0}, Vec2{real(-1.5), -2}, Vec2{-2, -6}};
    for (const Slider& s : sliders()) {
        int atCorner = 0;
        for (int step = 0; step < 2000; ++step) {
            // Along the outline of the hill, a little into it: the distance is brought about by bisection.
            Transform pose = poseAt(3 - step * 2.2e-3, 0, s.angle);
            const auto deepestAt = [&](Real y) {
                Real least = -8;  // where nothing is reported, the centre is in the ground
                bool isFirst = true;
                for (int i = 0; i < 4; ++i) {
                    Transform p = pose;
                    p.translation.y = y;
                    const ChainSegment segment = chainSegment(hill, false, 0, i);
                    const Manifold m = collide(segment, s.shape, p, 8);
                    for (std::size_t k = 0; k < static_cast<std::size_t>(m.count); ++k) {
                        least = isFirst ? m.points[k].separation : std::min(least, m.points[k].separation);
                        isFirst = false;
                    }
                }
                return least;
            };
            Real low = -4;
            Real high = 4;
            for (int i = 0; i < 30; ++i) {
                const Real middle = (low + high) / 2;
                (deepestAt(middle) > real(-0.002) ? high : low) = middle;
            }
            pose.translation.y = high;
            int points = 0;
            for (int i = 0; i < 4; ++i) {
                const ChainSegment segment = chainSegment(hill, false, 0, i);
                const Manifold m = collide(segment, s.shape, pose, real(0.001));
                points += m.count;
                if (m.count == 0) { continue; }
                // Never outside the range between the normals of the neighbours.
                const Vec2 before = segment.hasBefore ? normalOf(chainSegment(hill, false, 0, i - 1)) : Vec2{1, 0};
                const Vec2 after =
                    segment.hasAfter ? normalOf(chainSegment(hill, false, 0, i + 1)) : Vec2{-1, real(-0.5)};
                ASSERT_LE(static_cast<double>(cross(m.normal, before)), 1.001 / 1024) << s.name << " at " << step;
                ASSERT_GE(static_cast<double>(cross(m.normal, after)), -1.001 / 1024) << s.name << " at " << step;
                atCorner += length(m.normal - normalOf(segment)) > real(0.01) ? 1 : 0;
            }
            ASSERT_GE(points, 1) << s.name << " at step " << step << ", x " << pose.translation.x << " y "
                                 << pose.translation.y;
        }
        EXPECT_GT(atCorner, 20) << s.name << " never met a corner";
    }
}

TEST(ChainManifold, AConcaveCornerGivesBothFaces) {
    const std::array<Vec2, 3> valley = {Vec2{4, 4}, Vec2{0, 0}, Vec2{-4, 4}};
    const Polygon ball = makeCircle({}, 1).value();
    const Transform pose = poseAt(0, std::sqrt(2.0) - 0.001, 0);
    for (int i = 0; i < 2; ++i) {
        const ChainSegment segment = chainSegment(valley, false, 0, i);
        const Manifold m = collide(segment, ball, pose, 0);
        ASSERT_EQ(m.count, 1);
        EXPECT_LE(length(m.normal - normalOf(segment)), 2 * kEpsilon);
        EXPECT_NEAR(static_cast<double>(m.points[0].separation), -0.001 / std::sqrt(2.0), 1e-6);
    }
    const Polygon box = makeBox({1, 1}).value();
    for (int i = 0; i < 2; ++i) {
        const ChainSegment segment = chainSegment(valley, false, 0, i);
        const Manifold m = collide(segment, box, poseAt(0, std::sqrt(2.0) - 0.001, 0.78539816339744831), real(0.01));
        EXPECT_EQ(m.count, 2);
        EXPECT_LE(length(m.normal - normalOf(segment)), 2 * kEpsilon);
    }
}

TEST(ChainManifold, OnlyTheRightHandSideCollides) {
    const std::array<Vec2, 2> line = {Vec2{1, 0}, Vec2{-1, 0}};
    const ChainSegment segment = chainSegment(line, false, 0, 0);
    for (const Slider& s : sliders()) {
        for (const double y : {-0.02, -0.1, -0.3, -1.0}) {
            double center = 0;  // the vertex mean, for shapes that are not symmetric
            for (const Vec2 v : s.shape.points()) {
                center += static_cast<double>(rotate(rotationFromAngle(s.angle), v).y) / s.shape.count;
            }
            EXPECT_EQ(collide(segment, s.shape, poseAt(0, y - center, s.angle), 2).count, 0) << s.name << " at " << y;
            EXPECT_GE(collide(segment, s.shape, poseAt(0, -y - center, s.angle), 2).count, 1) << s.name << " at " << -y;
        }
    }
}

TEST(ChainManifold, OpenEndsAreRound) {
    const std::array<Vec2, 2> line = {Vec2{1, 0}, Vec2{-1, 0}};
    const ChainSegment segment = chainSegment(line, false, 0, 0);
    const Polygon ball = makeCircle({}, real(0.5)).value();
    const Manifold m = collide(segment, ball, poseAt(1.3, 0.4, 0), real(0.01));
    ASSERT_EQ(m.count, 1);
    EXPECT_NEAR(static_cast<double>(m.normal.x), 0.6, 1e-6);
    EXPECT_NEAR(static_cast<double>(m.normal.y), 0.8, 1e-6);
    EXPECT_NEAR(static_cast<double>(m.points[0].separation), 0, 1e-6);
}

/// Its middle is in front, beyond the end, and its lower side rests on the end from behind.
TEST(ChainManifold, OpenEndsHoldWhatLeansOverThem) {
    const std::array<Vec2, 2> line = {Vec2{1, 0}, Vec2{-1, 0}};
    const ChainSegment segment = chainSegment(line, false, 0, 0);
    constexpr double kAngle = 1.2;  // from the segment's direction; the end touches it half way between middle and foot
    constexpr double kHalf = 0.5;
    constexpr double kThick = 0.1;
    for (const double side : {-1.0, 1.0}) {
        for (const Polygon& shape : {makeCapsule({real(-kHalf), 0}, {real(kHalf), 0}, real(kThick)).value(),
                                     makeBox({real(kHalf), real(kThick)}).value()}) {
            const double angle = side > 0 ? kAngle : std::numbers::pi - kAngle;
            const DVec2 axis{std::cos(angle), std::sin(angle)};
            const DVec2 normal{side * axis.y, -side * axis.x};  // from the end to the shape: downwards
            const DVec2 middle = DVec2{side, 0} + 0.25 * axis + (kThick + 0.001) * normal;
            ASSERT_GT(middle.y, 0);
            const Manifold m = collide(segment, shape, poseAt(middle.x, middle.y, angle), real(0.01));
            ASSERT_EQ(m.count, 1) << "side " << side;
            EXPECT_NEAR(static_cast<double>(m.normal.x), normal.x, 1e-5) << "side " << side;
            EXPECT_NEAR(static_cast<double>(m.normal.y), normal.y, 1e-5) << "side " << side;
            EXPECT_NEAR(static_cast<double>(m.points[0].separation), 0.001, 1e-5) << "side " << side;
        }
    }
}

TEST(ChainManifold, RadiusGrowsTheChain) {
    const std::array<Vec2, 3> line = {Vec2{2, 0}, Vec2{0, 0}, Vec2{-2, 0}};
    const Polygon box = makeBox({1, 1}).value();
    for (int i = 0; i < 2; ++i) {
        const Manifold m = collide(chainSegment(line, false, real(0.25), i), box, poseAt(0, 1.25, 0), real(0.01));
        ASSERT_EQ(m.count, 2);
        EXPECT_EQ(m.normal, (Vec2{0, 1}));
        for (const ManifoldPoint& p : m.points) {
            EXPECT_EQ(p.separation, 0);
            EXPECT_EQ(p.point.y, real(0.25));
        }
    }
}

/// A segment of 2 m that collides upwards, between two neighbours that go down or up from its ends by an angle.
ChainSegment segmentBetween(double down) {
    const double y = -std::sin(down);
    const double x = 1 + std::cos(down);
    return {.before = {real(x), real(y)},
            .p = {1, 0},
            .q = {-1, 0},
            .after = {real(-x), real(y)},
            .hasBefore = true,
            .hasAfter = true};
}

TEST(ChainNormals, AreThoseThatTheNeighboursLeave) {
    const Vec2 up{0, 1};
    const auto slanting = [](double angle) { return Vec2{real(std::sin(angle)), real(std::cos(angle))}; };
    for (const double side : {-1.0, 1.0}) {
        for (const double down : {-0.5, 0.0}) {  // a valley, or flat ground
            EXPECT_EQ(outwardNormal(segmentBetween(down), slanting(0.3 * side)), up) << down;
            EXPECT_EQ(outwardNormal(segmentBetween(down), slanting(1.5 * side)), up) << down;
        }
        const ChainSegment ridge = segmentBetween(0.5);
        EXPECT_EQ(outwardNormal(ridge, up), up);
        EXPECT_EQ(outwardNormal(ridge, slanting(0.3 * side)), slanting(0.3 * side));
        const Vec2 neighbours = slanting(0.5 * side);
        EXPECT_NEAR(outwardNormal(ridge, slanting(1.5 * side)).x, neighbours.x, 1e-6);
        EXPECT_NEAR(outwardNormal(ridge, slanting(1.5 * side)).y, neighbours.y, 1e-6);
        EXPECT_EQ(outwardNormal(ridge, slanting(3.0 * side)), up);  // from behind
        ChainSegment open = ridge;
        open.hasBefore = open.hasAfter = false;
        EXPECT_EQ(outwardNormal(open, slanting(1.5 * side)), slanting(1.5 * side));
    }
}

}  // namespace
}  // namespace swept::test
