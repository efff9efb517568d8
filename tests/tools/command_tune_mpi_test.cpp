#include <gtest/gtest.h>

#include "run_program.h"
#include "small_scenes.h"
#include "tune_rows.h"

namespace swept {
namespace {

TEST(CommandTuneMpi, ManyProcessesFindWhatOneFinds) {
    const ScratchDirectory scratch;
    const std::string scene = scratch.write("ball.json", kBallScene);
    std::vector<std::string> arguments{"tune", scene, "--steps", "96", "--max-error", "penetration=0.02", "--out"};
    arguments.push_back(scratch.path("one"));
    ASSERT_EQ(runSwept(arguments).exitCode, 0);
    arguments.back() = scratch.path("many");
    // More processes than cores are welcome, and whoever runs tests may be root.
    setenv("OMPI_ALLOW_RUN_AS_ROOT", "1", 1);
    setenv("OMPI_ALLOW_RUN_AS_ROOT_CONFIRM", "1", 1);
    std::vector<std::string> launch{"--oversubscribe", "-n", "3", SWEPT_PROGRAM};
    launch.insert(launch.end(), arguments.begin(), arguments.end());
    const ProgramResult result = runProgram("mpirun", launch);
    if (result.exitCode == -1 || result.exitCode == 127) { GTEST_SKIP() << "no mpirun"; }
    ASSERT_EQ(result.exitCode, 0) << result.err;
    EXPECT_EQ(rowsWithoutCost(scratch.read("many/tune.csv")), rowsWithoutCost(scratch.read("one/tune.csv")));
    const std::string advice = "Recommended";
    EXPECT_EQ(result.out.find(advice), result.out.rfind(advice)) << "one of them talks";
}

}  // namespace
}  // namespace swept
