#pragma once

#include <benchmark/benchmark.h>

#include <chrono>

#include "kernels.h"

namespace swept::bench {

/// Destroys some of a pile between steps, which alone is measured, and makes them again.
/// @param destroy, make  called with the place of a body in the pile
template <class Step, class Destroy, class Make>
void measureDestruction(benchmark::State& state, int count, const Step& step, const Destroy& destroy,
                        const Make& make) {
    int next = 0;
    for ([[maybe_unused]] auto _ : state) {
        step();
        const auto start = std::chrono::steady_clock::now();
        for (int i = 0; i < kEdited; ++i) { destroy(editedOf(next + i, count)); }
        state.SetIterationTime(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
        for (int i = 0; i < kEdited; ++i) { make(editedOf(next++, count)); }
    }
    state.counters["each"] =
        benchmark::Counter(kEdited, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

}  // namespace swept::bench
