#include <array>
#include <set>

#include <swept/shapes/distance.h>

#include "../support/random.h"
#include "world_support.h"

/// Which segment of a chain it was: casts, what is nearest, contacts and events name the one that is there.

namespace swept::test {
namespace {

/// Terrain with valleys and steps; as a loop it is solid inside.
struct Terrain {
    std::string name;
    World world = makeWorld();
    ShapeId chain;
    std::vector<Polygon> segments;
    WorldTransform pose;

    /// @param reused  in slots that others left, in no order
    Terrain(std::uint64_t seed, bool isLoop, double radius, bool reused)
        : name("seed " + std::to_string(seed) + (isLoop ? ", loop" : "") + (radius > 0 ? ", thick" : "") +
               (reused ? ", reused" : "")) {
        Random random(seed);
        const double angle = random.range(-0.3, 0.3);
        const double x = random.range(-5, 5);
        const double y = random.range(-5, 5);
        const BodyId body = must(world.createBody(bodyAt(BodyType::fixed, {x, y}, angle)));
        if (reused) { leaveSlots(body, random); }
        std::vector<Vec2> points;
        const int count = random.integer(6, 20);
        for (int i = 0; i <= count; ++i) { points.push_back(vec(count - 2 * i, random.range(-0.7, 0.7))); }
        if (isLoop) { points.insert(points.end(), {vec(-count, -9), vec(count, -9)}); }
        chain = must(world.addChain(body, {.points = points, .loop = isLoop, .radius = real(radius)}));
        world.visitPolygons(chain, [&](const Polygon& polygon) { segments.push_back(polygon); });
        EXPECT_EQ(world.segmentCount(chain), segments.size()) << name;
        pose = world.transform(body);
    }

    void leaveSlots(BodyId body, Random& random) {
        std::vector<ShapeId> shapes;
        for (int i = 0; i < 30; ++i) { shapes.push_back(must(world.addShape(body, circle(0.1)))); }
        for (std::size_t i = shapes.size(); i > 1; --i) {
            std::swap(shapes[i - 1], shapes[static_cast<std::size_t>(random.integer(0, static_cast<int>(i) - 1))]);
        }
        for (const ShapeId shape : shapes) { must(world.destroyShape(shape)); }
    }

    /// Metres, radius included.
    double distanceFrom(std::size_t segment, DVec2 point) const {
        Polygon dot;
        dot.count = 1;
        return static_cast<double>(
            distance(segments[segment], dot, relativeTransform(pose, WorldTransform{point, {}})).distance);
    }
    /// The segment that is named is as near to the point as any other.
    void expectAt(DVec2 point, std::uint32_t segment, const std::string& what, double slack = 1e-4) const {
        ASSERT_LT(segment, segments.size()) << name << ": " << what;
        double least = std::numeric_limits<double>::infinity();
        for (std::size_t i = 0; i < segments.size(); ++i) { least = std::min(least, distanceFrom(i, point)); }
        EXPECT_LE(distanceFrom(segment, point), least + slack) << name << ": " << what << ' ' << segment;
    }
};

template <class Check>
void onTerrains(const Check& check) {
    for (std::uint64_t seed = 1; seed <= 12; ++seed) {
        Terrain terrain(seed, seed % 2 == 0, seed % 3 == 0 ? 0.05 : 0, seed % 4 < 2);
        check(terrain, seed);
    }
}

TEST(Segments, AreThoseThatRaysHit) {
    onTerrains([](Terrain& t, std::uint64_t seed) {
        Random random(seed);
        std::set<std::uint32_t> named;
        for (int i = 0; i < 200; ++i) {
            const double x = random.range(-12, 12);
            const double side = random.sign();  // from above, and from the side where it is solid
            const DVec2 from = apply(t.pose, vec(x, 5 * side));
            const double slant = random.range(-3, 3);
            const Vec2 way = rotate(t.pose.rotation, vec(slant, -10 * side));
            const CastHit first = t.world.castRay(from, way);
            if (!first) { continue; }
            EXPECT_EQ(first.shape, t.chain);
            t.expectAt(first.point, first.segment, "ray");
            named.insert(first.segment);
            int hits = 0;
            t.world.castRayAll(from, way, {}, [&](const CastHit& hit) {
                EXPECT_LT(hit.segment, t.segments.size()) << t.name;
                EXPECT_NEAR(t.distanceFrom(hit.segment, hit.point), 0, 1e-4) << t.name << ": each of a ray";
                if (hits++ == 0) { EXPECT_EQ(hit.segment, first.segment) << t.name; }
                return Real(1);
            });
        }
        EXPECT_GT(named.size(), t.segments.size() / 2) << t.name;
    });
}

TEST(Segments, AreThoseThatCastsMeet) {
    onTerrains([](Terrain& t, std::uint64_t seed) {
        Random random(seed);
        const Polygon ball = circle(0.2);
        const Polygon crate = box(0.2, 0.3);
        for (int i = 0; i < 100; ++i) {
            const double x = random.range(-12, 12);
            const double slant = random.range(-3, 3);
            const WorldTransform from{apply(t.pose, vec(x, 5)), rotationFromAngle(random.range(-3, 3))};
            const Vec2 way = rotate(t.pose.rotation, vec(slant, -10));
            const CastHit hit = t.world.castShape(i % 2 == 0 ? ball : crate, from, way);
            if (hit) { t.expectAt(hit.point, hit.segment, "cast", 1e-3); }
        }
    });
}

TEST(Segments, AreTheNearestOnes) {
    onTerrains([](Terrain& t, std::uint64_t seed) {
        Random random(seed);
        for (int i = 0; i < 100; ++i) {
            const double x = random.range(-14, 14);
            const DVec2 point = apply(t.pose, vec(x, random.range(-2, 4)));
            const NearestShape any = t.world.nearest(point, 100);
            ASSERT_TRUE(any.found);
            t.expectAt(point, any.segment, "nearest of all");
            EXPECT_EQ(t.world.nearest(t.chain, point).segment, any.segment) << t.name;
            const NearestShape crate = t.world.nearest(box(0.1, 0.2), {point, {}}, 100);
            t.expectAt(crate.point, crate.segment, "nearest to a box");
        }
    });
}

/// Of what falls on it, bounces and rolls about: contacts, and events of all types, name what is at their point.
TEST(Segments, AreThoseOfContactsAndEvents) {
    std::array<int, 5> told{};
    onTerrains([&told](Terrain& t, std::uint64_t seed) {
        Random random(seed);
        for (int i = 0; i < 12; ++i) {
            const double x = random.range(-8, 8);
            const double speed = random.range(-3, 3);
            ShapeDef def = material(0.3, 0.5);
            def.sensor = i % 6 == 5;
            const double fall = i % 4 == 0 ? 80 : 2;  // some are swept
            const BodyId body = must(t.world.createBody(dynamicAt(apply(t.pose, vec(x, 4)), vec(speed, -fall))));
            const Polygon crate = box(0.2, 0.3);
            must(t.world.addShape(body, i % 2 == 0 ? circle(0.25) : crate, def));
        }
        for (int step = 0; step < 240; ++step) {
            must(t.world.step(kStep));
            for (const ContactEvent& event : t.world.contactEvents()) {
                const bool isA = event.shapeA == t.chain;
                EXPECT_EQ(isA ? event.segmentB : event.segmentA, 0U) << "of what is no chain";
                if (!isA && event.shapeB != t.chain) { continue; }
                ++told[static_cast<std::size_t>(event.type)];
                const std::uint32_t segment = isA ? event.segmentA : event.segmentB;
                ASSERT_LT(segment, t.segments.size()) << t.name;
                if (event.point == DVec2{}) { continue; }  // apart, or gone
                const bool isOfSensor =
                    event.type == ContactEventType::sensorBegin || event.type == ContactEventType::sensorEnd;
                // Half way between the two surfaces, that of a sensor or of what is fast may be in the ground.
                t.expectAt(event.point, segment, "event", isOfSensor ? 0.35 : 0.1);
            }
            t.world.visitContacts([&](const ContactView& view) {
                const bool isA = view.shapeA == t.chain;
                if (isA || view.shapeB == t.chain) {
                    t.expectAt(view.point, isA ? view.segmentA : view.segmentB, "contact", 0.05);
                }
            });
        }
    });
    for (const int count : told) { EXPECT_GT(count, 20); }
}

/// A box laid on one segment is pushed on to the next two: it begins where it was laid, and ends where it left.
TEST(Segments, OfBeginAndEnd) {
    for (const Profile profile : kProfiles) {
        World world = makeWorld(profile);
        const std::array points{vec(30, 0), vec(20, 0), vec(10, 0), vec(0, 0)};
        const BodyId ground = must(world.createBody({}));
        const ShapeId chain = must(world.addChain(ground, points, false, material(0)));
        const BodyId body = addBody(world, dynamicAt({5, 0.5}, vec(10, 0)), box(0.5, 0.5), material(0));
        std::vector<std::pair<ContactEventType, std::uint32_t>> events;
        std::vector<std::uint32_t> under;
        for (int i = 0; i < 180; ++i) {
            run(world, 1);
            for (const ContactEvent& event : world.contactEvents()) {
                EXPECT_EQ(event.shapeA, chain);
                events.emplace_back(event.type, event.segmentA);
            }
            std::set<std::uint32_t> now;
            world.visitContacts(body, [&](const ContactView& view) { now.insert(view.segmentA); });
            if (now.size() == 1 && (under.empty() || under.back() != *now.begin())) { under.push_back(*now.begin()); }
        }
        const std::vector<std::pair<ContactEventType, std::uint32_t>> wanted{{ContactEventType::begin, 2},
                                                                             {ContactEventType::end, 0}};
        EXPECT_EQ(events, wanted) << profileName(profile);
        EXPECT_EQ(under, (std::vector<std::uint32_t>{2, 1, 0})) << profileName(profile);
    }
}

/// Ends that calls cause name it as well.
TEST(Segments, OfEndsByCalls) {
    World world = makeWorld();
    const std::array points{vec(20, 0), vec(10, 0), vec(0, 0)};
    const ShapeId chain = must(world.addChain(must(world.createBody({})), points, false));
    const BodyId body = addBody(world, dynamicAt({5, 0.5}), box(0.5, 0.5));
    run(world, 10);
    must(world.destroyBody(body));
    run(world, 1);
    ASSERT_EQ(world.contactEvents().size(), 1U);
    const ContactEvent& event = world.contactEvents()[0];
    EXPECT_EQ(event.type, ContactEventType::end);
    EXPECT_EQ(event.shapeA == chain ? event.segmentA : event.segmentB, 1U);
}

}  // namespace
}  // namespace swept::test
