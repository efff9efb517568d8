#include <atomic>
#include <new>
#include <numeric>
#include <stdexcept>
#include <thread>
#include <vector>

#include <swept/engine/crew/crew.h>

#include "../support/thread_tasks.h"

/// Workers that go through many loops together, whoever comes.

namespace swept::test {
namespace {

/// One thread after the other, the last range first: the leader is not the caller's first range, and nobody ever helps.
class BackwardTasks final : public TaskSystem {
public:
    int workerCount() const override { return 4; }
    void run(std::size_t count, std::size_t, FunctionRef<void(std::size_t, std::size_t, int)> body) override {
        for (std::size_t i = count; i > 0; --i) { body(i - 1, i, 0); }
    }
};

/// A chain of loops in which each needs what the one before wrote, elsewhere: a block that comes too early, too late or
/// twice changes the sums.
std::vector<std::uint64_t> chainOfLoops(TaskSystem& loops, int rounds) {
    constexpr std::size_t kCount = 200;
    std::vector<std::uint64_t> now(kCount);
    std::vector<std::uint64_t> next(kCount);
    std::iota(now.begin(), now.end(), std::uint64_t{1});
    for (int round = 0; round < rounds; ++round) {
        const std::size_t grain = 1 + static_cast<std::size_t>(round % 70);
        loops.run(kCount, grain, [&](std::size_t begin, std::size_t end, int) {
            for (std::size_t i = begin; i < end; ++i) { next[i] = 3 * now[(i * 7 + 1) % kCount] + now[kCount - 1 - i]; }
        });
        now.swap(next);
    }
    return now;
}

TEST(Crew, LoopsFollowEachOther) {
    SerialTaskSystem serial;
    for (const int rounds : {1, 3000}) {
        const std::vector<std::uint64_t> wanted = chainOfLoops(serial, rounds);
        for (const int workers : {1, 2, 3, 8}) {
            ThreadTasks tasks(workers);
            Crew crew;
            std::vector<std::uint64_t> got;
            crew.lead(tasks, [&] { got = chainOfLoops(crew, rounds); });
            EXPECT_EQ(got, wanted) << workers << " workers";
        }
    }
}

TEST(Crew, NeedsNobody) {
    SerialTaskSystem serial;
    BackwardTasks backward;
    const std::vector<std::uint64_t> wanted = chainOfLoops(serial, 50);
    for (TaskSystem* tasks : {static_cast<TaskSystem*>(&serial), static_cast<TaskSystem*>(&backward)}) {
        Crew crew;
        std::vector<std::uint64_t> got;
        crew.lead(*tasks, [&] { got = chainOfLoops(crew, 50); });
        EXPECT_EQ(got, wanted);
        EXPECT_EQ(crew.workerCount(), tasks->workerCount());
    }
}

TEST(Crew, OthersDoHelp) {
    ThreadTasks tasks(3);
    Crew crew;
    std::vector<std::atomic<int>> blocksOf(3);
    crew.lead(tasks, [&] {
        // Until somebody came: on a busy machine that takes a while.
        while (std::count_if(blocksOf.begin(), blocksOf.end(), [](const auto& blocks) { return blocks > 0; }) < 2) {
            crew.run(100, 1,
                     [&](std::size_t, std::size_t, int worker) { ++blocksOf[static_cast<std::size_t>(worker)]; });
        }
    });
    SUCCEED();
}

TEST(Crew, IsUsedAgain) {
    SerialTaskSystem serial;
    const std::vector<std::uint64_t> wanted = chainOfLoops(serial, 5);
    ThreadTasks tasks(3);
    Crew crew;
    for (int step = 0; step < 200; ++step) {
        std::vector<std::uint64_t> got;
        crew.lead(tasks, [&] { got = chainOfLoops(crew, 5); });
        ASSERT_EQ(got, wanted) << step;
    }
}

TEST(Crew, MoreBlocksThanATicketHolds) {
    ThreadTasks tasks(2);
    Crew crew;
    std::vector<std::uint8_t> visits(300'000);
    crew.lead(tasks, [&] {
        crew.run(visits.size(), 1, [&](std::size_t begin, std::size_t end, int) {
            for (std::size_t i = begin; i < end; ++i) { ++visits[i]; }
        });
    });
    EXPECT_EQ(std::count(visits.begin(), visits.end(), 1), static_cast<std::ptrdiff_t>(visits.size()));
}

/// Also when another thread leads: a task system that lets go of exceptions would end the program.
TEST(Crew, WhatIsThrownComesThrough) {
    class OtherThread final : public TaskSystem {
    public:
        int workerCount() const override { return 2; }
        void run(std::size_t count, std::size_t, FunctionRef<void(std::size_t, std::size_t, int)> body) override {
            std::thread([&]() noexcept { body(0, count, 0); }).join();
        }
    };
    OtherThread other;
    SerialTaskSystem serial;
    for (TaskSystem* tasks : {static_cast<TaskSystem*>(&other), static_cast<TaskSystem*>(&serial)}) {
        Crew crew;
        EXPECT_THROW(crew.lead(*tasks, [] { throw std::bad_alloc(); }), std::bad_alloc);
        bool led = false;
        crew.lead(*tasks, [&led] { led = true; });
        EXPECT_TRUE(led) << "not after that";
    }
}

}  // namespace
}  // namespace swept::test
