#include <gtest/gtest.h>

#include <swept/tools/worlds/world_bench.h>

// What a step took, by its repeats.

namespace swept::worlds {
namespace {

StepTime took(double seconds) { return {seconds, {.pairs = seconds / 2, .solve = seconds / 4}}; }

TEST(WorldBench, MedianOfRepeatsIgnoresADisturbedOne) {
    const StepTime median = timeOfRepeats({took(9), took(2), took(1)}, Repeats::median);
    EXPECT_EQ(median.seconds, 2);
    EXPECT_EQ(median.stages.pairs, 1);
    EXPECT_EQ(median.stages.solve, 0.5);
}

TEST(WorldBench, MedianOfAnEvenNumberLiesBetweenTheTwoInTheMiddle) {
    const StepTime median = timeOfRepeats({took(8), took(1), took(2), took(4)}, Repeats::median);
    EXPECT_EQ(median.seconds, 3);
    EXPECT_EQ(median.stages.pairs, 1.5);
    EXPECT_EQ(timeOfRepeats({took(4)}, Repeats::median).seconds, 4);
}

TEST(WorldBench, FastestOfRepeatsIsTheLeast) {
    const StepTime fastest = timeOfRepeats({took(9), took(2), took(1)}, Repeats::fastest);
    EXPECT_EQ(fastest.seconds, 1);
    EXPECT_EQ(fastest.stages.solve, 0.25);
}

}  // namespace
}  // namespace swept::worlds
