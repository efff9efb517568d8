#include <cmath>

#include <box2d/box2d.h>
#include <gtest/gtest.h>

#include <swept/shapes/ray_cast.h>

#include "box2d_vec2.h"
#include "shape_families.h"

/// The same rays against Box2D 2.4.1. Its polygons are cast without their skin, its rays do not hit what they start in.

namespace swept::test {
namespace {

struct Box2dHit {
    bool hit;
    b2RayCastOutput output;
};

Box2dHit castInBox2d(const b2Shape& shape, Vec2 origin, Vec2 direction, Real maxFraction) {
    const b2RayCastInput input{toBox2d(origin), toBox2d(origin + direction), static_cast<float>(maxFraction)};
    b2Transform identity;
    identity.SetIdentity();
    b2RayCastOutput output{};
    const bool hit = shape.RayCast(&output, input, identity, 0);
    return {hit, output};
}

void expectSame(const RayCastHit& ours, const Box2dHit& theirs, Vec2 direction, int i) {
    // Box2D computes in float, also where we use double; the fraction of a grazing ray is judged by the shift across.
    const double cosine = static_cast<double>(-dot(ours.normal, direction) / length(direction));
    const double slack = 1e-5 / std::fmax(std::fabs(cosine), 1e-3);
    ASSERT_NEAR(static_cast<double>(ours.fraction), static_cast<double>(theirs.output.fraction), slack) << "case " << i;
    const double turned = std::hypot(static_cast<double>(ours.normal.x) - static_cast<double>(theirs.output.normal.x),
                                     static_cast<double>(ours.normal.y) - static_cast<double>(theirs.output.normal.y));
    ASSERT_LE(turned, 1e-3) << "case " << i;
}

TEST(RayCastAgainstBox2d, PolygonsWithoutRadius) {
    Random random(1);
    int hits = 0;
    int disagreements = 0;
    for (int i = 0; i < 20'000; ++i) {
        // Box2D welds vertices closer than 2.5 mm, so the shapes are ones that it keeps as they are.
        const int count = random.integer(3, 8);
        std::vector<Vec2> vertices;
        std::vector<b2Vec2> theirVertices;
        const double start = random.range(0, 6);
        for (int k = 0; k < count; ++k) {
            const double angle = start + 6.283185307179586 * (k + random.range(-0.3, 0.3)) / count;
            vertices.push_back({static_cast<float>(std::cos(angle)), static_cast<float>(2 * std::sin(angle))});
            theirVertices.push_back(toBox2d(vertices.back()));
        }
        const Result<Polygon> polygon = makePolygon(vertices);
        ASSERT_TRUE(polygon.ok()) << "case " << i;
        b2PolygonShape shape;
        shape.Set(theirVertices.data(), count);
        ASSERT_EQ(shape.m_count, count) << "case " << i;

        const Vec2 origin{static_cast<float>(random.range(-4, 4)), static_cast<float>(random.range(-4, 4))};
        const Vec2 direction{static_cast<float>(random.range(-6, 6)), static_cast<float>(random.range(-6, 6))};
        if (containsPoint(polygon.value(), origin)) { continue; }
        const RayCastHit ours = rayCast(polygon.value(), origin, direction, 1);
        const Box2dHit theirs = castInBox2d(shape, origin, direction, 1);
        if (ours.hit != theirs.hit) {
            ++disagreements;
            continue;
        }
        if (!ours.hit) { continue; }
        ++hits;
        const double cornered =
            static_cast<double>(length(ours.normal - Vec2{theirs.output.normal.x, theirs.output.normal.y}));
        if (cornered > 1e-3) {  // through a vertex, where either normal is right
            ++disagreements;
            continue;
        }
        expectSame(ours, theirs, direction, i);
    }
    EXPECT_GT(hits, 2'500);
    EXPECT_LE(disagreements, 4) << "only rays that graze a vertex within rounding";
}

TEST(RayCastAgainstBox2d, Circles) {
    Random random(2);
    int hits = 0;
    int disagreements = 0;
    for (int i = 0; i < 20'000; ++i) {
        const Vec2 center{static_cast<float>(random.range(-1, 1)), static_cast<float>(random.range(-1, 1))};
        const float radius = static_cast<float>(random.range(0.2, 2));
        const Polygon circle = makeCircle(center, radius).value();
        b2CircleShape shape;
        shape.m_p = toBox2d(center);
        shape.m_radius = radius;
        const Vec2 origin{static_cast<float>(random.range(-4, 4)), static_cast<float>(random.range(-4, 4))};
        const Vec2 direction{static_cast<float>(random.range(-6, 6)), static_cast<float>(random.range(-6, 6))};
        if (containsPoint(circle, origin)) { continue; }
        const RayCastHit ours = rayCast(circle, origin, direction, 1);
        const Box2dHit theirs = castInBox2d(shape, origin, direction, 1);
        if (ours.hit != theirs.hit) {
            ++disagreements;
            continue;
        }
        if (!ours.hit) { continue; }
        ++hits;
        const double cosine = static_cast<double>(-dot(ours.normal, direction) / length(direction));
        if (cosine < 0.05) { continue; }  // grazing: a root of a small difference in float
        expectSame(ours, theirs, direction, i);
    }
    EXPECT_GT(hits, 1'800);
    EXPECT_LE(disagreements, 4);
}

TEST(RayCastAgainstBox2d, Segments) {
    Random random(3);
    int hits = 0;
    int disagreements = 0;
    for (int i = 0; i < 20'000; ++i) {
        const Vec2 p{static_cast<float>(random.range(-2, 0)), static_cast<float>(random.range(-2, 2))};
        const Vec2 q{static_cast<float>(random.range(0.5, 2)), static_cast<float>(random.range(-2, 2))};
        const Polygon segment = makeSegment(p, q).value();
        b2EdgeShape shape;
        shape.SetTwoSided(toBox2d(p), toBox2d(q));
        const Vec2 origin{static_cast<float>(random.range(-4, 4)), static_cast<float>(random.range(-4, 4))};
        const Vec2 direction{static_cast<float>(random.range(-6, 6)), static_cast<float>(random.range(-6, 6))};
        const RayCastHit ours = rayCast(segment, origin, direction, 1);
        const Box2dHit theirs = castInBox2d(shape, origin, direction, 1);
        if (ours.hit != theirs.hit) {
            ++disagreements;
            continue;
        }
        if (!ours.hit) { continue; }
        ++hits;
        expectSame(ours, theirs, direction, i);
    }
    EXPECT_GT(hits, 2'000);
    EXPECT_LE(disagreements, 4);
}

}  // namespace
}  // namespace swept::test
