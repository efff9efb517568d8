#include <box2d/b2_collision.h>
#include <box2d/b2_distance.h>
#include <box2d/b2_polygon_shape.h>
#include <gtest/gtest.h>

#include <swept/shapes/distance.h>
#include <swept/shapes/manifold.h>

#include "box2d_vec2.h"
#include "pair_families.h"

/// Against Box2D 2.4.1, for pairs that are no hard case for either.

namespace swept::test {
namespace {

b2Transform poseInBox2d(const Transform& t) {
    b2Transform pose;
    pose.p = toBox2d(t.translation);
    pose.q.c = static_cast<float>(t.rotation.c);
    pose.q.s = static_cast<float>(t.rotation.s);
    return pose;
}

b2PolygonShape polygonInBox2d(const Polygon& p) {
    b2PolygonShape shape;
    shape.m_count = p.count;
    shape.m_radius = 0;
    for (int i = 0; i < p.count; ++i) {
        shape.m_vertices[i] = toBox2d(p.vertices[static_cast<std::size_t>(i)]);
        shape.m_normals[i] = toBox2d(p.normals[static_cast<std::size_t>(i)]);
    }
    shape.m_centroid.SetZero();
    return shape;
}

PairCase stoutPair(std::uint64_t seed, double reach) {
    Random random(seed);
    const auto regular = [&random] {
        const int count = random.integer(3, 8);
        std::vector<Vec2> v;
        for (int i = 0; i < count; ++i) {
            const double angle = 6.2831853071795862 * (i + random.range(-0.2, 0.2)) / count;
            v.push_back({real(std::cos(angle)), real(std::sin(angle))});
        }
        return makePolygon(v).value();
    };
    return {regular(), regular(), randomPose(random, reach)};
}

TEST(AgainstBox2d, DistancesAndNormalsAgree) {
    int apart = 0;
    for (std::uint64_t seed = 0; seed < 20'000; ++seed) {
        const PairCase c = stoutPair(seed, 5);
        const b2PolygonShape a = polygonInBox2d(c.a);
        const b2PolygonShape b = polygonInBox2d(c.b);
        b2DistanceInput input;
        input.proxyA.Set(&a, 0);
        input.proxyB.Set(&b, 0);
        input.transformA.SetIdentity();
        input.transformB = poseInBox2d(c.bInA);
        input.useRadii = false;
        b2SimplexCache cache;
        cache.count = 0;
        b2DistanceOutput out;
        b2Distance(&out, &cache, &input);
        const Distance d = distance(c.a, c.b, c.bInA);
        ASSERT_NEAR(std::max(static_cast<double>(d.distance), 0.0), static_cast<double>(out.distance), 1e-5)
            << "seed " << seed << "\n"
            << c;
        if (out.distance < 0.01F) { continue; }
        ++apart;
        const b2Vec2 gap = (1 / out.distance) * (out.pointB - out.pointA);
        ASSERT_NEAR(static_cast<double>(d.normal.x), static_cast<double>(gap.x), 1e-3) << "seed " << seed << "\n" << c;
        ASSERT_NEAR(static_cast<double>(d.normal.y), static_cast<double>(gap.y), 1e-3) << "seed " << seed << "\n" << c;
    }
    EXPECT_GT(apart, 8'000);
}

TEST(AgainstBox2d, ManifoldsOfOverlappingPolygonsAgree) {
    int compared = 0;
    int two = 0;
    for (std::uint64_t seed = 0; seed < 20'000; ++seed) {
        const PairCase c = stoutPair(seed, 2);
        const std::vector<Point> pointsA = exactPoints(c.a);
        const std::vector<Point> pointsB = placed(c.b, c.bInA);
        const long double sideA = faceSeparation(pointsA, pointsB);
        const long double sideB = faceSeparation(pointsB, pointsA);
        // Near ties both engines prefer A's face, each within its own tolerance; deep ones have many near ties.
        if (std::max(sideA, sideB) > -1e-4L || std::fabs(sideA - sideB) < 0.01L || std::max(sideA, sideB) < -0.5L) {
            continue;
        }
        const b2PolygonShape a = polygonInBox2d(c.a);
        const b2PolygonShape b = polygonInBox2d(c.b);
        b2Transform identity;
        identity.SetIdentity();
        const b2Transform pose = poseInBox2d(c.bInA);
        b2Manifold theirs;
        b2CollidePolygons(&theirs, &a, identity, &b, pose);
        b2WorldManifold world;
        world.Initialize(&theirs, identity, 0, pose, 0);
        const Manifold ours = collide(c.a, c.b, c.bInA, 0);
        if (std::hypot(static_cast<double>(ours.normal.x) - static_cast<double>(world.normal.x),
                       static_cast<double>(ours.normal.y) - static_cast<double>(world.normal.y)) > 1e-3) {
            // Two faces of one shape may be equally good.
            ASSERT_NEAR(static_cast<double>(ours.points[0].separation), static_cast<double>(std::max(sideA, sideB)),
                        1.0);
            const Distance d = distance(c.a, c.b, c.bInA);
            ASSERT_NEAR(static_cast<double>(d.distance), static_cast<double>(std::max(sideA, sideB)), 1e-5);
            continue;
        }
        ++compared;
        bool isDecided = true;  // a second point that just touches may count or not
        float theirDeepest = 0;
        for (int i = 0; i < theirs.pointCount; ++i) {
            theirDeepest = std::min(theirDeepest, world.separations[i]);
            isDecided = isDecided && world.separations[i] < -1e-4F;
        }
        Real deepest = 0;
        for (std::size_t i = 0; i < static_cast<std::size_t>(ours.count); ++i) {
            deepest = std::min(deepest, ours.points[i].separation);
            isDecided = isDecided && ours.points[i].separation < real(-1e-4);
        }
        ASSERT_NEAR(static_cast<double>(deepest), static_cast<double>(theirDeepest), 1e-4) << "seed " << seed << "\n"
                                                                                           << c;
        if (!isDecided) { continue; }
        ASSERT_EQ(ours.count, theirs.pointCount) << "seed " << seed << "\n" << c;
        two += ours.count == 2 ? 1 : 0;
        for (std::size_t i = 0; i < static_cast<std::size_t>(ours.count); ++i) {
            double nearest = 1e9;
            for (int k = 0; k < theirs.pointCount; ++k) {
                nearest = std::min(
                    nearest,
                    std::hypot(static_cast<double>(ours.points[i].point.x) - static_cast<double>(world.points[k].x),
                               static_cast<double>(ours.points[i].point.y) - static_cast<double>(world.points[k].y)));
            }
            ASSERT_LE(nearest, 1e-3) << "seed " << seed << "\n" << c;
        }
    }
    EXPECT_GT(compared, 4'000);
    EXPECT_GT(two, 500);
}

}  // namespace
}  // namespace swept::test
