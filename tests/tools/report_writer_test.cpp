#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include <swept/tools/writers/report_writer.h>

namespace swept {
namespace {

SceneDescription smallScene() {
    SceneDescription scene;
    scene.name = "small";
    scene.settings.dt = 0.125;
    scene.settings.maxPenetration = 0.01;
    scene.settings.maxLostTime = 1;
    scene.bodies.resize(2);
    scene.bodies[1].name = "ball";
    return scene;
}

RunReport smallReport() {
    RunReport report;
    report.counters = {{"pairs", 12}, {"contacts", 7}};
    report.lostTime = {{1, 0.5, "budget"}};
    report.deepestPenetration = 0.02;
    report.largestJointError = 0.001;
    report.startEnergy = 100;
    report.endEnergy = 90;
    report.startMomentum = {1, 2};
    report.endMomentum = {3, 4};
    report.endAngularMomentum = -5;
    report.stateHash = 0x0123456789ABCDEF;
    return report;
}

TEST(ReportWriter, HoldsTheTotalsOfTheRun) {
    const auto json = nlohmann::json::parse(reportText(smallScene(), smallReport(), {"swept2d 1.2.3", "f64", 8}));
    EXPECT_EQ(json.at("scene"), "small");
    EXPECT_EQ(json.at("engine"), "swept2d 1.2.3");
    EXPECT_EQ(json.at("precision"), "f64");
    EXPECT_EQ(json.at("steps"), 8);
    EXPECT_EQ(json.at("time"), 1.0);
    EXPECT_EQ(json.at("finite"), true);
    EXPECT_EQ(json.at("counters").at("contacts").dump(), "7");
    EXPECT_EQ(json.at("countersSummedOverSteps"), 8);
    ASSERT_EQ(json.at("lostTime").size(), 1u);
    EXPECT_EQ(json.at("lostTime")[0].at("body"), "ball");
    EXPECT_EQ(json.at("lostTime")[0].at("seconds"), 0.5);
    EXPECT_EQ(json.at("lostTime")[0].at("reason"), "budget");
    EXPECT_EQ(json.at("deepestPenetration"), 0.02);
    EXPECT_EQ(json.at("largestJointError"), 0.001);
    EXPECT_EQ(json.at("energy").at("start"), 100);
    EXPECT_EQ(json.at("energy").at("end"), 90);
    EXPECT_EQ(json.at("momentum").at("end"), (nlohmann::json{3, 4}));
    EXPECT_EQ(json.at("angularMomentum").at("end"), -5);
    EXPECT_EQ(json.at("stateHash"), "0123456789abcdef");
}

TEST(ReportWriter, CountsTheStepsThatItIsAbout) {
    RunFacts facts{"e", "f32", 8};
    facts.from = 3;
    const auto json = nlohmann::json::parse(reportText(smallScene(), smallReport(), facts));
    EXPECT_EQ(json.at("steps"), 8);
    EXPECT_EQ(json.at("countersSummedOverSteps"), 5);
}

TEST(ReportWriter, TellsWhereAndWhenTheLargestErrorsWere) {
    SceneDescription scene = smallScene();
    scene.joints.resize(2);
    RunReport report = smallReport();
    const auto without = nlohmann::json::parse(reportText(scene, report, {"e", "f32", 8}));
    EXPECT_FALSE(without.contains("deepestPenetrationAt")) << "an engine that does not tell";
    EXPECT_FALSE(without.contains("largestJointErrorAt"));
    report.deepestPair = DeepestPair{0.5, 0, 1};
    report.worstJoint = WorstJoint{0.25, 1};
    report.lostTime = {{0, 0.4, "budget"}, {1, 0.3, "budget"}, {1, 0.2, "stop"}};
    const auto json = nlohmann::json::parse(reportText(scene, report, {"e", "f32", 8}));
    EXPECT_EQ(json.at("deepestPenetrationAt"), nlohmann::json::parse(R"({"time": 0.5, "bodies": ["body0", "ball"]})"));
    EXPECT_EQ(json.at("largestJointErrorAt"), nlohmann::json::parse(R"({"time": 0.25, "joint": 1, "name": "joint1"})"));
    EXPECT_EQ(json.at("mostLostTime"), nlohmann::json::parse(R"({"body": "ball", "seconds": 0.5})"));
    EXPECT_EQ(json.at("budgets").at("maxLostTime").at("value"), 0.5) << "for all reasons together";
    report.lostTime.clear();
    EXPECT_FALSE(nlohmann::json::parse(reportText(scene, report, {"e", "f32", 8})).contains("mostLostTime"));
}

TEST(ReportWriter, HasNoHashOfEnginesWithout) {
    RunReport report = smallReport();
    report.stateHash.reset();
    const auto json = nlohmann::json::parse(reportText(smallScene(), report, {"e", "f32", 8}));
    EXPECT_FALSE(json.contains("stateHash"));
}

TEST(ReportWriter, NamesTheSettingsUsed) {
    const auto json = nlohmann::json::parse(reportText(smallScene(), smallReport(), {"e", "f32", 8}));
    const auto& settings = json.at("settings");
    EXPECT_EQ(settings.at("dt"), 0.125);
    EXPECT_EQ(settings.at("profile"), "accurate");
    EXPECT_EQ(settings.at("continuous"), "subStep");
    EXPECT_EQ(settings.at("maxImpacts"), 64);
    EXPECT_EQ(settings.at("sleep"), true);
    EXPECT_EQ(settings.at("broadphase"), "automatic");
    EXPECT_FALSE(settings.contains("subSteps")) << "left to the profile";
}

TEST(ReportWriter, TellsWhichBudgetsWereKept) {
    const auto json = nlohmann::json::parse(reportText(smallScene(), smallReport(), {"e", "f32", 8}));
    const auto& budgets = json.at("budgets");
    EXPECT_EQ(budgets.at("maxPenetration").at("kept"), false);
    EXPECT_EQ(budgets.at("maxLostTime").at("kept"), true);
    EXPECT_FALSE(budgets.contains("maxJointError"));
}

TEST(ReportWriter, StaysValidWhenTheRunDidNot) {
    RunReport report = smallReport();
    report.endEnergy = std::numeric_limits<double>::quiet_NaN();
    report.finite = false;
    const auto json = nlohmann::json::parse(reportText(smallScene(), report, {"e", "f32", 8}));
    EXPECT_TRUE(json.at("energy").at("end").is_null());
    EXPECT_EQ(json.at("finite"), false);
}

}  // namespace
}  // namespace swept
