#include <map>
#include <set>
#include <tuple>

#include "thrown_crowd.h"

/// Who touches one body or one sensor, asked of it alone: as the list of all contacts and the events have it.

namespace swept::test {
namespace {

using Point = std::tuple<std::uint32_t, std::uint32_t, double, double>;  // shapes, place

Point pointOf(const ContactView& view) { return {view.shapeA.index, view.shapeB.index, view.point.x, view.point.y}; }

/// Some of many kinds in a chamber of chains, one of them with a sensor about it; a sensor that stands, and one of two
/// that moves among them.
struct Chamber {
    World world;
    std::vector<BodyId> bodies;
    std::vector<ShapeId> sensors;

    Chamber(std::uint64_t seed, bool sleep) {
        WorldSettings settings = awakeSettings();
        settings.sleep = sleep;
        world = makeWorld(settings);
        const BodyId walls = world.createBody({}).value();
        const std::array corners{vec(-9, -9), vec(-9, 9), vec(9, 9), vec(9, -9)};  // clockwise: solid outside
        must(world.addChain(walls, corners, true, material(0.5)));
        Random random(seed);
        bodies = throwCrowd(world, random, 60, [](int, BodyDef&, ShapeDef&) {});
        addSensor(walls, circle(3));
        addSensor(bodies[0], circle(1.5));
        BodyDef lift;
        lift.type = BodyType::kinematic;
        lift.velocity = vec(2, 1);
        addSensor(world.createBody(lift).value(), box(2, 2));
    }
    void addSensor(BodyId body, const Polygon& shape) {
        ShapeDef def;
        def.sensor = true;
        def.density = 0;
        sensors.push_back(must(world.addShape(body, shape, def)));
    }
    std::set<std::uint32_t> overlapsOf(ShapeId sensor) {
        std::set<std::uint32_t> found;
        world.visitOverlaps(sensor, [&](ShapeId other) { EXPECT_TRUE(found.insert(other.index).second); });
        return found;
    }
};

void expectEachHasItsOwn(Chamber& chamber) {
    std::map<std::uint32_t, std::vector<Point>> wanted;
    chamber.world.visitContacts([&](const ContactView& view) {
        wanted[view.bodyA.index].push_back(pointOf(view));
        wanted[view.bodyB.index].push_back(pointOf(view));
    });
    for (const BodyId body : chamber.bodies) {
        std::vector<Point> found;
        chamber.world.visitContacts(body, [&](const ContactView& view) {
            EXPECT_TRUE(view.bodyA == body || view.bodyB == body);
            found.push_back(pointOf(view));
        });
        ASSERT_EQ(found, wanted[body.index]);
    }
}

class TouchVisits : public testing::TestWithParam<bool> {};
INSTANTIATE_TEST_SUITE_P(Sleep, TouchVisits, testing::Bool());

TEST_P(TouchVisits, OfOneBodyAreThoseOfTheListOfAll) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        Chamber chamber(seed, GetParam());
        std::size_t points = 0;
        for (int i = 0; i < 400; ++i) {
            must(chamber.world.step(kStep));
            if (i % 40 != 39) { continue; }
            ASSERT_NO_FATAL_FAILURE(expectEachHasItsOwn(chamber));
            // What goes between two steps, before or after the contacts were listed, has none any more.
            must(chamber.world.destroyBody(chamber.bodies.back()));
            chamber.world.visitContacts(chamber.bodies.back(), [](const ContactView&) { FAIL(); });
            chamber.bodies.pop_back();
            ASSERT_NO_FATAL_FAILURE(expectEachHasItsOwn(chamber));
            chamber.world.visitContacts([&points](const ContactView&) { ++points; });
        }
        EXPECT_GT(points, 100u);
    }
}

/// What other settings bring back from where it was set aside stands elsewhere among the contacts by then, however many
/// questions were asked, and whatever went before.
TEST_P(TouchVisits, AreTheSameUnderOtherSettings) {
    std::uint64_t aside = 0;
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        Chamber chamber(seed, GetParam());
        runFor(chamber.world, 15);
        for (int round = 0; round < 6; ++round) {
            SCOPED_TRACE(testing::Message() << "round " << round);
            runFor(chamber.world, 1);
            aside += chamber.world.counters().settledBodies;
            for (const BodyId body : chamber.bodies) { aside += chamber.world.isAwake(body) ? 0U : 1U; }
            ASSERT_NO_FATAL_FAILURE(expectEachHasItsOwn(chamber));
            if (round % 2 == 1) {
                must(chamber.world.destroyBody(chamber.bodies.back()));
                chamber.bodies.pop_back();
            }
            for (const BodyId body : chamber.bodies) { must(chamber.world.setAwake(body, true)); }
            WorldSettings settings = chamber.world.settings();
            settings.subSteps = 4 + round;
            must(chamber.world.configure(settings));
            ASSERT_NO_FATAL_FAILURE(expectEachHasItsOwn(chamber));
            must(chamber.world.destroyBody(chamber.bodies.back()));
            chamber.bodies.pop_back();
            ASSERT_NO_FATAL_FAILURE(expectEachHasItsOwn(chamber));
        }
    }
    EXPECT_GT(aside, 100U) << "too little was set aside";
}

TEST_P(TouchVisits, OfASensorAreWhatEventsTell) {
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
        SCOPED_TRACE(testing::Message() << "seed " << seed);
        Chamber chamber(seed, GetParam());
        std::map<std::uint32_t, std::set<std::uint32_t>> inside;
        std::size_t begins = 0;
        for (int i = 0; i < 400; ++i) {
            must(chamber.world.step(kStep));
            for (const ContactEvent& event : chamber.world.contactEvents()) {
                if (event.type == ContactEventType::sensorBegin) {
                    EXPECT_TRUE(inside[event.shapeA.index].insert(event.shapeB.index).second);
                    ++begins;
                }
                if (event.type == ContactEventType::sensorEnd) { inside[event.shapeA.index].erase(event.shapeB.index); }
            }
            for (const ShapeId sensor : chamber.sensors) {
                ASSERT_EQ(chamber.overlapsOf(sensor), inside[sensor.index]) << "step " << i;
            }
        }
        EXPECT_GT(begins, 30u);
    }
}

TEST(TouchVisits, MayAskAgainMeanwhile) {
    Chamber chamber(4, false);
    runFor(chamber.world, 3);
    std::size_t outer = 0;
    std::size_t inner = 0;
    for (const BodyId body : chamber.bodies) {
        chamber.world.visitContacts(body, [&](const ContactView& view) {
            ++outer;
            const BodyId other = view.bodyA == body ? view.bodyB : view.bodyA;
            bool isMutual = false;
            chamber.world.visitContacts(
                other, [&](const ContactView& back) { isMutual = isMutual || pointOf(back) == pointOf(view); });
            inner += isMutual ? 1 : 0;
        });
    }
    EXPECT_GT(outer, 50u);
    EXPECT_EQ(inner, outer);
}

TEST(TouchVisits, OfASensorPutOverWhatSleeps) {
    WorldSettings settings = awakeSettings();
    settings.sleep = true;
    World world = makeWorld(settings);
    const BodyId ground = addStatic(world, box(10, 1));
    const BodyId sleeper = addBody(world, dynamicAt({0, 1.5}), box(0.5, 0.5));
    runFor(world, 3);
    ASSERT_FALSE(world.isAwake(sleeper));
    ShapeDef def;
    def.sensor = true;
    const ShapeId sensor = must(world.addShape(ground, circle(2), def));
    must(world.step(kStep));
    ASSERT_EQ(world.contactEvents().size(), 1u);
    EXPECT_EQ(world.contactEvents()[0].type, ContactEventType::sensorBegin);
    run(world, 10);
    EXPECT_TRUE(world.contactEvents().empty());
    EXPECT_FALSE(world.isAwake(sleeper));
    int count = 0;
    world.visitOverlaps(sensor, [&](ShapeId other) { count += world.bodyOf(other) == sleeper ? 1 : 0; });
    EXPECT_EQ(count, 1);
    must(world.destroyBody(sleeper));
    world.visitOverlaps(sensor, [](ShapeId) { FAIL(); });
    must(world.step(kStep));
    ASSERT_EQ(world.contactEvents().size(), 2u);  // of the touch of the ground as well
    int ends = 0;
    for (const ContactEvent& event : world.contactEvents()) {
        ends += event.type == ContactEventType::sensorEnd && event.shapeA == sensor ? 1 : 0;
    }
    EXPECT_EQ(ends, 1);
}

TEST(TouchVisits, OfWhatIsGoneOrNoSensorAreNone) {
    Chamber chamber(5, false);
    runFor(chamber.world, 1);
    chamber.world.visitContacts(BodyId{}, [](const ContactView&) { FAIL(); });
    chamber.world.visitShapes(chamber.bodies[1],
                              [&](ShapeId solid) { chamber.world.visitOverlaps(solid, [](ShapeId) { FAIL(); }); });
    must(chamber.world.destroyShape(chamber.sensors[0]));
    chamber.world.visitOverlaps(chamber.sensors[0], [](ShapeId) { FAIL(); });
}

/// Present touches in the new parts kept the touch in the old ones from ending.
TEST(TouchVisits, ASensorAndAChainThatChangePartsEndTheOldTouch) {
    for (const bool sensorFirst : {false, true}) {
        World world = makeWorld(0);
        ShapeDef sensor;
        sensor.sensor = true;
        const ShapeId first = must(world.addShape(must(world.createBody({})), box(1, 1), sensor));
        const std::array points{vec(0.5, 0), vec(0, 0.1), vec(-0.5, 0)};
        const ShapeId chain =
            must(world.addChain(must(world.createBody(bodyAt(BodyType::kinematic, {}))), points, false, {}));
        must(world.step(kStep));
        ASSERT_EQ(world.contactEvents().size(), 1U);
        must(world.redefine(sensorFirst ? first : chain, sensorFirst ? ShapeDef{} : sensor));
        must(world.redefine(sensorFirst ? chain : first, sensorFirst ? sensor : ShapeDef{}));
        must(world.step(kStep));
        int ends = 0;
        for (const ContactEvent& event : world.contactEvents()) {
            const bool isOld = event.shapeA == first && event.shapeB == chain;
            ends += isOld && event.type == ContactEventType::sensorEnd ? 1 : 0;
            EXPECT_EQ(isOld, event.type == ContactEventType::sensorEnd);
        }
        EXPECT_EQ(ends, 1) << sensorFirst;
    }
}

}  // namespace
}  // namespace swept::test
