#include <gtest/gtest.h>
#include <swept/samples/built_in/builtin_scenes.h>
#include <swept/samples/scene_names.h>
#include <swept/samples/scene_reader.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

#include "../support/some_of.h"
#include "random_scene.h"

namespace swept {
namespace {

void expectRoundTrip(const SceneDescription& scene, const std::string& what) {
    const std::string text = writeScene(scene);
    const SceneResult again = readScene(text, "round trip");
    ASSERT_TRUE(again.scene.has_value()) << what << ": " << again.error.text() << "\n" << text;
    EXPECT_TRUE(*again.scene == scene) << what << "\n" << text << "\n" << writeScene(*again.scene);
    EXPECT_EQ(writeScene(*again.scene), text) << what;
}

TEST(SceneRoundTrip, RandomScenes) {
    std::size_t shapes = 0;
    std::size_t joints[std::variant_size_v<JointGeometry>] = {};
    std::size_t kinds[std::variant_size_v<Geometry>] = {};
    for (std::uint64_t seed = 0; seed < test::someOf(900U); ++seed) {
        const SceneDescription scene = test::SceneMaker(seed).make();
        expectRoundTrip(scene, "seed " + std::to_string(seed));
        for (const JointDescription& joint : scene.joints) { ++joints[joint.joint.index()]; }
        for (const BodyDescription& body : scene.bodies) {
            for (const ShapeDescription& shape : body.shapes) {
                ++shapes;
                ++kinds[shape.geometry.index()];
            }
        }
    }
    EXPECT_GT(shapes, test::someOf(3'000u));
    EXPECT_GT(*std::min_element(std::begin(joints), std::end(joints)), test::someOf(15u))
        << "a type of joint is hardly tried";
    EXPECT_GT(*std::min_element(std::begin(kinds), std::end(kinds)), test::someOf(150u))
        << "a kind of geometry is hardly tried";
}

TEST(SceneRoundTrip, BuiltinScenes) {
    for (const BuiltinScene& scene : builtinScenes()) { expectRoundTrip(scene.make(), scene.name); }
}

// A changed member must not be lost: the writer leaves out only what the reader puts back.
TEST(SceneRoundTrip, TellsScenesApart) {
    const SceneDescription scene = test::SceneMaker(1).make();
    SceneDescription other = scene;
    other.bodies[0].shapes[0].friction = 0.25;
    EXPECT_NE(writeScene(scene), writeScene(other));
    EXPECT_FALSE(scene == other);
}

TEST(SceneRoundTrip, MixingRules) {
    SceneDescription scene;
    scene.bodies.resize(1);
    const auto names = namesOf<MixingRule>();
    for (std::size_t i = 0; i < names.size(); ++i) {
        ShapeDescription shape;
        shape.geometry = CircleGeometry{{0, 0}, 1};
        shape.frictionMixing = static_cast<MixingRule>(i);
        shape.restitutionMixing = static_cast<MixingRule>(names.size() - 1 - i);
        scene.bodies[0].shapes = {shape};
        expectRoundTrip(scene, std::string(names[i]));
        const std::string text = writeScene(scene);
        EXPECT_EQ(text.find("frictionMixing") == std::string::npos, i == 0) << "what is usual is left out: " << text;
    }
}

TEST(SceneWriter, NumbersAreTheShortestThatReadBack) {
    SceneDescription scene;
    scene.gravity = {0.1, -1.0 / 3};
    scene.settings.dt = 1e-9;
    scene.settings.maxSpeed = 3e38;
    EXPECT_EQ(writeScene(scene),
              "{\n \"gravity\": [0.1, -0.3333333333333333],\n"
              " \"settings\": {\"dt\": 1e-09, \"maxSpeed\": 3e+38},\n \"bodies\": []\n}\n");
}

TEST(SceneWriter, NegativeZeroKeepsItsSign) {
    SceneDescription scene;
    scene.gravity = {-0.0, 1};
    const SceneResult again = readScene(writeScene(scene), "test");
    ASSERT_TRUE(again.scene.has_value());
    EXPECT_TRUE(std::signbit(again.scene->gravity.x));
}

TEST(SceneWriter, DefaultsAreLeftOutExceptBodyTypes) {
    SceneDescription scene;
    scene.bodies.resize(2);
    scene.bodies[1].type = SceneBodyType::kinematic;
    scene.bodies[1].shapes.resize(1);
    scene.bodies[1].shapes[0].geometry = BoxGeometry{{1, 2}, {}, 0};
    EXPECT_EQ(writeScene(scene),
              "{\n \"bodies\": [{\"type\": \"static\"}, "
              "{\"type\": \"kinematic\", \"shapes\": [{\"box\": {\"half\": [1, 2]}}]}]\n}\n");
}

TEST(SceneWriter, LinesAreShortEnoughToRead) {
    for (const BuiltinScene& builtin : builtinScenes()) {
        std::istringstream text(writeScene(builtin.make()));
        std::string line;
        while (std::getline(text, line)) { EXPECT_LE(line.size(), 120u) << builtin.name << ": " << line; }
    }
}

}  // namespace
}  // namespace swept
