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

TEST(HandOver, BetweenTwoThreadsTakesNoLongerThanMemory) {
    if (std::thread::hardware_concurrency() < 2) { GTEST_SKIP() << "one processor"; }
    test::ThreadTasks tasks(2);
    std::optional<double> seconds;
    for (int i = 0; i < 20 && !seconds; ++i) { seconds = handOverSeconds(tasks); }  // others may keep a processor busy
    ASSERT_TRUE(seconds);
    EXPECT_GT(*seconds, 1e-10);
    EXPECT_LT(*seconds, 5e-6);
}

}  // namespace
}  // namespace swept::bench
