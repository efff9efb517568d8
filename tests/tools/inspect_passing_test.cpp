#include <gtest/gtest.h>

#include <string>
#include <vector>

#include <swept/samples/scene_builder.h>
#include <swept/tools/inspect/inspect_scene.h>

namespace swept {
namespace {

void expectOnePassing(const SceneDescription& scene, const std::string& where) {
    const std::vector<Finding> findings = inspectScene(scene).findings;
    ASSERT_EQ(findings.size(), 1u);
    EXPECT_EQ(findings[0].kind, "passing");
    EXPECT_EQ(findings[0].where, where);
    EXPECT_EQ(findings[0].severity, Severity::warning);
    EXPECT_FALSE(findings[0].remedy.empty());
}

TEST(InspectPassing, FindsBodiesThatMayPassEachOther) {
    SceneDescription scene = build::scene("bars", {0, 2}, 6);
    scene.gravity = {0, 0};
    for (int i = 0; i < 3; ++i) {
        build::addDynamic(scene, "bar" + std::to_string(i), {3.0 * i, 0}, {build::box({0.5, 0.03})});
    }
    EXPECT_TRUE(inspectScene(scene).findings.empty());
    scene.bodies[1].angularVelocity = 60;
    expectOnePassing(scene, "/bodies/1");
    scene.bodies[2].angularVelocity = 60;
    expectOnePassing(scene, "/bodies/1");  // which tells how many more
    EXPECT_NE(inspectScene(scene).findings[0].text.find("so may 1 more)"), std::string::npos);
    scene.bodies[1].bullet = scene.bodies[2].bullet = true;
    EXPECT_TRUE(inspectScene(scene).findings.empty());
    scene.bodies[2].bullet = false;
    expectOnePassing(scene, "/bodies/2");
    for (BodyDescription& body : scene.bodies) { body.shapes[0].filter.group = -1; }
    EXPECT_TRUE(inspectScene(scene).findings.empty()) << "they do not see each other";
}

}  // namespace
}  // namespace swept
