#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "csv_records.h"
#include "run_program.h"
#include "scratch_directory.h"

namespace swept {
namespace {

TEST(CommandBenchThreads, ComparesOneThreadWithSeveral) {
    const ScratchDirectory scratch;
    const auto result = runSwept({"bench", "threads", "--scenes", "heap,rain", "--most", "10", "--size", "0.02",
                                  "--steps", "10", "--profile", "fast", "--csv", scratch.path("threads.csv")});
    if (result.err.find("without oneTBB") != std::string::npos) {
        EXPECT_EQ(result.exitCode, 2) << result.out;
        return;
    }
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_NE(result.out.find("geometric mean of the ratios: Swept2D f32"), std::string::npos) << result.out;
    const auto records = recordsOf(scratch.read("threads.csv"));
    ASSERT_GE(records.size(), 1U + 2) << "a row of each scene, at least";
    for (std::size_t i = 1; i < records.size(); ++i) {
        EXPECT_EQ(numberIn(records, i, "steps"), 10);
        EXPECT_EQ(numberIn(records, i, "threads"), 2);
        EXPECT_GT(numberIn(records, i, "quickest_one"), 0) << records[i][0];
        EXPECT_GE(numberIn(records, i, "one"), numberIn(records, i, "quickest_one")) << records[i][0];
        EXPECT_GE(numberIn(records, i, "several"), numberIn(records, i, "quickest_several")) << records[i][0];
    }
}

TEST(CommandBenchThreads, RefusesWhatItCannotDo) {
    const std::vector<std::vector<std::string>> wrong = {
        {"bench", "threads", "--scenes", "elsewhere"},
        {"bench", "threads", "--threads", "1"},
        {"bench", "threads", "--size", "0"},
        {"bench", "threads", "--scenes", "heap", "--fewest", "40", "--most", "50"},
        {"bench", "threads", "--profile", "slow"},
        {"bench", "threads", "--csv", "no/such/directory/threads.csv"},
    };
    for (const std::vector<std::string>& arguments : wrong) { expectRefused(arguments); }
}

}  // namespace
}  // namespace swept
