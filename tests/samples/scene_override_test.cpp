#include <gtest/gtest.h>
#include <swept/samples/scene_reader.h>

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

struct Case {
    Override change;
    std::string pointer;
    std::string reason;
};

TEST(SceneOverride, Errors) {
    const std::vector<Case> cases{
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
        {{"/bodies/ball/mass", "1"}, "/bodies/ball/mass", "\"ball\" is not the index"},
        {{"/bodies/01", "{}"}, "/bodies/01", "is not the index"},
        {{"/bodies/99999999999999999999", "{}"}, "/bodies/99999999999999999999", "is not the index"},
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
    for (const Case& c : cases) {
        const SceneResult result = readWith({c.change});
        EXPECT_FALSE(result.scene.has_value()) << c.change.first;
        EXPECT_EQ(result.error.file, "my.json");
        EXPECT_EQ(result.error.pointer, c.pointer) << result.error.text();
        EXPECT_NE(result.error.reason.find(c.reason), std::string::npos) << result.error.text();
    }
}

}  // namespace
}  // namespace swept
