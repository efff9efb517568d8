#include <string>
#include <utility>
#include <vector>

#include "world_support.h"

/// Joints keep bodies from colliding, and hide nothing from sensors: what hangs on the level passes its gates.

namespace swept::test {
namespace {

ShapeDef sensorDef() {
    ShapeDef def;
    def.sensor = true;
    def.density = 0;
    return def;
}

struct Told {
    int begins = 0;
    int ends = 0;
};

/// Of one sensor, in the last step. Nothing begins twice, nor ends that did not begin.
void count(const World& world, ShapeId sensor, Told& told) {
    for (const ContactEvent& event : world.contactEvents()) {
        if (event.shapeA != sensor) { continue; }
        told.begins += event.type == ContactEventType::sensorBegin ? 1 : 0;
        told.ends += event.type == ContactEventType::sensorEnd ? 1 : 0;
    }
    int inside = 0;
    world.visitOverlaps(sensor, [&inside](ShapeId) { ++inside; });
    EXPECT_EQ(inside, told.begins - told.ends);
}

using Connect = JointId (*)(World& world, BodyId level, BodyId ball);
struct Way {
    std::string name;
    Connect connect;
};

/// Joints to the level by which a ball at (3, 0) gets to (0, -3) in time.
const std::vector<Way> kWays{
    {"hinge",
     [](World& world, BodyId level, BodyId ball) {
         RevoluteJointDef def;
         def.base.bodyA = level;
         def.base.bodyB = ball;
         return must(world.createJoint(def));
     }},
    {"rod",
     [](World& world, BodyId level, BodyId ball) {
         DistanceJointDef def;
         def.base.bodyA = ball;
         def.base.bodyB = level;
         def.anchorA = {3, 0};
         return must(world.createJoint(def));
     }},
    {"motor joint",
     [](World& world, BodyId level, BodyId ball) {
         MotorJointDef def;
         def.base.bodyA = level;
         def.base.bodyB = ball;
         def.drive.linearOffset = vec(-1, -4);
         def.drive.maxForce = real(50);
         return must(world.createJoint(def));
     }},
};

TEST(JointedSensors, OfTheLevelSeeWhatHangsOnIt) {
    for (const Profile profile : kProfiles) {
        for (const Way& way : kWays) {
            SCOPED_TRACE(profileName(profile) + ' ' + way.name);
            World world = makeWorld(profile);
            const BodyId level = must(world.createBody({}));
            const ShapeId gate = must(world.addShape(level, must(makeBox(vec(0.3, 2), vec(0, -3))), sensorDef()));
            const BodyId ball = addBody(world, dynamicAt({3, 0}), circle(0.3));
            way.connect(world, level, ball);
            Told told;
            for (int i = 0; i < 90; ++i) {
                run(world, 1);
                count(world, gate, told);
            }
            EXPECT_EQ(told.begins, 1);
            EXPECT_EQ(told.ends, 1);
        }
    }
}

/// Within a step, too, where a filter joint is all that there is between the two.
TEST(JointedSensors, SeeWhatPassesWithinAStep) {
    World world = makeWorld(0);
    const BodyId level = must(world.createBody({}));
    const ShapeId gate = must(world.addShape(level, box(0.1, 1), sensorDef()));
    const BodyId ball = addBody(world, dynamicAt({-1, 0}, vec(120, 0)), circle(0.1));
    FilterJointDef apart;
    apart.base.bodyA = level;
    apart.base.bodyB = ball;
    must(world.createJoint(apart));
    run(world, 1);
    Told told;
    count(world, gate, told);
    EXPECT_EQ(told.begins, 1);
    EXPECT_EQ(told.ends, 1);
}

/// A ball lies on the level in a zone of it. Joints that come, change and go end and begin the contact, but nothing in
/// the zone; asleep as well.
TEST(JointedSensors, AreToldNothingOfJointsThatComeAndGo) {
    for (const bool sleeps : {false, true}) {
        SCOPED_TRACE(sleeps ? "asleep" : "awake");
        WorldSettings settings = awakeSettings();
        settings.sleep = sleeps;
        World world = makeWorld(settings);
        const BodyId level = must(world.createBody({}));
        must(world.addShape(level, must(makeBox(vec(5, 1), vec(0, -1)))));
        const ShapeId zone = must(world.addShape(level, must(makeBox(vec(1, 1), vec(0, 1))), sensorDef()));
        const BodyId ball = addBody(world, dynamicAt({0, 0.5}), circle(0.5));
        Told told;
        int begins = 0, ends = 0;
        const auto step = [&](int steps) {
            for (int i = 0; i < steps; ++i) {
                run(world, 1);
                count(world, zone, told);
                for (const ContactEvent& event : world.contactEvents()) {
                    begins += event.type == ContactEventType::begin ? 1 : 0;
                    ends += event.type == ContactEventType::end ? 1 : 0;
                }
            }
        };
        step(400);
        EXPECT_EQ(world.isAwake(ball), !sleeps);
        DistanceJointDef rod;  // holds it where it is
        rod.base.bodyA = level;
        rod.base.bodyB = ball;
        rod.anchorA = {0, 2};
        rod.anchorB = {0, 0.5};
        const JointId joint = must(world.createJoint(rod));
        step(2);
        EXPECT_EQ(std::pair(begins, ends), std::pair(1, 1)) << "the joint keeps the two apart";
        rod.base.collideConnected = true;
        must(world.redefine(joint, rod));
        step(2);
        EXPECT_EQ(std::pair(begins, ends), std::pair(2, 1));
        rod.base.collideConnected = false;
        must(world.redefine(joint, rod));
        step(400);
        EXPECT_EQ(std::pair(begins, ends), std::pair(2, 2));
        must(world.destroyJoint(joint));
        step(2);
        EXPECT_EQ(std::pair(begins, ends), std::pair(3, 2));
        EXPECT_EQ(told.begins, 1);
        EXPECT_EQ(told.ends, 0);
    }
}

/// What is made a sensor while a joint keeps it apart begins to see, and what is made solid sees no more.
TEST(JointedSensors, MayBeMadeOfWhatIsKeptApart) {
    World world = makeWorld(0);
    const BodyId level = must(world.createBody({}));
    const ShapeId zone = must(world.addShape(level, box(1, 1)));
    const BodyId ball = addBody(world, dynamicAt({0, 0}), circle(0.5));
    FilterJointDef apart;
    apart.base.bodyA = level;
    apart.base.bodyB = ball;
    must(world.createJoint(apart));
    Told told;
    for (const bool isSensor : {true, false, true}) {
        ShapeDef def = world.definition(zone);
        def.sensor = isSensor;
        must(world.redefine(zone, def));
        for (int i = 0; i < 3; ++i) {
            run(world, 1);
            for (const ContactEvent& event : world.contactEvents()) {
                EXPECT_TRUE(event.type == ContactEventType::sensorBegin || event.type == ContactEventType::sensorEnd);
            }
            count(world, zone, told);
        }
        EXPECT_EQ(told.begins - told.ends, isSensor ? 1 : 0);
    }
    EXPECT_EQ(told.begins, 2);
    EXPECT_EQ(world.position(ball), DVec2{});
}

}  // namespace
}  // namespace swept::test
