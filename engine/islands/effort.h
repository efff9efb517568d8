#pragma once

#include <cstddef>
#include <cstdint>

#include "../../shapes/real.h"

namespace swept::inline SWEPT_PRECISION {

struct WorldState;

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
