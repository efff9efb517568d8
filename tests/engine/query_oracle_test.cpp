#include <optional>

#include <swept/shapes/chain.h>
#include <swept/shapes/distance.h>
#include <swept/shapes/ray_cast.h>

#include "../support/random.h"
#include "query_scenery.h"
#include "world_support.h"

/// Queries against a walk over all shapes, in random worlds.

namespace swept::test {
namespace {

TEST(Queries, RaysAgreeWithAWalkOverAllShapes) {
    int hits = 0;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        for (const DVec2 origin : origins()) {
            Scenery s(seed, origin);
            for (int i = 0; i < 100; ++i) {
                const QueryFilter query = s.filter();
                const DVec2 from = s.place(10);
                const Vec2 along = toReal(s.place(10) - from);
                const CastHit hit = s.world.castRay(from, along, query);
                const std::optional<Real> wanted = s.rayFraction(query, from, along);
                ASSERT_EQ(hit.hit, wanted.has_value()) << "seed " << seed << " ray " << i;
                if (!hit.hit) { continue; }
                ++hits;
                ASSERT_NEAR(static_cast<double>(hit.fraction), static_cast<double>(*wanted),
                            16 * static_cast<double>(kEpsilon))
                    << "seed " << seed << " ray " << i;
                ASSERT_TRUE(s.world.isValid(hit.shape));
                ASSERT_EQ(s.world.bodyOf(hit.shape), hit.body);
                const DVec2 point = from + static_cast<double>(hit.fraction) * toDouble(along);
                ASSERT_LT(length(hit.point - point), 1e-4) << "seed " << seed << " ray " << i;
            }
        }
    }
    EXPECT_GT(hits, 1'000);
}

TEST(Queries, RaysAtOneShapeMeetIt) {
    int hits = 0;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        for (const DVec2 origin : origins()) {
            Scenery s(seed, origin);
            for (int i = 0; i < 20; ++i) {
                const DVec2 from = s.place(10);
                const Vec2 along = toReal(s.place(10) - from);
                for (const Item& item : s.items) {
                    // The nearest of what its shapes answer is the nearest of the body.
                    std::optional<Real> nearest;
                    s.world.visitShapes(item.body, [&](ShapeId shape) {
                        const CastHit hit = s.world.castRay(shape, from, along);
                        if (!hit.hit) { return; }
                        ASSERT_EQ(hit.shape, shape);
                        ASSERT_EQ(hit.body, item.body);
                        ASSERT_LT(hit.segment, s.world.segmentCount(shape));
                        const DVec2 point = from + static_cast<double>(hit.fraction) * toDouble(along);
                        ASSERT_LT(length(hit.point - point), 1e-4) << "seed " << seed << " ray " << i;
                        if (!nearest || hit.fraction < *nearest) { nearest = hit.fraction; }
                    });
                    const std::optional<Real> wanted = s.rayFraction(item, from, along);
                    ASSERT_EQ(nearest.has_value(), wanted.has_value()) << "seed " << seed << " ray " << i;
                    if (!nearest) { continue; }
                    ++hits;
                    ASSERT_NEAR(static_cast<double>(*nearest), static_cast<double>(*wanted),
                                16 * static_cast<double>(kEpsilon))
                        << "seed " << seed << " ray " << i;
                }
            }
        }
    }
    EXPECT_GT(hits, 1'000);
    World world = makeWorld();
    const BodyId body = world.createBody({}).value();
    const ShapeId shape = world.addShape(body, box(1, 1)).value();
    EXPECT_TRUE(world.castRay(shape, {-5, 0}, vec(10, 0)).hit);
    EXPECT_FALSE(world.castRay(shape, {-5, 0}, vec(0, 0)).hit);
    EXPECT_FALSE(world.castRay(ShapeId{}, {-5, 0}, vec(10, 0)).hit);
    EXPECT_FALSE(world.castRay(shape, {std::numeric_limits<double>::quiet_NaN(), 0}, vec(10, 0)).hit);
    ASSERT_TRUE(world.setEnabled(body, false).ok());
    EXPECT_FALSE(world.castRay({-5, 0}, vec(10, 0)).hit);
    EXPECT_TRUE(world.castRay(shape, {-5, 0}, vec(10, 0)).hit);
    ASSERT_TRUE(world.destroyShape(shape).ok());
    EXPECT_FALSE(world.castRay(shape, {-5, 0}, vec(10, 0)).hit);
}

TEST(Queries, OverlapsAgreeWithAWalkOverAllShapes) {
    int found = 0;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        for (const DVec2 origin : origins()) {
            Scenery s(seed, origin);
            for (int i = 0; i < 50; ++i) {
                const QueryFilter query = s.filter();
                const Polygon polygon = anyPolygon(s.random);
                const WorldTransform where{s.place(8), rotationFromAngle(s.random.range(-4, 4))};
                std::vector<ShapeId> seen;
                s.world.overlapShape(polygon, where, query, [&](ShapeId id) {
                    seen.push_back(id);
                    return true;
                });
                for (const Item& item : s.items) {
                    const auto count =
                        std::count_if(seen.begin(), seen.end(), [&](ShapeId id) { return s.isOf(item, id); });
                    const Real gap = s.distanceTo(item, polygon, where);
                    if (std::fabs(gap) < real(1e-5)) { continue; }  // may go either way
                    const bool wanted = sees(query, item) && gap <= 0;
                    ASSERT_EQ(count > 0, wanted) << "seed " << seed << " query " << i << " gap " << gap;
                    found += wanted ? 1 : 0;
                }
                std::sort(seen.begin(), seen.end(), [](ShapeId a, ShapeId b) { return a.index < b.index; });
                ASSERT_EQ(std::adjacent_find(seen.begin(), seen.end()), seen.end()) << "visited twice";
            }
        }
    }
    EXPECT_GT(found, 300);
}

/// What is nearest to a point or a polygon, and how near each shape by itself is.
TEST(Queries, NearestAgreesWithAWalkOverAllShapes) {
    int found = 0;
    int overlapping = 0;
    int none = 0;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        for (const DVec2 origin : origins()) {
            Scenery s(seed, origin);
            for (int i = 0; i < 60; ++i) {
                const std::string name = "seed " + std::to_string(seed) + ", query " + std::to_string(i);
                const QueryFilter query = s.filter();
                const bool isPoint = i % 2 == 0;
                const Polygon polygon = isPoint ? point() : anyPolygon(s.random);
                const DVec2 place = s.place(12);
                const Rotation rotation = isPoint ? Rotation{} : rotationFromAngle(s.random.range(-4, 4));
                const WorldTransform where{place, rotation};
                const Real reach = real(std::exp(s.random.range(-3, 6)));
                const NearestShape nearest =
                    isPoint ? s.world.nearest(place, reach, query) : s.world.nearest(polygon, where, reach, query);
                const Real wanted = s.clearance(query, polygon, where);
                ASSERT_EQ(nearest.found, wanted <= reach) << name;
                none += nearest.found ? 0 : 1;
                if (!nearest.found) { continue; }
                ++found;
                ASSERT_EQ(nearest.distance, wanted) << name;
                overlapping += wanted < 0 ? 1 : 0;
                ASSERT_EQ(s.world.bodyOf(nearest.shape), nearest.body) << name;
                ASSERT_NEAR(static_cast<double>(length(nearest.normal)), 1, 1e-5) << name;
                // It lies on the surface of that shape; from there the normal leads to the point that asks.
                const NearestShape onIt = s.world.nearest(nearest.shape, nearest.point);
                ASSERT_EQ(onIt.shape, nearest.shape) << name;
                int parts = 0;
                s.world.visitPolygons(nearest.shape, [&parts](const Polygon&) { ++parts; });
                const double hidden = parts > 1 ? 0.02 : 0;  // the corner of a chain may be within the next segment
                ASSERT_LE(static_cast<double>(onIt.distance), 2e-5) << name;
                ASSERT_GE(static_cast<double>(onIt.distance), -2e-5 - hidden) << name;
                if (!isPoint) { continue; }
                const DVec2 there = nearest.point + static_cast<double>(nearest.distance) * toDouble(nearest.normal);
                ASSERT_LT(length(there - place), 2e-5) << name;
                const NearestShape alone = s.world.nearest(nearest.shape, place);
                ASSERT_EQ(alone.distance, nearest.distance) << name;
                ASSERT_EQ(alone.point, nearest.point) << name;
            }
        }
    }
    EXPECT_GT(found, 500);
    EXPECT_GT(overlapping, 50);
    EXPECT_GT(none, 50);
}

TEST(Queries, BoxesSeeEachShapeOnce) {
    int found = 0;
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
        Scenery s(seed, {});
        for (int i = 0; i < 50; ++i) {
            const QueryFilter query = s.filter();
            const Vec2 lower = toReal(s.place(8));
            const Vec2 size = toReal(s.place(2.5)) + vec(2.5, 2.5);
            const Aabb area{lower, lower + size};
            std::vector<ShapeId> seen;
            s.world.queryBox(area, query, [&](ShapeId id) {
                seen.push_back(id);
                return true;
            });
            for (const Item& item : s.items) {
                bool wanted = false;
                for (const Polygon& part : item.parts) {
                    wanted = wanted || overlaps(area, boundsOf(part, s.pose(item)));
                }
                wanted = wanted && sees(query, item);
                const bool got = std::any_of(seen.begin(), seen.end(), [&](ShapeId id) { return s.isOf(item, id); });
                ASSERT_EQ(got, wanted) << "seed " << seed << " query " << i;
                found += wanted ? 1 : 0;
            }
            std::sort(seen.begin(), seen.end(), [](ShapeId a, ShapeId b) { return a.index < b.index; });
            ASSERT_EQ(std::adjacent_find(seen.begin(), seen.end()), seen.end()) << "visited twice";
        }
    }
    EXPECT_GT(found, 300);
}

/// How far a cast that starts so far from the nearest shape may be lifted off what it stands on, metres, and be nearer
/// to other shapes by that.
Real liftFrom(Real clearance) {
    const Real near = real(2e-3);
    return clearance < near ? 2 * (near - clearance) : Real(0);
}

/// A cast that reports a hit stands within the target there, and was clear at every sampled moment before; one that
/// reports none was clear all the way. What starts in contact gets no deeper into anything than that allows.
TEST(Queries, CastShapesStopAtTheFirstThing) {
    int hits = 0;
    int misses = 0;
    int inContact = 0;
    for (std::uint64_t seed = 0; seed < 12; ++seed) {
        for (const DVec2 origin : origins()) {
            Scenery s(seed, origin);
            QueryFilter query;
            Polygon polygon;
            WorldTransform from;
            bool goesOn = false;  // from where the last one stopped, in contact
            for (int i = 0; i < 40; ++i) {
                if (!goesOn || i % 16 != 15) {
                    query = s.filter();
                    polygon = anyPolygon(s.random);
                    from.position = s.place(10);
                    from.rotation = rotationFromAngle(s.random.range(-4, 4));
                }
                const Vec2 along = toReal(s.place(10) - from.position);
                const CastHit hit = s.world.castShape(polygon, from, along, query);
                const auto at = [&](double t) {
                    return WorldTransform{from.position + t * toDouble(along), from.rotation};
                };
                const double end = hit.hit ? static_cast<double>(hit.fraction) : 1;
                const Real lift = liftFrom(s.clearance(query, polygon, from));
                const Real allowed = real(2e-5) + lift;
                inContact += lift > 0 && end > 0 ? 1 : 0;
                for (int k = 0; k < 64 && end > 0; ++k) {
                    const double t = end * k / 64;
                    ASSERT_GT(s.clearance(query, polygon, at(t)), -allowed)
                        << "seed " << seed << " cast " << i << " passes something at " << t << " of " << end;
                }
                (hit.hit ? hits : misses) += 1;
                goesOn = false;
                if (!hit.hit) { continue; }
                ASSERT_TRUE(s.world.isValid(hit.shape));
                ASSERT_EQ(s.world.bodyOf(hit.shape), hit.body);
                const Real gap = s.clearance(query, polygon, at(end));
                ASSERT_LT(gap, real(2e-3) + lift) << "seed " << seed << " cast " << i;
                from = at(end);
                goesOn = true;
            }
        }
    }
    EXPECT_GT(inContact, 5);
    EXPECT_LT(inContact, 50) << "the others are held to more";
    EXPECT_GT(hits, 200);
    EXPECT_GT(misses, 50);
}

TEST(Queries, VisitorsMayStop) {
    Scenery s(3, {});
    int calls = 0;
    s.world.queryBox({vec(-20, -20), vec(20, 20)}, {.sensors = true}, [&](ShapeId) { return ++calls < 3; });
    EXPECT_EQ(calls, 3);
}

/// Who looks around does not see itself, but sees what has its slot later.
TEST(Queries, LeaveOutOneBody) {
    World world = makeWorld();
    const BodyId self = addBody(world, dynamicAt({0, 0}), circle(0.5));
    const BodyId other = addBody(world, dynamicAt({3, 0}), circle(0.5));
    const QueryFilter filter{.ignore = self};
    EXPECT_EQ(world.castRay({0, 0}, vec(9, 0)).body, self);
    EXPECT_EQ(world.castRay({0, 0}, vec(9, 0), filter).body, other);
    EXPECT_EQ(world.castShape(circle(0.5), {{0, 0}, {}}, vec(9, 0), filter).body, other);
    EXPECT_EQ(world.bodyOf(world.nearest({0, 0}, 9, filter).shape), other);
    must(world.destroyBody(self));
    const BodyId next = addBody(world, dynamicAt({0, 0}), circle(0.5));
    ASSERT_EQ(next.index, self.index);
    EXPECT_EQ(world.castRay({0, 0}, vec(9, 0), filter).body, next);
}

/// Their boxes are made as a step begins, for all of it, however long it is and wherever they were put before.
TEST(Queries, SeeKinematicBodiesWhereAStepLeftThem) {
    for (const Real maxSpeed : {std::numeric_limits<Real>::infinity(), real(5)}) {
        WorldSettings settings = awakeSettings();
        settings.maxSpeed = maxSpeed;
        World world = makeWorld(settings);
        const BodyId body = addBody(world, bodyAt(BodyType::kinematic, {1, 2}), box(2, 0.1));
        for (int i = 0; i < 60; ++i) {
            must(world.setVelocity(body, vec(20 * std::sin(i), 9 * std::cos(i)), real(12 * std::sin(0.5 * i))));
            if (i % 7 == 0) { must(world.setPose(body, {0.3 * i, -2}, i)); }
            must(world.step(i % 5 == 0 ? 4 * kStep : (i % 3 == 0 ? kStep / 8 : kStep)));
            if (i % 11 == 0) { must(world.setVelocity(body, {}, 0)); }
            for (const double end : {-1.99, 1.99}) {
                const DVec2 point = world.position(body) + turned({end, 0}, world.angle(body));
                int seen = 0;
                world.overlapShape(circle(0.001), {point, {}}, {}, [&](ShapeId) { return ++seen > 0; });
                EXPECT_EQ(seen, 1) << "step " << i << ", up to " << maxSpeed << " m/s";
            }
        }
    }
}

TEST(Queries, RayVisitorsSeeAllThatIsOnTheRay) {
    World world = makeWorld();
    for (int i = 0; i < 5; ++i) { addStatic(world, circle(0.25), {}, {2.0 * i, 0}); }
    std::vector<double> fractions;
    world.castRayAll({-1, 0}, vec(20, 0), {}, [&](const CastHit& hit) {
        fractions.push_back(static_cast<double>(hit.fraction));
        return Real(1);
    });
    std::sort(fractions.begin(), fractions.end());
    ASSERT_EQ(fractions.size(), 5u);
    for (std::size_t i = 0; i < 5; ++i) { EXPECT_NEAR(fractions[i], (0.75 + 2.0 * static_cast<double>(i)) / 20, 1e-6); }
}

}  // namespace
}  // namespace swept::test
