#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <ctime>
#include <optional>
#include <thread>

#include <sched.h>

#include <swept/tools/bench/hand_over.h>

#include "../support/thread_tasks.h"

namespace swept::bench {
namespace {

using Clock = std::chrono::steady_clock;
using Seconds = std::chrono::duration<double>;

/// Whether this process may use two processors: tests run in containers, too.
bool hasTwoProcessors() {
    cpu_set_t allowed;
    CPU_ZERO(&allowed);
    return sched_getaffinity(0, sizeof(allowed), &allowed) == 0 && CPU_COUNT(&allowed) > 1;
}

/// Seconds for which the calling thread had a processor.
double ownSeconds() {
    timespec time{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// Works for as long as a game takes.
/// @return the share of the time for which the thread had a processor
double shareOfProcessor() {
    const Clock::time_point start = Clock::now();
    const double ownStart = ownSeconds();
    while (Clock::now() - start < std::chrono::milliseconds(5)) {}
    const double own = ownSeconds() - ownStart;
    return own / Seconds(Clock::now() - start).count();
}

/// Whether two threads had a processor each just now.
bool bothProcessorsAreFree() {
    std::atomic<bool> started = false;
    double other = 0;
    std::thread thread([&] {
        started = true;
        other = shareOfProcessor();
    });
    while (!started) { std::this_thread::yield(); }
    const double own = shareOfProcessor();
    thread.join();
    return own > 0.99 && other > 0.99;
}

TEST(HandOver, OneWorkerHasNobodyToHandTo) {
    SerialTaskSystem alone;
    EXPECT_FALSE(handOverSeconds(alone));
}

/// Where threads share one processor a game may have no end in time; then nothing is told, instead of a wrong number.
TEST(HandOver, OfThreadsOnOneProcessorIsNotMadeUp) {
    if (hasTwoProcessors()) { GTEST_SKIP() << "this process has two processors"; }
    test::ThreadTasks tasks(2);
    EXPECT_FALSE(handOverSeconds(tasks));
}

TEST(HandOver, BetweenTwoThreadsTakesNoLongerThanMemory) {
    if (!hasTwoProcessors()) { GTEST_SKIP() << "this process has one processor"; }
    constexpr double kMost = 5e-6;    // a game may take ten times as long before it is given up
    constexpr int kFreeMoments = 10;  // after so many it has had its chance
    constexpr Seconds kPatience{30};
    test::ThreadTasks tasks(2);
    std::optional<double> seconds;
    // Others may keep a processor busy, and a thread may be put aside in the middle of a game. So one asks again, and
    // only moments count in which both processors are seen to be free before and after the games.
    int freeMoments = 0;
    const Clock::time_point start = Clock::now();
    while (!(seconds && *seconds < kMost) && freeMoments < kFreeMoments && Clock::now() - start < kPatience) {
        const bool freeBefore = bothProcessorsAreFree();
        seconds = handOverSeconds(tasks);
        freeMoments += freeBefore && bothProcessorsAreFree() ? 1 : 0;
    }
    if (!(seconds && *seconds < kMost) && freeMoments < kFreeMoments) {
        GTEST_SKIP() << "others kept the processors busy for " << kPatience.count() << " s";
    }
    ASSERT_TRUE(seconds);
    EXPECT_GT(*seconds, 1e-10);
    EXPECT_LT(*seconds, kMost);
}

}  // namespace
}  // namespace swept::bench
