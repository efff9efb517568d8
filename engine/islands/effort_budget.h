#pragma once

#include <cstdint>
#include <limits>

#include "../../shapes/real.h"
#include "../state/profile.h"
#include "effort.h"

/// Sub-steps from the errors that the user accepts (`WorldSettings::maxPenetration`, `maxJointError`).

namespace swept::inline SWEPT_PRECISION {

struct WorldState;

constexpr bool hasErrorBudget(const WorldSettings& settings) {
    constexpr Real kNone = std::numeric_limits<Real>::infinity();
    return settings.maxPenetration < kNone || settings.maxJointError < kNone;
}

/// Of a step that is not cut into parts. The springs of contacts and joints are as stiff as these sub-steps can sample:
/// with a budget their own, since what they give way is the error.
constexpr int standardSubSteps(const WorldSettings& settings, Effort effort) {
    const int usual = subStepsOf(settings);
    return hasErrorBudget(settings) ? subStepsFor(effort, usual) : usual;
}

/// A step is good that ends within this part of the budget: what is left is room for what comes in the next one.
inline constexpr Real kGoodBudgetRatio = Real(3) / 4;

/// What the budgets of an island are compared with, at the start of the step. Kept for its capacity.
struct IslandErrors {
    Real penetration = 0;  ///< the deepest, metres
    Real jointError = 0;   ///< the largest, metres
    Real blow = 0;         ///< how far the fastest blow of this step would go on in it, metres
    Real push = 0;         ///< how far the forces on a member would take it in this step, metres
    bool hasContacts = false;
    bool hasJoints = false;
    // Of the last solve (effort_trial.h).
    std::uint8_t tries = 0;     ///< that were taken back
    Real penetrationAfter = 0;  ///< metres
    Real jointErrorAfter = 0;
    Effort next{};  ///< to be solved with again; else that which it was solved with
    std::int8_t doublings = std::numeric_limits<std::int8_t>::lowest();  ///< largest of a member in the last step
};

/// Changes the sub-steps of the islands' efforts (`WorldState::islandLoads`) to what keeps the budgets, and counts what
/// is beyond them. @pre the errors are finite: `hasErrorBudget`
void keepErrorBudgets(WorldState& world, double dt);

}  // namespace swept::inline SWEPT_PRECISION
