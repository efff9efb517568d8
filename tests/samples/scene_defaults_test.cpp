#include <gtest/gtest.h>
#include <swept/samples/scene_reader.h>

/// What the format says without words: every default, and that every documented key is understood.

namespace swept {
namespace {

SceneDescription readGood(const std::string& text) {
    const SceneResult result = readScene(text, "test");
    EXPECT_TRUE(result.scene.has_value()) << result.error.text() << "\n" << text;
    return result.scene.value_or(SceneDescription{});
}

TEST(SceneDefaults, Scene) {
    const SceneDescription scene = readGood(R"({"bodies": []})");
    EXPECT_EQ(scene.name, "");
    EXPECT_EQ(scene.gravity, (DVec2{0, -9.81}));
    EXPECT_FALSE(scene.view.has_value());
    EXPECT_TRUE(scene.bodies.empty());
    EXPECT_TRUE(scene.joints.empty());
    const SettingsDescription& s = scene.settings;
    EXPECT_EQ(s.dt, 1.0 / 60);
    EXPECT_EQ(s.profile, SceneProfile::accurate);
    EXPECT_FALSE(s.subSteps || s.relaxPasses || s.maxSpeed || s.toiTolerance);
    EXPECT_FALSE(s.maxPenetration || s.maxJointError || s.maxLostTime);
    EXPECT_EQ(s.continuous, SceneContinuous::subStep);
    EXPECT_EQ(s.maxImpacts, 64);
    EXPECT_TRUE(s.sleep);
    EXPECT_EQ(s.sleepSpeed, 0);
    EXPECT_EQ(s.broadphase, SceneBroadphase::automatic);
}

TEST(SceneDefaults, BodyAndShape) {
    const SceneDescription scene = readGood(R"({"bodies": [{"shapes": [{"circle": {"radius": 2}}]}]})");
    ASSERT_EQ(scene.bodies.size(), 1u);
    const BodyDescription& body = scene.bodies[0];
    EXPECT_EQ(bodyName(scene, 0), "body0");
    EXPECT_EQ(body.type, SceneBodyType::fixed);
    EXPECT_EQ(body.position, DVec2{});
    EXPECT_EQ(body.angle, 0);
    EXPECT_EQ(body.velocity, DVec2{});
    EXPECT_EQ(body.angularVelocity, 0);
    EXPECT_FALSE(body.bullet || body.fixedRotation);
    EXPECT_EQ(body.linearDamping, 0);
    EXPECT_EQ(body.angularDamping, 0);
    EXPECT_EQ(body.gravityScale, 1);
    EXPECT_TRUE(body.awake);
    EXPECT_TRUE(body.enabled);
    EXPECT_FALSE(body.continuous || body.mass || body.inertia);
    ASSERT_EQ(body.shapes.size(), 1u);
    const ShapeDescription& shape = body.shapes[0];
    EXPECT_EQ(shape.geometry, Geometry(CircleGeometry{{0, 0}, 2}));
    EXPECT_EQ(shape.radius, 0);
    EXPECT_EQ(shape.density, 1);
    EXPECT_EQ(shape.friction, 0.6);
    EXPECT_EQ(shape.restitution, 0);
    EXPECT_EQ(shape.rollingResistance, 0);
    EXPECT_EQ(shape.surfaceSpeed, 0);
    EXPECT_EQ(shape.frictionMixing, MixingRule::usual);
    EXPECT_EQ(shape.restitutionMixing, MixingRule::usual);
    EXPECT_FALSE(shape.sensor);
    EXPECT_EQ(shape.filter.category, 1u);
    EXPECT_EQ(shape.filter.mask, 4294967295u);
    EXPECT_EQ(shape.filter.group, 0);
}

TEST(SceneDefaults, GeometryAndJoints) {
    const SceneDescription scene = readGood(R"({"bodies": [
        {"shapes": [{"box": {"half": [1, 2]}}, {"chain": {"points": [[1, 0], [0, 0]]}}]},
        {"type": "dynamic", "mass": 1, "inertia": 1}],
        "joints": [{"type": "revolute", "bodyA": "body0", "bodyB": "body1", "anchor": [0, 0]},
                   {"type": "distance", "bodyA": "body0", "bodyB": "body1", "anchorA": [0, 0], "anchorB": [0, 1]}]})");
    ASSERT_EQ(scene.joints.size(), 2u);
    EXPECT_EQ(scene.bodies[0].shapes[0].geometry, Geometry(BoxGeometry{{1, 2}, {0, 0}, 0}));
    EXPECT_EQ(scene.bodies[0].shapes[1].geometry, Geometry(ChainGeometry{{{1, 0}, {0, 0}}, false}));
    EXPECT_EQ(jointName(scene, 1), "joint1");
    EXPECT_FALSE(scene.joints[0].collideConnected);
    EXPECT_FALSE(scene.joints[0].breakForce || scene.joints[0].breakTorque);
    EXPECT_EQ(scene.joints[0].joint, JointGeometry(RevoluteDescription{}));
    DistanceDescription distance;
    distance.anchorB = {0, 1};
    EXPECT_EQ(scene.joints[1].joint, JointGeometry(distance));
}

TEST(SceneKeys, OfSceneViewAndSettings) {
    const SceneDescription scene =
        readGood(R"({"name": "n", "gravity": [1, -2], "view": {"center": [3, 4], "height": 5},
        "settings": {"dt": 0.01, "profile": "fast", "subSteps": 8, "relaxPasses": 2, "continuous": "stop",
                     "maxImpacts": 9, "maxSpeed": 100, "sleep": false, "sleepSpeed": 0.2,
                     "broadphase": "allPairs", "toiTolerance": 0.001,
                     "maxPenetration": 0.01, "maxJointError": 0.02, "maxLostTime": 0.03},
        "bodies": [], "joints": []})");
    EXPECT_EQ(scene.name, "n");
    EXPECT_EQ(scene.gravity, (DVec2{1, -2}));
    EXPECT_EQ(scene.view, (ViewDescription{{3, 4}, 5}));
    SettingsDescription expected;
    expected.dt = 0.01;
    expected.profile = SceneProfile::fast;
    expected.subSteps = 8;
    expected.relaxPasses = 2;
    expected.continuous = SceneContinuous::stop;
    expected.maxImpacts = 9;
    expected.maxSpeed = 100;
    expected.sleep = false;
    expected.sleepSpeed = 0.2;
    expected.broadphase = SceneBroadphase::allPairs;
    expected.toiTolerance = 0.001;
    expected.maxPenetration = 0.01;
    expected.maxJointError = 0.02;
    expected.maxLostTime = 0.03;
    EXPECT_TRUE(scene.settings == expected);
}

TEST(SceneKeys, OfBodies) {
    const SceneDescription scene = readGood(R"({"bodies": [{"name": "b", "type": "dynamic", "position": [1, 2],
        "angle": 0.5, "velocity": [3, 4], "angularVelocity": 5, "bullet": true, "fixedRotation": false,
        "linearDamping": 0.1, "angularDamping": 0.2, "gravityScale": -1, "awake": false, "allowSleep": false,
        "enabled": false, "continuous": "off",
        "mass": 6, "inertia": 7, "shapes": []}, {"type": "dynamic", "mass": 1, "fixedRotation": true},
        {"type": "dynamic", "mass": 1, "fixedRotation": true, "inertia": 2}]})");
    BodyDescription expected;
    expected.name = "b";
    expected.type = SceneBodyType::dynamic;
    expected.position = {1, 2};
    expected.angle = 0.5;
    expected.velocity = {3, 4};
    expected.angularVelocity = 5;
    expected.bullet = true;
    expected.linearDamping = 0.1;
    expected.angularDamping = 0.2;
    expected.gravityScale = -1;
    expected.awake = false;
    expected.allowSleep = false;
    expected.enabled = false;
    expected.continuous = SceneContinuous::off;
    expected.mass = 6;
    expected.inertia = 7;
    ASSERT_EQ(scene.bodies.size(), 3u);
    EXPECT_TRUE(scene.bodies[0] == expected);
    EXPECT_TRUE(scene.bodies[1].fixedRotation);
}

TEST(SceneKeys, OfShapes) {
    const SceneDescription scene = readGood(R"({"bodies": [{"shapes": [
        {"box": {"half": [1, 2], "center": [3, 4], "angle": 5}, "radius": 0.1, "density": 2, "friction": 0.3,
         "restitution": 1, "rollingResistance": 0.25, "surfaceSpeed": -2.5, "frictionMixing": "minimum",
         "restitutionMixing": "product", "sensor": true, "filter": {"category": 2, "mask": 3, "group": -4}},
        {"circle": {"center": [1, 2], "radius": 3}},
        {"capsule": {"points": [[0, 1], [2, 3]], "radius": 4}},
        {"segment": [[0, 1], [2, 3]], "radius": 0.2},
        {"polygon": [[1, 1], [0, 0], [0, 1], [1, 0]], "radius": 0.3},
        {"chain": {"points": [[0, 0], [1, 0], [1, 1]], "loop": true}, "radius": 0.4},
        {"chain": {"points": [[0, 0], [1, 0], [1, 1]], "surfaces": [{}, {"friction": 0.3, "restitution": 1,
         "rollingResistance": 0.25, "surfaceSpeed": -2.5, "frictionMixing": "minimum",
         "restitutionMixing": "product"}]}}]}]})");
    ASSERT_EQ(scene.bodies.size(), 1u);
    const std::vector<ShapeDescription>& shapes = scene.bodies[0].shapes;
    ASSERT_EQ(shapes.size(), 7u);
    ShapeDescription expected;
    expected.geometry = BoxGeometry{{1, 2}, {3, 4}, 5};
    expected.radius = 0.1;
    expected.density = 2;
    expected.friction = 0.3;
    expected.restitution = 1;
    expected.rollingResistance = 0.25;
    expected.surfaceSpeed = -2.5;
    expected.frictionMixing = MixingRule::minimum;
    expected.restitutionMixing = MixingRule::product;
    expected.sensor = true;
    expected.filter = {2, 3, -4};
    EXPECT_TRUE(shapes[0] == expected);
    EXPECT_EQ(shapes[1].geometry, Geometry(CircleGeometry{{1, 2}, 3}));
    EXPECT_EQ(shapes[2].geometry, Geometry(CapsuleGeometry{{DVec2{0, 1}, DVec2{2, 3}}, 4}));
    EXPECT_EQ(shapes[3].geometry, Geometry(SegmentGeometry{{DVec2{0, 1}, DVec2{2, 3}}}));
    EXPECT_EQ(shapes[3].radius, 0.2);
    EXPECT_EQ(shapes[4].geometry, Geometry(PolygonGeometry{{{1, 1}, {0, 0}, {0, 1}, {1, 0}}}));  // in the given order
    EXPECT_EQ(shapes[5].geometry, Geometry(ChainGeometry{{{0, 0}, {1, 0}, {1, 1}}, true}));
    EXPECT_EQ(shapes[5].radius, 0.4);
    const SurfaceDescription surface{0.3, 1, 0.25, -2.5, MixingRule::minimum, MixingRule::product};
    EXPECT_EQ(shapes[6].geometry, Geometry(ChainGeometry{{{0, 0}, {1, 0}, {1, 1}}, false, {}, {}, {{}, surface}}));
}

TEST(SceneKeys, OfJoints) {
    const SceneDescription scene = readGood(R"({"bodies": [{"name": "a"}, {"type": "dynamic", "mass": 1, "inertia": 1}],
        "joints": [{"bodyA": "a", "bodyB": "body1", "name": "hinge", "collideConnected": true, "breakForce": 1,
                    "breakTorque": 2, "anchor": [3, 4], "anchorB": [1, 2],
                    "referenceAngle": -1, "lower": -5, "upper": 6, "motorSpeed": 7, "maxMotorTorque": 8,
                    "hertz": 9, "dampingRatio": 10, "springTarget": 11, "type": "revolute"},
                   {"type": "distance", "bodyA": "body1", "bodyB": "a", "anchorA": [1, 2], "anchorB": [3, 4],
                    "length": 5, "minLength": 4, "maxLength": 6, "hertz": 7, "dampingRatio": 8},
                   {"type": "pulley", "bodyA": "body1", "bodyB": "a", "groundA": [1, 2], "groundB": [3, 4],
                    "anchorA": [5, 6], "anchorB": [7, 8], "ratio": 9, "length": 10}]})");
    ASSERT_EQ(scene.joints.size(), 3u);
    JointDescription hinge;
    hinge.name = "hinge";
    hinge.bodyA = "a";
    hinge.bodyB = "body1";
    hinge.collideConnected = true;
    hinge.breakForce = 1;
    hinge.breakTorque = 2;
    hinge.joint = RevoluteDescription{{3, 4}, DVec2{1, 2}, -1, -5, 6, 7, 8, 9, 10, 11};
    EXPECT_TRUE(scene.joints[0] == hinge);
    EXPECT_EQ(scene.joints[1].joint, JointGeometry(DistanceDescription{{1, 2}, {3, 4}, 5, 4, 6, 7, 8}));
    EXPECT_EQ(scene.joints[2].joint, JointGeometry(PulleyDescription{{1, 2}, {3, 4}, {5, 6}, {7, 8}, 9, 10}));
}

TEST(SceneNumbers, WholeNumbersMayBeWrittenInAnyWay) {
    EXPECT_EQ(readGood(R"({"settings": {"maxImpacts": 1e2}, "bodies": []})").settings.maxImpacts, 100);
    EXPECT_EQ(readGood(R"({"settings": {"subSteps": 4.0}, "bodies": []})").settings.subSteps, 4);
}

TEST(SceneNumbers, AreReadToTheLastBit) {
    const SceneDescription scene = readGood(R"({"gravity": [0.1, -9007199254740993], "bodies": []})");
    EXPECT_EQ(scene.gravity.x, 0.1);
    EXPECT_EQ(scene.gravity.y, -9007199254740992.0);
    EXPECT_EQ(readGood(R"({"gravity": [1e-999, 4.9e-324], "bodies": []})").gravity, (DVec2{0, 0x1p-1074}));
}

TEST(SceneFiles, TheExamplesThatShip) {
    for (const char* name : {"hello.json", "seesaw.json", "thin-wall.json"}) {
        const SceneResult result = readSceneFile(std::string(SWEPT_SCENE_DIR "/") + name);
        EXPECT_TRUE(result.scene.has_value()) << result.error.text();
    }
}

}  // namespace
}  // namespace swept
