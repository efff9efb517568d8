#include <unordered_map>

#include "joint_support.h"
#include "world_digest.h"

/// What is changed while the world runs behaves like what was made so, and a refusal changes nothing.

namespace swept::test {
namespace {

ShapeId onlyShapeOf(const World& world, BodyId body) {
    ShapeId only{};
    world.visitShapes(body, [&only](ShapeId id) { only = id; });
    return only;
}

int contactsOf(const World& world, BodyId body) {
    int count = 0;
    world.visitContacts([&](const ContactView& view) { count += view.bodyA == body || view.bodyB == body ? 1 : 0; });
    return count;
}

/// A box asleep on a slope of 30 degrees, which friction 1 holds.
struct OnSlope {
    World world = makeWorld();
    BodyId ground;
    BodyId body;
    OnSlope() {
        WorldSettings settings = awakeSettings();
        settings.sleep = true;
        must(world.configure(settings));
        ground = addStatic(world, box(20, 1), material(1), {}, -kPi / 6);
        const DVec2 up = turned({0, 1.5}, -kPi / 6);
        BodyDef def = dynamicAt(up);
        def.angle = -kPi / 6;
        body = addBody(world, def, box(0.5, 0.5), material(1));
        runFor(world, 4);
        EXPECT_FALSE(world.isAwake(body));
    }
};

TEST(Redefine, FrictionOfWhatSleepsInContact) {
    OnSlope slope;
    ShapeDef surface = slope.world.definition(onlyShapeOf(slope.world, slope.body));
    EXPECT_EQ(surface.friction, real(1));
    surface.friction = 0;
    must(slope.world.redefine(onlyShapeOf(slope.world, slope.body), surface));
    EXPECT_EQ(slope.world.definition(onlyShapeOf(slope.world, slope.body)).friction, 0);
    const DVec2 before = slope.world.position(slope.body);
    runFor(slope.world, 1);
    EXPECT_NEAR(length(slope.world.position(slope.body) - before), 0.5 * kGravity * 0.5, 0.05);  // ½·g·sin 30°·t²
    for (const ContactEvent& event : slope.world.contactEvents()) { EXPECT_NE(event.type, ContactEventType::begin); }
}

TEST(Redefine, RestitutionOfGround) {
    World world = makeWorld();
    const BodyId ground = addStatic(world, box(20, 1), material(0.5));
    const BodyId ball = addBody(world, dynamicAt({0, 2.5}), circle(0.5));
    runFor(world, 0.2);
    ShapeDef surface = material(0.5, 1);
    must(world.redefine(onlyShapeOf(world, ground), surface));
    double highest = 0;
    for (int i = 0; i < 90; ++i) {
        run(world, 1);
        if (i > 30) { highest = std::max(highest, world.position(ball).y); }
    }
    EXPECT_NEAR(highest, 2.5, 0.01);
}

TEST(Redefine, FilterEndsAndBeginsContacts) {
    OnSlope slope;
    World& world = slope.world;
    ShapeDef def = world.definition(onlyShapeOf(world, slope.body));
    def.filter.mask = 0;
    must(world.redefine(onlyShapeOf(world, slope.body), def));
    EXPECT_EQ(contactsOf(world, slope.body), 0);
    run(world, 1);
    ASSERT_EQ(world.contactEvents().size(), 1U);
    EXPECT_EQ(world.contactEvents()[0].type, ContactEventType::end);
    def.filter.mask = 0xFFFFFFFFu;
    must(world.redefine(onlyShapeOf(world, slope.body), def));
    run(world, 2);
    EXPECT_GT(contactsOf(world, slope.body), 0);
    EXPECT_LT(std::abs(velocityOf(world, slope.body).y), 0.1);
}

TEST(Redefine, SensorAndBack) {
    World world = makeWorld();
    addStatic(world, box(20, 1));
    const BodyId gate = addStatic(world, box(0.2, 2), {}, {3, 3});
    ShapeDef open = world.definition(onlyShapeOf(world, gate));
    open.sensor = true;
    must(world.redefine(onlyShapeOf(world, gate), open));
    const BodyId ball = addBody(world, dynamicAt({0, 1.5}, vec(5, 0)), circle(0.5), material(0));
    int begins = 0;
    for (int i = 0; i < 90; ++i) {
        run(world, 1);
        for (const ContactEvent& event : world.contactEvents()) {
            begins += event.type == ContactEventType::sensorBegin ? 1 : 0;
        }
    }
    EXPECT_EQ(begins, 1);
    EXPECT_GT(world.position(ball).x, 5);
    open.sensor = false;
    must(world.redefine(onlyShapeOf(world, gate), open));
    must(world.setVelocity(ball, vec(-20, 0), 0));
    runFor(world, 1);
    EXPECT_GT(world.position(ball).x, 3);
}

TEST(Redefine, TypesOfABody) {
    World world = makeWorld();
    addStatic(world, box(20, 1));
    const BodyId body = addBody(world, dynamicAt({0, 5}, vec(1, 0)), box(0.5, 0.5));
    const BodyId rider = addBody(world, dynamicAt({0, 6}), box(0.5, 0.5));
    run(world, 5);
    BodyDef def = world.definition(body);
    EXPECT_EQ(def.velocity.x, world.velocity(body).x);
    def.type = BodyType::fixed;
    must(world.redefine(body, def));
    EXPECT_EQ(world.type(body), BodyType::fixed);
    EXPECT_EQ(world.velocity(body), Vec2{});
    const DVec2 place = world.position(body);
    runFor(world, 1);
    EXPECT_EQ(world.position(body), place);
    EXPECT_NEAR(world.position(rider).y, place.y + 1, 0.01);
    def.type = BodyType::kinematic;
    must(world.redefine(body, def));
    must(world.setVelocity(body, vec(0, 1), 0));
    runFor(world, 0.5);
    EXPECT_NEAR(world.position(body).y, place.y + 0.5, 1e-5);
    EXPECT_NEAR(world.position(rider).y, place.y + 1.5, 0.01);
    def.type = BodyType::dynamic;
    must(world.redefine(body, def));
    EXPECT_NEAR(world.mass(body), 1, 1e-6);
    runFor(world, 3);
    EXPECT_NEAR(world.position(body).y, 1.5, 0.01);
    EXPECT_NEAR(world.position(rider).y, 2.5, 0.02);
    must(world.destroyBody(body));
    runFor(world, 1);
    EXPECT_NEAR(world.position(rider).y, 1.5, 0.01);
}

/// By every way round, among others that are awake and asleep.
TEST(Redefine, LeavesNothingOfTheOldType) {
    for (int from = 0; from < 3; ++from) {
        for (int to = 0; to < 3; ++to) {
            World changed = makeWorld();
            World made = makeWorld();
            KnownIds known;
            for (World* world : {&changed, &made}) {
                addStatic(*world, box(20, 1));
                const bool isChanged = world == &changed;
                BodyDef def = bodyAt(static_cast<BodyType>(isChanged ? from : to), {0, 1.6});
                const BodyId body = addBody(*world, def, box(0.5, 0.5));
                if (isChanged) {
                    def.type = static_cast<BodyType>(to);
                    must(world->redefine(body, def));
                    known.bodies.push_back(body);
                }
                known.bodies.push_back(addBody(*world, dynamicAt({0.2, 2.8}), box(0.5, 0.5)));
                if (!isChanged) { known.bodies.pop_back(); }
                run(*world, 90);
            }
            for (const BodyId id : known.bodies) {
                EXPECT_EQ(changed.position(id), made.position(id)) << from << " to " << to;
                EXPECT_EQ(changed.isAwake(id), made.isAwake(id)) << from << " to " << to;
            }
        }
    }
}

TEST(Redefine, RefusalsChangeNothing) {
    World world = makeWorld();
    const BodyId ground = addStatic(world, box(20, 1));
    const std::array points{vec(3, 2), vec(2, 2.5), vec(1, 2)};
    const ShapeId chain = must(world.addChain(ground, points, false));
    const BodyId body = addBody(world, dynamicAt({0, 3}), box(0.5, 0.5));
    RevoluteJointDef hinge;
    hinge.base = between(ground, body);
    hinge.base.userData = 7;
    hinge.anchor = {0, 3};
    const JointId joint = must(world.createJoint(hinge));
    const KnownIds known{{ground, body}, {chain, onlyShapeOf(world, body)}, {joint}};
    run(world, 5);
    const std::uint64_t before = digestOf(world, known);
    BodyDef def = world.definition(body);
    def.linearDamping = -1;
    EXPECT_EQ(world.redefine(body, def).code, StatusCode::negative);
    EXPECT_EQ(world.redefine(BodyId{}, def).code, StatusCode::staleId);
    ShapeDef surface = world.definition(chain);
    surface.friction = -1;
    EXPECT_EQ(world.redefine(chain, surface).code, StatusCode::negative);
    EXPECT_EQ(world.redefine(ShapeId{}, {}).code, StatusCode::staleId);
    EXPECT_EQ(digestOf(world, known), before);
    must(world.destroyJoint(joint));
    BodyDef solid = world.definition(ground);
    solid.type = BodyType::dynamic;
    EXPECT_EQ(world.redefine(ground, solid).code, StatusCode::wrongBodyType);  // it has a chain
    BodyDef stiff = dynamicAt({0, 9});
    stiff.fixedRotation = true;
    stiff.angularVelocity = 1;
    EXPECT_EQ(world.createBody(stiff).status().code, StatusCode::outOfRange);
}

TEST(Redefine, BodiesDampedHeldUprightAndLifted) {
    World world = makeWorld();
    const BodyId body = addBody(world, dynamicAt({0, 3}, vec(4, 0), 5), box(0.5, 0.5));
    BodyDef def = world.definition(body);
    def.gravityScale = 0;
    def.linearDamping = 1;
    def.fixedRotation = true;
    def.userData = 9;
    must(world.redefine(body, def));
    EXPECT_EQ(world.angularVelocity(body), 0);
    EXPECT_EQ(world.setVelocity(body, {}, 1).code, StatusCode::outOfRange);
    runFor(world, 1);
    EXPECT_NEAR(velocityOf(world, body).x, 4 * std::exp(-1), 1e-4);
    EXPECT_EQ(world.position(body).y, 3);
    EXPECT_EQ(world.angle(body), 0);
    EXPECT_EQ(world.userData(body), 9U);
}

TEST(Redefine, VisitsTellWhatThereIs) {
    World world = makeWorld();
    const BodyId ground = addStatic(world, box(20, 1));
    const std::array points{vec(3, 2), vec(2, 2.5), vec(1, 2)};
    const ShapeId chain = must(world.addChain(ground, points, false));
    const BodyId body = addBody(world, dynamicAt({0, 3}), circle(0.5));
    DistanceJointDef rope;
    rope.base = between(ground, body);
    rope.base.userData = 7;
    rope.anchorA = {0, 6};
    rope.anchorB = {0, 3};
    const JointId joint = must(world.createJoint(rope));
    must(world.setBreakLimits(joint, real(1e6), {}));
    run(world, 3);
    std::unordered_map<BodyId, int> shapes;
    world.visitBodies([&](BodyId id) { world.visitShapes(id, [&](ShapeId) { ++shapes[id]; }); });
    EXPECT_EQ(shapes, (std::unordered_map<BodyId, int>{{ground, 2}, {body, 1}}));
    int segments = 0;
    world.visitPolygons(chain, [&](const Polygon& polygon) { segments += polygon.count == 2 ? 1 : 0; });
    EXPECT_EQ(segments, 2);
    int joints = 0;
    world.visitJoints([&](JointId id) { joints += id == joint ? 1 : 0; });
    world.visitJoints(body, [&](JointId id) { joints += id == joint ? 1 : 0; });
    EXPECT_EQ(joints, 2);
    EXPECT_EQ(world.userData(joint), 7U);
    const auto def = std::get<DistanceJointDef>(world.definition(joint));
    EXPECT_EQ(def.base.bodyB, body);
    EXPECT_EQ(def.base.breakForce, real(1e6));
    EXPECT_EQ(def.anchorA, (DVec2{0, 6}));
    EXPECT_NEAR(length(world.anchorB(joint) - world.anchorA(joint)), 3, 1e-5);
    world.visitShapes(BodyId{}, [](ShapeId) { FAIL(); });
    world.visitPolygons(ShapeId{}, [](const Polygon&) { FAIL(); });
}

/// A pool of bodies that are made asleep, all in one place, costs nothing until they are needed.
TEST(Redefine, WhatIsMadeAsleepSleepsOnWithItsShapes) {
    WorldSettings settings = awakeSettings();
    settings.sleep = true;
    World world = makeWorld(settings);
    std::vector<BodyId> pool;
    for (int i = 0; i < 20; ++i) {
        BodyDef def = dynamicAt({0, 5});
        def.awake = false;
        pool.push_back(addBody(world, def, circle(0.5)));
    }
    run(world, 30);
    EXPECT_EQ(world.counters().awakeBodies, 0U);
    EXPECT_EQ(world.position(pool[3]), (DVec2{0, 5}));
    must(world.setPose(pool[3], {10, 5}, 0));
    run(world, 30);
    EXPECT_LT(world.position(pool[3]).y, 4);
}

TEST(Redefine, AnotherGravityWakesWhatSleeps) {
    OnSlope slope;
    WorldSettings settings = slope.world.settings();
    settings.gravity = vec(0, 10);
    must(slope.world.configure(settings));
    const double before = slope.world.position(slope.body).y;
    runFor(slope.world, 0.5);
    EXPECT_NEAR(slope.world.position(slope.body).y, before + 0.5 * 10 * 0.25, 0.1);
}

TEST(Redefine, CastsSlideAlongWhatTheyAreNear) {
    World world = makeWorld();
    addStatic(world, box(20, 1));
    const Polygon ball = circle(0.5);
    const auto cast = [&](double height, Vec2 way) { return world.castShape(ball, {{0, 1.5 + height}, {}}, way); };
    const CastHit down = cast(1, vec(0, -5));
    ASSERT_TRUE(down.hit);
    const double stopped = 1 - 5 * static_cast<double>(down.fraction);  // where a controller stands then
    EXPECT_GT(stopped, 0);
    EXPECT_FALSE(cast(stopped, vec(3, 0)).hit);
    EXPECT_FALSE(cast(stopped, vec(-1, 2)).hit);
    EXPECT_TRUE(cast(stopped, vec(1, -1)).hit);
    EXPECT_EQ(cast(stopped, vec(1, -1)).fraction, 0);
    EXPECT_EQ(cast(-0.2, vec(1, 0)).normal, Vec2{});
}

/// Of a chain as of a segment: what it was to others ends, and what it is now begins.
TEST(Redefine, ChainsBetweenSolidAndSensorEndAndBegin) {
    for (const bool isChain : {false, true}) {
        for (const bool toSensor : {false, true}) {
            World world = makeWorld(0);
            const BodyId ground = must(world.createBody({}));
            ShapeDef def;
            def.sensor = !toSensor;
            const std::array points{vec(5, 0), vec(-5, 0)};
            const ShapeId shape = isChain ? must(world.addChain(ground, points, false, def))
                                          : must(world.addShape(ground, segment(5, 0, -5, 0), def));
            addBody(world, dynamicAt({1, 0.4995}), box(0.5, 0.5));
            run(world, 3);
            def.sensor = toSensor;
            must(world.redefine(shape, def));
            must(world.step(kStep));
            std::vector<ContactEventType> types;
            for (const ContactEvent& event : world.contactEvents()) {
                if (event.type != ContactEventType::hit) { types.push_back(event.type); }
            }
            const std::vector<ContactEventType> wanted =
                toSensor ? std::vector{ContactEventType::end, ContactEventType::sensorBegin}
                         : std::vector{ContactEventType::sensorEnd, ContactEventType::begin};
            EXPECT_EQ(types, wanted) << (isChain ? "chain" : "segment") << (toSensor ? " to sensor" : " to solid");
        }
    }
}

/// With the type who is A may change: the end still comes before the new begin.
TEST(Redefine, AnotherTypeEndsContactsBeforeTheyBegin) {
    World world = makeWorld();
    addBody(world, dynamicAt({0, 1}), box(0.5, 0.5));
    const BodyId lift = addBody(world, bodyAt(BodyType::kinematic, {0, 0}), box(0.5, 0.5));
    run(world, 3);
    BodyDef def = world.definition(lift);
    def.type = BodyType::dynamic;
    must(world.redefine(lift, def));
    must(world.step(kStep));
    std::vector<ContactEventType> types;
    for (const ContactEvent& event : world.contactEvents()) { types.push_back(event.type); }
    EXPECT_EQ(types, (std::vector{ContactEventType::end, ContactEventType::begin}));
}

TEST(Redefine, AnythingButUserDataWakesWhatWasMadeAsleep) {
    const auto isAwakeAfter = [](void (*change)(ShapeDef&)) {
        World world = makeWorld();
        BodyDef def = dynamicAt({0, 0});
        def.awake = false;
        const BodyId body = addBody(world, def, box(0.5, 0.5));
        ShapeDef surface = world.definition(onlyShapeOf(world, body));
        change(surface);
        must(world.redefine(onlyShapeOf(world, body), surface));
        return world.isAwake(body);
    };
    EXPECT_FALSE(isAwakeAfter([](ShapeDef& def) { def.userData = 7; }));
    EXPECT_TRUE(isAwakeAfter([](ShapeDef& def) { def.density = 3; }));
    EXPECT_TRUE(isAwakeAfter([](ShapeDef& def) { def.friction = 0; }));
    EXPECT_TRUE(isAwakeAfter([](ShapeDef& def) { def.filter.category = 2; }));
}

}  // namespace
}  // namespace swept::test
