#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include <swept/samples/runner.h>

#include "accuracy_case.h"

namespace swept::accuracy {

/// An engine with the settings it is judged by.
struct Contestant {
    std::string name;  ///< "accurate f32", "Box2D 2.4.1" …
    /// @return null, with a reason, when the engine cannot run this scene.
    std::function<std::unique_ptr<Runner>(const SceneDescription&, std::string& error)> make;
};

/// All that are there: ours, and the reference engines that were found when this was built.
std::vector<Contestant> allContestants();

struct MeasuredValue {
    std::string name;
    std::string unit;
    double value = 0;
};

/// One engine on one case.
struct Row {
    std::string group;
    std::string scene;
    std::string contestant;
    std::vector<MeasuredValue> values;  ///< empty when the run did not end
    std::string verdict;      ///< empty when all went well; "collapsed", "escaped", "not finite", "-" when refused
    std::string refusal;      ///< why the engine could not even begin
    double hertz = 0;         ///< steps a second
    int subSteps = 0;         ///< 0: the contestant's own
    double microseconds = 0;  ///< processor time per simulated second; 0 when it did not run
};

Row measure(const Case& c, const Contestant& contestant);

/// The same case with other steps: `hertz` steps a second, so many sub-steps each; the simulated time stays.
Case refined(const Case& c, double hertz, int subSteps);

/// Cases of the trade between error and cost: one measure of each, by name.
std::vector<Case> tradeCases();

}  // namespace swept::accuracy
