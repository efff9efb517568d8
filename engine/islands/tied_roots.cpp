#include "tied_roots.h"

#include <atomic>

namespace swept::inline SWEPT_PRECISION {
namespace {

/// Bodies per block of a parallel loop, which are asked for their islands alone.
constexpr std::size_t kRootGrain = 512;

}  // namespace

std::uint64_t findRoots(WorldState& world) {
    world.tiedRoots.resize(world.tied.size());
    if (world.tied.empty()) { return 0; }
    std::atomic<std::uint64_t> count = 0;
    world.loops->run(world.tied.size(), kRootGrain, [&world, &count](std::size_t begin, std::size_t end, int) {
        std::uint64_t some = 0;
        for (std::size_t i = begin; i < end; ++i) {
            const std::uint32_t root = world.islands.rootOf(world.tied[i]);
            world.tiedRoots[i] = root;
            some += root == world.tied[i] ? 1 : 0;
        }
        count.fetch_add(some, std::memory_order_relaxed);
    });
    world.islands.flatten(world.tied, world.tiedRoots);
    return count;
}

}  // namespace swept::inline SWEPT_PRECISION
