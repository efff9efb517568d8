#pragma once

#include <memory>

#include "task_system.h"

namespace swept {

/// The parallel loops of a world on oneTBB: the target `swept2d::tbb`, which is there when oneTBB was found at
/// configuration. It has an arena of its own, so that a game that uses oneTBB shares its threads without being slowed
/// by ours. Several worlds may use one at the same time, each stepped by a thread of its own.
class TbbTaskSystem final : public TaskSystem {
public:
    /// @param workers  threads at most, the calling one included; 0: as many as the machine has. oneTBB starts no more
    /// than that, unless its `global_control` says otherwise.
    explicit TbbTaskSystem(int workers = 0);
    ~TbbTaskSystem() override;

    int workerCount() const override;
    void run(std::size_t count, std::size_t grain,
             FunctionRef<void(std::size_t begin, std::size_t end, int worker)> body) override;

private:
    struct Arena;
    std::unique_ptr<Arena> arena_;
};

}  // namespace swept
