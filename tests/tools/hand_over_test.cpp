#include <gtest/gtest.h>

#include <chrono>
#include <optional>

#include <sched.h>

#include <swept/tools/bench/hand_over.h>

#include "../support/thread_tasks.h"

namespace swept::bench {
namespace {

/// Whether this process may use two processors: tests run in containers, too.
bool hasTwoProcessors() {
    cpu_set_t allowed;
    CPU_ZERO(&allowed);
    return sched_getaffinity(0, sizeof(allowed), &allowed) == 0 && CPU_COUNT(&allowed) > 1;
}

TEST(HandOver, OneWorkerHasNobodyToHandTo) {
    SerialTaskSystem alone;
    EXPECT_FALSE(handOverSeconds(alone));
}

/// Where threads share one processor a game may have no end in time; then nothing is told, instead of a wrong number.
TEST(HandOver, BetweenTwoThreadsTakesNoLongerThanMemory) {
    test::ThreadTasks tasks(2);
    std::optional<double> seconds;
    // Other tests may keep a processor busy, and a thread may be put aside in the middle of a game: then one asks
    // again, for as long as they may take.
    const double patience = hasTwoProcessors() ? 60 : 0.1;
    constexpr double kMost = 5e-6;  // a game may take ten times as long before it is given up
    const auto start = std::chrono::steady_clock::now();
    while (!(seconds && *seconds < kMost) &&
           std::chrono::steady_clock::now() - start < std::chrono::duration<double>(patience)) {
        seconds = handOverSeconds(tasks);
    }
    EXPECT_EQ(seconds.has_value(), hasTwoProcessors());
    if (!seconds) { return; }
    EXPECT_GT(*seconds, 1e-10);
    EXPECT_LT(*seconds, kMost);
}

}  // namespace
}  // namespace swept::bench
