#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <swept/samples/scene_reader.h>

#include "../bench/machine.h"
#include "../task_threads.h"
#include "../tune/ablation.h"
#include "../tune/plot.h"
#include "../tune/progress_bar.h"
#include "../tune/tuner.h"
#include "../tune/verdict.h"
#include "../writers/number_text.h"
#include "../writers/output_files.h"
#include "commands.h"
#include "json_output.h"
#include "scene_source.h"
#include "tune_json.h"

namespace swept {
namespace {

struct TuneArguments {
    SceneArguments scene;
    std::vector<std::string> limits;
    std::string out;
    std::string json;
    std::string shard;
    bool gather = false;
    bool ablate = false;
    int threads = 0;  ///< 0: all there are
};

constexpr int kNotKept = 1;  ///< exit code: no settings keep the errors
constexpr std::int64_t kFewestSteps = 8;
// In the directory of the results:
constexpr const char* kTuned = "/tuned.json";
constexpr const char* kLean = "/lean.json";
constexpr const char* kAblation = "/ablation.csv";

std::string directoryOf(const TuneArguments& arguments, const LoadedScene& loaded) {
    const bool isInput = arguments.scene.scene == "-";
    const std::string name = isInput ? "stdin" : std::filesystem::path(loaded.source).stem().string();
    return arguments.out.empty() ? "tune-" + name : arguments.out;
}

/// What was asked for, checked.
struct Task {
    tune::TuneOptions options;
    std::string source;
    std::string directory;
    std::string json;
    RunFacts facts;
};

std::ostream& told(const Task& task) { return toldBeside(task.json); }

TuneQuestion questionOf(const Task& task, const tune::Knowledge& known) {
    return {task.facts, task.options.subject, task.options.limits, known};
}

bool readTask(const TuneArguments& arguments, const tune::Team& team, Task& task, std::string& error) {
    if (arguments.scene.scene == "-" && team.size() > 1) {
        error = "standard input: mpirun hands it to one process alone; name a file";
        return false;
    }
    if (arguments.limits.empty()) {
        error = "--max-error is required: an error that you accept, such as --max-error penetration=0.002";
        return false;
    }
    const auto loaded = loadScene(arguments.scene, error);
    if (!loaded || !tune::parseLimits(arguments.limits, task.options.limits, error)) { return false; }
    if (!arguments.shard.empty() && !tune::parseShard(arguments.shard, task.options.shard, error)) { return false; }
    if (!arguments.shard.empty() && (arguments.gather || team.size() > 1)) {
        error = "--shard: is a part of the work; --gather and mpirun do all of it";
        return false;
    }
    if (arguments.ablate && (!arguments.shard.empty() || arguments.gather || team.size() > 1)) {
        error = "--ablate: is a dozen runs, for one process; --shard, --gather and mpirun share the search";
        return false;
    }
    if (!arguments.shard.empty() && !arguments.json.empty()) {
        error = "--json: is the advice of the whole search; a shard has none";
        return false;
    }
    if (loaded->steps < kFewestSteps) {
        error = "too short: tune needs " + std::to_string(kFewestSteps) + " steps at least";
        return false;
    }
    task.source = loaded->source;
    task.directory = directoryOf(arguments, *loaded);
    task.json = arguments.json;
    OutputFiles results;
    results.protect(loaded->file);
    results.addDirectory("--out", arguments.out);
    for (const char* const name : {kTuned, kLean, kAblation}) { results.addFile("--out", task.directory + name); }
    for (const std::string& name : tune::plottedFiles()) { results.addFile("--out", task.directory + '/' + name); }
    results.addFile("--out", tune::Store(task.directory, {}).path());
    results.addStream("--json", arguments.json);
    if (!results.refuseClashes(error)) { return false; }
    task.options.subject = {loaded->scene, loaded->steps + loaded->steps % 2};
    task.facts = factsOf(*loaded);
    task.facts.precision.clear();  // both are tried
    task.facts.steps = task.options.subject.ticks;
    const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    task.options.threads = arguments.threads > 0 ? arguments.threads : (team.size() > 1 ? 1 : cores);
    return true;
}

void printHead(const Task& task, const tune::Knowledge& known) {
    const tune::Subject& subject = task.options.subject;
    std::ostream& out = told(task);
    out << bench::machineText() << "\ntune " << task.source << ": " << subject.ticks << " steps of "
        << roundedText(1e3 * subject.scene.settings.dt) << " ms; compared with " << known.reference << '\n';
    for (const tune::Limit& limit : task.options.limits) {
        const measures::MeasureInfo& info = measures::infoOf(limit.measure);
        out << (limit.implied ? "and always: " : "accepted: ") << info.name << ' ' << roundedText(limit.value)
            << (std::string(info.unit) == "1" ? "" : std::string(" ") + info.unit);
        if (limit.implied) {
            out << '\n';
            continue;
        }
        out << " (" << info.definition;
        if (info.needsReference && known.uncertainty[limit.measure] > 0) {
            out << "; the reference is uncertain by " << roundedText(known.uncertainty[limit.measure], 2);
        }
        out << ")\n";
    }
    out << std::flush;
}

bool writeFile(const std::string& path, const std::string& text, std::string& error) {
    std::ofstream file(path, std::ios::binary);
    file << text;
    file.close();
    if (!file) { error = path + ": cannot be written"; }
    return error.empty();
}

/// What an earlier search recommended is no advice of this one. @return whether it was there
bool removeOldAdvice(const std::string& directory, const char* name) {
    std::error_code ignored;
    const std::string path = directory + name;
    return std::filesystem::is_regular_file(path, ignored) && std::filesystem::remove(path, ignored);
}

int printAdvice(const Task& task, const tune::Knowledge& known, OutputFiles& results, std::string& error) {
    const tune::Subject& subject = task.options.subject;
    const tune::Verdict verdict = tune::judge(subject, known, task.options.limits);
    const bool hadAdvice = removeOldAdvice(task.directory, kTuned);
    std::ostream& out = told(task);
    out << '\n';
    tune::writeTable(out, subject, task.options.limits, known, verdict);
    const std::string plotted = tune::plotRows(task.directory, subject, task.options.limits, known, verdict, error);
    if (!error.empty()) { return kExitBadInput; }
    if (std::ostream* const json = results.stream(task.json)) {
        *json << adviceJson(questionOf(task, known), verdict, task.directory + kTuned);
    }
    out << '\n';
    if (verdict.recommended < 0) {
        out << "None of " << known.rows.size() << " settings keeps these errors.";
        if (verdict.nearest >= 0) {
            const tune::Row& row = known.rows[static_cast<std::size_t>(verdict.nearest)];
            out << " Nearest: " << tune::settingsText(subject, row.config);
        }
        if (hadAdvice) { out << "\nThe " << &kTuned[1] << " of an earlier search is taken away."; }
        out << "\nrows   " << task.directory << "/tune.csv\n" << plotted << '\n';
        return kNotKept;
    }
    const tune::Row& row = known.rows[static_cast<std::size_t>(verdict.recommended)];
    out << "Recommended: " << tune::settingsText(subject, row.config);
    const tune::Row* const own = known.find(tune::ownConfig(subject.scene));
    if (own != nullptr) {
        const bool isKept = tune::holds(tune::strain(*own, task.options.limits, known.uncertainty));
        out << tune::costText(row.cost, own->cost, isKept);
    }
    out << '\n';
    const std::string tuned = writeScene(tune::withConfig(subject.scene, row.config));
    if (!writeFile(task.directory + kTuned, tuned, error)) { return kExitBadInput; }
    out << "scene  " << task.directory << kTuned
        << (row.config.engine == tune::Engine::f64 ? " (with --precision f64)" : "") << "\nrows   " << task.directory
        << "/tune.csv (" << known.rows.size() << ")\n"
        << plotted << '\n';
    return kExitDone;
}

/// Rows of other files become part of this one's.
void keepInStore(const tune::Subject& subject, const tune::Knowledge& there, const tune::Knowledge& known,
                 tune::Store& store) {
    if (!there.hasReference) { store.append(tune::csvLineOfReference(subject, known)); }
    for (const tune::Row& row : known.rows) {
        if (there.find(row.config) == nullptr) { store.append(tune::csvLine(subject, row)); }
    }
}

/// The rows of this process's own file, and those of all it shall know.
bool readRows(tune::Store& store, const tune::Subject& subject, bool gather, tune::Knowledge& there,
              tune::Knowledge& known, std::string& error) {
    return store.read(subject, false, there, error) && store.read(subject, gather, known, error);
}

/// What the scene can do without, as it is.
int ablateScene(const Task& task, tune::LazyReference& reference, const tune::Knowledge& known, OutputFiles& results,
                tune::ProgressBar& bar) {
    const tune::Subject& subject = task.options.subject;
    const std::vector<tune::Limit>& limits = task.options.limits;
    const tune::Ablation ablation =
        tune::ablate(subject, limits, reference.get(), task.options.threads,
                     [&bar](std::size_t done, std::size_t all) { bar.show("features", done, all); });
    bar.clear();
    std::ostream& out = told(task);
    std::string error;
    if (std::ostream* const json = results.stream(task.json)) {
        *json << ablationJson(questionOf(task, known), ablation, task.directory + kLean);
    }
    if (!results.close(error)) { return refuse(error); }
    if (!ablation.isDecided) {
        (void)removeOldAdvice(task.directory, kLean);
        out << "\nWhat it can do without is not decided: as it is, the scene does not keep these errors ("
            << tune::missedText(ablation.whole, limits, reference.get().uncertainty)
            << ").\nWithout --ablate, settings that do are looked for.\n";
        return kNotKept;
    }
    out << '\n';
    tune::writeAblation(out, limits, ablation);
    std::ostringstream csv;
    tune::writeAblationCsv(csv, ablation);
    std::error_code failure;
    std::filesystem::create_directories(task.directory, failure);
    if (!writeFile(task.directory + kAblation, csv.str(), error) ||
        !writeFile(task.directory + kLean, writeScene(tune::leanScene(subject, ablation)), error)) {
        return refuse("--out " + error);
    }
    out << "\nLeanest profile: ";
    for (std::size_t i = 0; i < ablation.lean.features.size(); ++i) {
        out << (i == 0 ? "without " : ", ") << ablation.lean.features[i];
    }
    if (ablation.lean.features.empty()) {
        out << "the scene as it is";
    } else {
        out << tune::costText(ablation.lean.row.cost, ablation.whole.cost, true);
    }
    out << "\nscene  " << task.directory << kLean << "\nrows   " << task.directory << kAblation << "\n";
    return kExitDone;
}

int tuneScene(const TuneArguments& arguments) {
    const auto team = tune::makeTeam();
    const bool isFirst = team->rank() == 0;
    const auto refuseOnce = [isFirst](const std::string& text) { return isFirst ? refuse(text) : kExitBadInput; };
    Task task;
    std::string error;
    if (!readTask(arguments, *team, task, error)) { return refuseOnce(error); }
    const tune::Subject& subject = task.options.subject;
    tune::Store store(task.directory, task.options.shard);
    tune::Knowledge there;
    tune::Knowledge known;
    if (!arguments.ablate && !readRows(store, subject, arguments.gather, there, known, error)) {
        return refuseOnce(error);
    }
    // No minute of computing ends at a place that cannot be written.
    OutputFiles results;
    results.addDirectory("--out", task.directory);
    results.addStream("--json", task.json);
    if (isFirst && !results.open(error)) { return refuseOnce(error); }
    tune::ProgressBar bar("tuning " + task.source, isFirst);
    tune::LazyReference reference(subject);
    if (!known.hasReference) {
        reference.tell(known, [&bar](int halving, int most) {
            bar.show("reference", static_cast<std::size_t>(halving - 1), static_cast<std::size_t>(most));
        });
    }
    tune::addImplied(task.options.limits, subject, known);
    error = tune::whyMeaningless(subject, task.options.limits, known);
    if (!error.empty() || (isFirst && !arguments.ablate && !store.open(error))) {
        bar.clear();
        results.discard();
        return refuseOnce(error);
    }
    if (isFirst) {
        bar.clear();
        printHead(task, known);
        if (arguments.ablate) { return ablateScene(task, reference, known, results, bar); }
        keepInStore(subject, there, known, store);
    }
    tune::tune(task.options, reference, *team, isFirst ? &store : nullptr, known,
               [&bar](std::size_t done, std::size_t all) { bar.show("runs", done, all); });
    bar.clear();
    if (!isFirst) { return kExitDone; }
    if (!store.good()) { return refuse("--out " + store.path() + ": could not be written to the end"); }
    if (!task.options.shard.isWhole()) {
        told(task) << "shard " << arguments.shard << " is done: " << known.rows.size() << " rows in " << store.path()
                   << "; when all are, the same command with --gather instead of --shard\n";
        return kExitDone;
    }
    const int code = printAdvice(task, known, results, error);
    if (!error.empty()) {
        results.discard();
        return refuse("--out " + error);
    }
    return results.close(error) ? code : refuse(error);
}

}  // namespace

void addTuneCommand(Command app) {
    const Command command =
        app.command("tune",
                    "The cheapest settings of a scene that keep an error you accept, and the whole trade; "
                    "needs " +
                        std::to_string(kFewestSteps) + " steps at least");
    const auto arguments = std::make_shared<TuneArguments>();
    addSceneArguments(command, arguments->scene);
    std::string measures;
    for (const measures::MeasureInfo& info : measures::allMeasures()) {
        measures += std::string(measures.empty() ? "" : ", ") + info.name + " [" + info.unit + "]";
    }
    command.option("--max-error", arguments->limits, "An error that you accept; may be repeated. Measures: " + measures)
        .type("MEASURE=VALUE")
        .oneValueEach();
    command.option("--out", arguments->out, "Directory for rows, plot and tuned scene [tune-NAME]").type("DIR");
    addJsonArgument(command, arguments->json, "The advice and all rows (with --ablate: all features)");
    command.option("--threads", arguments->threads, "Runs at a time [all cores]").type("N").within(1, kMostThreads);
    command.option("--shard", arguments->shard, "Only the i-th of n parts of the work, into a file of its own")
        .type("i/n");
    command.flag("--gather", arguments->gather, "Take the rows of all shards, run what is missing, give the advice");
    command.flag("--ablate", arguments->ablate,
                 "Instead of a search, each feature off in turn: what the scene can do without");
    command.runs([arguments] { return tuneScene(*arguments); });
}

}  // namespace swept
