#pragma once

#include "../../shapes/real.h"

/// Sub-steps from the errors that the user accepts (`WorldSettings::maxPenetration`, `maxJointError`).

namespace swept::inline SWEPT_PRECISION {

struct WorldState;

/// A step is good that ends within this part of the budget: what is left is room for what comes in the next one.
inline constexpr Real kGoodBudgetRatio = Real(3) / 4;

/// Changes the sub-steps of the islands' efforts (`WorldState::islandLoads`) to what keeps the budgets, and counts what
/// is beyond them. @pre the errors are finite: `hasErrorBudget`
void keepErrorBudgets(WorldState& world, double dt);

}  // namespace swept::inline SWEPT_PRECISION
