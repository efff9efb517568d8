#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "../../shapes/raw_vector.h"
#include "../../shapes/task_system.h"

namespace swept {

/// Of a list, in its order, what something is true of: asked by any worker, which is what it costs where bodies have to
/// be fetched for it, and taken by one.
/// @param grain  items that are worth handing over
/// @param answers  scratch
/// @param isMeant  called with each item once, in any order, at the same time; must not depend on what `take` changes
template <class IsMeant, class Take>
void forEachMeant(TaskSystem& loops, std::span<const std::uint32_t> items, std::size_t grain,
                  RawVector<std::uint8_t>& answers, const IsMeant& isMeant, const Take& take) {
    if (loops.workerCount() <= 1 || items.size() <= grain) {
        for (const std::uint32_t item : items) {
            if (isMeant(item)) { take(item); }
        }
        return;
    }
    answers.resize(items.size());
    loops.run(items.size(), grain, [&](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i) { answers[i] = isMeant(items[i]) ? 1 : 0; }
    });
    for (std::size_t i = 0; i < items.size(); ++i) {
        if (answers[i] != 0) { take(items[i]); }
    }
}

}  // namespace swept
