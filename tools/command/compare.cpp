#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <swept/samples/render/image_png.h>
#include <swept/samples/render/scene_renderer.h>

#include "../deviation.h"
#include "../reference/box2d_runner.h"
#include "../writers/csv_writer.h"
#include "../writers/number_text.h"
#include "../writers/output_files.h"
#include "camera.h"
#include "commands.h"
#include "picture_output.h"
#include "progress.h"
#include "scene_source.h"

namespace swept {
namespace {

constexpr std::int64_t kTableRows = 20;
constexpr const char* kOverlaySize = "1280x720";

struct CompareArguments {
    SceneArguments scene;
    std::string png;
    std::string size;  ///< kOverlaySize where none is given
    CameraArguments camera;
    std::string csv;
    std::optional<double> scale;  ///< metres
};

/// What a comparison has found so far.
struct Comparison {
    std::int64_t steps = 0;  ///< compared
    double scale = 0;
    std::int64_t firstBeyond = -1;  ///< first step with a deviation above the scale; −1: none
    bool finite = true;
    Frame ours;
    Frame theirs;
};

/// A column of the table: its numbers in a fixed width, so that rows line up.
void printCell(const std::string& text, int width) { std::cout << std::setw(width) << text << "  "; }

void printHead() {
    printCell("time", 7);
    printCell("worst", 9);
    printCell("mean", 9);
    printCell("angle", 9);
    printCell("our energy", 10);
    printCell("Box2D's", 10);
    std::cout << "worst body\n";
    printCell("s", 7);
    printCell("m", 9);
    printCell("m", 9);
    printCell("rad", 9);
    printCell("J", 10);
    printCell("J", 10);
    std::cout << '\n';
}

void printRow(const Deviation& deviation, double ourEnergy, double theirEnergy, const std::vector<std::string>& names) {
    printCell(roundedText(deviation.time), 7);
    printCell(roundedText(deviation.worstPosition, 3), 9);
    printCell(roundedText(deviation.meanPosition, 3), 9);
    printCell(roundedText(deviation.worstAngle, 3), 9);
    printCell(roundedText(ourEnergy, 5), 10);
    printCell(roundedText(theirEnergy, 5), 10);
    std::cout << (deviation.worstBody < 0 ? "-" : names[static_cast<std::size_t>(deviation.worstBody)]) << '\n';
}

/// Position, angle and velocity of each dynamic body in both engines' runs, step by step.
class DeviationCsv {
public:
    DeviationCsv(std::ostream& out, const std::vector<std::string>& names) : out_(out) {
        for (const std::string& name : names) { fields_.push_back(csvField(name)); }
        out_
            << "step,time,body,x,y,angle,box2dX,box2dY,box2dAngle,positionDeviation,angleDeviation,velocityDeviation\n";
    }

    void write(const Deviation& deviation, const Frame& ours, const Frame& theirs) {
        std::string rows;
        for (const BodyDeviation& body : deviation.bodies) {
            const auto i = static_cast<std::size_t>(body.body);
            rows += std::to_string(deviation.step) + ',';
            appendNumber(rows, deviation.time);
            rows += ',' + fields_[i];
            const BodyFrame& a = ours.bodies[i];
            const BodyFrame& b = theirs.bodies[i];
            for (const double number : {a.position.x, a.position.y, a.angle, b.position.x, b.position.y, b.angle,
                                        body.position, body.angle, body.velocity}) {
                rows += ',';
                appendNumber(rows, number);
            }
            rows += '\n';
        }
        out_ << rows;
    }

private:
    std::ostream& out_;
    std::vector<std::string> fields_;
};

/// @param renderer  learns which of our joints break; null: nothing is drawn
void compareRuns(const LoadedScene& loaded, Runner& ours, Box2dRunner& theirs, std::ostream* csvFile,
                 SceneRenderer* renderer, Comparison& found) {
    const std::vector<std::string> names = bodyNames(loaded.scene);
    std::optional<DeviationCsv> csv;
    if (csvFile != nullptr) { csv.emplace(*csvFile, names); }
    const std::int64_t stride = std::max<std::int64_t>(1, (loaded.steps + kTableRows - 1) / kTableRows);
    Progress progress("comparing " + loaded.source, loaded.steps, loaded.scene.settings.dt);
    printHead();
    for (std::int64_t step = 0; !theirs.aborted(); ++step) {
        ours.read(found.ours, true);
        theirs.read(found.theirs, true);
        const Deviation deviation = deviationOf(loaded.scene, found.ours, found.theirs);
        found.steps = step;
        if (csv) { csv->write(deviation, found.ours, found.theirs); }
        const bool isBeyond = !(deviation.worstPosition <= found.scale);
        if (isBeyond && found.firstBeyond < 0) { found.firstBeyond = step; }
        const RunReport report = ours.report();
        found.finite = report.finite;
        const bool isLast = step == loaded.steps || !found.finite;
        if (step % stride == 0 || isLast) { printRow(deviation, report.endEnergy, theirs.report().endEnergy, names); }
        if (isLast) { return; }
        ours.step();
        theirs.step();
        if (renderer != nullptr) { renderer->removeBrokenJoints(ours.events()); }
        progress.update(step + 1);
    }
}

/// The last state that both engines reached: ours filled, Box2D's as outlines.
bool writeOverlay(SceneRenderer& renderer, const Comparison& found, const std::string& path, std::string& error) {
    if (writePng(renderer.draw(found.ours, {&found.theirs, "Swept2D", "Box2D 2.4.1"}), path, error)) { return true; }
    error = "--png " + error;
    return false;
}

void printFindings(const LoadedScene& loaded, const Comparison& found, const Runner& ours, const Box2dRunner& theirs) {
    const double dt = loaded.scene.settings.dt;
    std::cout << "\nDeviation above " << roundedText(found.scale) << " m (--scale): ";
    if (found.firstBeyond < 0) {
        std::cout << "never in " << countText(found.steps, "step") << '\n';
    } else {
        std::cout << "from step " << found.firstBeyond << " ("
                  << roundedText(static_cast<double>(found.firstBeyond) * dt) << " s) on\n";
    }
    std::cout << "Deepest penetration: ours " << roundedText(ours.report().deepestPenetration, 3) << " m, Box2D "
              << roundedText(theirs.report().deepestPenetration, 3) << " m\n";
    if (theirs.aborted()) { std::cout << *theirs.aborted() << '\n'; }
    std::cout << "\nBox2D 2.4.1 stands in with these differences:\n";
    for (const std::string& sentence : theirs.approximations()) { std::cout << "  " << sentence << '\n'; }
}

std::unique_ptr<SceneRenderer> makeOverlayRenderer(const LoadedScene& loaded, const CompareArguments& arguments,
                                                   std::string& error) {
    PictureSize size;
    if (arguments.png.empty()) {
        error = faultWithoutPicture(arguments.size, arguments.camera);
        return nullptr;
    }
    if (!parseSize(arguments.size.empty() ? kOverlaySize : arguments.size, size, error)) { return nullptr; }
    const auto camera = cameraOf(arguments.camera, loaded.scene, error);
    if (!camera) { return nullptr; }
    RenderOptions options;
    camera->applyTo(options);
    options.width = size.width;
    options.height = size.height;
    auto renderer = SceneRenderer::create(loaded.scene, options, error);
    if (!renderer) { error = "no picture: " + error; }
    return renderer;
}

bool openOutputs(OutputFiles& outputs, const CompareArguments& arguments, const LoadedScene& loaded,
                 std::string& error) {
    outputs.protect(loaded.file);
    outputs.addFile("--csv", arguments.csv);
    outputs.addFile("--png", arguments.png);
    if (outputs.refuseClashes(error)) { error = endingFault("--png", arguments.png, "PNG"); }
    return error.empty() && outputs.open(error);
}

int compareScene(const CompareArguments& arguments) {
    std::string error;
    const auto loaded = loadScene(arguments.scene, error);
    if (!loaded) { return refuse(error); }
    if (arguments.scale && !(*arguments.scale > 0)) { return refuse("--scale: must be greater than 0"); }
    const auto renderer = makeOverlayRenderer(*loaded, arguments, error);
    if (!error.empty()) { return refuse(error); }
    const auto ours = makeRunner(loaded->scene, {loaded->precision, renderer != nullptr, true}, error);
    if (!ours) { return refuse(loaded->source + ": " + error); }
    const auto theirs = makeBox2dRunner(loaded->scene, error);
    if (!theirs) { return refuse(error); }
    OutputFiles outputs;
    if (!openOutputs(outputs, arguments, *loaded, error)) { return refuse(error); }

    Comparison found;
    found.scale = arguments.scale.value_or(visibleDeviation(loaded->scene));
    ours->read(found.ours, true);
    theirs->read(found.theirs, true);
    compareRuns(*loaded, *ours, *theirs, outputs.stream(arguments.csv), renderer.get(), found);
    if (!outputs.close(error)) { return refuse(error); }
    if (renderer && !writeOverlay(*renderer, found, arguments.png, error)) {
        outputs.discard();
        return refuse(error);
    }
    printFindings(*loaded, found, *ours, *theirs);
    if (!arguments.csv.empty()) { std::cout << "\ndeviations  " << arguments.csv << '\n'; }
    if (renderer) { std::cout << "overlay     " << arguments.png << '\n'; }
    return found.finite ? kExitDone : kExitNotFinite;
}

}  // namespace

void addCompareCommand(Command app) {
    const Command command =
        app.command("compare", "Run a scene here and in Box2D 2.4.1, and tell how far they drift apart");
    const auto arguments = std::make_shared<CompareArguments>();
    addSceneArguments(command, arguments->scene);
    addPrecisionArgument(command, arguments->scene);
    command.option("--png", arguments->png, "Picture of the last step, one engine over the other").type("FILE");
    command.option("--size", arguments->size, "Size of the picture in pixels [1280x720]").type("WxH");
    addCameraArguments(command, arguments->camera);
    command.option("--csv", arguments->csv, "State and deviation of every dynamic body after every step").type("FILE");
    command
        .option("--scale", arguments->scale,
                "Deviation whose first step is reported [a tenth of the smallest dynamic body]")
        .type("METRES");
    command.runs([arguments] { return compareScene(*arguments); });
}

}  // namespace swept
