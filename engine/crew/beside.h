#pragma once

#include <algorithm>
#include <cstddef>

#include "../../shapes/task_system.h"

namespace swept {

/// Slices of a loop that goes on beside something else, at most: so many that who does that gets fewer of them.
inline constexpr std::size_t kBesideSlices = 96;

/// A loop beside something that one worker must do alone, in its order: that takes as long as half of both then, unless
/// it is the longer one. Neither may need what the other one writes.
/// @param alone  what is done by one worker; runs no loops itself
/// @param grain  rounds that are worth handing over: of fewer all are done by who does the other thing, unless handing
/// over costs nothing
/// @param body  called with ranges that cover [0, count) exactly once
inline void runBeside(TaskSystem& loops, FunctionRef<void()> alone, std::size_t count, std::size_t grain,
                      FunctionRef<void(std::size_t begin, std::size_t end)> body) {
    const bool isAtOnce = loops.startSeconds() < TaskSystem::kAtOnce;
    const std::size_t slices = std::min(isAtOnce ? count : count / grain, kBesideSlices);
    if (loops.workerCount() <= 1 || slices == 0) {
        alone();
        if (count > 0) { body(0, count); }
        return;
    }
    loops.run(slices + 1, 1, [&](std::size_t begin, std::size_t end, int) {
        if (begin == 0) {
            alone();
            ++begin;
        }
        const std::size_t first = count * (begin - 1) / slices;
        const std::size_t last = count * (end - 1) / slices;
        if (first < last) { body(first, last); }
    });
}

}  // namespace swept
