#pragma once

#include <cstddef>
#include <cstdint>

#include "../state/flight_work.h"

namespace swept::inline SWEPT_PRECISION {

/// How much a worker's flights have left of a step, but for the bodies themselves: what a try that is given up leaves
/// is cut off again.
struct FlightTraces {
    std::size_t events = 0;
    std::size_t poses = 0;
    std::size_t losses = 0;
    std::size_t crossed = 0;
    std::uint64_t impacts = 0;
    std::uint64_t speedsLimited = 0;
};

inline FlightTraces tracesOf(const FlightScratch& scratch) {
    return {.events = scratch.events.size(),
            .poses = scratch.impactPoses.size(),
            .losses = scratch.lostTime.size(),
            .crossed = scratch.chains.crossed.size(),
            .impacts = scratch.counters.impacts,
            .speedsLimited = scratch.counters.speedsLimited};
}

/// @pre it has no fewer
template <class Items>
void cutTo(Items& items, std::size_t size) {
    items.erase(items.begin() + static_cast<std::ptrdiff_t>(size), items.end());
}

inline void cutTo(FlightScratch& scratch, const FlightTraces& before) {
    cutTo(scratch.events, before.events);
    cutTo(scratch.impactPoses, before.poses);
    cutTo(scratch.lostTime, before.losses);
    cutTo(scratch.chains.crossed, before.crossed);
    scratch.counters.impacts = before.impacts;
    scratch.counters.speedsLimited = before.speedsLimited;
}

}  // namespace swept::inline SWEPT_PRECISION
