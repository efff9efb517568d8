#pragma once

#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

#include <swept/engine/task_system.h>

#include "../support/random.h"
#include "../support/thread_tasks.h"

/// Task systems that a world must not be able to tell apart.

namespace swept::test {

/// Every range one element long, in an order that no two loops share, handed to three workers in turn: all on one
/// thread, so that what is found wrong here is found again.
class ShuffledTasks final : public TaskSystem {
public:
    int workerCount() const override { return kWorkers; }
    double startSeconds() const override { return 0; }  // each loop as it is
    void run(std::size_t count, std::size_t /*grain*/, FunctionRef<void(std::size_t, std::size_t, int)> body) override {
        std::vector<std::size_t> order(count);
        std::iota(order.begin(), order.end(), std::size_t{0});
        for (std::size_t i = count; i > 1; --i) {
            std::swap(order[i - 1], order[static_cast<std::size_t>(random_.integer(0, static_cast<int>(i) - 1))]);
        }
        for (std::size_t i = 0; i < count; ++i) { body(order[i], order[i] + 1, static_cast<int>(i) % kWorkers); }
    }

private:
    static constexpr int kWorkers = 3;
    Random random_{5};
};

/// The last element first.
class BackwardTasks final : public TaskSystem {
public:
    int workerCount() const override { return 2; }
    double startSeconds() const override { return 0; }
    void run(std::size_t count, std::size_t /*grain*/, FunctionRef<void(std::size_t, std::size_t, int)> body) override {
        for (std::size_t i = count; i > 0; --i) { body(i - 1, i, static_cast<int>(i % 2)); }
    }
};

/// All that may run a world in parallel, on threads and off.
struct Crowds {
    ThreadTasks one{1};
    ThreadTasks two{2};
    ThreadTasks three{3};
    ThreadTasks eight{8};
    ShuffledTasks shuffled;
    BackwardTasks backward;
    std::vector<TaskSystem*> all{&one, &two, &three, &eight, &shuffled, &backward};
};

}  // namespace swept::test
