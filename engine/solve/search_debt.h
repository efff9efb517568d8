#pragma once

#include <cstddef>
#include <cstdint>

#include "../../shapes/real.h"

namespace swept::inline SWEPT_PRECISION {

/// What it cost to solve the contacts of a class all at once.
struct SearchCost {
    int rounds = 0;
    int subSteps = 0;
    std::size_t bodies = 0;
    bool isLarge = false;
    bool isSolved = false;  ///< in vain else
};

/// The most that a body may owe, but for one step more: as after a search in vain.
inline constexpr std::uint16_t kMostDebt = 96;

/// What a body owes after such a search. Debts go down by one in each step; beyond a limit, as after a search in vain,
/// the island is iterated: a web until it owes nothing, a tower for some steps, unless it has masses far apart.
std::uint16_t searchDebtAfter(std::uint16_t debt, const SearchCost& cost);

}  // namespace swept::inline SWEPT_PRECISION
