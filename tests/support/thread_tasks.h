#pragma once

#include <algorithm>
#include <atomic>
#include <condition_variable>
#include <mutex>
#include <thread>
#include <vector>

#include <swept/shapes/task_system.h>

namespace swept::test {

/// A task system as a game might plug one in: some threads that take the next chunk of a loop as soon as they are free,
/// so that who does what differs from run to run. The calling thread is worker 0.
class ThreadTasks final : public TaskSystem {
public:
    explicit ThreadTasks(int workers) : workers_(workers) {
        for (int worker = 1; worker < workers; ++worker) {
            threads_.emplace_back([this, worker] { serve(worker); });
        }
    }
    ThreadTasks(const ThreadTasks&) = delete;
    ThreadTasks& operator=(const ThreadTasks&) = delete;
    ~ThreadTasks() override {
        {
            const std::lock_guard lock(mutex_);
            closing_ = true;
        }
        started_.notify_all();
        for (std::thread& thread : threads_) { thread.join(); }
    }

    int workerCount() const override { return workers_; }
    /// So little that even the smallest world is handed over.
    double startSeconds() const override { return 1e-12; }

    void run(std::size_t count, std::size_t grain, FunctionRef<void(std::size_t, std::size_t, int)> body) override {
        if (count == 0) { return; }
        {
            const std::lock_guard lock(mutex_);
            body_ = &body;
            count_ = count;
            grain_ = std::max<std::size_t>(grain, 1);
            next_ = 0;
            busy_ = workers_ - 1;
            ++round_;
        }
        started_.notify_all();
        work(0);
        std::unique_lock lock(mutex_);
        finished_.wait(lock, [this] { return busy_ == 0; });
        body_ = nullptr;
    }

    /// Chunks that other threads than the caller's took so far: a test that compares runs must have had some.
    std::size_t chunksOfOthers() const { return chunksOfOthers_; }

private:
    void serve(int worker) {
        std::size_t seen = 0;
        for (;;) {
            {
                std::unique_lock lock(mutex_);
                started_.wait(lock, [&] { return closing_ || round_ != seen; });
                if (closing_) { return; }
                seen = round_;
            }
            work(worker);
            const std::lock_guard lock(mutex_);
            if (--busy_ == 0) { finished_.notify_one(); }
        }
    }

    void work(int worker) {
        for (;;) {
            const std::size_t begin = next_.fetch_add(grain_);
            if (begin >= count_) { return; }
            if (worker != 0) { ++chunksOfOthers_; }
            (*body_)(begin, std::min(begin + grain_, count_), worker);
        }
    }

    int workers_;
    std::vector<std::thread> threads_;
    std::mutex mutex_;
    std::condition_variable started_;
    std::condition_variable finished_;
    FunctionRef<void(std::size_t, std::size_t, int)>* body_ = nullptr;
    std::size_t count_ = 0;
    std::size_t grain_ = 1;
    std::atomic<std::size_t> next_ = 0;
    std::atomic<std::size_t> chunksOfOthers_ = 0;
    int busy_ = 0;
    std::size_t round_ = 0;
    bool closing_ = false;
};

}  // namespace swept::test
