#include "../contacts/contact_making.h"
#include "../contacts/new_pairs.h"
#include "step.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// New pairs per block of a parallel loop: each asks for two shapes and two bodies all over memory.
constexpr std::size_t kNewPairGrain = 32;

}  // namespace

void findPairs(WorldState& world) {
    const std::uint64_t testsBefore = world.broadphase->counters().boxTests;
    world.broadphase->pairs(world.newPairs, *world.loops);
    world.counters.boxTests = world.broadphase->counters().boxTests - testsBefore;
    std::vector<NewPair>& found = world.newPairKinds;
    found.resize(world.newPairs.size());
    world.loops->run(found.size(), kNewPairGrain, [&world, &found](std::size_t begin, std::size_t end, int) {
        for (std::size_t i = begin; i < end; ++i) {
            const ProxyPair& pair = world.newPairs[i];
            found[i] = newPairOf(world, shapeOf(world, pair.a), shapeOf(world, pair.b));
        }
    });
}

}  // namespace swept::inline SWEPT_PRECISION
