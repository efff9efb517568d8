#include <algorithm>
#include <cmath>
#include <iomanip>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <swept/samples/render/image_png.h>
#include <swept/samples/render/scene_renderer.h>

#include "../deviation.h"
#include "../reference/box2d_runner.h"
#include "../writers/csv_writer.h"
#include "../writers/number_text.h"
#include "../writers/output_files.h"
#include "../writers/report_json.h"
#include "camera.h"
#include "commands.h"
#include "json_output.h"
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
    std::string json;
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
    ReportJson table = ReportJson::array();  ///< of what is printed
};

/// A column of the table: its numbers in a fixed width, so that rows line up.
void printCell(std::ostream& out, const std::string& text, int width) { out << std::setw(width) << text << "  "; }

void printHead(std::ostream& out) {
    printCell(out, "time", 7);
    printCell(out, "worst", 9);
    printCell(out, "mean", 9);
    printCell(out, "angle", 9);
    printCell(out, "our energy", 10);
    printCell(out, "Box2D's", 10);
    out << "worst body\n";
    printCell(out, "s", 7);
    printCell(out, "m", 9);
    printCell(out, "m", 9);
    printCell(out, "rad", 9);
    printCell(out, "J", 10);
    printCell(out, "J", 10);
    out << '\n';
}

void printRow(std::ostream& out, const Deviation& deviation, double ourEnergy, double theirEnergy,
              const std::vector<std::string>& names) {
    printCell(out, roundedText(deviation.time), 7);
    printCell(out, roundedText(deviation.worstPosition, 3), 9);
    printCell(out, roundedText(deviation.meanPosition, 3), 9);
    printCell(out, roundedText(deviation.worstAngle, 3), 9);
    printCell(out, roundedText(ourEnergy, 5), 10);
    printCell(out, roundedText(theirEnergy, 5), 10);
    out << (deviation.worstBody < 0 ? "-" : names[static_cast<std::size_t>(deviation.worstBody)]) << '\n';
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

ReportJson deviationJson(const Deviation& deviation, double ourEnergy, double theirEnergy,
                         const std::vector<std::string>& names) {
    ReportJson row;
    row["step"] = deviation.step;
    row["time"] = deviation.time;
    row["worstPosition"] = deviation.worstPosition;
    row["meanPosition"] = deviation.meanPosition;
    row["worstAngle"] = deviation.worstAngle;
    if (deviation.worstBody >= 0) { row["body"] = names[static_cast<std::size_t>(deviation.worstBody)]; }
    row["energy"] = ReportJson{{"ours", ourEnergy}, {"box2d", theirEnergy}};
    return row;
}

/// @param out       gets the table
/// @param renderer  learns which of our joints break; null: nothing is drawn
void compareRuns(std::ostream& out, const LoadedScene& loaded, Runner& ours, Box2dRunner& theirs, std::ostream* csvFile,
                 SceneRenderer* renderer, Comparison& found) {
    const std::vector<std::string> names = bodyNames(loaded.scene);
    std::optional<DeviationCsv> csv;
    if (csvFile != nullptr) { csv.emplace(*csvFile, names); }
    const std::int64_t stride = std::max<std::int64_t>(1, (loaded.steps + kTableRows - 1) / kTableRows);
    Progress progress("comparing " + loaded.source, loaded.steps, loaded.scene.settings.dt);
    printHead(out);
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
        if (step % stride == 0 || isLast) {
            const double theirEnergy = theirs.report().endEnergy;
            printRow(out, deviation, report.endEnergy, theirEnergy, names);
            found.table.push_back(deviationJson(deviation, report.endEnergy, theirEnergy, names));
        }
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

void printFindings(std::ostream& out, const LoadedScene& loaded, const Comparison& found, const Runner& ours,
                   const Box2dRunner& theirs) {
    const double dt = loaded.scene.settings.dt;
    out << "\nDeviation above " << roundedText(found.scale) << " m (--scale): ";
    if (found.firstBeyond < 0) {
        out << "never in " << countText(found.steps, "step") << '\n';
    } else {
        out << "from step " << found.firstBeyond << " (" << roundedText(static_cast<double>(found.firstBeyond) * dt)
            << " s) on\n";
    }
    out << "Deepest penetration: ours " << roundedText(ours.report().deepestPenetration, 3) << " m, Box2D "
        << roundedText(theirs.report().deepestPenetration, 3) << " m\n";
    if (theirs.aborted()) { out << *theirs.aborted() << '\n'; }
    out << "\nBox2D 2.4.1 stands in with these differences:\n";
    for (const std::string& sentence : theirs.approximations()) { out << "  " << sentence << '\n'; }
}

std::string comparisonJson(const LoadedScene& loaded, Comparison& found, const Runner& ours,
                           const Box2dRunner& theirs) {
    RunFacts facts = factsOf(loaded);
    facts.steps = found.steps;
    ReportJson json = headOf(loaded.scene, facts);
    json["scale"] = found.scale;
    if (found.firstBeyond >= 0) {
        const double time = static_cast<double>(found.firstBeyond) * loaded.scene.settings.dt;
        json["firstBeyond"] = ReportJson{{"step", found.firstBeyond}, {"time", time}};
    }
    json["deviations"] = std::move(found.table);
    addTotals(json["ours"], loaded.scene, ours.report(), found.steps);
    json["box2d"]["engine"] = "Box2D 2.4.1";
    addTotals(json["box2d"], loaded.scene, theirs.report(), found.steps);
    json["box2d"].erase("lostTime");  // it keeps no book of that
    if (theirs.aborted()) { json["box2d"]["aborted"] = *theirs.aborted(); }
    json["box2d"]["differences"] = theirs.approximations();
    return jsonText(json);
}

std::unique_ptr<SceneRenderer> makeOverlayRenderer(const LoadedScene& loaded, const CompareArguments& arguments,
                                                   std::string& error) {
    PictureSize size;
    if (!parseSize(arguments.size.empty() ? kOverlaySize : arguments.size, size, error)) { return nullptr; }
    if (arguments.png.empty()) {
        error = faultWithoutPicture(arguments.size, arguments.camera);
        return nullptr;
    }
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
    outputs.addStream("--json", arguments.json);
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
    std::ostream& out = toldBeside(arguments.json);
    compareRuns(out, *loaded, *ours, *theirs, outputs.stream(arguments.csv), renderer.get(), found);
    if (std::ostream* const json = outputs.stream(arguments.json)) {
        *json << comparisonJson(*loaded, found, *ours, *theirs);
    }
    if (!outputs.close(error)) { return refuse(error); }
    if (renderer && !writeOverlay(*renderer, found, arguments.png, error)) {
        outputs.discard();
        return refuse(error);
    }
    printFindings(out, *loaded, found, *ours, *theirs);
    if (!arguments.csv.empty()) { out << "\ndeviations  " << arguments.csv << '\n'; }
    if (renderer) { out << "overlay     " << arguments.png << '\n'; }
    return found.finite ? kExitDone : kExitNotFinite;
}

}  // namespace

void addCompareCommand(Command app) {
    const Command command =
        app.command("compare", "Run a scene here and in Box2D 2.4.1, and tell how far they drift apart");
    const auto arguments = std::make_shared<CompareArguments>();
    addSceneArguments(command, arguments->scene);
    addPrecisionArgument(command, arguments->scene);
    addJsonArgument(command, arguments->json, "What is found, and the totals of both");
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
