#include <string>

#include "joint_support.h"

/// Calls that spare a game some words: each is what its longer form is.

namespace swept::test {
namespace {

TEST(ShortCalls, GravityAloneLeavesOtherSettings) {
    WorldSettings settings;
    settings.profile = Profile::fast;
    World world = makeWorld(settings);
    must(world.setGravity(vec(3, 0)));
    settings.gravity = vec(3, 0);
    EXPECT_EQ(world.settings().gravity, settings.gravity);
    EXPECT_EQ(world.settings().profile, Profile::fast);
    EXPECT_EQ(world.setGravity({std::numeric_limits<Real>::quiet_NaN(), 0}).code, StatusCode::notFinite);
    EXPECT_EQ(world.settings().gravity, settings.gravity);
}

TEST(ShortCalls, ModifyChangesWhatItIsToldAndNothingElse) {
    World world = makeWorld();
    BodyDef def = dynamicAt({0, 5}, vec(1, 0));
    def.linearDamping = real(0.25);
    const BodyId body = addBody(world, def, box(0.5, 0.5));
    must(world.modify(body, [](BodyDef& d) { d.gravityScale = 0; }));
    EXPECT_EQ(world.definition(body).gravityScale, 0);
    EXPECT_EQ(world.definition(body).linearDamping, real(0.25));
    run(world, 10);
    EXPECT_EQ(world.position(body).y, 5);

    ShapeId shape;
    world.visitShapes(body, [&](ShapeId id) { shape = id; });
    must(world.modify(shape, [](ShapeDef& d) { d.density = 3; }));
    EXPECT_NEAR(world.mass(body), 3, 1e-6);

    RevoluteJointDef hinge;
    hinge.base = between(anchorOf(world), body);
    const JointId joint = must(world.createJoint(hinge));
    must(world.modify(joint, [](AnyJointDef& d) { std::get<RevoluteJointDef>(d).motor = AngularMotor{2, 5}; }));
    EXPECT_TRUE(std::get<RevoluteJointDef>(world.definition(joint)).motor.has_value());

    EXPECT_EQ(world.modify(BodyId{}, [](BodyDef&) { FAIL() << "of nothing"; }).code, StatusCode::staleId);
    EXPECT_EQ(world.modify(JointId{}, [](AnyJointDef& d) { std::get<WeldJointDef>(d).linearSpring = {}; }).code,
              StatusCode::staleId);
    EXPECT_EQ(world.modify(shape, [](ShapeDef& d) { d.friction = -1; }).code, StatusCode::negative);
}

TEST(ShortCalls, PosesWithoutAnAngleKeepIt) {
    World world = makeWorld(0);
    BodyDef def = bodyAt(BodyType::kinematic, {0, 0}, 0.5);
    def.angularVelocity = 1;
    const BodyId lift = addBody(world, def, box(1, 0.1));
    run(world, 60);
    const double angle = world.angle(lift);
    EXPECT_NEAR(angle, 1.5, 1e-5);
    must(world.setPose(lift, {2, 3}));
    EXPECT_EQ(world.position(lift), (DVec2{2, 3}));
    EXPECT_EQ(world.angle(lift), angle);
    must(world.driveTo(lift, {2, 4}, kStep));
    run(world, 1);
    EXPECT_NEAR(world.position(lift).y, 4, 1e-6);
    EXPECT_EQ(world.angle(lift), angle);
}

TEST(ShortCalls, JointsNameTheirBodies) {
    World world = makeWorld();
    const BodyId ground = anchorOf(world);
    const BodyId wheel = addBody(world, dynamicAt({0, 0}), circle(0.5));
    RevoluteJointDef hinge;
    hinge.base = between(ground, wheel);
    const JointId joint = must(world.createJoint(hinge));
    EXPECT_EQ(world.bodyA(joint), ground);
    EXPECT_EQ(world.bodyB(joint), wheel);
    must(world.destroyJoint(joint));
    EXPECT_EQ(world.bodyA(joint), BodyId{});
    EXPECT_EQ(world.bodyB(joint), BodyId{});
}

TEST(ShortCalls, WaysAreAddedToPositions) {
    constexpr DVec2 far{1e9, -1e9};
    constexpr Vec2 way{Real(0.5), Real(0.25)};
    static_assert(far + way == DVec2{1e9 + 0.5, -1e9 + 0.25});
    static_assert(far - way == DVec2{1e9 - 0.5, -1e9 - 0.25});
    DVec2 at = far;
    at += way;
    EXPECT_EQ(at, far + way);
    at -= way;
    EXPECT_EQ(at, far);
    at += {0.1, 0.1};  // in double
    EXPECT_EQ(at.x, 1e9 + 0.1);
}

TEST(ShortCalls, AValueOutlivesItsResult) {
    const auto made = [] { return Result<std::string>(std::string(100, 'a')); };
    const std::string& kept = made().value();
    EXPECT_EQ(kept, std::string(100, 'a'));
}

}  // namespace
}  // namespace swept::test
