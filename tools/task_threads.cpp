#include "task_threads.h"

#ifdef SWEPT_TBB
#include <swept/engine/tbb_task_system.h>
#endif
#if defined(SWEPT_TBB) && defined(__linux__)
#define SWEPT_SPREADS_THREADS
#include <atomic>
#include <vector>

#include <sched.h>

#include <oneapi/tbb/task_scheduler_observer.h>
#endif

namespace swept {

#ifdef SWEPT_SPREADS_THREADS
/// Tells each thread its place as it enters an arena, the first time.
class ThreadSpread::Observer final : public tbb::task_scheduler_observer {
public:
    Observer() {
        sched_getaffinity(0, sizeof(before_), &before_);
        for (int processor = 0; processor < CPU_SETSIZE; ++processor) {
            if (CPU_ISSET(processor, &before_)) { processors_.push_back(processor); }
        }
        observe(true);
    }
    Observer(const Observer&) = delete;
    Observer& operator=(const Observer&) = delete;
    ~Observer() override {
        observe(false);
        sched_setaffinity(0, sizeof(before_), &before_);
    }

    void on_scheduler_entry(bool /*isWorker*/) override {
        thread_local bool isPlaced = false;
        if (isPlaced || processors_.empty()) { return; }
        isPlaced = true;
        cpu_set_t own;
        CPU_ZERO(&own);
        CPU_SET(processors_[next_.fetch_add(1) % processors_.size()], &own);
        sched_setaffinity(0, sizeof(own), &own);
    }

private:
    cpu_set_t before_{};
    std::vector<int> processors_;  ///< that this process may use
    std::atomic<std::size_t> next_ = 0;
};
#else
class ThreadSpread::Observer {};
#endif

ThreadSpread::ThreadSpread() : observer_(std::make_unique<Observer>()) {}
ThreadSpread::~ThreadSpread() = default;

std::unique_ptr<TaskSystem> makeTaskSystem([[maybe_unused]] int threads) {
#ifdef SWEPT_TBB
    if (threads > 1) { return std::make_unique<TbbTaskSystem>(threads); }
#endif
    return nullptr;
}

}  // namespace swept
