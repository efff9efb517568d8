#include <swept/samples/runner.h>
#include <swept/samples/scene_builder.h>
#include <swept/samples/scene_reader.h>

swept::SceneDescription seesaw() {
    using namespace swept::build;
    swept::SceneDescription result = scene("seesaw", {0, 1.5}, 5);  // name, centre and height of the view
    addFixed(result, "floor", {0, 0}, {box({6, 0.1}, {0, -0.1}), polygon({{-0.3, 0}, {0.3, 0}, {0, 0.6}})});
    addDynamic(result, "plank", {0, 0.68}, {withFriction(box({2, 0.05}), 0.9)});
    hinge(result, "floor", "plank", {0, 0.68});
    addDynamic(result, "left", {-1.6, 1.5}, {box({0.2, 0.2})});
    addDynamic(result, "right", {1.6, 3}, {withDensity(box({0.2, 0.2}), 3)}).angularVelocity = 2;
    result.settings.dt = 1.0 / 120;
    return result;
}

/// Height of the last body after two seconds, or the reason why there is none in `error`.
double heightAfterTwoSeconds(const swept::SceneDescription& scene, std::string& error) {
    if (const auto fault = swept::validateScene(scene)) {
        error = fault->text();
        return 0;
    }
    swept::RunnerOptions options;
    options.precision = swept::Precision::f64;
    const std::unique_ptr<swept::Runner> runner = swept::makeRunner(scene, options, error);
    if (!runner) { return 0; }
    const swept::Trace trace = swept::runTrace(*runner, 240);
    return trace.frames.back().bodies.back().position.y;
}
