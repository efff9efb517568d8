#pragma once

#include <cstdint>
#include <cstring>
#include <type_traits>

#include "../../solver/direct/direct_scope.h"

namespace swept::inline SWEPT_PRECISION {

struct WorldState;

/// How the solver treats an island: into how many sub-steps it divides the step, and what it solves all at once instead
/// of by iteration. Islands of one class are one solve.
struct Effort {
    std::int8_t doublings = 0;  ///< of the sub-steps that the settings ask for; negative: halvings
    DirectScope direct = DirectScope::none;
    bool isCrowd = false;  ///< jostling, not carrying: one pass of relaxation after each solve does
    bool isLarge = false;  ///< a web of more than `kSmallWebBodies`: searched with more patience
    /// Which of those that were searched in vain in this step, from 1 on: a class of its own, since all others may be
    /// solved by then; 0: none.
    std::uint8_t retry = 0;
    bool isSettled = false;  ///< contacts are right as they are (settled.h): held in one sub-step, not solved anew

    /// At once: a step compares thousands.
    bool operator==(const Effort& other) const { return std::memcmp(this, &other, sizeof(Effort)) == 0; }
};
static_assert(std::has_unique_object_representations_v<Effort>);

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

/// Contacts that close loops are solved all at once in islands of so many bodies, as long as they are at rest. Larger
/// ones, up to `kMostWebBodies`, have to begin at rest, or to have been solved so in the step before, and remember what
/// that cost: a search for what presses and sticks that does not end must not stop the world.
inline constexpr std::uint32_t kSmallWebBodies = 256;
inline constexpr std::uint32_t kMostWebBodies = 2048;

/// What it cost to solve the contacts of a class all at once.
struct SearchCost {
    int rounds = 0;
    int subSteps = 0;
    std::size_t bodies = 0;
    bool isLarge = false;
    bool isSolved = false;  ///< in vain else
};

/// What a body owes after such a search. Debts go down by one in each step; beyond a limit, as after a search in vain,
/// the island is iterated: a web until it owes nothing, a tower for some steps, unless it has masses far apart.
std::uint16_t searchDebtAfter(std::uint16_t debt, const SearchCost& cost);

/// Gives every body that the solver moves the effort of its island, from the state alone.
void assignEfforts(WorldState& world, double dt);

}  // namespace swept::inline SWEPT_PRECISION
