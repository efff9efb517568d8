#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <swept/samples/scene_names.h>
#include <swept/samples/scene_reader.h>

#include "../task_threads.h"
#include "../writers/csv_writer.h"
#include "../writers/event_writer.h"
#include "../writers/finite_state.h"
#include "../writers/number_text.h"
#include "../writers/output_files.h"
#include "../writers/report_writer.h"
#include "commands.h"
#include "json_output.h"
#include "picture_output.h"
#include "progress.h"
#include "scene_source.h"

namespace swept {
namespace {

struct RunArguments {
    SceneArguments scene;
    PictureArguments pictures;
    std::optional<double> from;  ///< seconds
    std::string csv;
    std::optional<std::int64_t> csvEvery;  ///< steps; 1 where none is given
    std::vector<std::string> csvBodies;    ///< names; none: all bodies
    std::string events;
    std::string report;
    std::string json;  ///< another name of the same, which other commands have, too
    std::string writtenScene;
    std::string writtenEnd;
    int threads = 1;

    const std::string& reportFile() const { return report.empty() ? json : report; }
};

/// What happened to the run, for the exit code and the summary.
struct RunOutcome {
    std::int64_t steps = 0;
    std::optional<std::string> culprit;  ///< the first body whose state is not finite
};

/// A run with all that looks at it: steps, hands each state to the writers, and stops at the first that is not finite.
class ObservedRun {
public:
    /// @param span  what is told of it; the steps before are run all the same
    ObservedRun(Runner& runner, const LoadedScene& loaded, StepSpan span, std::vector<std::string> names)
        : runner_(runner), loaded_(loaded), span_(span), names_(std::move(names)) {}

    /// @param csvBodies  indices of those whose states are written; none: all
    void writeTo(OutputFiles& outputs, const RunArguments& arguments, const std::vector<std::size_t>& csvBodies) {
        outputs_ = &outputs;
        csvEvery_ = arguments.csvEvery.value_or(1);
        if (std::ostream* const file = outputs.stream(arguments.csv)) { csv_.emplace(*file, names_, csvBodies); }
        if (std::ostream* const file = outputs.stream(arguments.events)) { events_.emplace(*file, names_); }
    }

    /// @return false, and the reason in `error`, when something could not be written or a step was refused.
    bool run(PictureOutput* pictures, RunOutcome& outcome, std::string& error) {
        Progress progress(loaded_.source, loaded_.steps, loaded_.scene.settings.dt);
        const bool wantsContacts = pictures != nullptr && pictures->wantsContacts();
        for (std::int64_t step = 0;; ++step) {
            runner_.read(frame_, wantsContacts && span_.includes(step));
            if (csv_ && span_.includes(step, csvEvery_)) { csv_->write(frame_); }
            outcome.steps = step;
            if (const auto body = firstNotFinite(frame_)) {
                outcome.culprit = names_[*body];
                return true;
            }
            if (pictures != nullptr && !pictures->show(frame_, runner_.events(), error)) { return false; }
            if (outputs_ != nullptr && !outputs_->isWritten(error)) { return false; }
            if (step == loaded_.steps) { return true; }
            if (!runner_.step()) {
                error = loaded_.source + ": " + runner_.report().refusal;
                return false;
            }
            if (events_ && step >= span_.first) { events_->write(runner_.events()); }
            progress.update(step + 1);
        }
    }

private:
    Runner& runner_;
    const LoadedScene& loaded_;
    StepSpan span_;
    std::vector<std::string> names_;
    std::optional<CsvWriter> csv_;
    std::int64_t csvEvery_ = 1;
    std::optional<EventWriter> events_;
    const OutputFiles* outputs_ = nullptr;
    Frame frame_;
};

void addRunOptions(Command command, RunArguments& arguments) {
    addSceneArguments(command, arguments.scene);
    addPrecisionArgument(command, arguments.scene);
    command.option("--from", arguments.from, "Pictures, states, events and totals begin at this time of the run [0]")
        .type("S");
    addPictureArguments(command, arguments.pictures);
    command.option("--csv", arguments.csv, "State of every body after every step; - is standard output").type("FILE");
    command.option("--csv-every", arguments.csvEvery, "Steps from one state to the next [1]").type("N");
    command.option("--csv-bodies", arguments.csvBodies, "Only the states of these bodies, separated by commas")
        .type("NAME,...")
        .separatedBy(',')
        .oneValueEach();
    command.option("--events", arguments.events, "Contact, sensor and joint events as JSON lines, or -").type("FILE");
    command.option("--report", arguments.report, "Totals of the run as JSON, or -").type("FILE");
    command.option("--json", arguments.json, "Another name of --report, which other commands have, too").type("FILE");
    command
        .option("--write-scene", arguments.writtenScene,
                "The scene as it is run, with what --set and --view change, as JSON, or -")
        .type("FILE");
    command
        .option("--write-end", arguments.writtenEnd,
                "The scene as the run leaves it, to be run on from there, as JSON, or -")
        .type("FILE");
    command
        .option("--threads", arguments.threads,
                "Threads that the step may use; never changes the results. Small scenes use one all the same [1]")
        .type("N")
        .within(1, kMostThreads);
}

OutputFiles placesOf(const RunArguments& arguments, const LoadedScene& loaded, StepSpan span) {
    OutputFiles outputs;
    outputs.protect(loaded.file);
    outputs.addStream("--csv", arguments.csv);
    outputs.addStream("--events", arguments.events);
    outputs.addStream(arguments.report.empty() ? "--json" : "--report", arguments.reportFile());
    outputs.addStream("--write-scene", arguments.writtenScene);
    outputs.addStream("--write-end", arguments.writtenEnd);
    addPicturePlaces(outputs, arguments.pictures, span);
    return outputs;
}

/// Where people are told of the run: not in the midst of what another program reads.
std::ostream& toldIn(const RunArguments& arguments) {
    const auto files = {&arguments.csv, &arguments.events, &arguments.reportFile(), &arguments.writtenScene,
                        &arguments.writtenEnd};
    const auto isPiped = [](const std::string* file) { return *file == "-"; };
    return std::any_of(files.begin(), files.end(), isPiped) ? std::cerr : std::cout;
}

/// The largest errors of the run, and where and when they were.
void printWorst(std::ostream& out, const SceneDescription& scene, const RunReport& report) {
    const auto nameOf = [&scene](int body) { return inQuotes(bodyName(scene, static_cast<std::size_t>(body))); };
    out << "deepest penetration " << roundedText(report.deepestPenetration, 3) << " m";
    if (const auto& pair = report.deepestPair) {
        out << " (" << nameOf(pair->a) << " and " << nameOf(pair->b) << " at " << roundedText(pair->time) << " s)";
    }
    out << '\n';
    if (!scene.joints.empty()) { out << "largest joint error " << roundedText(report.largestJointError, 3) << " m"; }
    if (const auto& worst = report.worstJoint) {
        const std::string joint = inQuotes(jointName(scene, static_cast<std::size_t>(worst->joint)));
        out << " (" << joint << " at " << roundedText(worst->time) << " s)";
    }
    if (!scene.joints.empty()) { out << '\n'; }
    double lost = 0;
    for (const LostTime& entry : report.lostTime) { lost += entry.seconds; }
    if (const auto most = mostLostTime(report)) {
        out << "lost time " << roundedText(lost, 3) << " s in all bodies, most by " << nameOf(most->body) << ": "
            << roundedText(most->seconds, 3) << " s\n";
    }
}

/// @param from  the step from which on the run is told of
void printSummary(std::ostream& out, const LoadedScene& loaded, const RunOutcome& outcome, std::int64_t from,
                  const RunReport& report) {
    const double dt = loaded.scene.settings.dt;
    const std::string& name = loaded.scene.name.empty() ? loaded.source : loaded.scene.name;
    out << name << ": " << countText(outcome.steps, "step") << " of " << roundedText(dt)
        << " s = " << roundedText(static_cast<double>(outcome.steps) * dt) << " s, computed in "
        << roundedText(report.stepSeconds, 3) << " s (" << (loaded.precision == Precision::f64 ? "f64" : "f32")
        << ")\n";
    if (from > 0) { out << "from " << roundedText(static_cast<double>(from) * dt) << " s on:\n"; }
    printWorst(out, loaded.scene, report);
}

void printPlace(std::ostream& out, const char* what, const std::string& path) {
    if (!path.empty() && path != "-") { out << what << path << '\n'; }
}

void warnOfBudget(const char* name, const std::optional<double>& limit, double value, const char* unit) {
    if (!limit || value <= *limit) { return; }
    std::cerr << "swept: warning: " << roundedText(value, 3) << ' ' << unit << " is above the scene's budget " << name
              << " = " << roundedText(*limit) << ' ' << unit << '\n';
}

/// A run in which a state overflowed has left what was asked for, though all of it is finite.
void warnOfOverflow(const RunReport& report) {
    const auto isPutBack = [](const NamedNumber& counter) { return counter.name == "putBack"; };
    const auto found = std::find_if(report.counters.begin(), report.counters.end(), isPutBack);
    if (found == report.counters.end() || found->value == 0) { return; }
    std::cerr << "swept: warning: " << roundedText(found->value) << (found->value == 1 ? " state" : " states")
              << " of bodies overflowed and " << (found->value == 1 ? "was" : "were")
              << " put back to rest where the step began (counter putBack)\n";
}

/// Writes what belongs to the end of the run, closes the files, and tells the user.
int finishRun(const RunArguments& arguments, const LoadedScene& loaded, const Runner& runner, const RunOutcome& outcome,
              StepSpan span, OutputFiles& outputs) {
    const RunReport report = runner.report();
    const std::int64_t from = span.first <= outcome.steps ? span.first : 0;  // else all of the run is reported
    if (std::ostream* const file = outputs.stream(arguments.reportFile())) {
        RunFacts facts = factsOf(loaded);
        facts.steps = outcome.steps;
        facts.from = from;
        *file << reportText(loaded.scene, report, facts);
    }
    std::string error;
    if (!outputs.close(error)) { return refuse(error); }
    std::ostream& out = toldIn(arguments);
    printSummary(out, loaded, outcome, from, report);
    printPlace(out, "states    ", arguments.csv);
    printPlace(out, "events    ", arguments.events);
    printPlace(out, "report    ", arguments.reportFile());
    printPlace(out, "scene     ", arguments.writtenScene);
    printPlace(out, "its end   ", arguments.writtenEnd);
    printPicturePlaces(out, arguments.pictures, {span.first, outcome.steps});
    warnOfBudget("maxPenetration", loaded.scene.settings.maxPenetration, report.deepestPenetration, "m");
    warnOfBudget("maxJointError", loaded.scene.settings.maxJointError, report.largestJointError, "m");
    const auto most = mostLostTime(report);
    warnOfBudget("maxLostTime", loaded.scene.settings.maxLostTime, most ? most->seconds : 0, "s");
    warnOfOverflow(report);
    if (!outcome.culprit) { return kExitDone; }
    std::cerr << "swept: " << loaded.source << ": the state of body \"" << *outcome.culprit
              << "\" is not finite after step " << outcome.steps << '\n';
    return kExitNotFinite;
}

/// As it was meant between commas: "chassis, ground".
std::string withoutBlanks(const std::string& typed) {
    const std::size_t first = typed.find_first_not_of(' ');
    return first == std::string::npos ? "" : typed.substr(first, typed.find_last_not_of(' ') - first + 1);
}

/// Indices of the bodies whose states are asked for. @return nothing, and one line in `error`, when one is none, or
/// other options of the states make no sense.
std::optional<std::vector<std::size_t>> csvBodiesOf(const RunArguments& arguments,
                                                    const std::vector<std::string>& names, std::string& error) {
    if (arguments.csv.empty() && (arguments.csvEvery || !arguments.csvBodies.empty())) {
        error = std::string(arguments.csvEvery ? "--csv-every" : "--csv-bodies") + " needs --csv";
        return std::nullopt;
    }
    if (arguments.csvEvery.value_or(1) < 1) {
        error = "--csv-every: must be at least 1";
        return std::nullopt;
    }
    std::vector<std::size_t> bodies;
    for (const std::string& typed : arguments.csvBodies) {
        const bool isExact = std::find(names.begin(), names.end(), typed) != names.end();
        const std::string name = isExact ? typed : withoutBlanks(typed);
        if (name.empty()) {
            error = "--csv-bodies: a name is empty";
            return std::nullopt;
        }
        const auto body = bodyOfName("--csv-bodies", name, names, error);
        if (!body) { return std::nullopt; }
        bodies.push_back(*body);
    }
    return bodies;
}

/// What is told of the run. @return nothing, and one line in `error`, when it would end before.
std::optional<StepSpan> spanOf(const RunArguments& arguments, const LoadedScene& loaded, std::string& error) {
    const double from = arguments.from.value_or(0);
    if (!std::isfinite(from) || from < 0) {
        error = "--from: must be a finite number of seconds, at least 0";
        return std::nullopt;
    }
    const double dt = loaded.scene.settings.dt;
    const double first = std::round(from / dt);
    if (!(first <= static_cast<double>(loaded.steps))) {
        error = "--from " + roundedText(from) + ": the run ends at " +
                roundedText(static_cast<double>(loaded.steps) * dt) + " s (--duration)";
        return std::nullopt;
    }
    return StepSpan{static_cast<std::int64_t>(first), loaded.steps};
}

/// The scene as it is run. A view that follows a body is nothing that a scene can hold.
std::string sceneText(SceneDescription scene, const Camera& camera) {
    if (camera.view && !camera.follow) { scene.view = camera.view; }
    return textOfScene(scene);
}

/// The scene as the run left it, in the same form, with the same view.
std::string endText(const Runner& runner, const LoadedScene& loaded, const Camera& camera) {
    const std::string text = runner.sceneNow();
    SceneResult end = readScene(text, loaded.source);
    if (!end.scene) { return text; }  // a world may be where the format has no numbers
    end.scene->view = loaded.scene.view;
    end.scene->settings.dt = loaded.scene.settings.dt;  // a world that took no step knows of none
    return sceneText(std::move(*end.scene), camera);
}

int runScene(const RunArguments& arguments) {
    if (!arguments.report.empty() && !arguments.json.empty()) {
        return refuse("--report and --json are the same: give one of them, not both");
    }
    std::string error;
    const auto loaded = loadScene(arguments.scene, error);
    if (!loaded) { return refuse(error); }
    const std::vector<std::string> names = bodyNames(loaded->scene);
    const auto camera = cameraOf(arguments.pictures.camera, loaded->scene, error);
    const auto csvBodies = camera ? csvBodiesOf(arguments, names, error) : std::nullopt;
    const auto span = csvBodies ? spanOf(arguments, *loaded, error) : std::nullopt;
    if (!span) { return refuse(error); }
    const auto pictures = makePictureOutput(loaded->scene, arguments.pictures, *camera, *span, error);
    if (!error.empty()) { return refuse(error); }
    const bool needsEvents = !arguments.events.empty() || pictures != nullptr;
    const auto tasks = makeTaskSystem(arguments.threads);
    if (arguments.threads > 1 && !tasks) {
        std::cerr << "swept: warning: --threads: built without oneTBB, so this runs on one thread\n";
    }
    const RunnerOptions options{loaded->precision,         needsEvents, true,
                                arguments.pictures.sweeps, tasks.get(), span->first};
    const auto runner = makeRunner(loaded->scene, options, error);
    if (!runner) { return refuse(loaded->source + ": " + error); }
    OutputFiles outputs = placesOf(arguments, *loaded, *span);
    if (!outputs.open(error)) { return refuse(error); }
    if (std::ostream* const file = outputs.stream(arguments.writtenScene)) {
        *file << sceneText(loaded->scene, *camera);
    }
    ObservedRun run(*runner, *loaded, *span, names);
    run.writeTo(outputs, arguments, *csvBodies);
    RunOutcome outcome;
    const bool complete = run.run(pictures.get(), outcome, error);
    if (!complete || (pictures && !pictures->finish(error))) {
        outputs.discard();
        return error.empty() ? kExitBadInput : refuse(error);
    }
    if (std::ostream* const file = outputs.stream(arguments.writtenEnd)) {
        *file << endText(*runner, *loaded, *camera);
    }
    return finishRun(arguments, *loaded, *runner, outcome, *span, outputs);
}

}  // namespace

void addRunCommand(Command app) {
    const Command command = app.command("run", "Run a scene: pictures, states, events, a report");
    const auto arguments = std::make_shared<RunArguments>();
    addRunOptions(command, *arguments);
    command.runs([arguments] { return runScene(*arguments); });
}

}  // namespace swept
