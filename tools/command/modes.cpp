#include <algorithm>
#include <iomanip>
#include <iostream>
#include <iterator>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <swept/samples/render/contact_sheet.h>
#include <swept/samples/render/image_png.h>
#include <swept/samples/render/render_view.h>
#include <swept/samples/render/scene_renderer.h>
#include <swept/samples/scene_names.h>

#include "../bench/run_time.h"
#include "../writers/number_text.h"
#include "../writers/output_files.h"
#include "../writers/report_json.h"
#include "camera.h"
#include "commands.h"
#include "json_output.h"
#include "picture_output.h"
#include "scene_source.h"

namespace swept {
namespace {

constexpr SceneContinuous kModes[] = {SceneContinuous::off, SceneContinuous::speedLimit, SceneContinuous::speculative,
                                      SceneContinuous::stop, SceneContinuous::subStep};

constexpr const char* kPanelSize = "420x440";  // of each

struct ModesArguments {
    SceneArguments scene;
    std::string json;
    std::string png;
    std::string size;  ///< kPanelSize where none is given
    CameraArguments camera;
};

/// One mode's run of the scene.
struct ModeRun {
    std::string name;
    Frame frame;
    std::vector<SceneEvent> breaks;  ///< of joints
    RunReport report;
    double seconds = 0;  ///< processor time of all steps
    double lostSeconds = 0;

    double counter(const char* wanted) const {
        for (const NamedNumber& number : report.counters) {
            if (number.name == wanted) { return number.value; }
        }
        return 0;
    }
};

/// All bodies in one mode: what they say themselves is overruled.
SceneDescription inMode(SceneDescription scene, SceneContinuous mode) {
    scene.settings.continuous = mode;
    for (BodyDescription& body : scene.bodies) { body.continuous.reset(); }
    return scene;
}

void keepBreaks(std::span<const SceneEvent> events, std::vector<SceneEvent>& breaks) {
    const auto isBreak = [](const SceneEvent& event) { return event.type == SceneEventType::jointBreak; };
    std::copy_if(events.begin(), events.end(), std::back_inserter(breaks), isBreak);
}

/// One run that measures, which also warms up, and then those that are timed.
bool runMode(const LoadedScene& loaded, SceneContinuous mode, ModeRun& run, std::string& error) {
    run.name = namesOf<SceneContinuous>()[static_cast<std::size_t>(mode)];
    const SceneDescription scene = inMode(loaded.scene, mode);
    const auto runner = makeRunner(scene, {loaded.precision, true, true, true}, error);
    if (!runner) { return false; }
    for (std::int64_t step = 0; step < loaded.steps; ++step) {
        runner->step();
        keepBreaks(runner->events(), run.breaks);
    }
    runner->read(run.frame, false);
    run.report = runner->report();
    for (const LostTime& entry : run.report.lostTime) { run.lostSeconds += entry.seconds; }
    const auto makeTimed = [&] { return makeRunner(scene, {loaded.precision}, error); };
    run.seconds = bench::fastestRun(makeTimed, loaded.steps);
    return true;
}

void printTable(std::ostream& out, const LoadedScene& loaded, const std::vector<ModeRun>& runs) {
    out << loaded.source << ": " << countText(loaded.steps, "step") << " in each mode\n"
        << "mode         impacts   sweeps      TOI  lost (ms)  energy change (J)  deepest (mm)  us a step\n";
    for (const ModeRun& run : runs) {
        const auto steps = static_cast<double>(std::max<std::int64_t>(loaded.steps, 1));
        // No part of what there was: where energy counts from, and with it that part, is anyone's choice.
        const double energy = run.report.endEnergy - run.report.startEnergy;
        out << std::left << std::setw(12) << run.name << std::right << std::setw(8)
            << roundedText(run.counter("impacts"), 9) << std::setw(9) << roundedText(run.counter("sweeps"), 9)
            << std::setw(9) << roundedText(run.counter("toiCalls"), 9) << std::setw(11)
            << roundedText(1000 * run.lostSeconds) << std::setw(19) << roundedText(withoutMinusZero(energy))
            << std::setw(14) << roundedText(1000 * run.report.deepestPenetration, 3) << std::setw(11)
            << roundedText(1e6 * run.seconds / steps, 3) << '\n';
    }
    out << "lost: of their steps, by all bodies together\n";
}

std::string modesJson(const LoadedScene& loaded, const std::vector<ModeRun>& runs) {
    ReportJson json = headOf(loaded.scene, factsOf(loaded));
    json["modes"] = ReportJson::array();
    for (const ModeRun& run : runs) {
        ReportJson entry;
        entry["continuous"] = run.name;
        const double simulated = static_cast<double>(loaded.steps) * loaded.scene.settings.dt;
        if (simulated > 0) { entry["cost"] = run.seconds / simulated; }
        addTotals(entry, loaded.scene, run.report, loaded.steps);
        json["modes"].push_back(std::move(entry));
    }
    return jsonText(json);
}

std::string captionOf(const ModeRun& run) {
    if (run.lostSeconds > 0) {
        return run.name + " \u00B7 lost " + roundedText(1000 * run.lostSeconds, 3) + " ms in all bodies";
    }
    return run.counter("impacts") > 0 ? run.name + " \u00B7 nothing lost" : run.name;
}

/// The scene as a run has left it.
SceneDescription movedTo(SceneDescription scene, const Frame& frame) {
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) {
        scene.bodies[i].position = frame.bodies[i].position;
        scene.bodies[i].angle = frame.bodies[i].angle;
    }
    return scene;
}

/// The scene's own view is meant for the pictures of a run. Panels are narrower: where that would cut off bodies that
/// begin or end in sight of it, they show more above and below instead.
std::optional<ViewDescription> viewOf(const LoadedScene& loaded, const std::vector<ModeRun>& runs, PictureSize size) {
    constexpr double kAspect = 16.0 / 9;
    constexpr double kMargin = 1.02;
    if (!loaded.scene.view) { return std::nullopt; }
    ViewDescription view = *loaded.scene.view;
    const double most = 0.5 * kAspect * view.height;
    double half = halfWidthOf(loaded.scene, view, most);
    for (const ModeRun& run : runs) {
        half = std::max(half, halfWidthOf(movedTo(loaded.scene, run.frame), view, most));
    }
    view.height = std::max(view.height, 2 * kMargin * half * size.height / size.width);
    return view;
}

/// All modes side by side.
bool draw(const LoadedScene& loaded, const std::vector<ModeRun>& runs, const std::string& file, PictureSize size,
          const Camera& camera, std::string& error) {
    RenderOptions options;
    camera.applyTo(options);
    options.width = size.width;
    options.height = size.height;
    options.sweeps = true;
    options.sweepWork = false;
    if (!camera.isGiven()) { options.view = viewOf(loaded, runs, size); }
    options.title = options.legend = options.time = false;
    std::vector<Image> tiles;
    std::vector<std::string> captions;
    for (const ModeRun& run : runs) {
        const auto renderer = SceneRenderer::create(loaded.scene, options, error);
        if (!renderer) {
            error = "no picture: " + error;
            return false;
        }
        renderer->removeBrokenJoints(run.breaks);
        tiles.push_back(renderer->draw(run.frame));
        captions.push_back(captionOf(run));
    }
    const auto sheet = contactSheet(tiles, captions, static_cast<int>(tiles.size()), error);
    if (!sheet) { error = file + ": " + error; }
    if (sheet && writePng(*sheet, file, error)) { return true; }
    error = "--png " + error;
    return false;
}

int compareModes(const ModesArguments& arguments) {
    std::string error;
    const auto loaded = loadScene(arguments.scene, error);
    if (!loaded) { return refuse(error); }
    PictureSize size;
    if (!parseSize(arguments.size.empty() ? kPanelSize : arguments.size, size, error)) { return refuse(error); }
    if (arguments.png.empty()) { error = faultWithoutPicture(arguments.size, arguments.camera); }
    const auto camera = error.empty() ? cameraOf(arguments.camera, loaded->scene, error) : std::nullopt;
    if (!camera) { return refuse(error); }
    OutputFiles outputs;
    outputs.protect(loaded->file);
    outputs.addFile("--png", arguments.png);
    outputs.addStream("--json", arguments.json);
    if (outputs.refuseClashes(error)) { error = endingFault("--png", arguments.png, "PNG"); }
    if (!error.empty() || !outputs.open(error)) { return refuse(error); }
    std::vector<ModeRun> runs;
    for (const SceneContinuous mode : kModes) {
        if (!runMode(*loaded, mode, runs.emplace_back(), error)) {
            outputs.discard();
            return refuse(loaded->source + ": " + error);
        }
    }
    if (!arguments.png.empty() && !draw(*loaded, runs, arguments.png, size, *camera, error)) {
        outputs.discard();
        return refuse(error);
    }
    if (std::ostream* const json = outputs.stream(arguments.json)) { *json << modesJson(*loaded, runs); }
    if (!outputs.close(error)) { return refuse(error); }
    printTable(toldBeside(arguments.json), *loaded, runs);
    return kExitDone;
}

}  // namespace

void addModesCommand(Command app) {
    const Command command = app.command(
        "modes",
        "Run a scene in every continuous mode, whatever its bodies say: a table, and the last step side by side");
    const auto arguments = std::make_shared<ModesArguments>();
    addSceneArguments(command, arguments->scene);
    addPrecisionArgument(command, arguments->scene);
    addJsonArgument(command, arguments->json, "The totals of each mode");
    command.option("--png", arguments->png, "Draw the last step of each mode, side by side").type("FILE");
    command.option("--size", arguments->size, "Pixels of each of them [420x440]").type("WxH");
    addCameraArguments(command, arguments->camera);
    command.runs([arguments] { return compareModes(*arguments); });
}

}  // namespace swept
