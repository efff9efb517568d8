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
    bool isCrowd = false;    ///< jostling, not carrying: one pass of relaxation after each solve does
    bool isLarge = false;    ///< a web of more than `kSmallWebBodies`: searched with more patience, taken back in vain
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

/// After each solve.
constexpr int relaxPassesFor(Effort effort, int relaxPasses) {
    return effort.isCrowd && relaxPasses > 1 ? 1 : relaxPasses;
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
    Real fastest = 0;          ///< square of the largest speed of a centre of mass, m²/s²
    std::uint32_t moving = 0;  ///< bodies on the move: fast for their size
    Real heaviestLoose = 0;    ///< kg, of the bodies that no joint holds
    std::uint32_t driven = 0;  ///< joints with a motor or a spring
    std::uint32_t debt = 0;    ///< largest `Body::searchDebt`
    bool staysPut = true;      ///< each body was solved all at once in the last step, or does not move at all
    Effort effort{};
};

/// What a body adds to the load of its island.
struct BodyLoad {
    double height = 0;      ///< centre of mass against gravity, metres
    Real mass = 0;          ///< kg
    Real extent = 0;        ///< metres
    Real speedSquared = 0;  ///< m²/s²
    std::uint16_t debt = 0;
    bool isMoving = false;
    bool staysPut = false;
    bool isJointed = false;
};

/// Contacts that close loops are solved all at once in islands of so many bodies, as long as they are at rest. Larger
/// ones, up to `kMostWebBodies`, have to begin at rest, or to have been solved so in the step before, and remember what
/// that cost: a search for what presses and sticks that does not end must not stop the world.
inline constexpr std::uint32_t kSmallWebBodies = 256;
inline constexpr std::uint32_t kMostWebBodies = 2048;

/// What a body owes after so many rounds of a search in its large island. Debts go down by one in each step; beyond a
/// limit, as after a search in vain, the island is iterated.
std::uint16_t searchDebtAfter(std::uint16_t debt, int rounds, bool isSolved);

/// Gives every body that the solver moves the effort of its island, from the state alone.
void assignEfforts(WorldState& world, double dt);

}  // namespace swept::inline SWEPT_PRECISION
