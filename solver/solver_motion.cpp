#include <atomic>
#include <span>

#include "free_motion.h"
#include "halves.h"
#include "moving_limits.h"
#include "solver.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Bodies per part of a parallel loop.
constexpr std::size_t kBodyGrain = 128;

}  // namespace

/// Bodies by slot less one; the first half of them is that of contacts (`ContactBlocks`).
void Solver::forBodies(const SolverBatch& batch, FunctionRef<void(std::size_t begin, std::size_t end)> body) {
    const std::size_t count = batch.states.size() - 1;
    runInHalves(*loops_, count / 2, count, kBodyGrain, body);
}

/// @return bodies whose speed was cut
int Solver::integrateVelocities(SolverBatch& batch, Real maxSpeed) {
    std::atomic<int> limited = 0;
    forBodies(batch, [&](std::size_t begin, std::size_t end) {
        const int some = swept::integrateVelocities(batch, maxSpeed, begin + 1, end + 1);
        if (some > 0) { limited.fetch_add(some, std::memory_order_relaxed); }
    });
    return limited;
}

/// Instead of a warm start, in sub-steps after the first one: directions and arms of contacts are held for the whole
/// step, so what the impulses of the sub-step before did to a body is the difference that they made to its speeds. Only
/// of contacts, and where nothing else changed these.
int Solver::integrateAndRepeat(SolverBatch& batch, Real maxSpeed, bool isFirst) {
    std::atomic<int> limited = 0;
    free_.resize(batch.states.size());
    forBodies(batch, [&](std::size_t begin, std::size_t end) {
        const int some = swept::integrateAndRepeat(batch, maxSpeed, isFirst, free_, begin + 1, end + 1);
        if (some > 0) { limited.fetch_add(some, std::memory_order_relaxed); }
    });
    return limited;
}

void Solver::integratePositions(SolverBatch& batch, Real h) {
    forBodies(batch, [&](std::size_t begin, std::size_t end) {
        move_(std::span(batch.states).subspan(begin + 1, end - begin), h);
    });
    if (batch.mayGlide) { moveLimits(batch, h); }
}

}  // namespace swept::inline SWEPT_PRECISION
