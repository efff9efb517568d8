#pragma once

#include <memory>

#include <swept/engine/task_system.h>

namespace swept {

/// More threads than any machine has: the largest number that commands take.
inline constexpr int kMostThreads = 4096;

/// A task system on so many threads, the calling one included.
/// @return null for one thread, and where the tools were built without oneTBB: worlds then run on the calling thread.
std::unique_ptr<TaskSystem> makeTaskSystem(int threads);

}  // namespace swept
