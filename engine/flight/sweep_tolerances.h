#pragma once

#include <algorithm>
#include <optional>

#include "../state/tolerances.h"
#include "../state/world_state.h"

/// How exactly sweeps meet what is in their way, and how far bodies may sink into it.

namespace swept::inline SWEPT_PRECISION {

/// Separation at which an impact is resolved, and how exactly it is met, metres.
double targetOf(const WorldState& world, const FlightObstacle& obstacle);
double toleranceOf(const WorldState& world, const FlightObstacle& obstacle);
/// The latter by the former.
inline double toleranceOf(const WorldState& world, double target) {
    const std::optional<Real>& wanted = world.settings.toiTolerance;
    return wanted ? std::min(static_cast<double>(*wanted), target / 2) : target / 4;
}
/// How far ground may be uneven that counts as flush, and how far a body may sag between two impacts of a contact that
/// carries it, metres.
inline Real slopOf(const Shape& own, const Shape& other) { return kTargetRatio * extentOfPair(own, other); }
inline Real slopOf(const WorldState& world, const FlightObstacle& obstacle) {
    return slopOf(world.shapes[obstacle.own], world.shapes[obstacle.other]);
}
/// Largest error of a manifold's separation (`Real`) against that of the sweeps (double), metres.
inline Real roundingOf(const Shape& own, const Shape& other) {
    return std::min(kFlightRoundings * kEpsilon * (own.size + other.size), slopOf(own, other));
}
inline Real roundingOf(const WorldState& world, const FlightObstacle& obstacle) {
    return roundingOf(world.shapes[obstacle.own], world.shapes[obstacle.other]);
}
/// Separation up to which what the sweeps met shows up in a manifold, metres.
Real reachOf(const WorldState& world, const FlightObstacle& obstacle);
/// Separation at which what has this separation, and was dealt with, counts as met again, metres.
double levelInContact(const WorldState& world, const FlightObstacle& obstacle, double separation);

/// How far a body may sink into what the solver holds it off, metres.
inline double slackOf(const Shape& own, const Shape& other) {
    return static_cast<double>(slopOf(own, other) * (kSlackRatio / kTargetRatio));
}
inline double slackOf(const WorldState& world, const FlightObstacle& obstacle) {
    return slackOf(world.shapes[obstacle.own], world.shapes[obstacle.other]);
}

/// How far a body may sink into what it just met before that counts as met again, in slops.
inline constexpr Real kChatterSlops = Real(1) / 8;
/// How far a body sags between two impacts of what carries it, in slops.
inline constexpr double kSagSlops = 0.5;
/// What a bullet rides on: see `rideSag`.
inline constexpr double kMostSagSlops = 64;
inline constexpr int kImpactsPerDoubling = 4;

/// How far a bullet and what it rides on may sink into each other between two impacts, metres. Ever farther in one
/// step, up to a sixteenth of the extent: something that whirls then gets on by three radians in 64 impacts, however
/// fast.
/// @param impacts  that there were in this step
double rideSag(const WorldState& world, const FlightObstacle& obstacle, int impacts);

}  // namespace swept::inline SWEPT_PRECISION
