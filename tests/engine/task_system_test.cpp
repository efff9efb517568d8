#include <gtest/gtest.h>

#include <atomic>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "../support/thread_tasks.h"

#ifdef SWEPT_TEST_TBB
#include <swept/engine/tbb_task_system.h>
#endif

/// What `TaskSystem` promises, of every one that we have.

namespace swept::test {
namespace {

enum class Kind { serial, threads, tbb };

std::unique_ptr<TaskSystem> make(Kind kind, int workers) {
    switch (kind) {
        case Kind::serial:
            return std::make_unique<SerialTaskSystem>();
        case Kind::threads:
            return std::make_unique<ThreadTasks>(workers);
        case Kind::tbb:
            break;
    }
#ifdef SWEPT_TEST_TBB
    return std::make_unique<TbbTaskSystem>(workers);
#else
    return nullptr;
#endif
}

class TaskSystems : public testing::TestWithParam<Kind> {};

void expectExactCover(TaskSystem& tasks, std::size_t count, std::size_t grain) {
    std::vector<std::atomic<int>> visits(count);
    std::atomic<int> tooShort = 0;
    std::atomic<int> strangeWorkers = 0;
    tasks.run(count, grain, [&](std::size_t begin, std::size_t end, int worker) {
        if (end - begin < grain && end != count) { ++tooShort; }
        if (worker < 0 || worker >= tasks.workerCount()) { ++strangeWorkers; }
        for (std::size_t i = begin; i < end; ++i) { ++visits[i]; }
    });
    for (std::size_t i = 0; i < count; ++i) { ASSERT_EQ(visits[i], 1) << i << " of " << count << ", grain " << grain; }
    EXPECT_EQ(tooShort, 0) << count << ", grain " << grain;
    EXPECT_EQ(strangeWorkers, 0);
}

TEST_P(TaskSystems, CoverEverythingOnce) {
    for (const int workers : {1, 2, 3, 8}) {
        const auto tasks = make(GetParam(), workers);
        ASSERT_GE(tasks->workerCount(), 1);
        for (const std::size_t count : {0U, 1U, 2U, 7U, 64U, 1000U}) {
            for (const std::size_t grain : {0U, 1U, 3U, 64U, 5000U}) { expectExactCover(*tasks, count, grain); }
        }
    }
}

/// Two ranges at the same time never have the same worker: that is whose scratch they use.
TEST_P(TaskSystems, WorkersDoOneThingAtATime) {
    const auto tasks = make(GetParam(), 3);
    std::vector<std::atomic<int>> inside(static_cast<std::size_t>(tasks->workerCount()));
    std::atomic<int> clashes = 0;
    for (int round = 0; round < 50; ++round) {
        tasks->run(64, 1, [&](std::size_t, std::size_t, int worker) {
            std::atomic<int>& mine = inside[static_cast<std::size_t>(worker)];
            if (++mine != 1) { ++clashes; }
            std::this_thread::yield();
            --mine;
        });
    }
    EXPECT_EQ(clashes, 0);
}

std::string nameOf(const testing::TestParamInfo<Kind>& info) {
    return info.param == Kind::serial ? "serial" : info.param == Kind::threads ? "threads" : "tbb";
}
#ifdef SWEPT_TEST_TBB
constexpr Kind kKinds[] = {Kind::serial, Kind::threads, Kind::tbb};
#else
constexpr Kind kKinds[] = {Kind::serial, Kind::threads};
#endif
INSTANTIATE_TEST_SUITE_P(Kinds, TaskSystems, testing::ValuesIn(kKinds), nameOf);

#ifdef SWEPT_TEST_TBB
/// Two worlds stepped at the same time may share one.
TEST(TbbTaskSystem, ServesSeveralThreadsAtOnce) {
    TbbTaskSystem tasks(2);
    std::vector<std::thread> callers;
    for (int i = 0; i < 3; ++i) {
        callers.emplace_back([&tasks] {
            for (int round = 0; round < 20; ++round) { expectExactCover(tasks, 500, 7); }
        });
    }
    for (std::thread& caller : callers) { caller.join(); }
}
#endif

}  // namespace
}  // namespace swept::test
