#include <gtest/gtest.h>

#include <optional>
#include <thread>

#include <swept/tools/bench/hand_over.h>

#include "../support/thread_tasks.h"

namespace swept::bench {
namespace {

TEST(HandOver, OneWorkerHasNobodyToHandTo) {
    SerialTaskSystem alone;
    EXPECT_FALSE(handOverSeconds(alone));
}

/// Where threads share one processor a game may have no end in time; then nothing is told, instead of a wrong number.
TEST(HandOver, BetweenTwoThreadsTakesNoLongerThanMemory) {
    test::ThreadTasks tasks(2);
    std::optional<double> seconds;
    for (int i = 0; i < 20 && !seconds; ++i) { seconds = handOverSeconds(tasks); }  // others may keep a processor busy
    const bool hasTwo = std::thread::hardware_concurrency() > 1;
    EXPECT_TRUE(seconds || !hasTwo);
    EXPECT_GT(seconds.value_or(1), 1e-10);
    if (hasTwo) { EXPECT_LT(seconds.value_or(1), 5e-6); }  // a game may take ten times as long before it is given up
}

}  // namespace
}  // namespace swept::bench
