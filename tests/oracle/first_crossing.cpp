#include "first_crossing.h"

#include <algorithm>
#include <array>

namespace swept::oracle {
namespace {

/// Whether [from, to] can be proved free along the axis guessed for its middle, at rest or turning with a body.
bool isFree(const MovingPair& pair, double level, double from, double to, double middle, const PlainSeparation& guess) {
    const double half = std::max(nextUp(to - middle), nextUp(middle - from));
    const MovingPair::Moment moment = pair.momentAt(middle);
    const auto isFreeAlong = [&](double spin) { return pair.staysAbove(level, moment, half, guess.axis, spin); };
    if (isFreeAlong(0)) { return true; }
    // The normal of an edge turns with it; without one, either body's turn may be what keeps the axis right.
    const double spinA = pair.spinA(middle);
    if (guess.owner != AxisOwner::b && spinA != 0 && isFreeAlong(spinA)) { return true; }
    const double spinB = pair.spinB(middle);
    return guess.owner != AxisOwner::a && spinB != 0 && isFreeAlong(spinB);
}

/// Whether the separation is proved to be at or below the level. @param guess  of that fraction
bool isCrossed(const MovingPair& pair, double level, double fraction, const PlainSeparation& guess) {
    return guess.core - pair.radii() <= level && pair.separationAt(fraction, guess).hi <= level;
}

/// Moves `hi` towards `lo` while that can be proved; rounding ends it.
void sharpen(const MovingPair& pair, double level, double resolution, Crossing& crossing) {
    while (crossing.hi - crossing.lo > resolution) {
        const double middle = crossing.lo + 0.5 * (crossing.hi - crossing.lo);
        if (!isCrossed(pair, level, middle, pair.guess(middle))) { return; }
        crossing.hi = middle;
    }
}

}  // namespace

Crossing firstCrossing(const MovingPair& pair, double level, double from, double to, const CrossingSettings& settings) {
    Crossing result{CrossingState::undecided, from, to, 0};
    if (isCrossed(pair, level, from, pair.guess(from))) { return {CrossingState::found, from, from, 1}; }
    if (isCrossed(pair, level, to, pair.guess(to))) { result.state = CrossingState::found; }
    double span = to - from;
    while (result.pieces < settings.budget && result.lo < result.hi) {
        if (result.state == CrossingState::found && result.hi - result.lo <= settings.resolution) { break; }
        const bool last = span >= result.hi - result.lo;
        const double end = last ? result.hi : result.lo + span;
        // As fine as doubles are, or as is asked for: to creep on by roundings would take the whole budget.
        const double finest = result.state == CrossingState::found ? 0.25 * settings.resolution : 0;
        if (!(end - result.lo > finest)) { break; }
        const double middle = result.lo + 0.5 * (end - result.lo);
        const PlainSeparation guess = pair.guess(middle);
        ++result.pieces;
        // Where the middle itself looks crossed, no proof is worth trying.
        if (guess.core - pair.radii() > level && isFree(pair, level, result.lo, end, middle, guess)) {
            result.lo = end;
            span *= 2;
            continue;
        }
        if (isCrossed(pair, level, middle, guess)) {
            result.state = CrossingState::found;
            result.hi = middle;
        }
        span = 0.5 * (end - result.lo);
    }
    if (result.state == CrossingState::found) { sharpen(pair, level, settings.resolution, result); }
    if (result.state == CrossingState::undecided && !(result.lo < to)) { result.state = CrossingState::none; }
    return result;
}

}  // namespace swept::oracle
