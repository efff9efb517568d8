#include <gtest/gtest.h>
#include <swept/samples/scene_reader.h>

#include <string>
#include <variant>
#include <vector>

namespace swept {
namespace {

const std::string kScene = R"({"name": "n", "bodies": [{"name": "floor", "shapes": [{"box": {"half": [1, 1]}}]},
    {"name": "a/b~c", "type": "dynamic", "shapes": [{"circle": {"radius": 1}}]}]})";

SceneResult readWith(const std::vector<Override>& overrides) { return readScene(kScene, "my.json", overrides); }

TEST(SceneOverride, ReplacesAndAddsMembers) {
    const SceneResult good = readWith({{"/name", "\"other\""},
                                       {"/gravity", "[0, -1.6]"},
                                       {"/gravity/1", "-3.7"},
                                       {"/bodies/1/mass", "3"},
                                       {"/bodies/1/shapes/0/circle/radius", "0.25"}});
    ASSERT_TRUE(good.scene.has_value()) << good.error.text();
    EXPECT_EQ(good.scene->name, "other");
    EXPECT_EQ(good.scene->gravity, (DVec2{0, -3.7}));
    EXPECT_EQ(good.scene->bodies[1].mass, 3);
    EXPECT_EQ(good.scene->bodies[1].shapes[0].geometry, Geometry(CircleGeometry{{}, 0.25}));
}

TEST(SceneOverride, MakesObjectsThatWereLeftOut) {
    const SceneResult result =
        readWith({{"/settings/dt", "0.01"}, {"/view/height", "7"}, {"/bodies/0/shapes/0/filter/group", "-3"}});
    ASSERT_TRUE(result.scene.has_value()) << result.error.text();
    EXPECT_EQ(result.scene->settings.dt, 0.01);
    EXPECT_EQ(result.scene->view->height, 7);
    EXPECT_EQ(result.scene->bodies[0].shapes[0].filter.group, -3);
}

TEST(SceneOverride, AppendsToArrays) {
    const SceneResult result = readWith({{"/bodies/-", R"({"name": "new"})"}, {"/bodies/3", R"({"name": "newer"})"}});
    ASSERT_TRUE(result.scene.has_value()) << result.error.text();
    ASSERT_EQ(result.scene->bodies.size(), 4u);
    EXPECT_EQ(result.scene->bodies[3].name, "newer");
}

const std::string kNamedScene = R"({"bodies": [{"name": "floor"}, {"type": "dynamic", "mass": 1, "inertia": 1},
    {"name": "a/b~c", "type": "dynamic", "mass": 1, "inertia": 1}, {"name": "0", "angle": 4}],
    "joints": [{"type": "revolute", "bodyA": "floor", "bodyB": "body1", "anchor": [0, 0]},
               {"name": "rod", "type": "distance", "bodyA": "floor", "bodyB": "a/b~c", "anchorA": [0, 0],
                "anchorB": [0, 1]}]})";

TEST(SceneOverride, FindsBodiesAndJointsByTheirNames) {
    const SceneResult result = readScene(kNamedScene, "my.json",
                                         {{"/bodies/floor/angle", "0.5"},
                                          {"/bodies/body1/position", "[3, 4]"},
                                          {"/bodies/a~1b~0c/mass", "7"},
                                          {"/bodies/floor/name", "\"ground\""},
                                          {"/bodies/ground/position", "[9, 0]"},
                                          {"/joints/0/bodyA", "\"ground\""},
                                          {"/joints/rod/bodyA", "\"ground\""},
                                          {"/joints/joint0/motorSpeed", "2"},
                                          {"/joints/joint0/maxMotorTorque", "1"},
                                          {"/joints/rod/breakForce", "6"}});
    ASSERT_TRUE(result.scene.has_value()) << result.error.text();
    const SceneDescription& scene = *result.scene;
    EXPECT_EQ(scene.bodies[0].angle, 0.5);
    EXPECT_EQ(scene.bodies[0].position, (DVec2{9, 0}));
    EXPECT_EQ(scene.bodies[1].position, (DVec2{3, 4}));
    EXPECT_EQ(scene.bodies[2].mass, 7);
    EXPECT_EQ(scene.joints[1].breakForce, 6);
    EXPECT_EQ(std::get<RevoluteDescription>(scene.joints[0].joint).motorSpeed, 2);
    const SceneResult replaced = readScene(kNamedScene, "my.json",
                                           {{"/bodies/0", R"({"name": "floor", "angle": 2})"},
                                            {"/bodies/-", R"({"name": "new"})"},
                                            {"/bodies/new/angle", "3"}});
    ASSERT_TRUE(replaced.scene.has_value()) << replaced.error.text();
    EXPECT_EQ(replaced.scene->bodies[0].angle, 2) << "an index is one, whatever a body is called";
    EXPECT_EQ(replaced.scene->bodies[3].angle, 4);
    EXPECT_EQ(replaced.scene->bodies[4].angle, 3);
}

TEST(SceneOverride, TellsOfNamesThatAreNone) {
    const auto reasonWith = [](const std::string& scene, const Override& change) {
        const SceneResult result = readScene(scene, "my.json", {change});
        EXPECT_FALSE(result.scene.has_value());
        EXPECT_EQ(result.error.pointer, change.first);
        return result.error.reason;
    };
    EXPECT_EQ(reasonWith(kNamedScene, {"/bodies/flor/angle", "1"}),
              "--set /bodies/flor/angle=1: \"flor\" is neither an index nor the name of one of them; did you mean "
              "\"floor\"?");
    EXPECT_EQ(reasonWith(kNamedScene, {"/joints/hinge/lower", "1"}),
              "--set /joints/hinge/lower=1: \"hinge\" is neither an index nor the name of one of them; known here: "
              "joint0, rod");
    EXPECT_NE(reasonWith(R"({"bodies": [{"name": "a"}, {"name": "a"}]})", {"/bodies/a/angle", "1"})
                  .find("there are several with the name \"a\""),
              std::string::npos);
    EXPECT_NE(reasonWith(R"({"bodies": []})", {"/bodies/a/angle", "1"}).find("\"a\" is not the index"),
              std::string::npos);
    EXPECT_NE(reasonWith(kScene, {"/bodies/floor/shapes/floor/friction", "1"}).find("\"floor\" is not the index"),
              std::string::npos)
        << "shapes have no names";
    // Whatever is in the arrays.
    EXPECT_NE(reasonWith(R"({"bodies": [1, null, {"name": 5}]})", {"/bodies/a/angle", "1"})
                  .find("known here: body0, body1, body2"),
              std::string::npos);
    const SceneResult typed = readScene(kNamedScene, "my.json", {{"/bodies/floor/angle", "true"}});
    EXPECT_EQ(typed.error.pointer, "/bodies/0/angle") << "as for the same text in the file";
    const SceneResult tiny = readScene(kNamedScene, "my.json", {{"/bodies/body1/mass", "1e-999"}});
    EXPECT_NE(tiny.error.reason.find("(1e-999 underflows)"), std::string::npos) << tiny.error.text();
}

struct OverrideCase {
    Override change;
    std::string pointer;
    std::string reason;
};

TEST(SceneOverride, Errors) {
    const std::vector<OverrideCase> cases{
        {{"/settings/dt", "abc"}, "/settings/dt", "--set /settings/dt=abc: not a JSON value"},
        {{"/settings/continuous", "off"}, "/settings/continuous", "a string needs double quotes: \"off\""},
        {{"/settings/dt", ""}, "/settings/dt", "--set /settings/dt=: not a JSON value"},
        {{"/settings/dt", "0.1 0.2"}, "/settings/dt", "not a JSON value"},
        {{"/settings/dt", "1e999"}, "/settings/dt", "overflows"},
        {{"/bodies", "[1, {\"a\": 1, \"a\": 2}]"}, "/bodies", "/1/a: the key occurs twice"},
        {{"settings/dt", "1"}, "", "must start with /"},
        {{"", "{}"}, "", "must start with /"},
        {{"/a~2", "1"}, "/a~2", "~ must be followed by 0 or 1"},
        {{"/a~", "1"}, "/a~", "~ must be followed by 0 or 1"},
        {{"/bodies/2/mass", "1"}, "/bodies/2/mass", "there is no element \"2\", the array has 2"},
        {{"/bodies/7", "{}"}, "/bodies/7", "there is no element \"7\", the array has 2"},
        {{"/bodies/-/mass", "1"}, "/bodies/-/mass", "there is no element \"-\""},
        {{"/bodies/ball/mass", "1"}, "/bodies/ball/mass", "\"ball\" is neither an index nor the name"},
        {{"/bodies/01", "{}"}, "/bodies/01", "is neither an index nor the name"},
        {{"/bodies/99999999999999999999", "{}"}, "/bodies/99999999999999999999", "is neither an index nor"},
        {{"/gravity/1", "-1"}, "/gravity/1", "the scene leaves out the array that would have element \"1\": set all"},
        {{"/bodies/1/shapes/0/polygon/vertices/-", "1"},
         "/bodies/1/shapes/0/polygon/vertices/-",
         "leaves out the array"},
        {{"/name/x", "1"}, "/name/x", "there is no \"x\" inside a string"},
        // Those that are well-formed fail as the same text in the file would.
        {{"/setings/dt", "1"}, "/setings", "did you mean \"settings\"?"},
        {{"/settings/dt", "\"fast\""}, "/settings/dt", "must be a number, not a string"},
        {{"/settings/dt", "0"}, "/settings/dt", "must be greater than 0, not 0"},
        {{"/bodies/1/shapes/0/circle/a~1b", "0"}, "/bodies/1/shapes/0/circle/a~1b", "unknown key \"a/b\""},
    };
    for (const OverrideCase& c : cases) {
        const SceneResult result = readWith({c.change});
        EXPECT_FALSE(result.scene.has_value()) << c.change.first;
        EXPECT_EQ(result.error.file, "my.json");
        EXPECT_EQ(result.error.pointer, c.pointer) << result.error.text();
        EXPECT_NE(result.error.reason.find(c.reason), std::string::npos) << result.error.text();
    }
}

}  // namespace
}  // namespace swept
