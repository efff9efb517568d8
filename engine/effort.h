#pragma once

#include <cstdint>

#include "../solver/direct_solver.h"

namespace swept::inline SWEPT_PRECISION {

struct WorldState;

/// How the solver treats an island: into how many sub-steps it divides the step, and what it solves all at once instead
/// of by iteration. Islands of one class are one solve.
struct Effort {
    std::int8_t doublings = 0;  ///< of the sub-steps that the settings ask for; negative: halvings
    DirectScope direct = DirectScope::none;
    bool isSettled = false;  ///< contacts are right as they are (settled.h): held in one sub-step, not solved anew

    constexpr bool operator==(const Effort&) const = default;
};

/// Doublings go up to this many sub-steps, unless the settings ask for more themselves.
inline constexpr int kMostSubSteps = 64;

/// At least 1.
constexpr int subStepsFor(Effort effort, int subSteps) {
    if (effort.isSettled) { return 1; }
    if (effort.doublings >= 0) { return subSteps << effort.doublings; }
    const int halved = subSteps >> -effort.doublings;
    return halved > 1 ? halved : 1;
}

/// What decides about the effort of an island: sums over its members. Kept for its capacity.
struct IslandLoad {
    std::uint32_t bodies = 0;
    std::uint32_t contacts = 0;
    std::uint32_t joints = 0;
    Real lightest = 0;  ///< kg
    Real heaviest = 0;
    std::uint32_t plainJoints = 0;   ///< rigid, without springs, limits and motors
    bool isAnchored = false;         ///< a joint ties it to what is not dynamic
    bool hasLoop = false;            ///< joints between some of its bodies, and the ground, close one
    std::uint32_t longestChain = 0;  ///< joints that hang together without contacts
    Real lightestJointed = 0;        ///< kg, of the bodies that joints hold
    Real thinnest = 0;               ///< smallest extent, metres
    double lowest = 0;               ///< centre of mass against gravity, metres
    double highest = 0;
    Real fastest = 0;  ///< square of the largest speed of a centre of mass, m²/s²
    Effort effort{};
};

/// Gives every body that the solver moves the effort of its island, from the state alone.
void assignEfforts(WorldState& world, double dt);

}  // namespace swept::inline SWEPT_PRECISION
