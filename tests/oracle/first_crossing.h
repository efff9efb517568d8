#pragma once

#include <cstdint>

#include "moving_pair.h"

namespace swept::oracle {

enum class CrossingState : std::uint8_t {
    found,      ///< above the level before `lo`, at or below it at `hi`
    none,       ///< above the level on the whole interval
    undecided,  ///< above the level before `lo`; beyond, the budget ended before anything was proved (grazing)
};

struct Crossing {
    CrossingState state = CrossingState::undecided;
    double lo = 0;
    double hi = 0;
    int pieces = 0;  ///< time intervals looked at
};

struct CrossingSettings {
    double resolution = 0;  ///< `found` ends when hi − lo is no more than this; 1: with the first proof of a crossing
    int budget = 20'000;    ///< time intervals; grazing needs thousands, whatever has a proof at all far fewer
};

/// The first fraction of [from, to] at which the separation of the pair falls to the level, by branch and bound over
/// time: an interval is discarded when it is proved free, else halved; a fraction at which the separation is proved to
/// be at or below the level cuts off all that comes after it.
Crossing firstCrossing(const MovingPair& pair, double level, double from, double to, const CrossingSettings& settings);

}  // namespace swept::oracle
