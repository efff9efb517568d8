#include "sweep_tolerances.h"

#include <cmath>
#include <limits>

namespace swept::inline SWEPT_PRECISION {
namespace {

/// What is sunk in deeper than the slack gets on by this part of the usual tolerance alone: it may be pressed step
/// after step, and each may have 64 parts.
constexpr double kSunkTolerance = 1.0 / 1024;

}  // namespace

double targetOf(const WorldState& world, const FlightObstacle& obstacle) {
    const Shape& own = world.shapes[obstacle.own];
    const Shape& other = world.shapes[obstacle.other];
    const auto extent = static_cast<double>(extentOfPair(own, other));
    const double unit = std::max(static_cast<double>(kFlightRoundings) * std::numeric_limits<double>::epsilon(),
                                 static_cast<double>(kEpsilon));
    return std::clamp(unit * static_cast<double>(own.size + other.size),
                      static_cast<double>(kFlightTargetRatio) * extent, static_cast<double>(kTargetRatio) * extent);
}

Real reachOf(const WorldState& world, const FlightObstacle& obstacle) {
    const double met = targetOf(world, obstacle) + 3 * toleranceOf(world, obstacle);
    return static_cast<Real>(met) + roundingOf(world, obstacle);
}

double levelInContact(const WorldState& world, const FlightObstacle& obstacle, double separation) {
    if (obstacle.isSunkInto) { return separation - 2 * toleranceOf(world, obstacle); }
    // What rounding, or a corner that turns in, leaves of an approach that was dealt with must not count as an impact
    // again and again: bars that come to rest on uneven ground lost 1.7 % of their time by it.
    const Real sink = std::max(roundingOf(world, obstacle), kChatterSlops * slopOf(world, obstacle));
    return separation - 2 * toleranceOf(world, obstacle) - static_cast<double>(sink);
}

double toleranceOf(const WorldState& world, const FlightObstacle& obstacle) {
    return (obstacle.isSunkInto ? kSunkTolerance : 1) * toleranceOf(world, targetOf(world, obstacle));
}

double rideSag(const WorldState& world, const FlightObstacle& obstacle, int impacts) {
    const auto slop = static_cast<double>(slopOf(world, obstacle));
    return slop * std::min(std::ldexp(kSagSlops, impacts / kImpactsPerDoubling), kMostSagSlops);
}

}  // namespace swept::inline SWEPT_PRECISION
