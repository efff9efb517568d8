#pragma once

#include <atomic>
#include <cstdint>

#include "../../shapes/cache_line.h"
#include "../../shapes/real.h"
#include "../../shapes/task_system.h"

namespace swept::inline SWEPT_PRECISION {

/// Workers of a task system that stay together through many loops. One of them leads: it does the work as if alone, and
/// where that comes to a loop, those who have arrived by then take blocks of it. Nobody waits for a worker that does
/// not come, so that it is no matter whether the task system runs its ranges at the same time or one after the other.
///
/// A loop costs two writes to memory that all watch, and one or two per claim: about a microsecond in all. In between
/// the others spin, and after some microseconds let other programs run.
class Crew final : public TaskSystem {
public:
    /// Runs `work` on one of the workers of `tasks`, and returns when it is done. Only `work` may call `run` of this
    /// crew. What it throws comes through here, on the calling thread: a task system need not know of exceptions.
    void lead(TaskSystem& tasks, FunctionRef<void()> work);

    /// Of the task system that it works on; 1 without.
    int workerCount() const override { return workers_; }
    void run(std::size_t count, std::size_t grain,
             FunctionRef<void(std::size_t begin, std::size_t end, int worker)> body) override;
    /// Of the task system, too: what small loops are worth is then judged the same.
    double startSeconds() const override { return startSeconds_; }

private:
    /// Neither of these two throws: others work on what it would leave. Memory that runs out within a shared loop ends
    /// the program.
    void help(int worker) noexcept;
    void share(std::size_t blocks, std::size_t helpers) noexcept;
    std::uint32_t takeBlocks(std::uint64_t ticket, bool fromFront, int worker);

    int workers_ = 1;
    int leader_ = 0;
    double startSeconds_ = 0;

    // The present loop. Written by the leader before it hands out the ticket; whoever holds a block may read it.
    const FunctionRef<void(std::size_t, std::size_t, int)>* body_ = nullptr;
    std::size_t count_ = 0;
    std::size_t blockLength_ = 1;

    // Each on a cache line of its own: the first two are written for every block.
    alignas(kCacheLine) std::atomic<std::uint64_t> ticket_ = 0;  ///< which loop, and which of its blocks are free
    std::atomic<std::uint64_t> share_ = 1;                       ///< blocks of a claim
    alignas(kCacheLine) std::atomic<std::uint32_t> done_ = 0;    ///< blocks of the present loop, by others
    alignas(kCacheLine) std::atomic<int> helpers_ = 0;           ///< that have arrived
    std::atomic<bool> isLed_ = false;
};

}  // namespace swept::inline SWEPT_PRECISION
