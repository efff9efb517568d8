#include "tbb_task_system.h"

#include <algorithm>

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>

namespace swept {

struct TbbTaskSystem::Arena {
    tbb::task_arena arena;
};

TbbTaskSystem::TbbTaskSystem(int workers)
    : arena_(std::make_unique<Arena>(Arena{tbb::task_arena(workers > 0 ? workers : tbb::task_arena::automatic)})) {}

TbbTaskSystem::~TbbTaskSystem() = default;

int TbbTaskSystem::workerCount() const { return std::max(arena_->arena.max_concurrency(), 1); }

void TbbTaskSystem::run(std::size_t count, std::size_t grain, FunctionRef<void(std::size_t, std::size_t, int)> body) {
    if (count == 0) { return; }
    // oneTBB halves its ranges, so that they may be half as long as asked for: it is given whole grains.
    const std::size_t length = std::max<std::size_t>(grain, 1);
    const std::size_t grains = (count - 1) / length + 1;
    arena_->arena.execute([&] {
        tbb::parallel_for(tbb::blocked_range<std::size_t>(0, grains), [&](const tbb::blocked_range<std::size_t>& some) {
            body(some.begin() * length, std::min(some.end() * length, count),
                 tbb::this_task_arena::current_thread_index());
        });
    });
}

}  // namespace swept
