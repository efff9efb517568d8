#include <gtest/gtest.h>

#include <algorithm>
#include <string>

#include "run_program.h"
#include "small_scenes.h"

namespace swept {
namespace {

TEST(CommandCompare, TellsHowFarTheEnginesDriftApart) {
    const ScratchDirectory scratch;
    const std::string scene = scratch.write("ball.json", kBallScene);
    const auto result = runSwept({"compare", scene, "--steps", "32", "--csv", scratch.path("out.csv"), "--png",
                                  scratch.path("out.png"), "--size", "160x90", "--scale", "0.02"});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    // In free fall Box2D is behind the parabola by g t dt / 2: 0.0625 m/s² s · t, above 0.02 m from t = 0.32 s on.
    EXPECT_NE(result.out.find("Deviation above 0.02 m (--scale): from step 21"), std::string::npos) << result.out;
    EXPECT_NE(result.out.find("ball"), std::string::npos);
    EXPECT_NE(result.out.find("skin"), std::string::npos) << "the adapter says what it approximates";
    EXPECT_EQ(scratch.read("out.png").substr(1, 3), "PNG");
    const std::string csv = scratch.read("out.csv");
    EXPECT_EQ(csv.substr(0, csv.find('\n')),
              "step,time,body,x,y,angle,box2dX,box2dY,box2dAngle,positionDeviation,angleDeviation,velocityDeviation");
    EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 1 + 33) << "one dynamic body";
    const std::string last = csv.substr(csv.rfind("\n32,") + 1);
    EXPECT_EQ(last.substr(0, 12), "32,0.5,ball,");
}

TEST(CommandCompare, AnAbortOfBox2dIsAResult) {
    const ScratchDirectory scratch;
    const std::string scene = scratch.write("abort.json", kSceneThatAbortsBox2d);
    const auto result =
        runSwept({"compare", scene, "--steps", "10", "--png", scratch.path("out.png"), "--size", "160x90"});
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_NE(result.out.find("Box2D aborted while the world was built (Assertion"), std::string::npos) << result.out;
    EXPECT_EQ(scratch.read("out.png").substr(1, 3), "PNG") << "the initial state can still be drawn";
    EXPECT_EQ(result.err, "");
}

}  // namespace
}  // namespace swept
