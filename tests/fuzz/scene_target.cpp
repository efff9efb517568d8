#include <memory>
#include <string>
#include <string_view>

#include <swept/samples/runner.h>
#include <swept/samples/scene_reader.h>
#include <swept/samples/world_runners.h>
#include <swept/tools/writers/finite_state.h>

#include "fuzz_targets.h"

namespace swept::test {
namespace {

using MakeRunner = std::unique_ptr<Runner> (*)(const SceneDescription&, const RunnerOptions&, std::string&);

constexpr int kSteps = 3;
// Beyond this a few steps take seconds, which is no crash but keeps the fuzzer from looking at anything else.
constexpr std::size_t kMostBodies = 30;
constexpr int kMostSubSteps = 64;

void runBriefly(const SceneDescription& scene, MakeRunner makeRunner) {
    std::string error;
    const auto runner = makeRunner(scene, {.collectEvents = true, .measure = true}, error);
    if (!runner) {
        demand(!error.empty(), "an engine that refuses a scene says why");
        return;
    }
    Frame frame;
    for (int i = 0; i < kSteps; ++i) {
        runner->step();
        runner->read(frame, true);
        demand(!firstNotFinite(frame), "a scene that validates runs to finite states");
    }
}

}  // namespace

void fuzzScene(Bytes text) {
    const std::string_view view(reinterpret_cast<const char*>(text.data()), text.size());
    const SceneResult result = readScene(view, "fuzz");
    if (!result.scene) {
        demand(!result.error.reason.empty(), "an error says why");
        return;
    }
    demand(!validateScene(*result.scene), "what was read validates");
    const SceneResult again = readScene(writeScene(*result.scene), "again");
    demand(again.scene.has_value() && *again.scene == *result.scene, "what was written reads back the same");
    if (result.scene->bodies.size() > kMostBodies || result.scene->settings.subSteps.value_or(0) > kMostSubSteps) {
        return;
    }
    runBriefly(*result.scene, f32::makeWorldRunner);
#ifdef SWEPT_FUZZ_F64
    runBriefly(*result.scene, f64::makeWorldRunner);
#endif
}

}  // namespace swept::test
