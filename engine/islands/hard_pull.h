#pragma once

#include "../state/profile.h"
#include "../state/tolerances.h"
#include "../state/world_state.h"
#include "effort.h"
#include "effort_budget.h"

/// What lies on something alone, and is pulled so hard that it would be fast from rest within a step: thin for its
/// gravity and step (a coin of 1 cm at 60 Hz), or drawn by a force. Contacts carry it like all else, as far as
/// sub-steps make the pull small. They hold friction and rolling resistance, and it can fall asleep. What is pulled
/// harder flies from impact to impact: it sinks in less, but falls a little way along a slope before each, and creeps.

namespace swept::inline SWEPT_PRECISION {

inline bool isPulledHard(const WorldState& world, const Body& body, Real dt) {
    return length(accelerationOf(world, body)) * square(dt) > kFastRatio * body.extent;
}

/// How far something is pulled in a sub-step, from rest, in extents, if contacts carry it: at most. They give way by
/// two to three and a half times as much; nothing fast gets deeper than a quarter of its extent. (With four times as
/// much, balls left a segment on its other side in profile `accurate`.)
inline constexpr Real kCarriedRatio = Real(1) / 16;

/// Likewise within a step. In profile `accurate` a body on its own has as many sub-steps as it needs; springs are those
/// of the usual ones.
constexpr Real mostCarried(const WorldSettings& settings) {
    const int usual = subStepsOf(settings);
    int most = usual;
    if (settings.profile == Profile::accurate && !hasErrorBudget(settings)) {
        while (2 * most <= kMostSubSteps) { most *= 2; }
    }
    return kCarriedRatio * static_cast<Real>(usual) * static_cast<Real>(most);
}

/// @param pull  m/s², towards the contact
inline bool isCarried(const WorldState& world, const Body& body, Real pull, Real dt) {
    const Real way = pull * square(dt);
    return pull > 0 && (way <= kFastRatio * body.extent || way <= mostCarried(world.settings) * body.extent);
}

}  // namespace swept::inline SWEPT_PRECISION
