#pragma once

#include <cstddef>

#include "../shapes/function_ref.h"

namespace swept {

/// Where a world runs its parallel loops: a game plugs in its own job system. The results are the same bits for every
/// implementation and every number of workers.
class TaskSystem {
public:
    virtual ~TaskSystem() = default;

    /// Upper bound of the worker indices that `run` hands out, at least 1.
    virtual int workerCount() const = 0;

    /// Calls `body(begin, end, worker)` for ranges that cover [0, count) exactly once, each at least `grain` long except
    /// the last; returns when all are done. Ranges may run at the same time on different workers.
    virtual void run(std::size_t count, std::size_t grain,
                     FunctionRef<void(std::size_t begin, std::size_t end, int worker)> body) = 0;
};

/// Everything on the calling thread, in one range.
class SerialTaskSystem final : public TaskSystem {
public:
    int workerCount() const override { return 1; }
    void run(std::size_t count, std::size_t /*grain*/,
             FunctionRef<void(std::size_t, std::size_t, int)> body) override {
        if (count > 0) { body(0, count, 0); }
    }
};

}  // namespace swept
