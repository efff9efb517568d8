#include "joint_support.h"

/// Calls that tell or change one thing of a body or joint.

namespace swept::test {
namespace {

TEST(Calls, TransformIsWhereShapesAre) {
    World world = makeWorld();
    BodyDef def = dynamicAt({1e6, 3}, vec(4, 5), 7);
    def.angle = 0.3;
    const BodyId body = addBody(world, def, circle(0.5, vec(1, 0)));
    for (int i = 0; i < 20; ++i) {
        must(world.step(kStep));
        const WorldTransform pose = world.transform(body);
        EXPECT_EQ(pose.position, world.position(body));
        EXPECT_NEAR(static_cast<double>(pose.rotation.c), std::cos(world.angle(body)), 1e-6);
        EXPECT_NEAR(static_cast<double>(pose.rotation.s), std::sin(world.angle(body)), 1e-6);
        EXPECT_LT(length(apply(pose, vec(1, 0)) - world.centerOfMass(body)), 1e-6);
    }
    EXPECT_EQ(world.transform({}).position, DVec2{});
}

TEST(Calls, VelocityOfAPoint) {
    World world = makeWorld(0);
    const BodyId body = addBody(world, dynamicAt({2, 3}, vec(4, 5), 6), box(1, 1));
    EXPECT_EQ(world.velocityAt(body, {2, 3}), vec(4, 5));
    EXPECT_EQ(world.velocityAt(body, {3, 3}), vec(4, 11));
    EXPECT_EQ(world.velocityAt(body, {2, 5}), vec(-8, 5));
    EXPECT_EQ(world.velocityAt({}, {2, 5}), Vec2{});
}

/// It is a number wherever the point is: without a spin the velocity of the body, with one at most the largest number.
TEST(Calls, VelocityOfAPointFarAway) {
    World world = makeWorld(0);
    const BodyId still = addBody(world, dynamicAt({2, 3}, vec(4, 5)), circle(1));
    const BodyId spinning = addBody(world, dynamicAt({9, 3}, vec(4, 5), 6), circle(1));
    constexpr Real kMost = std::numeric_limits<Real>::max();
    for (const double far : {1e30, 1e39, 1e300, std::numeric_limits<double>::max()}) {
        EXPECT_EQ(world.velocityAt(still, {far, -far}), vec(4, 5)) << far;
        const Vec2 turning = world.velocityAt(spinning, {far, -far});
        const double expected = std::min(6 * (far / static_cast<double>(kMost)), 1.0);
        EXPECT_NEAR(turning.x / kMost, expected, 1e-6) << far;
        EXPECT_NEAR(turning.y / kMost, expected, 1e-6) << far;
    }
}

TEST(Calls, OneVelocityLeavesTheOther) {
    World world = makeWorld(0);
    const BodyId body = addBody(world, dynamicAt({2, 3}, vec(4, 5), 6), box(1, 1));
    must(world.setVelocity(body, vec(-1, 7)));
    EXPECT_EQ(world.velocity(body), vec(-1, 7));
    EXPECT_EQ(world.angularVelocity(body), Real(6));
    must(world.setAngularVelocity(body, 2));
    EXPECT_EQ(world.velocity(body), vec(-1, 7));
    EXPECT_EQ(world.angularVelocity(body), Real(2));
    EXPECT_EQ(world.setVelocity({}, vec(1, 0)).code, StatusCode::staleId);
    EXPECT_EQ(world.setAngularVelocity({}, 1).code, StatusCode::staleId);
    const Status nan = world.setAngularVelocity(body, std::numeric_limits<Real>::quiet_NaN());
    EXPECT_EQ(nan.code, StatusCode::notFinite);
    EXPECT_STREQ(nan.field, "angularVelocity");
    EXPECT_EQ(world.angularVelocity(body), Real(2));
}

/// A lift that is told each step where to be.
TEST(Calls, KinematicBodiesAreDriven) {
    World world = makeWorld();
    const BodyId lift = addBody(world, bodyAt(BodyType::kinematic, {1000, 0}, 0.5), box(2, 0.25));
    const BodyId rider = addBody(world, dynamicAt({1000, 1}), box(0.5, 0.5));
    must(world.setPose(lift, {1000, 0}, 0));
    for (int i = 1; i <= 120; ++i) {
        const DVec2 place{1000 + std::sin(0.02 * i), 1 - std::cos(0.02 * i)};
        must(world.driveTo(lift, place, 1e-3 * i, kStep));
        must(world.step(kStep));
        ASSERT_NEAR(world.position(lift).x, place.x, 1e-7) << i;
        ASSERT_NEAR(world.position(lift).y, place.y, 1e-7) << i;
        ASSERT_NEAR(world.angle(lift), 1e-3 * i, 1e-7) << i;
    }
    EXPECT_NEAR(world.position(rider).y - world.position(lift).y, 0.75, 0.1);
    EXPECT_EQ(world.driveTo(rider, {}, 0, kStep).code, StatusCode::wrongBodyType);
    EXPECT_EQ(world.driveTo({}, {}, 0, kStep).code, StatusCode::staleId);
    EXPECT_EQ(world.driveTo(lift, {}, 0, 0).code, StatusCode::notPositive);
    EXPECT_EQ(world.driveTo(lift, {0, std::nan("")}, 0, kStep).code, StatusCode::notFinite);
    const double far = 0.75 * std::sqrt(static_cast<double>(std::numeric_limits<Real>::max()));
    EXPECT_EQ(world.driveTo(lift, {far / 4, 0}, 0, 1e-3).code, StatusCode::outOfRange);
    EXPECT_EQ(world.driveTo(lift, {1000, 0}, far / 4, 1e-3).code, StatusCode::outOfRange);
}

TEST(Calls, ForcesAndImpulsesAtTheCentre) {
    World world = makeWorld(0);
    const BodyId body = must(world.createBody(dynamicAt({3, 4})));
    must(world.addShape(body, box(1, 1), material(0)));
    must(world.addShape(body, must(makeCircle(vec(2, 0), 1)), material(0)));
    must(world.applyImpulse(body, vec(world.mass(body), 0)));
    EXPECT_NEAR(static_cast<double>(world.velocity(body).x), 1, 1e-6);
    must(world.applyForce(body, vec(0, 60 * world.mass(body))));
    must(world.step(kStep));
    EXPECT_NEAR(static_cast<double>(world.velocity(body).y), 1, 1e-6);
    EXPECT_EQ(world.angularVelocity(body), 0);
    EXPECT_EQ(world.applyForce({}, vec(1, 0)).code, StatusCode::staleId);
    EXPECT_EQ(world.applyImpulse(addStatic(world, box(1, 1)), vec(1, 0)).code, StatusCode::wrongBodyType);
}

TEST(Calls, AngularImpulse) {
    World world = makeWorld(0);
    const BodyId body = addBody(world, dynamicAt({}), box(1, 1));
    must(world.applyAngularImpulse(body, real(2 * world.inertia(body))));
    EXPECT_NEAR(spinOf(world, body), 2, 1e-6);
    EXPECT_EQ(world.velocity(body), Vec2{});
    EXPECT_EQ(world.applyAngularImpulse(body, std::numeric_limits<Real>::quiet_NaN()).code, StatusCode::notFinite);
    EXPECT_EQ(world.applyAngularImpulse(body, std::numeric_limits<Real>::infinity()).code, StatusCode::notFinite);
    EXPECT_EQ(world.applyAngularImpulse({}, 1).code, StatusCode::staleId);
    EXPECT_EQ(world.applyAngularImpulse(addStatic(world, box(1, 1)), 1).code, StatusCode::wrongBodyType);
    EXPECT_NEAR(spinOf(world, body), 2, 1e-6);
}

/// Each is a number, their product is none.
TEST(Calls, ForceWhoseTorqueIsNoNumberIsRefused) {
    World world = makeWorld(0);
    const BodyId body = addBody(world, dynamicAt({}), box(1, 1));
    const double large = std::sqrt(static_cast<double>(std::numeric_limits<Real>::max())) / 4;
    EXPECT_EQ(world.applyForce(body, vec(0, large), {large, 0}).code, StatusCode::outOfRange);
    must(world.applyTorque(body, real(large)));
    EXPECT_EQ(world.applyTorque(body, real(1.5 * large)).code, StatusCode::outOfRange);
}

/// A mass or inertia so small that no number is its inverse is none.
TEST(Calls, MassWithoutInverseIsNone) {
    World world = makeWorld();
    BodyDef def = dynamicAt({0, 1});
    def.mass = std::numeric_limits<Real>::denorm_min();
    const BodyId body = addBody(world, def, box(0.5, 0.5));
    EXPECT_EQ(world.step(kStep).code, StatusCode::missingMass);
    EXPECT_EQ(world.mass(body), 0);
    def.mass = 1;
    def.inertia = std::numeric_limits<Real>::denorm_min();
    must(world.redefine(body, def));
    addStatic(world, box(10, 0.1));
    runFor(world, 1);
    EXPECT_NEAR(world.position(body).y, 0.6, 0.01);
}

TEST(Calls, AxisOfAnyLength) {
    for (const double size : {std::numeric_limits<double>::denorm_min(), 1e-310, 1e-100, 1.0, 1e15}) {
        World world = makeWorld();
        PrismaticJointDef def;
        const BodyId slider = addBody(world, dynamicAt({}), box(0.5, 0.5));
        def.base = between(anchorOf(world), slider);
        def.axis = {0, size};
        const JointId joint = must(world.createJoint(def));
        runFor(world, 1);
        EXPECT_NEAR(world.position(slider).y, -kGravity / 2, 0.1) << size;
        EXPECT_LT(world.jointError(joint), 1e-5) << size;
        EXPECT_EQ(world.counters().putBack, 0U) << size;
    }
}

TEST(Calls, LengthThatWasSetIsTold) {
    World world = makeWorld();
    DistanceJointDef def;
    def.base = between(anchorOf(world), addBody(world, dynamicAt({0, -2}), circle(0.5)));
    def.anchorB = {0, -2};
    const JointId joint = must(world.createJoint(def));
    EXPECT_FALSE(std::get<DistanceJointDef>(world.definition(joint)).length);
    must(world.setLength(joint, 3));
    EXPECT_EQ(std::get<DistanceJointDef>(world.definition(joint)).length, real(3));
    must(world.setLengthLimits(joint, LengthLimits{1, 4}));
    EXPECT_EQ(world.setLength(joint, -1).code, StatusCode::notPositive);
    EXPECT_EQ(world.setLengthLimits(must(world.createJoint(WeldJointDef{.base = def.base})), LengthLimits{1, 4}).code,
              StatusCode::wrongJointType);
    EXPECT_EQ(world.setLengthLimits(must(world.createJoint(WeldJointDef{.base = def.base})), std::nullopt).code,
              StatusCode::wrongJointType);
}

/// Its target is where it holds A, in all that tells of it, wherever A is.
TEST(Calls, TargetOfAMouseThatWasSet) {
    World world = makeWorld(0);
    const BodyId anchor = addBody(world, bodyAt(BodyType::kinematic, {}), circle(0.1));
    must(world.setVelocity(anchor, vec(1, 0), 0));
    const BodyId body = addBody(world, dynamicAt({3, 0}), circle(0.5));
    MouseJointDef def;
    def.base = between(anchor, body);
    def.base.breakForce = real(1e-6);
    def.target = {3.25, 0};
    const JointId joint = must(world.createJoint(def));
    must(world.setTarget(joint, {3.25, 4}));
    EXPECT_NEAR(static_cast<double>(world.jointTranslation(joint)), 4, 1e-6);
    const MouseJointDef told = std::get<MouseJointDef>(world.definition(joint));
    EXPECT_EQ(told.target, (DVec2{3.25, 4}));
    EXPECT_EQ(told.anchor, (DVec2{3.25, 0}));  // by which it has it still
    must(world.step(kStep));
    ASSERT_EQ(world.jointBreaks().size(), 1U);
    EXPECT_EQ(world.jointBreaks()[0].point, (DVec2{3.25, 4}));
}

TEST(Calls, StageTimesAreThoseOfTheLastStep) {
    World world = makeWorld();
    addBody(world, dynamicAt({}), circle(0.5));
    WorldSettings settings = world.settings();
    settings.measureStageTimes = true;
    must(world.configure(settings));
    must(world.step(kStep));
    EXPECT_GT(world.stageTimes().finish, 0);
    settings.measureStageTimes = false;
    must(world.configure(settings));
    must(world.step(kStep));
    EXPECT_EQ(world.stageTimes().finish, 0);
}

}  // namespace
}  // namespace swept::test
