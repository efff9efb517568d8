#include <gtest/gtest.h>

#include <array>
#include <vector>

#include <swept/engine/crew/beside.h>
#include <swept/engine/crew/crew.h>
#include <swept/solver/halves.h>

#include "../support/thread_tasks.h"

/// One worker does something alone, while the others go through a loop; loops that are cut where halves meet: each
/// round happens once.

namespace swept::test {
namespace {

/// One range per round, the last one first: what is alone comes last.
class BackwardRounds final : public TaskSystem {
public:
    int workerCount() const override { return 2; }
    void run(std::size_t count, std::size_t, FunctionRef<void(std::size_t, std::size_t, int)> body) override {
        for (std::size_t i = count; i > 0; --i) { body(i - 1, i, 0); }
        ++loops;
    }
    int loops = 0;
};

constexpr std::array kCounts{0U, 1U, 2U, 15U, 16U, 31U, 32U, 95U, 96U, 97U, 1000U, 4096U};

/// @return whether the last round that was done came before what is alone
bool expectEachOnce(TaskSystem& loops, std::size_t count, std::size_t grain) {
    int alone = 0;
    bool isAfter = false;
    std::vector<int> rounds(count);
    runBeside(
        loops,
        [&] {
            ++alone;
            isAfter = count > 0 && rounds.back() > 0;
        },
        count, grain,
        [&rounds](std::size_t begin, std::size_t end) {
            EXPECT_LT(begin, end);
            for (std::size_t i = begin; i < end; ++i) { ++rounds[i]; }
        });
    EXPECT_EQ(alone, 1) << count << " rounds";
    EXPECT_EQ(rounds, std::vector<int>(count, 1));
    return isAfter;
}

TEST(Beside, DoesEachRoundOnceAndWhatIsAlone) {
    for (const int workers : {2, 3, 8}) {
        ThreadTasks threads(workers);
        for (const std::size_t count : kCounts) {
            int alone = 0;
            std::vector<int> rounds(count);
            runBeside(
                threads, [&alone] { ++alone; }, count, 16,
                [&rounds](std::size_t begin, std::size_t end) {
                    for (std::size_t i = begin; i < end; ++i) { ++rounds[i]; }
                });
            EXPECT_EQ(alone, 1) << count << " rounds, " << workers << " workers";
            EXPECT_EQ(rounds, std::vector<int>(count, 1)) << workers << " workers";
        }
        // Others do take part, sooner or later.
        for (int more = 0; more < 100'000 && threads.chunksOfOthers() == 0; ++more) {
            runBeside(
                threads, [] {}, 96, 1, [](std::size_t, std::size_t) {});
        }
        EXPECT_GT(threads.chunksOfOthers(), 0U);
    }
}

TEST(Beside, IsSharedFromAGrainOn) {
    for (const std::size_t grain : {1U, 16U, 64U}) {
        for (const std::size_t count : kCounts) {
            BackwardRounds backward;
            const bool isShared = count >= grain && count > 0;
            EXPECT_EQ(expectEachOnce(backward, count, grain), isShared) << count << " rounds, grain " << grain;
            EXPECT_EQ(backward.loops, isShared ? 1 : 0);
        }
    }
}

TEST(Beside, AloneComesFirstWhereThereIsOneWorker) {
    SerialTaskSystem serial;
    for (const std::size_t count : kCounts) { EXPECT_FALSE(expectEachOnce(serial, count, 1)); }
}

TEST(Halves, EachRoundIsDoneOnce) {
    for (const int workers : {1, 2, 3, 8}) {
        ThreadTasks threads(workers);
        Crew crew;
        crew.lead(threads, [&] {
            for (const std::size_t count : {0U, 1U, 2U, 7U, 64U, 1000U}) {
                for (const std::size_t middle : {std::size_t{0}, count / 5, count / 2, count}) {
                    std::vector<int> rounds(count);
                    runInHalves(crew, middle, count, 4, [&rounds](std::size_t begin, std::size_t end) {
                        ASSERT_LT(begin, end);
                        for (std::size_t i = begin; i < end; ++i) { ++rounds[i]; }
                    });
                    EXPECT_EQ(rounds, std::vector<int>(count, 1)) << workers << " workers, middle " << middle;
                }
            }
        });
    }
}

/// Notes what it is asked for, as two workers would be.
class NotingTasks final : public TaskSystem {
public:
    int workerCount() const override { return 2; }
    void run(std::size_t count, std::size_t, FunctionRef<void(std::size_t, std::size_t, int)> body) override {
        body(0, count / 2, 0);
        body(count / 2, count, 1);
    }
};

TEST(Halves, AreCutAtTheMiddle) {
    NotingTasks two;
    for (const std::size_t middle : {1U, 30U, 50U, 99U}) {
        std::vector<std::size_t> edges;
        runInHalves(two, middle, 100, 4, [&edges](std::size_t begin, std::size_t end) {
            edges.push_back(begin);
            edges.push_back(end);
        });
        EXPECT_EQ(edges, (std::vector<std::size_t>{0, middle, middle, 100}));
    }
}

}  // namespace
}  // namespace swept::test
