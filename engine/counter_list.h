#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "counters.h"

namespace swept {

/// What a counter of several solves, or of several steps, is.
enum class CounterSum : std::uint8_t {
    all,         ///< of all of them together
    mostOfStep,  ///< the most of any solve; of several steps the sum of that
    most,        ///< the most of any
};

struct CounterEntry {
    const char* name = "";  ///< in reports
    std::uint64_t StepCounters::*member = nullptr;
    CounterSum sum = CounterSum::all;
};

/// Every counter: the one list by which they are added up and printed.
inline constexpr auto kCounters = std::to_array<CounterEntry>({
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
    {"colours", &StepCounters::colours, CounterSum::mostOfStep},
    {"subSteps", &StepCounters::subSteps},
    {"bounceRounds", &StepCounters::bounceRounds},
    {"bodySubSteps", &StepCounters::bodySubSteps},
    {"effortClasses", &StepCounters::effortClasses},
    {"mostSubSteps", &StepCounters::mostSubSteps, CounterSum::most},
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
static_assert(sizeof(StepCounters) == kCounters.size() * sizeof(std::uint64_t), "a counter is missing in the list");

/// Adds what a part of a step counted to the whole of it.
constexpr void addPart(StepCounters& step, const StepCounters& part) {
    const auto add = [&step, &part](const CounterEntry& counter) {
        std::uint64_t& total = step.*counter.member;
        const std::uint64_t more = part.*counter.member;
        total = counter.sum == CounterSum::all ? total + more : (std::max)(total, more);
    };
    // All in a row, without a loop: small steps have several parts.
    [&add]<std::size_t... kIndex>(std::index_sequence<kIndex...>) { (add(std::get<kIndex>(kCounters)), ...); }
    (std::make_index_sequence<kCounters.size()>());
}

/// Adds what a step counted to a sum of steps.
constexpr void addStep(StepCounters& sum, const StepCounters& step) {
    for (const CounterEntry& counter : kCounters) {
        std::uint64_t& total = sum.*counter.member;
        const std::uint64_t more = step.*counter.member;
        total = counter.sum == CounterSum::most ? (std::max)(total, more) : total + more;
    }
}

}  // namespace swept
