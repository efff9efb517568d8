#include "joint_support.h"
#include "world_digest.h"

/// A joint that is given another definition does as one that was made so, and touches only what is other.

namespace swept::test {
namespace {

/// The world as it was before, of a copy that does not know of the call.
template <class Call>
void expectChangesNothing(World& world, const Call& call) {
    World other = world;
    call();
    run(world, 30);
    run(other, 30);
    EXPECT_EQ(world.stateHash(), other.stateHash());
}

template <class Def>
Def definitionOf(const World& world, JointId joint) {
    return std::get<Def>(world.definition(joint));
}

/// A static body, and a box beside it.
struct Pair {
    World world = makeWorld();
    BodyId ground = must(world.createBody({}));
    BodyId crate = addBody(world, dynamicAt({2, 0}), box(0.5, 0.5));
    JointDef base{.bodyA = ground, .bodyB = crate};
};

/// What a definition says of the present is what the setters say.
template <class Def, class Change, class Setter>
void expectDoesAsSetter(const Def& def, const Change& change, const Setter& setter) {
    Pair pair;
    Def made = def;
    made.base = pair.base;
    const JointId joint = must(pair.world.createJoint(made));
    run(pair.world, 10);
    World other = pair.world;
    Def now = definitionOf<Def>(pair.world, joint);
    change(now);
    must(pair.world.redefine(joint, now));
    must(setter(other, joint));
    run(pair.world, 60);
    run(other, 60);
    EXPECT_EQ(pair.world.stateHash(), other.stateHash());
    EXPECT_EQ(pair.world.jointForce(joint), other.jointForce(joint));
    Pair unchanged;
    made.base = unchanged.base;
    must(unchanged.world.createJoint(made));
    run(unchanged.world, 70);
    EXPECT_NE(pair.world.stateHash(), unchanged.world.stateHash());
}

TEST(JointRedefine, DoesAsTheSettersOfItsParts) {
    const Spring spring{.hertz = 3, .dampingRatio = real(0.5)};
    expectDoesAsSetter(
        RevoluteJointDef{},
        [](auto& def) {
            def.limits = {real(-0.5), real(0.5)};
        },
        [](World& world, JointId id) {
            return world.setAngleLimits(id, AngleLimits{real(-0.5), real(0.5)});
        });
    expectDoesAsSetter(
        RevoluteJointDef{},
        [](auto& def) {
            def.motor = {3, 1000};
        },
        [](World& world, JointId id) {
            return world.setAngularMotor(id, AngularMotor{3, 1000});
        });
    expectDoesAsSetter(
        RevoluteJointDef{}, [&](auto& def) { def.spring = spring; },
        [&](World& world, JointId id) { return world.setSpring(id, spring); });
    const PrismaticJointDef slider{.axis = {0, 1}};
    expectDoesAsSetter(
        slider,
        [](auto& def) {
            def.limits = {-1, 1};
        },
        [](World& world, JointId id) {
            return world.setTranslationLimits(id, TranslationLimits{-1, 1});
        });
    expectDoesAsSetter(
        slider,
        [](auto& def) {
            def.motor = {1, 1000};
        },
        [](World& world, JointId id) {
            return world.setLinearMotor(id, LinearMotor{1, 1000});
        });
    expectDoesAsSetter(
        WheelJointDef{}, [&](auto& def) { def.spring = spring; },
        [&](World& world, JointId id) { return world.setSpring(id, spring); });
    expectDoesAsSetter(
        DistanceJointDef{.anchorB = {2, 0}}, [](auto& def) { def.length = 3; },
        [](World& world, JointId id) { return world.setLength(id, 3); });
    expectDoesAsSetter(
        DistanceJointDef{.anchorB = {2, 0}},
        [](auto& def) {
            def.limits = {1, 3};
        },
        [](World& world, JointId id) {
            return world.setLengthLimits(id, LengthLimits{1, 3});
        });
    expectDoesAsSetter(
        WeldJointDef{}, [&](auto& def) { def.angularSpring = spring; },
        [&](World& world, JointId id) { return world.setWeldSprings(id, std::nullopt, spring); });
    expectDoesAsSetter(
        MotorJointDef{}, [](auto& def) { def.drive.maxForce = 100; },
        [](World& world, JointId id) { return world.setDrive(id, {.maxForce = 100}); });
    expectDoesAsSetter(
        MouseJointDef{.target = {2, 0}},
        [](auto& def) {
            def.target = {3, 1};
        },
        [](World& world, JointId id) {
            return world.setTarget(id, {3, 1});
        });
}

/// Bodies, points and axes are not looked at, nor what they were made of.
TEST(JointRedefine, LeavesWhereItIs) {
    Pair pair;
    const JointId joint = must(pair.world.createJoint(RevoluteJointDef{.base = pair.base}));
    run(pair.world, 10);
    const DVec2 anchor = pair.world.anchorB(joint);
    expectChangesNothing(pair.world, [&] {
        must(pair.world.redefine(joint, pair.world.definition(joint)));
        must(pair.world.redefine(joint, RevoluteJointDef{.anchor = {7, 7}}));
    });
    EXPECT_LT(length(pair.world.anchorB(joint) - anchor), 1e-5);
    const auto def = definitionOf<RevoluteJointDef>(pair.world, joint);
    EXPECT_EQ(def.base.bodyB, pair.crate);
    EXPECT_EQ(def.anchor.x, 0);
}

TEST(JointRedefine, UserDataAndBreakLimitsWakeNothing) {
    WorldSettings settings = awakeSettings();
    settings.sleep = true;
    World world = makeWorld(settings);
    const BodyId ground = addStatic(world, box(20, 1));
    const BodyId crate = addBody(world, dynamicAt({0, 1.5}), box(0.5, 0.5));
    const JointId joint =
        must(world.createJoint(RevoluteJointDef{.base = {.bodyA = ground, .bodyB = crate}, .anchor = {0, 1}}));
    runFor(world, 4);
    ASSERT_FALSE(world.isAwake(crate));
    auto def = definitionOf<RevoluteJointDef>(world, joint);
    def.base.userData = 42;
    def.base.breakForce = real(1e6);
    must(world.redefine(joint, def));
    EXPECT_EQ(world.userData(joint), 42U);
    EXPECT_EQ(definitionOf<RevoluteJointDef>(world, joint).base.userData, 42U);
    EXPECT_EQ(definitionOf<RevoluteJointDef>(world, joint).base.breakForce, real(1e6));
    EXPECT_FALSE(world.isAwake(crate));
    BodyDef body = world.definition(crate);
    body.userData = 43;
    must(world.redefine(crate, body));
    EXPECT_EQ(world.userData(crate), 43U);
    EXPECT_FALSE(world.isAwake(crate));
    body.linearDamping = 1;
    must(world.redefine(crate, body));
    EXPECT_TRUE(world.isAwake(crate));
}

TEST(JointRedefine, StrengthOfAMouse) {
    Pair pair;
    const JointId joint = must(pair.world.createJoint(MouseJointDef{.base = pair.base, .target = {2, 0}}));
    runFor(pair.world, 0.5);
    EXPECT_NEAR(pair.world.position(pair.crate).y, 0, 1e-3);
    auto def = definitionOf<MouseJointDef>(pair.world, joint);
    def.maxForce = real(0.5 * pair.world.mass(pair.crate) * kGravity);
    must(pair.world.redefine(joint, def));
    const double before = pair.world.position(pair.crate).y;
    runFor(pair.world, 1);
    EXPECT_NEAR(pair.world.position(pair.crate).y - before, -0.25 * kGravity, 0.06);  // half of gravity is left
    EXPECT_NEAR(velocityOf(pair.world, pair.crate).y, -0.5 * kGravity, 0.05);
}

/// The one turns on, and the other by the new ratio from where it is.
TEST(JointRedefine, RatioOfAGear) {
    World world = makeWorld(0);
    const BodyId ground = must(world.createBody({}));
    std::array<BodyId, 2> wheels;
    std::array<JointId, 2> hinges;
    for (std::size_t i = 0; i < 2; ++i) {
        const DVec2 at{3.0 * static_cast<double>(i), 0};
        wheels[i] = addBody(world, dynamicAt(at), circle(1));
        hinges[i] = must(world.createJoint(RevoluteJointDef{.base = {ground, wheels[i]}, .anchor = at}));
    }
    const JointId gear = must(world.createJoint(GearJointDef{.jointA = hinges[0], .jointB = hinges[1], .ratio = 2}));
    must(world.setAngularMotor(hinges[1], AngularMotor{1, 1000}));
    runFor(world, 2);
    const double first = world.jointAngle(hinges[0]);
    const double second = world.jointAngle(hinges[1]);
    EXPECT_NEAR(first, -2 * second, 1e-3);
    auto def = definitionOf<GearJointDef>(world, gear);
    def.ratio = -3;
    must(world.redefine(gear, def));
    EXPECT_LT(world.jointAngleError(gear), 1e-3);
    runFor(world, 2);
    EXPECT_NEAR(world.jointAngle(hinges[1]) - second, 2, 0.05);
    EXPECT_NEAR(world.jointAngle(hinges[0]) - first, 3 * (world.jointAngle(hinges[1]) - second), 0.05);
    EXPECT_LT(world.jointAngleError(gear), 1e-3);
}

TEST(JointRedefine, RatioOfAPulley) {
    Pair pair;
    const BodyId other = addBody(pair.world, dynamicAt({-2, 0}), box(0.5, 0.5));
    const JointId rope = must(pair.world.createJoint(PulleyJointDef{.base = {.bodyA = other, .bodyB = pair.crate},
                                                                    .groundA = {-2, 4},
                                                                    .groundB = {2, 3},
                                                                    .anchorA = {-2, 0},
                                                                    .anchorB = {2, 0}}));
    runFor(pair.world, 0.5);
    EXPECT_NEAR(pair.world.position(other).y, 0, 1e-3);  // as heavy
    auto def = definitionOf<PulleyJointDef>(pair.world, rope);
    def.ratio = 2;
    must(pair.world.redefine(rope, def));
    EXPECT_LT(pair.world.jointError(rope), 1e-3);
    const double ofA = pair.world.position(other).y;
    const double ofB = pair.world.position(pair.crate).y;
    runFor(pair.world, 0.5);
    // m·(2g - g) = (m + m·2²)·a of A's side, by the way that A goes and half of that for B.
    const double way = pair.world.position(other).y - ofA;
    EXPECT_LT(way, -0.1);
    EXPECT_NEAR(pair.world.position(pair.crate).y - ofB, -0.5 * way, 1e-3);
}

/// It is stretched by 20 m, which the sum of the new ratio is less than.
TEST(JointRedefine, NoRatioLeavesAPulleyWithoutARope) {
    World world = makeWorld(0);
    const BodyId hung = addBody(world, dynamicAt({0, -1}), circle(0.5));
    const BodyId far = addBody(world, dynamicAt({10, 0}), circle(0.5));
    const JointId rope = must(world.createJoint(PulleyJointDef{
        .base = {.bodyA = hung, .bodyB = far}, .anchorA = {0, -1}, .anchorB = {10, 0}, .ratio = 2, .length = Real(1)}));
    auto def = definitionOf<PulleyJointDef>(world, rope);
    for (const double ratio : {1.0, 1.9}) {  // 1.9: exactly nothing is left, or less by a rounding
        def.ratio = real(ratio);
        const Status status = world.redefine(rope, def);
        EXPECT_EQ(status.code, StatusCode::outOfRange) << ratio;
        EXPECT_EQ(std::string(status.field), "ratio");
    }
    EXPECT_EQ(definitionOf<PulleyJointDef>(world, rope).ratio, 2);
    def.ratio = real(1.95);
    must(world.redefine(rope, def));
    EXPECT_NEAR(definitionOf<PulleyJointDef>(world, rope).length.value(), 0.5, 1e-5);
    must(world.redefine(rope, world.definition(rope)));
}

TEST(JointRedefine, WhetherTheTwoCollide) {
    World world = makeWorld(0);
    const BodyId ground = addStatic(world, box(1, 1));
    const BodyId crate = addBody(world, dynamicAt({1.4, 0}), box(0.5, 0.5));
    const JointId joint = must(
        world.createJoint(DistanceJointDef{.base = {.bodyA = ground, .bodyB = crate}, .limits = LengthLimits{0, 9}}));
    run(world, 10);
    world.visitContacts([](const ContactView&) { ADD_FAILURE(); });
    auto def = definitionOf<DistanceJointDef>(world, joint);
    def.base.collideConnected = true;
    must(world.redefine(joint, def));
    EXPECT_TRUE(definitionOf<DistanceJointDef>(world, joint).base.collideConnected);
    run(world, 1);
    ASSERT_EQ(world.contactEvents().size(), 1U);
    EXPECT_EQ(world.contactEvents()[0].type, ContactEventType::begin);
    must(world.setVelocity(crate, vec(-2, 0), 0));
    runFor(world, 1);
    EXPECT_GT(world.position(crate).x, 1.35);
    def.base.collideConnected = false;
    must(world.redefine(joint, def));
    world.visitContacts([](const ContactView&) { ADD_FAILURE(); });
    run(world, 1);
    ASSERT_EQ(world.contactEvents().size(), 1U);
    EXPECT_EQ(world.contactEvents()[0].type, ContactEventType::end);
}

/// The rod that a rope of no length becomes, and back: no order of the two refuses what is good in the end.
TEST(JointRedefine, RopeOfNoLengthAndRod) {
    World world = makeWorld(0);
    const BodyId ground = must(world.createBody({}));
    const BodyId ball = addBody(world, dynamicAt({0, 0}), circle(0.5));
    const DistanceJointDef rope{.base = {.bodyA = ground, .bodyB = ball}, .limits = LengthLimits{0, 2}};
    const JointId joint = must(world.createJoint(rope));
    must(world.setVelocity(ball, vec(1, 0), 0));
    runFor(world, 1);
    DistanceJointDef rod = rope;
    rod.limits.reset();
    EXPECT_EQ(world.redefine(joint, rod).code, StatusCode::notPositive);
    rod.length = 2;
    must(world.redefine(joint, rod));
    runFor(world, 2);
    EXPECT_NEAR(length(world.position(ball)), 2, 1e-2);
    DistanceJointDef again = rope;
    again.length = 0;
    must(world.redefine(joint, again));
    EXPECT_EQ(definitionOf<DistanceJointDef>(world, joint).length, Real(0));
}

/// A spring of no length has no direction, within limits neither: no call makes one of a rope of no length.
TEST(JointRedefine, RopeOfNoLengthAndSpring) {
    World world = makeWorld(0);
    const BodyId ground = must(world.createBody({}));
    const BodyId ball = addBody(world, dynamicAt({1, 0}), circle(0.5));
    DistanceJointDef def{.base = {.bodyA = ground, .bodyB = ball},
                         .anchorB = {1, 0},
                         .length = Real(0),
                         .limits = LengthLimits{0, 2},
                         .spring = Spring{.hertz = 5, .dampingRatio = 1}};
    const auto expectRefused = [](const Status& status) {
        EXPECT_EQ(status.code, StatusCode::notPositive);
        EXPECT_STREQ(status.field, "length");
    };
    expectRefused(world.createJoint(def).status());
    DistanceJointDef rope = def;
    rope.spring.reset();
    const JointId joint = must(world.createJoint(rope));
    expectRefused(world.setSpring(joint, def.spring));
    expectRefused(world.redefine(joint, def));
    EXPECT_FALSE(definitionOf<DistanceJointDef>(world, joint).spring);
    must(world.setSpring(joint, std::nullopt));
    def.length = 1;  // in whatever order: the length is there before the spring
    must(world.redefine(joint, def));
    EXPECT_EQ(definitionOf<DistanceJointDef>(world, joint).length, Real(1));
    EXPECT_TRUE(definitionOf<DistanceJointDef>(world, joint).spring);
    expectRefused(world.setLength(joint, 0));
    must(world.setLengthLimits(joint, LengthLimits{0, 3}));
    must(world.redefine(joint, rope));
    EXPECT_EQ(definitionOf<DistanceJointDef>(world, joint).length, Real(0));
    EXPECT_FALSE(definitionOf<DistanceJointDef>(world, joint).spring);
}

TEST(JointRedefine, RefusalsChangeNothing) {
    Pair pair;
    World& world = pair.world;
    const BodyId other = addBody(world, dynamicAt({-2, 0}), circle(0.5));
    JointDef base = pair.base;
    base.bodyB = other;
    const JointId wheel = must(world.createJoint(WheelJointDef{.base = base, .anchor = {-2, 0}}));
    const JointId hinge = must(world.createJoint(RevoluteJointDef{.base = pair.base}));
    const JointId second = must(world.createJoint(RevoluteJointDef{.base = base}));
    const JointId gear = must(world.createJoint(GearJointDef{.jointA = hinge, .jointB = second}));
    const JointId pulley = must(world.createJoint(PulleyJointDef{
        .base = {.bodyA = pair.crate, .bodyB = other}, .groundA = {2, 3}, .groundB = {-2, 3}, .anchorA = {2, 0}}));
    run(world, 5);
    const JointId stale = must(world.createJoint(RevoluteJointDef{.base = base}));
    must(world.destroyJoint(stale));
    const auto expectRefused = [&](JointId id, const AnyJointDef& def, StatusCode code, const std::string& field) {
        const AnyJointDef before = world.definition(id);
        const Status status = world.redefine(id, def);
        EXPECT_EQ(status.code, code) << field;
        EXPECT_EQ(status.field, field);
        EXPECT_EQ(world.definition(id).index(), before.index());
    };
    const Real nan = std::numeric_limits<Real>::quiet_NaN();
    expectChangesNothing(world, [&] {
        expectRefused(stale, RevoluteJointDef{}, StatusCode::staleId, "joint");
        expectRefused(hinge, WheelJointDef{}, StatusCode::wrongJointType, "joint");
        // What is good in a bad definition is not taken either.
        const AngularMotor motor{5, 100};
        expectRefused(hinge, RevoluteJointDef{.limits = AngleLimits{1, 0}, .motor = motor}, StatusCode::outOfRange,
                      "upper");
        expectRefused(hinge, RevoluteJointDef{.base = {.breakForce = Real(0)}, .motor = motor}, StatusCode::notPositive,
                      "breakForce");
        expectRefused(wheel, WheelJointDef{.motor = motor, .spring = Spring{nan, 0}}, StatusCode::notFinite, "hertz");
        expectRefused(gear, GearJointDef{.base = {.userData = 7}, .ratio = 0}, StatusCode::outOfRange, "ratio");
        expectRefused(pulley, PulleyJointDef{.base = {.collideConnected = true}, .ratio = -1}, StatusCode::negative,
                      "ratio");
        expectRefused(pulley, PulleyJointDef{.ratio = std::numeric_limits<Real>::max()}, StatusCode::outOfRange,
                      "ratio");
    });
    EXPECT_EQ(world.userData(gear), 0U);
    EXPECT_FALSE(definitionOf<PulleyJointDef>(world, pulley).base.collideConnected);
    EXPECT_EQ(definitionOf<GearJointDef>(world, gear).ratio, 1);
}

}  // namespace
}  // namespace swept::test
