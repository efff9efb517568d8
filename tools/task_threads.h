#pragma once

#include <memory>

#include <swept/engine/task_system.h>

namespace swept {

/// More threads than any machine has: the largest number that commands take.
inline constexpr int kMostThreads = 4096;

/// A task system on so many threads, the calling one included.
/// @return null for one thread, and where the tools were built without oneTBB: worlds then run on the calling thread.
std::unique_ptr<TaskSystem> makeTaskSystem(int threads);

/// For measuring: as long as it lives, each thread of oneTBB keeps to a processor of its own from its first task on,
/// the calling one too. There are systems that wake a thread on the processor of the one that woke it, and leave it
/// there as long as it mostly sleeps: then the second worker of a step came when the step was nearly over. Does nothing
/// elsewhere than on Linux, and without oneTBB.
class ThreadSpread {
public:
    ThreadSpread();
    ThreadSpread(const ThreadSpread&) = delete;
    ThreadSpread& operator=(const ThreadSpread&) = delete;
    ~ThreadSpread();

private:
    class Observer;
    std::unique_ptr<Observer> observer_;
};

}  // namespace swept
