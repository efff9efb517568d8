#include "task_threads.h"

#ifdef SWEPT_TBB
#include <swept/engine/tbb_task_system.h>
#endif

namespace swept {

std::unique_ptr<TaskSystem> makeTaskSystem([[maybe_unused]] int threads) {
#ifdef SWEPT_TBB
    if (threads > 1) { return std::make_unique<TbbTaskSystem>(threads); }
#endif
    return nullptr;
}

}  // namespace swept
