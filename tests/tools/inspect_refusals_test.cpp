#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <string>

#include <swept/samples/runner.h>
#include <swept/samples/scene_builder.h>
#include <swept/tools/inspect/inspect_scene.h>

/// What the scene doctor says can be done, and what would be refused.

namespace swept {
namespace {

const Finding* findingOf(const Inspection& inspection, const std::string& kind) {
    const auto found = std::find_if(inspection.findings.begin(), inspection.findings.end(),
                                    [&](const Finding& finding) { return finding.kind == kind; });
    return found == inspection.findings.end() ? nullptr : &*found;
}

SceneDescription ballOverGround() {
    SceneDescription scene = build::scene("ball", {0, 2}, 6);
    build::addFixed(scene, "ground", {0, -0.5}, {build::box({10, 0.5})});
    build::addDynamic(scene, "ball", {0, 5}, {build::circle(0.5)});
    return scene;
}

TEST(InspectRefusals, TheStepThatItSuggestsIsShortEnough) {
    for (double radius = 0.0004; radius < 0.02; radius *= 1.037) {
        SceneDescription scene = ballOverGround();
        scene.settings.dt = 1.0 / 30;
        scene.bodies[1].shapes = {build::circle(radius)};
        const Inspection inspection = inspectScene(scene);
        const Finding* const finding = findingOf(inspection, "step-too-long");
        ASSERT_NE(finding, nullptr) << radius;
        const std::string start = "--set /settings/dt=";
        ASSERT_EQ(finding->remedy.substr(0, start.size()), start);
        char* rest = nullptr;
        scene.settings.dt = std::strtod(finding->remedy.c_str() + start.size(), &rest);
        EXPECT_EQ(findingOf(inspectScene(scene), "step-too-long"), nullptr) << finding->remedy;
        const double hertz = std::strtod(rest + 2, nullptr);  // " (…"
        EXPECT_NEAR(1 / scene.settings.dt, hertz, 0.002 * hertz) << finding->remedy;
        EXPECT_LT(finding->text.size() + finding->remedy.size(), 400U);
    }
}

TEST(InspectRefusals, WarnsOfWhatSinglePrecisionRefuses) {
    SceneDescription scene = ballOverGround();
    scene.bodies[1].velocity = {3e38, 0};
    const Inspection inspection = inspectScene(scene);
    const Finding* const finding = findingOf(inspection, "refused");
    ASSERT_NE(finding, nullptr);
    EXPECT_EQ(finding->severity, Severity::warning);
    EXPECT_EQ(finding->where, "/bodies/1/velocity");
    EXPECT_NE(finding->text.find("in f32, the default: is out of range"), std::string::npos) << finding->text;
    EXPECT_NE(finding->remedy.find("--precision f64"), std::string::npos) << finding->remedy;
    EXPECT_EQ(inspection.needs.back().feature, "f64");
    EXPECT_TRUE(inspection.needs.back().needed);
}

TEST(InspectRefusals, WarnsOfWhatBothPrecisionsRefuse) {
    SceneDescription scene = ballOverGround();
    scene.settings.subSteps = 8000;  // which no file may have
    const Inspection inspection = inspectScene(scene);
    const Finding* const finding = findingOf(inspection, "refused");
    ASSERT_NE(finding, nullptr);
    EXPECT_NE(finding->text.find("in both precisions"), std::string::npos) << finding->text;
    EXPECT_EQ(finding->remedy.find("f64"), std::string::npos) << finding->remedy;
}

TEST(InspectRefusals, AnEmptySceneHasNothingThatCouldTurn) {
    const Inspection inspection = inspectScene(SceneDescription{});
    EXPECT_TRUE(inspection.findings.empty());
    for (const Need& need : inspection.needs) {
        EXPECT_FALSE(need.needed) << need.feature;
        if (need.feature == "rotation") { EXPECT_EQ(need.reason, "no body is dynamic"); }
    }
}

}  // namespace
}  // namespace swept
