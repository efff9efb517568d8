#include <algorithm>
#include <iostream>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include <swept/samples/scene_reader.h>

#include "../bench/machine.h"
#include "../number_text.h"
#include "../tune/plot.h"
#include "../tune/progress_bar.h"
#include "../tune/tuner.h"
#include "../tune/verdict.h"
#include "commands.h"
#include "scene_source.h"

namespace swept {
namespace {

constexpr int kMostThreads = 4096;

struct TuneArguments {
    SceneArguments scene;
    std::vector<std::string> limits;
    std::string out;
    std::string shard;
    bool gather = false;
    int threads = 0;  ///< 0: all there are
};

constexpr int kNotKept = 1;  ///< exit code: no settings keep the errors
constexpr std::int64_t kFewestSteps = 8;

std::string directoryOf(const TuneArguments& arguments, const LoadedScene& loaded) {
    if (!arguments.out.empty()) {
        return arguments.out;
    }
    std::string name = loaded.scene.name.empty() ? "scene" : loaded.scene.name;
    std::replace_if(
        name.begin(), name.end(), [](char c) { return c == '/' || c == ' '; }, '-');
    return "tune-" + name;
}

/// What was asked for, checked.
struct Task {
    tune::TuneOptions options;
    std::string source;
    std::string directory;
};

bool readTask(const TuneArguments& arguments, const tune::Team& team, Task& task, std::string& error) {
    const auto loaded = loadScene(arguments.scene, error);
    if (!loaded || !tune::parseLimits(arguments.limits, task.options.limits, error)) {
        return false;
    }
    if (!arguments.shard.empty() && !tune::parseShard(arguments.shard, task.options.shard, error)) {
        return false;
    }
    if (!arguments.shard.empty() && (arguments.gather || team.size() > 1)) {
        error = "--shard: is a part of the work; --gather and mpirun do all of it";
        return false;
    }
    if (loaded->steps < kFewestSteps) {
        error = "too short: tune needs " + std::to_string(kFewestSteps) + " steps at least";
        return false;
    }
    task.source = loaded->source;
    task.directory = directoryOf(arguments, *loaded);
    task.options.subject = {loaded->scene, loaded->steps + loaded->steps % 2};
    const int cores = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    task.options.threads = arguments.threads > 0 ? arguments.threads : (team.size() > 1 ? 1 : cores);
    return true;
}

void printHead(const Task& task, const tune::Knowledge& known) {
    const tune::Subject& subject = task.options.subject;
    std::cout << bench::machineText() << "\ntune " << task.source << ": " << subject.ticks << " steps of "
              << roundedText(1e3 * subject.scene.settings.dt) << " ms; compared with " << known.reference << '\n';
    for (const tune::Limit& limit : task.options.limits) {
        const measures::MeasureInfo& info = measures::infoOf(limit.measure);
        std::cout << (limit.implied ? "and always: " : "accepted: ") << info.name << ' ' << roundedText(limit.value)
                  << (std::string(info.unit) == "1" ? "" : std::string(" ") + info.unit);
        if (limit.implied) {
            std::cout << '\n';
            continue;
        }
        std::cout << " (" << info.definition;
        if (info.needsReference && known.uncertainty[limit.measure] > 0) {
            std::cout << "; the reference is uncertain by " << roundedText(known.uncertainty[limit.measure], 2);
        }
        std::cout << ")\n";
    }
    std::cout << std::flush;
}

/// The scene with the recommended settings.
bool writeTuned(const Task& task, const tune::Config& config, std::string& error) {
    const std::string path = task.directory + "/tuned.json";
    std::ofstream file(path, std::ios::binary);
    file << writeScene(tune::withConfig(task.options.subject.scene, config));
    file.close();
    if (!file) {
        error = path + ": cannot be written";
    }
    return error.empty();
}

int printAdvice(const Task& task, const tune::Knowledge& known, std::string& error) {
    const tune::Subject& subject = task.options.subject;
    const tune::Verdict verdict = tune::judge(subject, known, task.options.limits);
    std::cout << '\n';
    tune::writeTable(std::cout, subject, task.options.limits, known, verdict);
    const std::string plotted = tune::plotRows(task.directory, subject, task.options.limits, known, verdict, error);
    if (!error.empty()) {
        return kExitBadInput;
    }
    std::cout << '\n';
    if (verdict.recommended < 0) {
        std::cout << "None of " << known.rows.size() << " settings keeps these errors.";
        if (verdict.nearest >= 0) {
            const tune::Row& row = known.rows[static_cast<std::size_t>(verdict.nearest)];
            std::cout << " Nearest: " << tune::settingsText(subject, row.config);
        }
        std::cout << "\nrows   " << task.directory << "/tune.csv\n" << plotted << '\n';
        return kNotKept;
    }
    const tune::Row& row = known.rows[static_cast<std::size_t>(verdict.recommended)];
    std::cout << "Recommended: " << tune::settingsText(subject, row.config);
    const tune::Row* const own = known.find(tune::ownConfig(subject.scene));
    if (own != nullptr && own->cost > 0 && row.cost > 0) {
        std::cout << ": " << roundedText(row.cost / own->cost, 2) << " of what the scene costs now";
    }
    std::cout << '\n';
    if (!writeTuned(task, row.config, error)) {
        return kExitBadInput;
    }
    std::cout << "scene  " << task.directory << "/tuned.json"
              << (row.config.engine == tune::Engine::f64 ? " (with --precision f64)" : "") << "\nrows   "
              << task.directory << "/tune.csv (" << known.rows.size() << ")\n"
              << plotted << '\n';
    return kExitDone;
}

/// Rows of other files become part of this one's.
void keepInStore(const tune::Subject& subject, const tune::Knowledge& there, const tune::Knowledge& known,
                 tune::Store& store) {
    if (!there.hasReference) {
        store.append(tune::csvLineOfReference(subject, known));
    }
    for (const tune::Row& row : known.rows) {
        if (there.find(row.config) == nullptr) {
            store.append(tune::csvLine(subject, row));
        }
    }
}

int tuneScene(const TuneArguments& arguments) {
    const auto team = tune::makeTeam();
    const bool isFirst = team->rank() == 0;
    const auto refuseOnce = [isFirst](const std::string& text) { return isFirst ? refuse(text) : kExitBadInput; };
    Task task;
    std::string error;
    if (!readTask(arguments, *team, task, error)) {
        return refuseOnce(error);
    }
    const tune::Subject& subject = task.options.subject;
    tune::Store store(task.directory, task.options.shard);
    tune::Knowledge there;
    tune::Knowledge known;
    if (!store.read(subject, false, there, error) || !store.read(subject, arguments.gather, known, error)) {
        return refuseOnce(error);
    }
    tune::ProgressBar bar("tuning " + task.source, isFirst);
    tune::LazyReference reference(subject);
    if (!known.hasReference) {
        reference.tell(known, [&bar](int halving, int most) {
            bar.show("reference", static_cast<std::size_t>(halving - 1), static_cast<std::size_t>(most));
        });
    }
    tune::addImplied(task.options.limits, subject, known);
    error = tune::whyMeaningless(subject, task.options.limits, known);
    if (!error.empty() || (isFirst && !store.open(error))) {
        bar.clear();
        return refuseOnce(error);
    }
    if (isFirst) {
        bar.clear();
        printHead(task, known);
        keepInStore(subject, there, known, store);
    }
    tune::tune(task.options, reference, *team, isFirst ? &store : nullptr, known,
               [&bar](std::size_t done, std::size_t all) { bar.show("runs", done, all); });
    bar.clear();
    if (!isFirst) {
        return kExitDone;
    }
    if (!store.good()) {
        return refuse(store.path() + ": could not be written to the end");
    }
    if (!task.options.shard.isWhole()) {
        std::cout << "shard " << arguments.shard << " is done: " << known.rows.size() << " rows in " << store.path()
                  << "; when all are, the same command with --gather instead of --shard\n";
        return kExitDone;
    }
    const int code = printAdvice(task, known, error);
    return error.empty() ? code : refuse(error);
}

}  // namespace

void addTuneCommand(Command app) {
    const Command command =
        app.command("tune", "The cheapest settings of a scene that keep an error you accept, and the whole trade");
    const auto arguments = std::make_shared<TuneArguments>();
    addSceneArguments(command, arguments->scene);
    std::string measures;
    for (const measures::MeasureInfo& info : measures::allMeasures()) {
        measures += std::string(measures.empty() ? "" : ", ") + info.name + " [" + info.unit + "]";
    }
    command.option("--max-error", arguments->limits, "An error that you accept; may be repeated. Measures: " + measures)
        .type("MEASURE=VALUE")
        .required()
        .oneValueEach();
    command.option("--out", arguments->out, "Directory for rows, plot and tuned scene [tune-NAME]").type("DIR");
    command.option("--threads", arguments->threads, "Runs at a time [all cores]").type("N").within(1, kMostThreads);
    command.option("--shard", arguments->shard, "Only the i-th of n parts of the work, into a file of its own")
        .type("i/n");
    command.flag("--gather", arguments->gather, "Take the rows of all shards, run what is missing, give the advice");
    command.runs([arguments] { return tuneScene(*arguments); });
}

}  // namespace swept
