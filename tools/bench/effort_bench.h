#pragma once

#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

#include <swept/samples/runner.h>

#include "effort_scenes.h"

/// Effort from an error budget beside fixed numbers of sub-steps.

namespace swept::bench {

/// What a run came to.
struct EffortRun {
    double penetration = 0;   ///< deepest, metres
    double jointError = 0;    ///< largest, metres
    double missed = 0;        ///< contacts and joints beyond their budget, over all steps, as the engine reports it
    double bodiesAgain = 0;   ///< solved again within a step
    double bodySubSteps = 0;  ///< the cost, by count
    double error = 0;         ///< the larger one of both errors as a part of its budget: up to 1 it was kept
};

/// Budgets of a scene against the smallest fixed number of sub-steps that keeps them.
struct EffortRow {
    std::string scene;
    Precision precision = Precision::f32;
    double maxPenetration = 0;  ///< metres; 0: none
    double maxJointError = 0;
    EffortRun chosen;
    int fixedSubSteps = 0;  ///< 0: none up to 64 keeps them
    EffortRun fixed;
    double chosenSeconds = 0;  ///< of the steps of a run, the fastest of the repeats
    double fixedSeconds = 0;
};

struct EffortBenchSettings {
    int repeats = 3;    ///< runs that are timed, in turns; 0: none
    double budget = 1;  ///< times those of the scenes
};

std::vector<EffortRow> benchEffort(const EffortBenchSettings& settings,
                                   const std::function<void(const EffortRow&)>& watch);
/// One scene of it.
EffortRow effortRow(const EffortScene& scene, Precision precision, const EffortBenchSettings& settings);

void writeEffortTable(std::ostream& out, const std::vector<EffortRow>& rows);
void writeEffortCsv(std::ostream& csv, const std::vector<EffortRow>& rows);

}  // namespace swept::bench
