#include <gtest/gtest.h>

#include <swept/engine/stages/shared_step.h>

/// Which steps are handed to several threads: those with enough in shared loops, counted in the step before.

namespace swept::test {
namespace {

/// Two workers, one after the other.
class TwoWorkers final : public TaskSystem {
public:
    explicit TwoWorkers(double startSeconds) : startSeconds_(startSeconds) {}
    int workerCount() const override { return 2; }
    void run(std::size_t count, std::size_t, FunctionRef<void(std::size_t, std::size_t, int)> body) override {
        for (std::size_t i = 0; i < count; ++i) { body(i, i + 1, static_cast<int>(i % 2)); }
    }
    double startSeconds() const override { return startSeconds_; }

private:
    double startSeconds_;
};

/// A heap on the move, all of it iterated.
StepCounters heapOf(std::uint64_t bodies) {
    StepCounters counters;
    counters.awakeBodies = counters.solvedBodies = bodies;
    counters.manifolds = counters.constraints = 2 * bodies;
    counters.colours = 8;
    counters.bodySubSteps = 4 * bodies;
    counters.effortClasses = 1;
    return counters;
}

TEST(SharedStep, WhatIsAtRestIsNoWork) {
    StepCounters counters;
    EXPECT_EQ(workOf(counters), 0);
    counters.awakeBodies = counters.settledBodies = 10'000;
    EXPECT_EQ(workOf(counters), 0);
}

TEST(SharedStep, GrowsWithTheWorld) {
    EXPECT_GT(workOf(heapOf(200)), 0);
    EXPECT_GT(workOf(heapOf(2000)), 10 * workOf(heapOf(200)));
}

/// 1275 boxes side by side that rest: contacts are few to find, and their impulses are one worker's.
TEST(SharedStep, DirectSolvesAreNotShared) {
    StepCounters direct = heapOf(1275);
    direct.manifolds = 0;
    StepCounters iterated = direct;
    direct.directBodies = direct.solvedBodies;
    EXPECT_GT(workOf(iterated), 2 * workOf(direct));
    direct.directBodies *= 2;  // kinematic ones are counted, too
    EXPECT_GT(workOf(direct), 0);
}

TEST(SharedStep, IsHandedOverWhereItGains) {
    const auto loopsFor = [](TaskSystem* tasks, double work) {
        WorldState world;
        if (tasks != nullptr) { world.userTasks = tasks; }
        const TaskSystem* loops = nullptr;
        shareStep(world, work, [&] { loops = world.loops; });
        if (loops == &world.serialTasks) { return 's'; }
        return loops == &world.crew ? 'c' : 't';
    };
    TwoWorkers slow(1e-4);
    TwoWorkers atOnce(0);
    EXPECT_EQ(loopsFor(nullptr, 1), 's');
    EXPECT_EQ(loopsFor(&slow, workOf(heapOf(200))), 's');
    EXPECT_EQ(loopsFor(&slow, workOf(heapOf(5000))), 'c');
    EXPECT_EQ(loopsFor(&atOnce, 0), 't');
}

}  // namespace
}  // namespace swept::test
