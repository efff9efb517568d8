#include <algorithm>
#include <map>
#include <set>
#include <tuple>

#include "../support/random.h"
#include "world_support.h"

/// Events: what begins ends, hits say when and how fast, and all come in order. Who wakes whom. What steps count.

namespace swept::test {
namespace {

using EventPair = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t, std::uint32_t>;

EventPair pairOf(const ContactEvent& e) {
    return {e.shapeA.index, e.shapeA.generation, e.shapeB.index, e.shapeB.generation};
}

/// Reads events after every step, as a game does, and keeps the set of what touches.
class Listener {
public:
    void listen(const World& world) {
        for (const ContactEvent& event : world.contactEvents()) {
            if (event.type == ContactEventType::hit) { continue; }
            const bool begins = event.type == ContactEventType::begin || event.type == ContactEventType::sensorBegin;
            if (begins) {
                EXPECT_TRUE(touching_.insert(pairOf(event)).second) << "began twice";
                ++begins_;
            } else {
                EXPECT_EQ(touching_.erase(pairOf(event)), 1u) << "ended without having begun";
                ++ends_;
            }
        }
    }
    std::size_t touching() const { return touching_.size(); }
    int begins() const { return begins_; }
    int ends() const { return ends_; }

private:
    std::set<EventPair> touching_;
    int begins_ = 0;
    int ends_ = 0;
};

void expectSorted(const World& world) {
    const auto key = [](const ContactEvent& e) { return std::tuple(e.fraction, e.shapeA.index, e.shapeB.index); };
    const auto events = world.contactEvents();
    for (std::size_t i = 1; i < events.size(); ++i) { EXPECT_LE(key(events[i - 1]), key(events[i])); }
    for (const ContactEvent& event : events) {
        EXPECT_GE(event.fraction, 0);
        EXPECT_LE(event.fraction, 1);
    }
}

/// A box of bouncing things, with a chain for a floor and a sensor in the middle.
World bouncingWorld(std::vector<BodyId>& bodies) {
    World world = makeWorld();
    const BodyId room = must(world.createBody({}));
    const std::vector<Vec2> walls{vec(-5, 9), vec(-5, 3), vec(-4, 1), vec(-1, 0), vec(2, 0.5), vec(5, 2), vec(5, 9)};
    const std::vector<Vec2> rightToLeft(walls.rbegin(), walls.rend());
    must(world.addChain(room, rightToLeft, false, material(0.3, 0.5)));
    ShapeDef sensor;
    sensor.sensor = true;
    must(world.addShape(room, must(makeBox(vec(1, 1), vec(0, 2))), sensor));
    Random random(5);
    for (int i = 0; i < 24; ++i) {
        const DVec2 place{random.range(-4, 4), random.range(3, 8)};
        const Polygon shape = i % 2 == 0 ? circle(random.range(0.1, 0.4)) : box(random.range(0.1, 0.4), 0.3);
        bodies.push_back(
            addBody(world, dynamicAt(place, vec(random.range(-8, 8), random.range(-8, 8))), shape, material(0.4, 0.6)));
    }
    return world;
}

TEST(Events, WhatBeginsEnds) {
    std::vector<BodyId> bodies;
    World world = bouncingWorld(bodies);
    Listener listener;
    for (int step = 0; step < 600; ++step) {
        must(world.step(kStep));
        listener.listen(world);
        expectSorted(world);
        if (testing::Test::HasFailure()) { FAIL() << "step " << step; }
        // Some are taken away while they touch, some are thrown up again.
        if (step % 40 == 39 && bodies.size() > 4) {
            must(world.destroyBody(bodies.back()));
            bodies.pop_back();
        }
        if (step % 25 == 24) { must(world.setPose(bodies[0], {0, 7}, 0)); }
    }
    for (const BodyId body : bodies) { must(world.destroyBody(body)); }
    must(world.step(kStep));
    listener.listen(world);
    EXPECT_EQ(listener.touching(), 0u);
    EXPECT_GT(listener.begins(), 100);
    EXPECT_EQ(listener.begins(), listener.ends());
}

/// So many that they are put into order by counting (key_sort.h), in no order of their slots.
TEST(Events, ManyOfAStepComeInOrder) {
    World world = makeWorld();
    const BodyId ground = must(world.createBody({}));
    must(world.addChain(ground, std::vector<Vec2>{vec(400, 0), vec(0, 0), vec(-400, 0)}, false, material(0.3, 0.5)));
    Random random(11);
    for (int i = 0; i < 400; ++i) {
        const DVec2 place{random.range(-300, 300), random.range(0.6, 0.9)};
        addBody(world, dynamicAt(place, vec(0, -20)), circle(0.5), material(0));
    }
    std::size_t most = 0;
    for (int step = 0; step < 30; ++step) {
        must(world.step(kStep));
        expectSorted(world);
        most = std::max(most, world.contactEvents().size());
    }
    EXPECT_GT(most, 200u);
}

/// A chain is one shape, whichever of its segments something touches when it is taken away, and also where another one
/// takes its place before the next step.
TEST(Events, ChainsThatAreTakenAwayEndUnderTheirName) {
    for (const bool isReplaced : {false, true}) {
        World world = makeWorld();
        const BodyId ground = must(world.createBody({}));
        const std::vector<Vec2> points{vec(6, 0), vec(4, 0), vec(2, 0), vec(0, 0), vec(-2, 0)};
        const ShapeId chain = must(world.addChain(ground, points, false, material(0.3)));
        addBody(world, dynamicAt({1, 0.5}), circle(0.5));  // on the last but one
        Listener listener;
        for (int step = 0; step < 5; ++step) {
            must(world.step(kStep));
            listener.listen(world);
        }
        ASSERT_EQ(listener.touching(), 1u);
        must(world.destroyShape(chain));
        if (isReplaced) { must(world.addChain(ground, points, false, material(0.3))); }
        must(world.step(kStep));
        listener.listen(world);
        EXPECT_EQ(listener.ends(), 1) << isReplaced;
        EXPECT_EQ(listener.begins(), isReplaced ? 2 : 1) << isReplaced;
    }
}

/// A ball that falls from rest on a floor: v = √(2 g s), t = v/g, impulse = (1 + e) m v.
TEST(Events, HitOfAFlyerIsThatOfTheClosedForm) {
    World world = makeWorld();
    addStatic(world, box(10, 1), material(0, 0.5));
    const double radius = 0.05;
    const double height = 20;
    const BodyId ball = addBody(world, dynamicAt({0, 1 + radius + height}), circle(radius), material(0, 0.5));
    const double speed = std::sqrt(2 * kGravity * height);
    const double time = speed / kGravity;
    int hits = 0;
    for (int step = 1; step <= 150; ++step) {
        must(world.step(kStep));
        for (const ContactEvent& event : world.contactEvents()) {
            if (event.type != ContactEventType::hit) { continue; }
            ++hits;
            EXPECT_NEAR(static_cast<double>(event.approachSpeed), speed, 1e-3 * speed);
            EXPECT_NEAR((step - 1 + event.fraction) * kStep, time, 1e-4 * time);
            EXPECT_NEAR(static_cast<double>(event.impulse), 1.5 * world.mass(ball) * speed,
                        2e-3 * world.mass(ball) * speed);
            EXPECT_NEAR(static_cast<double>(event.normal.y), 1, 1e-6) << "from the floor to the ball";
            EXPECT_EQ(event.bodyB, ball);
            EXPECT_NEAR(event.point.y, 1, 1e-3);
        }
    }
    EXPECT_EQ(hits, 1);
}

/// What stops at a wall says so in that step, and has the velocity after the impact.
TEST(Events, HitInModeStopComesInItsStep) {
    WorldSettings settings = awakeSettings(0);
    settings.continuous = ContinuousMode::stop;
    World world = makeWorld(settings);
    const BodyId wall = addStatic(world, segment(0, -5, 0, 5), material(0, 0.5));
    const BodyId ball = addBody(world, dynamicAt({-1.5, 0.25}, vec(120, 0)), circle(0.1), material(0, 0.5));
    must(world.step(kStep));
    ASSERT_EQ(world.contactEvents().size(), 1U);
    const ContactEvent hit = world.contactEvents()[0];
    EXPECT_EQ(hit.type, ContactEventType::hit);
    EXPECT_EQ(hit.bodyA, wall);
    EXPECT_EQ(hit.bodyB, ball);
    EXPECT_NEAR(hit.fraction, 1.4 / 2, 1e-4);
    EXPECT_LT(length(hit.point - DVec2{0, 0.25}), 1e-4);
    EXPECT_NEAR(static_cast<double>(hit.normal.x), -1, 1e-6);
    EXPECT_NEAR(static_cast<double>(hit.approachSpeed), 120, 1e-4);
    EXPECT_NEAR(static_cast<double>(hit.impulse) / (1.5 * 120 * world.mass(ball)), 1, 1e-5);
    EXPECT_NEAR(velocityOf(world, ball).x, -60, 1e-4);
    EXPECT_NEAR(world.position(ball).x, -0.1, 1e-4);
    ASSERT_EQ(world.lostTime().size(), 1U);
    EXPECT_EQ(world.lostTime()[0].reason, LostTimeReason::stop);
    EXPECT_NEAR(world.lostTime()[0].seconds, (1 - hit.fraction) * kStep, 1e-9);
    must(world.step(kStep));
    for (const ContactEvent& event : world.contactEvents()) { EXPECT_NE(event.type, ContactEventType::hit); }
    EXPECT_NEAR(world.position(ball).x, -1.1, 1e-4);
}

TEST(Events, SensorsSeeAndDoNotTouch) {
    World world = makeWorld(0.0);
    ShapeDef sensor;
    sensor.sensor = true;
    sensor.userData = 7;
    const BodyId gate = addStatic(world, box(0.5, 2), sensor);
    const BodyId ball = addBody(world, dynamicAt({-3, 0}, vec(2, 0)), circle(0.25));
    std::vector<std::pair<ContactEventType, double>> seen;
    for (int step = 1; step <= 200; ++step) {
        must(world.step(kStep));
        for (const ContactEvent& event : world.contactEvents()) {
            seen.emplace_back(event.type, step * kStep);
            EXPECT_EQ(event.bodyA, gate) << "the sensor is A";
            EXPECT_EQ(event.bodyB, ball);
            EXPECT_EQ(world.userData(event.shapeA), 7u);
            EXPECT_NEAR(event.point.x, event.type == ContactEventType::sensorBegin ? -0.5 : 0.5, 0.05);
            EXPECT_NEAR(event.point.y, 0, 1e-6);
        }
    }
    ASSERT_EQ(seen.size(), 2u);
    EXPECT_EQ(seen[0].first, ContactEventType::sensorBegin);
    EXPECT_NEAR(seen[0].second, 2.25 / 2, 2.5 * kStep);
    EXPECT_EQ(seen[1].first, ContactEventType::sensorEnd);
    EXPECT_NEAR(seen[1].second, 3.75 / 2, 2.5 * kStep);
    EXPECT_EQ(velocityOf(world, ball), (DVec2{2, 0}));
}

bool collides(Filter a, Filter b, bool joined, bool collideConnected) {
    World world = makeWorld();
    ShapeDef floor;
    floor.filter = a;
    const BodyId ground = addStatic(world, box(5, 1), floor);
    ShapeDef ball;
    ball.filter = b;
    const BodyId body = addBody(world, dynamicAt({0, 1.6}), circle(0.5), ball);
    if (joined) {
        DistanceJointDef def{.base = {.bodyA = ground, .bodyB = body, .collideConnected = collideConnected},
                             .anchorA = {0, 0},
                             .anchorB = {0, 1.6}};
        def.limits = LengthLimits{0, 100};
        must(world.createJoint(def));
    }
    run(world, 60);
    return world.position(body).y > 1;
}

TEST(Events, FiltersGroupsAndJointsDecideWhoCollides) {
    EXPECT_TRUE(collides({}, {}, false, false));
    EXPECT_FALSE(collides({2, 1, 0}, {1, 1, 0}, false, false)) << "the ball does not look for category 2";
    EXPECT_TRUE(collides({2, 1, 0}, {1, 2, 0}, false, false));
    EXPECT_FALSE(collides({1, 1, -3}, {1, 1, -3}, false, false));
    EXPECT_TRUE(collides({1, 0, 3}, {1, 0, 3}, false, false));
    EXPECT_TRUE(collides({1, 1, -3}, {1, 1, -4}, false, false));
    EXPECT_FALSE(collides({}, {}, true, false));
    EXPECT_TRUE(collides({}, {}, true, true));
}

/// Two boxes asleep on each other.
struct Sleepers {
    World world;
    BodyId ground, lower, upper;
    Sleepers() {
        ground = addStatic(world, box(10, 1));
        lower = addBody(world, dynamicAt({0, 1.5}), box(0.5, 0.5));
        upper = addBody(world, dynamicAt({0, 2.5}), box(0.5, 0.5));
        run(world, 300);
        EXPECT_FALSE(world.isAwake(lower) || world.isAwake(upper));
    }
};

TEST(Waking, DestroyedSupportWakesWhatStoodOnIt) {
    Sleepers s;
    must(s.world.destroyBody(s.lower));
    EXPECT_TRUE(s.world.isAwake(s.upper));
    run(s.world, 120);
    EXPECT_NEAR(s.world.position(s.upper).y, 1.5, 0.02);
}

TEST(Waking, DestroyedShapeWakesWhatStoodOnIt) {
    World world;
    const BodyId ground = must(world.createBody({}));
    const ShapeId floor = must(world.addShape(ground, box(10, 1)));
    const BodyId crate = addBody(world, dynamicAt({0, 1.5}), box(0.5, 0.5));
    run(world, 300);
    EXPECT_FALSE(world.isAwake(crate));
    must(world.destroyShape(floor));
    EXPECT_TRUE(world.isAwake(crate));
    run(world, 60);
    EXPECT_LT(world.position(crate).y, 0);
}

TEST(Waking, DestroyedJointWakesWhatHungOnIt) {
    World world;
    const BodyId hook = must(world.createBody(bodyAt(BodyType::fixed, {0, 5})));
    const BodyId bob = addBody(world, dynamicAt({0, 3}), circle(0.5));
    const JointId rod = must(world.createJoint(
        DistanceJointDef{.base = {.bodyA = hook, .bodyB = bob}, .anchorA = {0, 5}, .anchorB = {0, 3}}));
    run(world, 600);
    EXPECT_FALSE(world.isAwake(bob));
    must(world.destroyJoint(rod));
    EXPECT_TRUE(world.isAwake(bob));
}

TEST(Waking, TeleportWakesBothPlaces) {
    Sleepers s;
    must(s.world.setPose(s.lower, {5, 4}, 0.25));
    EXPECT_TRUE(s.world.isAwake(s.lower) && s.world.isAwake(s.upper));
    EXPECT_EQ(s.world.position(s.lower), (DVec2{5, 4}));
    EXPECT_EQ(s.world.angle(s.lower), 0.25);
    run(s.world, 200);
    EXPECT_NEAR(s.world.position(s.upper).y, 1.5, 0.02);
    EXPECT_NEAR(s.world.position(s.lower).x, 5, 0.5);
}

/// A platform that starts to move takes along what sleeps on it, and what hangs from it.
TEST(Waking, KinematicBodyTakesSleepersAlong) {
    World world;
    const BodyId lift = addBody(world, bodyAt(BodyType::kinematic, {0, 0}), box(3, 0.5));
    const BodyId crate = addBody(world, dynamicAt({0, 1}), box(0.5, 0.5));
    const BodyId bob = addBody(world, dynamicAt({2, -3}), circle(0.5));
    must(world.createJoint(
        DistanceJointDef{.base = {.bodyA = lift, .bodyB = bob}, .anchorA = {2, -0.5}, .anchorB = {2, -3}}));
    run(world, 600);
    ASSERT_FALSE(world.isAwake(crate) || world.isAwake(bob));
    must(world.setVelocity(lift, vec(0, 1), 0));
    run(world, 60);
    EXPECT_NEAR(world.position(crate).y, 2, 0.05);
    EXPECT_NEAR(world.position(bob).y, -2, 0.05);
}

/// A sleeping body is not an anchor for what moves: who pulls at it wakes it.
TEST(Waking, JointedPartnerIsWoken) {
    World world;
    const BodyId hook = must(world.createBody(bodyAt(BodyType::fixed, {0, 5})));
    const BodyId a = addBody(world, dynamicAt({0, 4}), circle(0.25));
    const BodyId b = addBody(world, dynamicAt({0, 3}), circle(0.25));
    const auto rod = [&world](BodyId upper, BodyId lower, double y) {
        must(world.createJoint(
            DistanceJointDef{.base = {.bodyA = upper, .bodyB = lower}, .anchorA = {0, y + 1}, .anchorB = {0, y}}));
    };
    rod(hook, a, 4);
    rod(a, b, 3);
    must(world.setAwake(a, false));
    must(world.setVelocity(b, vec(3, 0), 0));
    run(world, 30);
    EXPECT_TRUE(world.isAwake(a));
    EXPECT_GT(std::abs(world.position(a).x), 0.01);
}

TEST(Counters, SlowSceneNeverSweeps) {
    World world = makeWorld();
    addStatic(world, box(10, 1));
    // At rest they would be held from the first step on.
    for (int i = 0; i < 5; ++i) { addBody(world, dynamicAt({0, 1.5 + i}, vec(0.01 * i, 0)), box(0.5, 0.5)); }
    int solved = 0;
    for (int step = 0; step < 120; ++step) {
        must(world.step(kStep));
        const StepCounters& counters = world.counters();
        ASSERT_EQ(counters.sweeps + counters.toiCalls + counters.flyers + counters.impacts, 0u) << "step " << step;
        ASSERT_EQ(counters.awakeBodies, 5u);
        ASSERT_EQ(counters.putBack + counters.speedsLimited + counters.wokeUp, 0u);
        ASSERT_EQ(counters.islands, 1u);
        ASSERT_EQ(counters.touching, 5u);
        ASSERT_EQ(counters.solvedBodies + counters.settledBodies, 5u) << "all or nothing is held";
        ASSERT_EQ(counters.constraints, counters.solvedBodies);
        if (counters.solvedBodies > 0) {
            ASSERT_GE(counters.colours, 2u) << "neighbours in the stack may not share a colour";
            ++solved;
        }
    }
    EXPECT_GT(solved, 0);
}

TEST(Counters, SleepingSceneDoesNothing) {
    Sleepers s;
    must(s.world.step(kStep));
    const StepCounters& counters = s.world.counters();
    EXPECT_EQ(counters.awakeBodies + counters.manifolds + counters.constraints + counters.boxTests +
                  counters.proxiesMoved + counters.wokeUp + counters.fellAsleep,
              0u);
    must(s.world.applyImpulse(s.upper, vec(0.1, 0), {0, 2.5}));
    must(s.world.step(kStep));
    EXPECT_EQ(s.world.counters().wokeUp, 2u) << "the two of them, by the call before the step";
    must(s.world.step(kStep));
    EXPECT_EQ(s.world.counters().wokeUp, 0u);
}

TEST(Counters, FlyerIsSweptOnce) {
    World world = makeWorld();
    addStatic(world, box(10, 1));
    addBody(world, dynamicAt({0, 5}, vec(0, -100)), circle(0.1), material(0, 0.5));
    std::uint64_t impacts = 0;
    for (int step = 0; step < 10; ++step) {
        must(world.step(kStep));
        EXPECT_EQ(world.counters().flyers, 1u);
        EXPECT_EQ(world.counters().sweeps, 1u);
        impacts += world.counters().impacts;
    }
    EXPECT_EQ(impacts, 1u);
}

}  // namespace
}  // namespace swept::test
