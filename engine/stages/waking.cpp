#include "waking.h"

#include <algorithm>
#include <functional>

#include "../bodies/awake.h"
#include "../contacts/noticing.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

/// What is awake wakes what it touches, layer by layer: in each the pairs are looked at in their order, and what woke
/// in it counts at once. After the first layer that is due only of pairs that are new, and of those of what woke since
/// both slept: a row of sleepers that were put to sleep one by one has as many layers as bodies.
class WakingLayers {
public:
    /// @param from  place in `awake` of the first that woke
    WakingLayers(WorldState& world, std::size_t from) : world_(world), pairs_(world.sleepingPairs), noted_(from) {
        pairs_.firsts.resize(world.bodies.slotCount(), kNoIndex);
    }
    WakingLayers(const WakingLayers&) = delete;
    WakingLayers& operator=(const WakingLayers&) = delete;
    ~WakingLayers() {
        for (const SleepingPairs::Link& link : pairs_.links) {
            const TouchingPair& pair = world_.touching[link.pair];
            pairs_.firsts[pair.bodyA] = pairs_.firsts[pair.bodyB] = kNoIndex;
        }
        pairs_.links.clear();
        pairs_.due.clear();
        pairs_.dueNext.clear();
    }

    void wakeNext() {
        noteWoken(0);
        while (!pairs_.due.empty()) {
            std::pop_heap(pairs_.due.begin(), pairs_.due.end(), std::greater());
            const std::uint32_t place = pairs_.due.back();
            pairs_.due.pop_back();
            look(place);
        }
        while (seen_ < world_.touching.size()) { look(seen_++); }
        pairs_.due.swap(pairs_.dueNext);
        std::make_heap(pairs_.due.begin(), pairs_.due.end(), std::greater());
    }

private:
    void look(std::uint32_t place) {
        const TouchingPair& pair = world_.touching[place];
        if (!pair.areDynamic()) { return; }
        const bool isAwakeA = world_.bodies[pair.bodyA].awake;
        const bool isAwakeB = world_.bodies[pair.bodyB].awake;
        if (isAwakeA != isAwakeB) {
            wake(world_, isAwakeA ? pair.bodyB : pair.bodyA);
            noteWoken(place + 1);
        } else if (!isAwakeA) {
            link(pair.bodyA, place);
            link(pair.bodyB, place);
        }
    }

    void link(std::uint32_t body, std::uint32_t place) {
        pairs_.links.push_back({place, pairs_.firsts[body]});
        pairs_.firsts[body] = static_cast<std::uint32_t>(pairs_.links.size() - 1);
    }

    /// @param next  the place up to which pairs were looked at in this layer
    void noteWoken(std::uint32_t next) {
        for (; noted_ < world_.awake.size(); ++noted_) {
            const std::uint32_t slot = world_.awake[noted_];
            for (std::uint32_t i = pairs_.firsts[slot]; i != kNoIndex; i = pairs_.links[i].next) {
                const std::uint32_t place = pairs_.links[i].pair;
                if (place < next) {
                    pairs_.dueNext.push_back(place);
                } else {
                    pairs_.due.push_back(place);
                    std::push_heap(pairs_.due.begin(), pairs_.due.end(), std::greater());
                }
            }
        }
    }

    WorldState& world_;
    SleepingPairs& pairs_;
    std::size_t noted_;       ///< place in `awake`: of those before the pairs are due
    std::uint32_t seen_ = 0;  ///< so many pairs were looked at
};

}  // namespace

void wakeAcrossJoints(WorldState& world, std::size_t from) {
    for (std::size_t i = from; i < world.awake.size(); ++i) {  // grows as it goes
        const std::uint32_t slot = world.awake[i];
        if (!disturbs(world, slot)) { continue; }
        for (const std::uint32_t index : world.bodies[slot].joints) {
            const Joint& joint = world.joints[index];
            if (!joint.holds()) { continue; }
            for (const std::uint32_t other : joint.allBodies()) { wake(world, other); }
        }
    }
}

void wakeOnward(WorldState& world, std::size_t from) {
    if (from >= world.awake.size() || !anyAsleep(world)) { return; }
    WakingLayers layers(world, from);
    while (from < world.awake.size() && anyAsleep(world)) {
        const std::size_t before = world.awake.size();
        if (world.joints.size() > 0) { wakeAcrossJoints(world, from); }
        if (!world.parked.woken.empty()) { listUnparked(world); }
        layers.wakeNext();
        from = before;
    }
}

}  // namespace swept::inline SWEPT_PRECISION
