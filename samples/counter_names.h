#pragma once

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "../engine/counters.h"
#include "frame.h"

namespace swept {

/// Every counter with its name in reports: the one list that sums and prints them.
inline constexpr auto kCounterNames = std::to_array<std::pair<const char*, std::uint64_t StepCounters::*>>({
    {"awakeBodies", &StepCounters::awakeBodies},
    {"freeBodies", &StepCounters::freeBodies},
    {"solvedBodies", &StepCounters::solvedBodies},
    {"flyers", &StepCounters::flyers},
    {"clashes", &StepCounters::clashes},
    {"pairsFound", &StepCounters::pairsFound},
    {"boxTests", &StepCounters::boxTests},
    {"contacts", &StepCounters::contacts},
    {"manifolds", &StepCounters::manifolds},
    {"touching", &StepCounters::touching},
    {"constraints", &StepCounters::constraints},
    {"colours", &StepCounters::colours},
    {"subSteps", &StepCounters::subSteps},
    {"bounceRounds", &StepCounters::bounceRounds},
    {"bodySubSteps", &StepCounters::bodySubSteps},
    {"effortClasses", &StepCounters::effortClasses},
    {"mostSubSteps", &StepCounters::mostSubSteps},
    {"bodiesAgain", &StepCounters::bodiesAgain},
    {"directBodies", &StepCounters::directBodies},
    {"settledBodies", &StepCounters::settledBodies},
    {"factorisations", &StepCounters::factorisations},
    {"directRounds", &StepCounters::directRounds},
    {"directGivenUp", &StepCounters::directGivenUp},
    {"overPenetration", &StepCounters::overPenetration},
    {"overJointError", &StepCounters::overJointError},
    {"overLostTime", &StepCounters::overLostTime},
    {"islands", &StepCounters::islands},
    {"sweeps", &StepCounters::sweeps},
    {"toiCalls", &StepCounters::toiCalls},
    {"toiIterations", &StepCounters::toiIterations},
    {"sensorSweeps", &StepCounters::sensorSweeps},
    {"impacts", &StepCounters::impacts},
    {"aheadContacts", &StepCounters::aheadContacts},
    {"speedsLimited", &StepCounters::speedsLimited},
    {"speedsCapped", &StepCounters::speedsCapped},
    {"fellAsleep", &StepCounters::fellAsleep},
    {"wokeUp", &StepCounters::wokeUp},
    {"putBack", &StepCounters::putBack},
    {"proxiesMoved", &StepCounters::proxiesMoved},
});
static_assert(sizeof(StepCounters) == kCounterNames.size() * sizeof(std::uint64_t), "a counter has no name");

/// Of what is itself the most of something the larger number stays.
inline void addCounters(StepCounters& sums, const StepCounters& step) {
    for (const auto& [name, member] : kCounterNames) {
        const bool isMost = member == &StepCounters::mostSubSteps;
        sums.*member = isMost ? std::max(sums.*member, step.*member) : sums.*member + step.*member;
    }
}

inline std::vector<NamedNumber> namedCounters(const StepCounters& counters) {
    std::vector<NamedNumber> named;
    for (const auto& [name, member] : kCounterNames) { named.push_back({name, static_cast<double>(counters.*member)}); }
    return named;
}

}  // namespace swept
