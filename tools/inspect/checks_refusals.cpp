#include <string>

#include <swept/samples/runner.h>

#include "checks.h"

namespace swept {
namespace {

/// "/bodies/1/angle: is out of range: …"; empty: the engine takes the scene.
std::string refusalOf(const SceneDescription& scene, Precision precision) {
    RunnerOptions options;
    options.precision = precision;
    std::string refusal;
    (void)makeRunner(scene, options, refusal);
    return refusal;
}

Finding findingOf(const std::string& where, const std::string& refusal, const std::string& remedy) {
    const std::size_t colon = refusal.find(": ");
    return {Severity::warning, "refused", refusal.substr(0, colon),
            "swept run refuses this " + where + ": " + refusal.substr(colon + 2), remedy};
}

}  // namespace

bool checkRefusals(const SceneDescription& scene, std::vector<Finding>& findings) {
    const std::string single = refusalOf(scene, Precision::f32);
    const std::string both = refusalOf(scene, Precision::f64);
    if (!both.empty()) {
        findings.push_back(
            findingOf(single.empty() ? "in f64" : "in both precisions", both, "numbers within the limits"));
    } else if (!single.empty()) {
        findings.push_back(
            findingOf("in f32, the default", single, "--precision f64, or numbers within the limits of f32"));
    }
    return both.empty() && !single.empty();
}

}  // namespace swept
