#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <tuple>
#include <type_traits>
#include <variant>
#include <vector>

#include "../samples/random_scene.h"
#include "../support/some_of.h"
#include "scene_of_world.h"
#include "vandal.h"

/// A world as a scene has all that the world has, and is read by the reader of scenes whatever that is.

namespace swept::test {
namespace {

/// A box whose corners a float cannot tell apart, so far from the origin, is a box of that size for the world, but no
/// hull of its corners for the reader.
bool isFlat(const std::string& text, const std::string& what) {
    const SceneResult read = readScene(text, what, {});
    SceneWorld built;
    std::string error;
    return read.scene && !buildWorld(*read.scene, built, error) && error.find("degenerate") != std::string::npos;
}

/// Numbers of a scene that the world has as `Real`, and where they begin: what is left out is `usual`.
void expectNear(const std::optional<double>& wanted, const std::optional<double>& found, const std::string& what,
                double usual = 0) {
    const double a = wanted.value_or(usual);
    EXPECT_NEAR(found.value_or(usual), a, (kIsDouble ? 1e-9 : 1e-5) * (std::fabs(a) + 1e-20)) << what;
}
/// What is none is none.
void expectSame(const std::optional<double>& wanted, const std::optional<double>& found, const std::string& what) {
    EXPECT_EQ(wanted.has_value(), found.has_value()) << what;
    expectNear(wanted, found, what);
}

/// All but places.
struct JointComparison {
    const JointGeometry& other;
    std::string what;

    void operator()(const RevoluteDescription& a) const { expectGuide(a); }
    void operator()(const PrismaticDescription& a) const { expectGuide(a); }
    void operator()(const WheelDescription& a) const { expectGuide(a); }
    void operator()(const DistanceDescription& a) const {
        const auto& b = std::get<DistanceDescription>(other);
        const bool hasLength = a.hertz || !(a.minLength || a.maxLength);
        if (a.length && hasLength) { expectSame(a.length, b.length, what); }
        expectNear(a.minLength, b.minLength, what);
        expectSame(a.maxLength, b.maxLength, what);
        expectSpring(a, b);
    }
    void operator()(const WeldDescription& a) const {
        const auto& b = std::get<WeldDescription>(other);
        expectSame(a.linearHertz, b.linearHertz, what);
        expectSame(a.angularHertz, b.angularHertz, what);
        if (a.linearHertz || a.angularHertz) { expectNear(a.dampingRatio, b.dampingRatio, what); }
    }
    void operator()(const MotorDescription& a) const {
        const auto& b = std::get<MotorDescription>(other);
        expectSame(a.maxForce, b.maxForce, what);
        expectSame(a.maxTorque, b.maxTorque, what);
        if (a.maxTorque) {
            expectNear(a.angularOffset, b.angularOffset, what);
            expectSame(a.angularVelocity, b.angularVelocity, what);
        }
        if (a.maxForce && a.linearVelocity) {
            ASSERT_TRUE(b.linearVelocity.has_value()) << what;
            expectNear(a.linearVelocity->x, b.linearVelocity->x, what);
            expectNear(a.linearVelocity->y, b.linearVelocity->y, what);
        }
        if (a.maxForce && a.linearOffset) {
            ASSERT_TRUE(b.linearOffset.has_value()) << what;
            expectNear(a.linearOffset->x, b.linearOffset->x, what);
            expectNear(a.linearOffset->y, b.linearOffset->y, what);
        }
    }
    void operator()(const MouseDescription& a) const {
        const auto& b = std::get<MouseDescription>(other);
        expectSame(a.hertz, b.hertz, what);
        expectNear(a.dampingRatio, b.dampingRatio, what);
        expectSame(a.maxForce, b.maxForce, what);
    }
    void operator()(const GearDescription& a) const {
        const auto& b = std::get<GearDescription>(other);
        EXPECT_EQ(a.jointA, b.jointA) << what;
        EXPECT_EQ(a.jointB, b.jointB) << what;
        expectNear(a.ratio, b.ratio, what);
    }
    void operator()(const PulleyDescription& a) const {
        const auto& b = std::get<PulleyDescription>(other);
        expectNear(a.ratio, b.ratio, what);
        if (a.length) { expectSame(a.length, b.length, what); }
        EXPECT_EQ(a.groundA, b.groundA) << what;
        EXPECT_EQ(a.groundB, b.groundB) << what;
    }
    void operator()(const FilterJointDescription&) const {}

private:
    template <class Guided>
    void expectGuide(const Guided& a) const {
        const auto& b = std::get<Guided>(other);
        expectSame(a.lower, b.lower, what);
        expectSame(a.upper, b.upper, what);
        expectNear(a.motorSpeed, b.motorSpeed, what);
        if constexpr (std::is_same_v<Guided, PrismaticDescription>) {
            expectSame(a.maxMotorForce, b.maxMotorForce, what);
        } else {
            expectSame(a.maxMotorTorque, b.maxMotorTorque, what);
        }
        if constexpr (std::is_same_v<Guided, WheelDescription>) {
            expectSpring(a, b);
        } else {
            expectSame(a.hertz, b.hertz, what);
            expectNear(a.dampingRatio, b.dampingRatio, what);
        }
        if (a.hertz) { expectNear(a.springTarget, b.springTarget, what); }
    }
    /// Of stiffness told by what moves along a line, whose mass hangs by the last digit of anchors that are so far from
    /// their bodies as some of these.
    template <class Sprung>
    void expectSpring(const Sprung& a, const Sprung& b) const {
        EXPECT_EQ(a.hertz.has_value(), b.hertz.has_value()) << what;
        if (!kIsDouble) { return; }
        expectNear(a.hertz, b.hertz, what);
        expectNear(a.dampingRatio, b.dampingRatio, what);
    }
};

/// Of what a point of a body comes to in the world, m.
double sizesOf(const World& world, BodyId body, DVec2 point) {
    const DVec2 origin = world.position(body);
    return length(point) + length(point - origin) + length(world.centerOfMass(body) - origin);
}

/// Joints begin where they were.
void expectSamePlaces(const World& world, const World& other, const std::string& where) {
    const std::vector<JointId> joints = jointsOf(world);
    const std::vector<JointId> twins = jointsOf(other);
    ASSERT_EQ(joints.size(), twins.size()) << where;
    for (std::size_t i = 0; i < joints.size(); ++i) {
        if (world.type(joints[i]) != other.type(twins[i])) { continue; }  // a motor without strength
        const std::string what = where + ", joint " + std::to_string(i);
        const JointDef base = std::visit([](const auto& def) { return def.base; }, world.definition(joints[i]));
        const double far =
            sizesOf(world, base.bodyA, world.anchorA(joints[i])) + sizesOf(world, base.bodyB, world.anchorB(joints[i]));
        const double rounding = (kIsDouble ? 1e-14 : 2e-6) * far;
        const JointType type = world.type(joints[i]);
        if (type == JointType::gear) { continue; }  // which hold in the scene
        if (type != JointType::motor) {             // which count this from where they are made
            EXPECT_LE(length(other.anchorA(twins[i]) - world.anchorA(joints[i])), rounding) << what;
            EXPECT_LE(length(other.anchorB(twins[i]) - world.anchorB(joints[i])), rounding) << what;
            EXPECT_NEAR(static_cast<double>(other.jointTranslation(twins[i])),
                        static_cast<double>(world.jointTranslation(joints[i])), rounding)
                << what;
        }
        if (type != JointType::pulley) {  // which are a difference of ropes
            EXPECT_NEAR(static_cast<double>(other.jointError(twins[i])),
                        static_cast<double>(world.jointError(joints[i])), 2 * rounding)
                << what;
        }
        const bool hasReference = type != JointType::distance && type < JointType::mouse;
        if (hasReference) { EXPECT_NEAR(other.jointAngle(twins[i]), world.jointAngle(joints[i]), 1e-8) << what; }
    }
}

void expectSameJoints(const SceneDescription& scene, const SceneDescription& other, const std::string& where) {
    ASSERT_EQ(scene.joints.size(), other.joints.size()) << where;
    std::map<std::string, const JointDescription*> others;
    for (std::size_t i = 0; i < other.joints.size(); ++i) { others[jointName(other, i)] = &other.joints[i]; }
    for (std::size_t i = 0; i < scene.joints.size(); ++i) {
        const JointDescription& a = scene.joints[i];
        const auto found = others.find(jointName(scene, i));
        ASSERT_TRUE(found != others.end()) << where;
        const JointDescription& b = *found->second;
        const std::string what = where + ", " + jointName(scene, i);
        if (a.joint.index() != b.joint.index()) {  // a motor without strength
            EXPECT_EQ(static_cast<JointType>(b.joint.index()), JointType::filter) << what;
            continue;
        }
        EXPECT_EQ(a.bodyA, b.bodyA) << what;
        EXPECT_EQ(a.bodyB, b.bodyB) << what;
        if (!std::holds_alternative<MouseDescription>(a.joint)) {  // whose bodies collide in any case
            EXPECT_EQ(a.collideConnected, b.collideConnected) << what;
        }
        expectSame(a.breakForce, b.breakForce, what);
        expectSame(a.breakTorque, b.breakTorque, what);
        std::visit(JointComparison{b.joint, what}, a.joint);
    }
}

TEST(WorldScene, HasAllThatARandomSceneHas) {
    int tried = 0;
    int flat = 0;
    std::map<JointType, int> kinds;
    for (std::uint64_t seed = 0; seed < someOf(1400U); ++seed) {
        const SceneDescription scene = SceneMaker(seed).make();
        SceneWorld built;
        std::string error;
        if (!buildWorld(scene, built, error)) { continue; }  // what a float rounds to nothing
        ++tried;
        const std::string what = "seed " + std::to_string(seed);
        const std::string text = sceneOf(built.world, namesOf(scene, built.world));
        if (!kIsDouble && isFlat(text, what)) {
            ++flat;
            continue;
        }
        const SceneWorld again = rebuilt(text, what);
        expectSameBodies(built.world, again.world, what);
        const std::vector<JointId> joints = jointsOf(built.world);
        for (const JointId joint : joints) { ++kinds[built.world.type(joint)]; }
        const SceneResult read = readScene(text, what, {});
        ASSERT_TRUE(read.scene.has_value());
        expectSameJoints(scene, *read.scene, what);
        expectSamePlaces(built.world, again.world, what);
        EXPECT_EQ(read.scene->name, scene.name);
        for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
            EXPECT_EQ(read.scene->bodies[i].name, scene.bodies[i].name) << what;
        }
        WorldSettings a = built.world.settings();
        const WorldSettings b = again.world.settings();
        EXPECT_EQ(std::tuple(a.gravity, a.profile, a.subSteps, a.relaxPasses, a.continuous, a.maxImpacts, a.maxSpeed),
                  std::tuple(b.gravity, b.profile, b.subSteps, b.relaxPasses, b.continuous, b.maxImpacts, b.maxSpeed))
            << what;
        EXPECT_EQ(std::tuple(a.maxPenetration, a.maxJointError, a.maxLostTime, a.toiTolerance, a.sleep, a.sleepSpeed,
                             a.broadphase),
                  std::tuple(b.maxPenetration, b.maxJointError, b.maxLostTime, b.toiTolerance, b.sleep, b.sleepSpeed,
                             b.broadphase))
            << what;
    }
    EXPECT_GT(tried, someOf(500));
    EXPECT_LT(flat, tried / 2);
    for (int type = 0; type <= static_cast<int>(JointType::filter); ++type) {
        EXPECT_GT(kinds[static_cast<JointType>(type)], someOf(15)) << "kind " << type;
    }
}

/// Whatever was called, in any order, with numbers of any size: what is left is a scene that the reader takes.
TEST(WorldScene, OfAnyWorldIsRead) {
    for (const Sizes sizes : {Sizes::usual, Sizes::extreme}) {
        for (std::uint64_t seed = 0; seed < someOf(60U); ++seed) {
            Vandal vandal(seed, sizes);
            for (int act = 0; act < 300; ++act) {
                vandal.act();
                if (act % 50 != 49) { continue; }
                const std::string text = sceneOf(vandal.world());
                const SceneResult read = readScene(text, "vandal", {});
                ASSERT_TRUE(read.scene.has_value())
                    << "seed " << seed << ", act " << act << ": " << read.error.text() << '\n'
                    << text;
            }
        }
    }
}

/// What the reader refuses, and the engine does not.
TEST(WorldScene, OfNumbersThatScenesDoNotHave) {
    constexpr Real kMost = std::numeric_limits<Real>::max();
    World world = makeWorld();
    const BodyId wall = addStatic(world, box(1, 1));
    const BodyId bar = addBody(world, dynamicAt({3, 0}), box(1, 0.1));
    RevoluteJointDef hinge;
    hinge.base = {.bodyA = wall, .bodyB = bar, .breakForce = kMost, .breakTorque = kMost};
    hinge.anchor = {2, 0};
    hinge.motor = AngularMotor{real(1), kMost};
    hinge.limits = AngleLimits{-kMost, kMost};
    must(world.createJoint(hinge));
    DistanceJointDef rope;
    rope.base = {.bodyA = wall, .bodyB = bar};
    rope.anchorA = {0, 0};
    rope.anchorB = {3, 0};
    rope.limits = LengthLimits{0, kMost};
    must(world.createJoint(rope));
    rope.limits = LengthLimits{0, 0};  // a winch, reeled in
    must(world.createJoint(rope));
    rope.anchorB = rope.anchorA;
    rope.limits = LengthLimits{real(0.5), kMost};
    must(world.createJoint(rope));
    rope.length = real(0);
    rope.limits = LengthLimits{0, 1};
    must(world.createJoint(rope));
    (void)must(world.createBody({.type = BodyType::dynamic, .enabled = false}));
    (void)must(world.createBody({.type = BodyType::dynamic, .mass = 2}));
    const SceneWorld again = rebuilt(sceneOf(world), "extremes");
    ASSERT_EQ(again.joints.size(), 5U);
    const auto read = std::get<RevoluteJointDef>(again.world.definition(again.joints[0]));
    EXPECT_FALSE(read.base.breakForce || read.base.breakTorque || read.limits) << "none that could be reached";
    EXPECT_GE(read.motor.value().maxTorque, real(2.9e38));
    EXPECT_EQ(std::get<DistanceJointDef>(again.world.definition(again.joints[3])).limits->min, real(0.5));
}

TEST(WorldScene, NamesAreMadeDifferentAndWellFormed) {
    World world = makeWorld();
    const std::vector<std::string> given{"crate",  "crate", "", "body2", "caf\xe9 \xc3\xa9\xed\xa0\x80\"\\\n\x01",
                                         "crate 2"};
    for (std::size_t i = 0; i < given.size(); ++i) {
        (void)addBody(world, {.position = {3.0 * static_cast<double>(i), 0}, .userData = i}, box(1, 1));
    }
    const std::string text = sceneOf(world, {.ofBody = [&](BodyId id) { return given[world.userData(id)]; }});
    const SceneResult read = readScene(text, "names", {});
    ASSERT_TRUE(read.scene.has_value()) << read.error.text() << text;
    std::vector<std::string> found;
    for (const BodyDescription& body : read.scene->bodies) { found.push_back(body.name); }
    EXPECT_EQ(found, (std::vector<std::string>{"crate", "crate 2", "", "body2 2",
                                               "caf? \xc3\xa9?"
                                               "?"
                                               "?\"\\\n\x01",
                                               "crate 2 2"}));
}

}  // namespace
}  // namespace swept::test
