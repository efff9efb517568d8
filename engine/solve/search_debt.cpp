#include "search_debt.h"

#include <algorithm>

namespace swept::inline SWEPT_PRECISION {
namespace {

/// So many rounds of the search cost a step of debt. A pyramid of 1275 boxes that finds its first impulses owes 10, and
/// nothing after that; at most nine steps in a row are spent on rounds without end.
constexpr int kRoundsOfDebt = 16;
/// In a small web or a tower what is at rest needs some rounds in each sub-step, for ever; more of them cost a step of
/// debt for so many bodies that they were for. (A heap of 256 bodies that came to rest asked for 150 rounds, 10 ms,
/// fourteen times in a row, where a step that is iterated takes 0.15 ms.)
constexpr int kUsualRoundsOfSubStep = 6;
constexpr int kBodyRoundsOfDebt = 512;

}  // namespace

std::uint16_t searchDebtAfter(std::uint16_t debt, const SearchCost& cost) {
    const int unusual = std::max(cost.rounds - kUsualRoundsOfSubStep * cost.subSteps, 0);
    const auto ofSmall =
        static_cast<std::int64_t>(unusual) * static_cast<std::int64_t>(cost.bodies) / kBodyRoundsOfDebt;
    const std::int64_t owed = debt + (cost.isLarge ? cost.rounds / kRoundsOfDebt : ofSmall);
    // A step goes down from it before anybody asks.
    return cost.isSolved && owed < kMostDebt ? static_cast<std::uint16_t>(owed) : kMostDebt + 1;
}

}  // namespace swept::inline SWEPT_PRECISION
