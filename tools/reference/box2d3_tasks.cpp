#include "box2d3_tasks.h"

#ifdef SWEPT_BENCH_TBB
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_group.h>
#endif

namespace swept {

#ifdef SWEPT_BENCH_TBB
struct Box2d3Tasks::Arena {
    tbb::task_arena arena;

    explicit Arena(int threads) : arena(threads) {}

    static void* enqueue(b2TaskCallback* task, void* taskContext, void* userContext) {
        auto* const self = static_cast<Arena*>(userContext);
        auto* const group = new tbb::task_group;  // NOLINT: handed to finish
        self->arena.execute([&] { group->run([task, taskContext] { task(taskContext); }); });
        return group;
    }
    static void finish(void* userTask, void* userContext) {
        const std::unique_ptr<tbb::task_group> group(static_cast<tbb::task_group*>(userTask));
        static_cast<Arena*>(userContext)->arena.execute([&] { group->wait(); });
    }
};

Box2d3Tasks::Box2d3Tasks(int threads) : arena_(threads > 1 ? std::make_unique<Arena>(threads) : nullptr) {}

void Box2d3Tasks::addTo(b2WorldDef& definition) const {
    if (arena_ == nullptr) { return; }
    definition.workerCount = arena_->arena.max_concurrency();
    definition.enqueueTask = Arena::enqueue;
    definition.finishTask = Arena::finish;
    definition.userTaskContext = arena_.get();
}
#else
struct Box2d3Tasks::Arena {};

Box2d3Tasks::Box2d3Tasks(int /*threads*/) {}

void Box2d3Tasks::addTo(b2WorldDef& /*definition*/) const {}
#endif

Box2d3Tasks::~Box2d3Tasks() = default;

}  // namespace swept
