#include <swept/samples/built_in/builtin_scenes.h>

#include <cmath>
#include <string>
#include <variant>
#include <vector>

#include "mixed_scene.h"
#include "scene_of_world.h"

/// What is made of a world as a scene is where the world was, and goes on much as it does.

namespace swept::test {
namespace {

/// Two bars on a joint, that `make` makes, and the one that can move.
struct Swing {
    World world;
    BodyId base;
    BodyId bar;
    JointId joint;
};
template <class Def>
Swing swing(Def def, BodyType baseType = BodyType::fixed) {
    Swing swing{makeWorld(), {}, {}, {}};
    swing.base = addBody(swing.world, bodyAt(baseType, {0, 5}, 0.3), box(0.5, 0.2));
    swing.bar = addBody(swing.world, dynamicAt({1, 5}, vec(1, 2), 2), box(1, 0.1));
    def.base.bodyA = swing.base;
    def.base.bodyB = swing.bar;
    swing.joint = must(swing.world.createJoint(def));
    return swing;
}

/// Where it is, and what it counts from there.
void expectSameJoint(const World& world, JointId joint, const World& other, JointId twin, const std::string& what) {
    const double rounding = kIsDouble ? 1e-12 : 2e-6;
    EXPECT_NEAR(static_cast<double>(other.jointError(twin)), static_cast<double>(world.jointError(joint)), rounding)
        << what;
    EXPECT_NEAR(static_cast<double>(other.jointAngleError(twin)), static_cast<double>(world.jointAngleError(joint)),
                rounding)
        << what;
    if (world.type(joint) != JointType::motor) {  // which counts it from where it is made
        EXPECT_NEAR(static_cast<double>(other.jointTranslation(twin)),
                    static_cast<double>(world.jointTranslation(joint)), rounding)
            << what;
        EXPECT_LE(length(other.anchorA(twin) - world.anchorA(joint)), 1e-6) << what;
        EXPECT_LE(length(other.anchorB(twin) - world.anchorB(joint)), 1e-6) << what;
    }
    const auto hasLimits = [&](const auto& mine) {
        const auto its = std::get<std::decay_t<decltype(mine)>>(other.definition(twin));
        if constexpr (requires { mine.limits; }) { EXPECT_EQ(mine.limits, its.limits) << what; }
        if constexpr (requires { mine.springTarget; }) { EXPECT_EQ(mine.springTarget, its.springTarget) << what; }
        if constexpr (requires { mine.axis; }) {  // not a rod, nor what has no angle of its own
            EXPECT_NEAR(other.jointAngle(twin), world.jointAngle(joint), 1e-12) << what;
        }
    };
    std::visit(hasLimits, world.definition(joint));
}

/// From 0.4 s on it goes on as the world itself does: limits, targets and motors are where they were.
template <class Def>
void expectToGoOn(const Def& def, double tolerance, const std::string& what, BodyType baseType = BodyType::fixed) {
    Swing first = swing(def, baseType);
    run(first.world, 24);
    const std::string text = sceneOf(first.world);
    SceneWorld again = rebuilt(text, what);
    ASSERT_EQ(again.joints.size(), 1U) << text;
    EXPECT_EQ(again.world.type(again.joints[0]), first.world.type(first.joint)) << what;
    expectSameJoint(first.world, first.joint, again.world, again.joints[0], what);
    run(first.world, 120);
    run(again.world, 120);
    const DVec2 wanted = first.world.position(first.bar);
    const DVec2 found = again.world.position(again.bodies[1]);
    expectAtMost(what + ": place, m", length(found - wanted), tolerance);
    expectAtMost(what + ": angle, rad", std::fabs(again.world.angle(again.bodies[1]) - first.world.angle(first.bar)),
                 tolerance);
}

TEST(WorldScene, JointsGoOnFromWhereTheyAre) {
    const Spring spring{real(2), real(0.2)};
    RevoluteJointDef hinge;
    hinge.anchor = {0.2, 5};
    expectToGoOn(hinge, 1e-4, "hinge");
    hinge.limits = AngleLimits{real(-0.9), real(0.35)};
    expectToGoOn(hinge, 1e-4, "hinge with limits");
    hinge.limits.reset();
    hinge.spring = spring;
    hinge.springTarget = real(0.7);
    expectToGoOn(hinge, 1e-3, "hinge with a spring that aims");
    hinge.motor = AngularMotor{real(-2), real(30)};
    expectToGoOn(hinge, 1e-3, "hinge with a motor");

    DistanceJointDef rod;
    rod.anchorA = {0.1, 5.1};
    rod.anchorB = {1.5, 5};
    expectToGoOn(rod, 1e-4, "rod");
    rod.length = real(1.7);
    rod.spring = spring;
    expectToGoOn(rod, 1e-3, "spring");
    rod.limits = LengthLimits{real(1), real(1.9)};
    expectToGoOn(rod, 2e-3, "spring within limits");
    rod.spring.reset();
    rod.length.reset();
    rod.limits = LengthLimits{real(0), real(2.5)};
    expectToGoOn(rod, 2e-3, "rope");

    PrismaticJointDef slider;
    slider.anchor = {0.2, 5};
    slider.axis = {3, 1};
    slider.limits = TranslationLimits{real(-0.8), real(0.6)};
    expectToGoOn(slider, 1e-4, "slider with limits");
    slider.limits.reset();
    slider.spring = spring;
    slider.springTarget = real(-0.4);
    expectToGoOn(slider, 1e-3, "slider with a spring that aims");

    WheelJointDef wheel;
    wheel.anchor = {1, 5};
    wheel.axis = {1, 2};
    wheel.spring = spring;
    wheel.springTarget = real(0.3);
    wheel.limits = TranslationLimits{real(-0.5), real(0.7)};
    wheel.motor = AngularMotor{real(4), real(2)};
    expectToGoOn(wheel, 2e-3, "wheel");

    WeldJointDef weld;
    weld.anchor = {0.5, 5};
    expectToGoOn(weld, 1e-4, "weld");

    MotorJointDef motor;
    motor.drive.maxForce = real(80);
    motor.drive.maxTorque = real(20);
    expectToGoOn(motor, 1e-3, "motor joint that keeps the pose");
    motor.drive.linearOffset = vec(0.5, -0.5);
    motor.drive.angularOffset = real(0.8);
    expectToGoOn(motor, 1e-3, "motor joint with offsets");
    motor.drive.linearOffset.reset();
    motor.drive.angularOffset.reset();
    motor.drive.linearVelocity = vec(0.25, 0.125);
    motor.drive.angularVelocity = real(0.5);
    expectToGoOn(motor, 1e-3, "motor joint with velocities");

    MouseJointDef mouse;
    mouse.target = {2, 6};
    mouse.anchor = DVec2{1.7, 5};
    mouse.spring = spring;
    expectToGoOn(mouse, 2e-3, "mouse joint");

    PulleyJointDef pulley;
    pulley.groundA = {-1, 9};
    pulley.groundB = {2, 9};
    pulley.anchorA = {0, 5};
    pulley.anchorB = {1, 5};
    pulley.ratio = real(0.5);
    Swing hung = swing(pulley, BodyType::dynamic);
    SceneWorld again = rebuilt(sceneOf(hung.world), "pulley");
    run(hung.world, 60);
    run(again.world, 60);
    expectAtMost("pulley: place, m", length(again.world.position(again.bodies[1]) - hung.world.position(hung.bar)),
                 1e-3);
}

/// The axis of a slider turns with its base.
TEST(WorldScene, AxesAreWhereTheyTurnedTo) {
    World world = makeWorld(real(0));
    const BodyId base = addBody(world, bodyAt(BodyType::kinematic, {0, 0}), box(0.2, 0.2));
    const BodyId sled = addBody(world, dynamicAt({1, 0}), box(0.1, 0.1));
    must(world.setVelocity(base, {}, real(1)));
    PrismaticJointDef def;
    def.base.bodyA = base;
    def.base.bodyB = sled;
    def.anchor = {1, 0};
    def.axis = {1, 0};
    def.limits = TranslationLimits{real(-0.5), real(0.25)};
    const JointId joint = must(world.createJoint(def));
    run(world, 90);
    SceneWorld again = rebuilt(sceneOf(world), "turned");
    run(world, 30);
    run(again.world, 30);
    const double begun = length(world.position(sled) - world.position(base)) - 1;
    EXPECT_NEAR(begun, 0.25, 1e-3) << "flung out to its limit";
    EXPECT_NEAR(static_cast<double>(world.jointTranslation(joint)), 0.25, 1e-3);
    EXPECT_NEAR(static_cast<double>(again.world.jointTranslation(again.joints[0])), 0.25, 1e-3) << "and still there";
    expectAtMost("place, m", length(again.world.position(again.bodies[1]) - world.position(sled)), 1e-4);
}

/// Apart, turned, slack, or drawn out: what a joint lacks of holding, and what loads a spring, is in the scene.
TEST(WorldScene, JointsThatDoNotHoldBeginSo) {
    const auto expectKept = [](auto def, const std::string& what) {
        Swing first = swing(def);
        must(first.world.setPose(first.bar, {1.25, 5.5}, 0.75));
        const SceneWorld again = rebuilt(sceneOf(first.world), what);
        ASSERT_EQ(again.joints.size(), 1U) << what;
        expectSameJoint(first.world, first.joint, again.world, again.joints[0], what);
        World other = first.world;
        must(other.setAwake(first.bar, true));
        SceneWorld moves = rebuilt(sceneOf(first.world), what);
        run(other, 60);
        run(moves.world, 60);
        expectAtMost(what + ": a second later, m",
                     length(moves.world.position(moves.bodies[1]) - other.position(first.bar)), 0.01);
        expectAtMost(what + ": a second later, rad",
                     std::fabs(moves.world.angle(moves.bodies[1]) - other.angle(first.bar)), 0.02);
    };
    const Spring spring{real(2), real(0.2)};
    expectKept(RevoluteJointDef{.anchor = {0.2, 5}, .limits = AngleLimits{real(-2), real(2)}}, "hinge");
    expectKept(PrismaticJointDef{.anchor = {0.2, 5}, .axis = {3, 1}, .spring = spring}, "slider");
    expectKept(WheelJointDef{.anchor = {1, 5}, .axis = {1, 2}, .spring = spring}, "wheel");
    expectKept(WeldJointDef{.anchor = {0.5, 5}}, "weld");
    expectKept(WeldJointDef{.anchor = {0.5, 5}, .linearSpring = spring}, "weld on a spring");
    expectKept(WeldJointDef{.anchor = {0.5, 5}, .linearSpring = spring, .angularSpring = spring}, "weld on springs");
    MotorJointDef motor;
    motor.drive.maxForce = real(80);
    motor.drive.maxTorque = real(20);
    expectKept(motor, "motor joint");
    PulleyJointDef rope;
    rope.groundA = {-1, 9};
    rope.groundB = {2, 9};
    rope.anchorA = {0, 5};
    rope.anchorB = {1, 5};
    expectKept(rope, "slack rope");
}

TEST(WorldScene, BuiltInScenesAreReadAgainWhereverTheyAre) {
    std::vector<SceneDescription> all;
    for (const BuiltinScene& entry : builtinScenes()) { all.push_back(entry.make()); }
    all.push_back(scenes::mixedScene());
    for (const SceneDescription& scene : all) {
        SceneWorld built;
        std::string error;
        ASSERT_TRUE(buildWorld(scene, built, error)) << error;
        run(built.world, 40, scene.settings.dt);
        SceneWorld again = rebuilt(sceneOf(built.world, namesOf(scene, built.world)), scene.name);
        expectSameBodies(built.world, again.world, scene.name);
        EXPECT_EQ(again.world.jointCount(), built.world.jointCount()) << scene.name;
        run(again.world, 3, scene.settings.dt);
    }
}

/// A wall that sleeps sleeps on.
TEST(WorldScene, WhatSleepsSleepsOn) {
    World world;
    (void)addStatic(world, box(10, 0.5), {}, {0, -0.5});
    for (int i = 0; i < 12; ++i) { addBody(world, dynamicAt({i % 3 * 1.25, 0.5 + i / 3}), box(0.5, 0.5)); }
    runFor(world, 4);
    ASSERT_EQ(world.counters().awakeBodies, 0);
    SceneWorld again = rebuilt(sceneOf(world), "asleep");
    run(again.world, 5);
    for (const BodyId body : again.bodies) { EXPECT_FALSE(again.world.isAwake(body)); }
}

/// Slots and generations do not count: places do.
TEST(WorldScene, AfterThingsWereDestroyed) {
    World world = makeWorld();
    std::vector<BodyId> links;
    for (int i = 0; i < 5; ++i) { links.push_back(addBody(world, dynamicAt({0.5 * i, 3}), box(0.25, 0.1))); }
    std::vector<JointId> hinges;
    for (std::size_t i = 1; i < 5; ++i) {
        RevoluteJointDef def;
        def.base.bodyA = links[i - 1];
        def.base.bodyB = links[i];
        def.anchor = {0.5 * static_cast<double>(i) - 0.25, 3};
        hinges.push_back(must(world.createJoint(def)));
    }
    GearJointDef gear;
    gear.jointA = hinges[2];
    gear.jointB = hinges[3];
    gear.ratio = real(-2);
    (void)must(world.createJoint(gear));
    MotorJointDef idle;  // without strength, which keeps the two apart
    idle.base.bodyA = links[2];
    idle.base.bodyB = links[4];
    (void)must(world.createJoint(idle));
    must(world.destroyBody(links[0]));
    const SceneWorld again = rebuilt(sceneOf(world), "destroyed");
    ASSERT_EQ(again.bodies.size(), 4U);
    ASSERT_EQ(again.joints.size(), 5U);
    EXPECT_EQ(again.world.type(again.joints.back()), JointType::filter);
    const auto wheels = std::get<GearJointDef>(again.world.definition(again.joints[3]));
    EXPECT_EQ(wheels.jointA, again.joints[1]);
    EXPECT_EQ(wheels.jointB, again.joints[2]);
    EXPECT_EQ(wheels.ratio, real(-2));
    // Nobody can be moved by what is left of it.
    for (const std::size_t i : {std::size_t{1}, std::size_t{2}}) {
        BodyDef def = world.definition(links[i]);
        def.type = BodyType::kinematic;
        must(world.redefine(links[i], def));
    }
    EXPECT_EQ(rebuilt(sceneOf(world), "held").joints.size(), 4U);
}

TEST(WorldScene, ChainsWithNeighboursAndLoops) {
    World world;
    const BodyId ground = must(world.createBody({}));
    const std::vector<Vec2> open{vec(4, 0), vec(0, -1), vec(-4, 0)};
    (void)must(world.addChain(ground, open, false, {}, real(0.05), {.before = vec(8, 1), .after = vec(-8, 1)}));
    (void)must(world.addChain(ground, open, false));
    const std::vector<Vec2> loop{vec(0, 3), vec(2, 3), vec(1, 5)};
    (void)must(world.addChain(ground, loop, true));
    const SceneResult read = readScene(sceneOf(world), "chains", {});
    ASSERT_TRUE(read.scene.has_value()) << read.error.text();
    const auto& shapes = read.scene->bodies[0].shapes;
    const auto& first = std::get<ChainGeometry>(shapes[0].geometry);
    EXPECT_EQ(first.before, (DVec2{8, 1}));
    EXPECT_EQ(first.after, (DVec2{-8, 1}));
    EXPECT_EQ(shapes[0].radius, 0.05) << "the digits of a float that say which it is";
    EXPECT_EQ(std::get<ChainGeometry>(shapes[1].geometry), (ChainGeometry{.points = {{4, 0}, {0, -1}, {-4, 0}}}));
    EXPECT_EQ(std::get<ChainGeometry>(shapes[2].geometry),
              (ChainGeometry{.points = {{0, 3}, {2, 3}, {1, 5}}, .loop = true}));
}

TEST(WorldScene, OfAWorldWithNothing) {
    EXPECT_EQ(sceneOf(makeWorld(real(10))),
              "{\"gravity\": [0, -10], \"settings\": {\"sleep\": false},\n \"bodies\": [],\n \"joints\": []}\n");
}

}  // namespace
}  // namespace swept::test
