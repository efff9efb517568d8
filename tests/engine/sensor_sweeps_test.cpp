#include <array>

#include "../support/random.h"
#include "world_support.h"

/// Sensors see what passes them within a step, where the way of the body is followed.

namespace swept::test {
namespace {

WorldSettings sweepSettings(ContinuousMode mode, double gravity = 0) {
    WorldSettings settings = awakeSettings(gravity);
    settings.continuous = mode;
    return settings;
}

struct ContactMode {
    ContinuousMode mode;
    std::size_t events;
};

std::vector<ContactEvent> sensorEventsOf(const World& world) {
    std::vector<ContactEvent> events;
    for (const ContactEvent& event : world.contactEvents()) {
        const bool isSensor = event.type == ContactEventType::sensorBegin || event.type == ContactEventType::sensorEnd;
        if (isSensor) { events.push_back(event); }
    }
    return events;
}

ShapeDef sweptSensorDef() {
    ShapeDef def;
    def.sensor = true;
    return def;
}

/// A gate of 20 cm in the middle of a way of 2 m, passed within one step: in and out at their times.
TEST(SensorSweeps, SeeWhatPassesWithinAStep) {
    for (const ContactMode mode : {ContactMode{ContinuousMode::subStep, 2}, ContactMode{ContinuousMode::stop, 2},
                                   ContactMode{ContinuousMode::off, 0}}) {
        World world = makeWorld(sweepSettings(mode.mode));
        const BodyId gate = addStatic(world, box(0.1, 1), sweptSensorDef());
        const BodyId ball = addBody(world, dynamicAt({-1, 0}, vec(120, 0)), circle(0.1));
        run(world, 1);
        const std::vector<ContactEvent> events = sensorEventsOf(world);
        ASSERT_EQ(events.size(), mode.events);
        EXPECT_EQ(world.counters().sensorSweeps, mode.events / 2);
        if (events.empty()) { continue; }
        EXPECT_EQ(events[0].type, ContactEventType::sensorBegin);
        EXPECT_EQ(events[1].type, ContactEventType::sensorEnd);
        EXPECT_NEAR(events[0].fraction, (1 - 0.2) / 2, 1e-3);
        EXPECT_NEAR(events[1].fraction, (1 + 0.2) / 2, 1e-3);
        EXPECT_EQ(events[0].bodyA, gate);
        EXPECT_EQ(events[0].bodyB, ball);
        EXPECT_LT(length(events[0].point - DVec2{-0.1, 0}), 1e-3);
        EXPECT_LT(length(events[1].point - DVec2{0.1, 0}), 1e-3);
        EXPECT_LT(length(events[0].normal - vec(-1, 0)), 1e-6);
        EXPECT_LT(length(events[1].normal - vec(1, 0)), 1e-6);
        run(world, 1);
        EXPECT_TRUE(sensorEventsOf(world).empty());
    }
}

/// To a wall and back through the same gate in one step: the way is followed from impact to impact.
TEST(SensorSweeps, FollowTheWayThroughItsImpacts) {
    World world = makeWorld(0);
    addStatic(world, box(0.1, 1), sweptSensorDef());
    addStatic(world, segment(0.6, -1, 0.6, 1), material(0, 1));
    const BodyId ball = addBody(world, dynamicAt({-0.5, 0}, vec(120, 0)), circle(0.1), material(0, 1));
    run(world, 1);
    EXPECT_NEAR(world.centerOfMass(ball).x, -0.5, 0.01);
    const std::vector<ContactEvent> events = sensorEventsOf(world);
    ASSERT_EQ(events.size(), 4U);
    const double expected[] = {0.15, 0.35, 0.65, 0.85};
    for (std::size_t i = 0; i < 4; ++i) {
        EXPECT_NEAR(events[i].fraction, expected[i], 1e-3);
        EXPECT_EQ(events[i].type == ContactEventType::sensorBegin, i % 2 == 0);
    }
}

/// Begin and end alternate, whatever stops inside, starts inside, turns, or is a sensor that moves.
TEST(SensorSweeps, WhatBeginsEnds) {
    Random random(12);
    std::size_t seen = 0;
    for (int round = 0; round < 48; ++round) {
        World world =
            makeWorld(sweepSettings(round % 2 == 0 ? ContinuousMode::subStep : ContinuousMode::stop, kGravity));
        for (const double side : {-1.0, 1.0}) {
            addStatic(world, segment(2 * side, -2, 2 * side, 2), material(0.2, 0.9));
            addStatic(world, segment(-2, 2 * side, 2, 2 * side), material(0.2, 0.9));
        }
        addStatic(world, box(0.05, 0.8), sweptSensorDef(), {0, 0}, random.range(0, 3));
        BodyDef def = bodyAt(BodyType::kinematic, {0.9, 0});
        def.angularVelocity = 40;
        addBody(world, def, box(0.7, 0.02), sweptSensorDef());
        for (int i = 0; i < 3; ++i) {
            const double speed = random.range(5, 300);
            const double aim = random.range(0, 2 * kPi);
            addBody(world,
                    dynamicAt({-1.2 + 0.6 * i, -1}, vec(speed * std::cos(aim), speed * std::sin(aim)),
                              random.range(-50, 50)),
                    i == 0 ? circle(0.1) : box(0.15, 0.02), material(0.2, 0.9));
        }
        std::vector<std::pair<std::uint32_t, std::uint32_t>> open;
        for (int step = 0; step < 60; ++step) {
            run(world, 1);
            for (const ContactEvent& event : sensorEventsOf(world)) {
                const auto key = std::make_pair(event.shapeA.index, event.shapeB.index);
                const auto found = std::find(open.begin(), open.end(), key);
                ASSERT_EQ(found == open.end(), event.type == ContactEventType::sensorBegin)
                    << "round " << round << ", step " << step << ", fraction " << event.fraction;
                ASSERT_TRUE(event.fraction >= 0 && event.fraction <= 1);
                if (found == open.end()) {
                    open.push_back(key);
                } else {
                    open.erase(found);
                }
                ++seen;
            }
        }
    }
    EXPECT_GT(seen, 2000U) << "too few to prove anything";
}

TEST(SensorSweeps, CostNothingWithoutSensorsOrSpeed) {
    World world = makeWorld(0);
    addBody(world, dynamicAt({-1, 0}, vec(120, 0)), circle(0.1));
    run(world, 1);
    EXPECT_EQ(world.counters().sensorSweeps + world.counters().toiCalls, 0U);
    const BodyId gate = addStatic(world, box(1, 1), sweptSensorDef(), {9, 0});
    addBody(world, dynamicAt({8, 0}, vec(1, 0)), circle(0.1));
    run(world, 2);
    EXPECT_EQ(world.counters().sensorSweeps, 0U);
    must(world.destroyBody(gate));
}

TEST(SensorSweeps, SeeWhatPassesAChain) {
    for (const bool isChain : {false, true}) {
        World world = makeWorld(sweepSettings(ContinuousMode::subStep));
        const BodyId gate = must(world.createBody({}));
        const std::array points{vec(0, -2), vec(0, 0), vec(0, 2)};
        if (isChain) {
            must(world.addChain(gate, points, false, sweptSensorDef()));
        } else {
            must(world.addShape(gate, segment(0, -2, 0, 2), sweptSensorDef()));
        }
        addBody(world, dynamicAt({-1, 0}, vec(120, 0)), circle(0.1));
        run(world, 1);
        const std::vector<ContactEvent> events = sensorEventsOf(world);
        ASSERT_EQ(events.size(), 2U) << (isChain ? "chain" : "segment");
        EXPECT_EQ(events[0].type, ContactEventType::sensorBegin);
        EXPECT_NEAR(events[0].fraction, 0.45, 1e-3);
        EXPECT_EQ(events[1].type, ContactEventType::sensorEnd);
        EXPECT_NEAR(events[1].fraction, 0.55, 1e-3);
    }
}

/// Both cross in the middle of the step, far from where either began.
TEST(SensorSweeps, OfFastBodiesSeeFastBodies) {
    for (const BroadphaseKind kind : {BroadphaseKind::automatic, BroadphaseKind::allPairs}) {
        WorldSettings settings = sweepSettings(ContinuousMode::subStep);
        settings.broadphase = kind;
        World world = makeWorld(settings);
        const BodyId scanner = addBody(world, dynamicAt({-1, 0}, vec(120, 0)), circle(0.05));
        must(world.addShape(scanner, circle(0.1), sweptSensorDef()));
        addBody(world, dynamicAt({0, -1}, vec(0, 120)), circle(0.1));
        run(world, 1);
        const std::vector<ContactEvent> events = sensorEventsOf(world);
        ASSERT_EQ(events.size(), 2U);
        // The gap is √2·|1 − 2f| metres at first, and they meet at 0.2.
        EXPECT_NEAR(events[0].fraction, 0.5 - 0.1 / std::sqrt(2.0), 1e-3);
        EXPECT_NEAR(events[1].fraction, 0.5 + 0.1 / std::sqrt(2.0), 1e-3);
    }
}

/// Wherever their ways lie: in a column, in a row, or all over the place; beside those of others.
TEST(SensorSweeps, OfManyFastBodiesSeeTheirOwnOnes) {
    for (const DVec2 apart : {DVec2{0, 5}, DVec2{5, 0}, DVec2{3, 4}}) {
        World world = makeWorld(sweepSettings(ContinuousMode::subStep));
        constexpr int kPairs = 150;
        for (int i = 0; i < kPairs; ++i) {
            const DVec2 place = (i * 37 % kPairs) * apart;
            const BodyId scanner = addBody(world, dynamicAt(place + DVec2{-1, 0}, vec(120, 0)), circle(0.05));
            must(world.addShape(scanner, circle(0.1), sweptSensorDef()));
            addBody(world, dynamicAt(place + DVec2{0, -1}, vec(0, 120)), circle(0.1));
        }
        run(world, 1);
        EXPECT_EQ(sensorEventsOf(world).size(), 2U * kPairs);
        EXPECT_EQ(world.counters().sensorSweeps, kPairs);
    }
}

/// Thrown up so that it is at the same height at both ends of a step of 0.2 s, and 5 cm higher in its middle.
TEST(SensorSweeps, SeeTheTopOfAParabola) {
    WorldSettings settings = sweepSettings(ContinuousMode::subStep, kGravity);
    World world = makeWorld(settings);
    addStatic(world, box(10, 0.1), sweptSensorDef(), {0, 0.33});  // its bottom at 0.23
    addBody(world, dynamicAt({0, 0}, vec(10, 1)), circle(0.2));
    run(world, 1, 0.2);
    const std::vector<ContactEvent> events = sensorEventsOf(world);
    ASSERT_EQ(events.size(), 2U);
    // 0.2 + t − 5·t² = 0.23
    const double away = std::sqrt(1 - 0.6) / 10;
    EXPECT_NEAR(events[0].fraction * 0.2, 0.1 - away, 1e-3);
    EXPECT_NEAR(events[1].fraction * 0.2, 0.1 + away, 1e-3);
}

/// A ball that touches at the start and leaves at once; balls that graze.
TEST(SensorSweeps, NeverTellTheEndBeforeItsBegin) {
    int seen = 0;
    for (int i = 0; i < 400; ++i) {
        World world = makeWorld(sweepSettings(ContinuousMode::subStep));
        addStatic(world, circle(0.3), sweptSensorDef());
        const bool leaves = i % 4 == 0;
        const double y = 0.4999 + 0.0002 * i / 400;
        addBody(world, leaves ? dynamicAt({0.5, 0}, vec(100, 0)) : dynamicAt({-0.8, y}, vec(100, 0)), circle(0.2));
        run(world, 1);
        const std::vector<ContactEvent> events = sensorEventsOf(world);
        ASSERT_EQ(events.size() % 2, 0U);
        for (std::size_t k = 0; k < events.size(); k += 2) {
            ASSERT_EQ(events[k].type, ContactEventType::sensorBegin) << "y = " << y;
            ASSERT_EQ(events[k + 1].type, ContactEventType::sensorEnd);
            EXPECT_GT(length(toReal(events[k + 1].point)), real(0.1)) << "where they were, not at the origin";
            ++seen;
        }
    }
    EXPECT_GT(seen, 100);
}

/// Feet of a character that stands, jumps and lands: on a box, on a chain of three segments, on what moves.
TEST(Sensors, OfWhatMovesSeeTheGround) {
    for (const int ground : {0, 1, 2}) {
        World world = makeWorld(awakeSettings());
        BodyDef def;
        def.type = ground == 2 ? BodyType::kinematic : BodyType::fixed;
        const BodyId floor = must(world.createBody(def));
        const std::array points{vec(10, 0), vec(0.1, 0), vec(-0.1, 0), vec(-10, 0)};
        const ShapeId shape = ground == 1 ? must(world.addChain(floor, points, false, {}))
                                          : must(world.addShape(floor, must(makeBox(vec(10, 0.5), vec(0, -0.5)))));
        def = dynamicAt({0, 1});
        def.fixedRotation = true;
        const BodyId hero = addBody(world, def, box(0.4, 0.9));
        const ShapeId foot = must(world.addShape(hero, must(makeBox(vec(0.3, 0.1), vec(0, -0.9))), sweptSensorDef()));
        const ShapeId head = must(world.addShape(hero, must(makeBox(vec(0.3, 0.1), vec(0, 0.9))), sweptSensorDef()));
        std::vector<ContactEvent> events;
        for (int i = 0; i < 150; ++i) {
            if (i == 60) { must(world.setVelocity(hero, vec(0, 4), 0)); }
            run(world, 1);
            const std::vector<ContactEvent> more = sensorEventsOf(world);
            events.insert(events.end(), more.begin(), more.end());
        }
        ASSERT_EQ(events.size(), 3U) << ground;
        for (std::size_t i = 0; i < 3; ++i) {
            EXPECT_EQ(events[i].type, i == 1 ? ContactEventType::sensorEnd : ContactEventType::sensorBegin);
            EXPECT_EQ(events[i].shapeA, foot);
            EXPECT_EQ(events[i].shapeB, shape);
        }
        std::vector<ShapeId> below;
        world.visitOverlaps(foot, [&](ShapeId other) { below.push_back(other); });
        EXPECT_EQ(below, std::vector{shape});
        world.visitOverlaps(head, [](ShapeId) { FAIL(); });
        must(world.destroyBody(floor));
        run(world, 1);
        ASSERT_EQ(sensorEventsOf(world).size(), 1U);
        EXPECT_EQ(sensorEventsOf(world)[0].type, ContactEventType::sensorEnd);
    }
}

/// A probe that flies through a wall in a step, and one that is put over a wall while it sleeps.
TEST(Sensors, OfWhatMovesSeeWallsTheyPass) {
    World world = makeWorld(0);
    const BodyId wall = addStatic(world, box(0.05, 5));
    const BodyId probe = must(world.createBody(dynamicAt({-3, 0}, vec(240, 0))));
    must(world.addShape(probe, circle(0.1), sweptSensorDef()));
    run(world, 1);
    const std::vector<ContactEvent> events = sensorEventsOf(world);
    ASSERT_EQ(events.size(), 2U);
    EXPECT_NEAR(events[0].fraction, (3 - 0.15) / 4, 1e-3);
    EXPECT_NEAR(events[1].fraction, (3 + 0.15) / 4, 1e-3);
    EXPECT_EQ(events[0].bodyB, wall);
    must(world.setPose(probe, {20, 0}, 0));
    must(world.setVelocity(probe, {}, 0));
    must(world.setAwake(probe, false));
    run(world, 2);
    must(world.setPose(wall, {20, 0}, 0));
    run(world, 1);
    ASSERT_EQ(sensorEventsOf(world).size(), 1U);
    EXPECT_EQ(sensorEventsOf(world)[0].type, ContactEventType::sensorBegin);
}

/// Until what has them can move.
TEST(Sensors, OfFixedBodiesSeeNoGround) {
    World world = makeWorld(0);
    addStatic(world, box(5, 0.5));
    const BodyId gate = addStatic(world, box(1, 1), sweptSensorDef());
    addStatic(world, box(1, 1), sweptSensorDef(), {0.5, 0});
    run(world, 2);
    EXPECT_TRUE(sensorEventsOf(world).empty());
    EXPECT_EQ(world.counters().contacts, 0U);
    BodyDef def = world.definition(gate);
    def.type = BodyType::kinematic;
    must(world.redefine(gate, def));
    run(world, 1);
    EXPECT_EQ(sensorEventsOf(world).size(), 1U);
    def.type = BodyType::fixed;
    must(world.redefine(gate, def));
    run(world, 1);
    ASSERT_EQ(sensorEventsOf(world).size(), 1U);
    EXPECT_EQ(sensorEventsOf(world)[0].type, ContactEventType::sensorEnd);
    EXPECT_EQ(world.counters().contacts, 0U);
}

}  // namespace
}  // namespace swept::test
