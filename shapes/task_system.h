#pragma once

#include <cstddef>

#include "function_ref.h"

namespace swept {

/// Where a world runs its parallel loops: a game plugs in its own job system. The results are the same bits for every
/// implementation and every number of workers, provided that all threads have the same floating-point environment.
class TaskSystem {
public:
    static constexpr double kAtOnce = 1e-9;  ///< s

    virtual ~TaskSystem() = default;

    /// Upper bound of the worker indices that `run` hands out, at least 1.
    virtual int workerCount() const = 0;

    /// Calls `body(begin, end, worker)` for ranges that cover [0, count) exactly once, each at least `grain` long
    /// except the last; returns when all are done. Ranges may run at the same time on different workers. A body does
    /// not call `run` itself, and does not throw.
    virtual void run(std::size_t count, std::size_t grain,
                     FunctionRef<void(std::size_t begin, std::size_t end, int worker)> body) = 0;

    /// Seconds, roughly, that `run` costs and takes until other threads work: a step that is short in comparison stays
    /// on its thread. A step has hundreds of loops, most of them a few microseconds long; so a world asks for one range
    /// per worker, once a step, and its workers go through all loops together (engine/crew/crew.h). 0 means
    /// that other threads wait for loops already: then each loop is handed to `run` as it is. Below `kAtOnce`
    /// everything is shared, however small: so that tests of small worlds see it.
    virtual double startSeconds() const { return 1e-4; }
};

/// Everything on the calling thread, in one range.
class SerialTaskSystem final : public TaskSystem {
public:
    int workerCount() const override { return 1; }
    void run(std::size_t count, std::size_t /*grain*/, FunctionRef<void(std::size_t, std::size_t, int)> body) override {
        if (count > 0) { body(0, count, 0); }
    }
};

}  // namespace swept
