#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <memory>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "../envelope/map.h"
#include "../envelope/survey.h"
#include "../task_threads.h"
#include "../tune/progress_bar.h"
#include "../writers/output_files.h"
#include "commands.h"

namespace swept {
namespace {

struct EnvelopeArguments {
    std::string out = "envelope";
    std::vector<std::string> slices;
    std::string shard;
    bool coarse = false;
    bool box2d = false;
    int threads = 0;  ///< 0: all there are
};

bool readTask(const EnvelopeArguments& arguments, envelope::SurveyOptions& options, std::string& error) {
    options.directory = arguments.out;
    options.engines = {tune::Engine::f32, tune::Engine::f64};
    for (const tune::Engine engine : {tune::Engine::box2d, tune::Engine::box2d3}) {
        if (arguments.box2d && tune::isThere(engine)) { options.engines.push_back(engine); }
    }
    options.threads =
        arguments.threads > 0 ? arguments.threads : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    OutputFiles results;
    results.addDirectory("--out", arguments.out);
    if (!results.refuseClashes(error)) { return false; }
    return arguments.shard.empty() || tune::parseShard(arguments.shard, options.shard, error);
}

/// Those that were asked for.
std::vector<envelope::Slice> slicesOf(const EnvelopeArguments& arguments) {
    std::vector<envelope::Slice> slices =
        envelope::allSlices(arguments.coarse ? envelope::Grain::coarse : envelope::Grain::full);
    std::erase_if(slices, [&](const envelope::Slice& slice) {
        return !arguments.slices.empty() &&
               std::find(arguments.slices.begin(), arguments.slices.end(), slice.name) == arguments.slices.end();
    });
    return slices;
}

bool writeFile(const std::filesystem::path& path, const std::string& text, std::string& error) {
    std::ofstream file(path, std::ios::binary);
    file << text;
    file.close();
    if (!file) { error = path.string() + ": cannot be written"; }
    return error.empty();
}

int mapEnvelope(const EnvelopeArguments& arguments) {
    envelope::SurveyOptions options;
    std::string error;
    if (!readTask(arguments, options, error)) { return refuse(error); }
    std::ostringstream summary;
    std::string limits;
    std::string drawn;
    for (const envelope::Slice& slice : slicesOf(arguments)) {
        envelope::Rows rows;
        tune::ProgressBar bar(slice.name, true);
        const auto watch = [&bar](std::size_t done, std::size_t all) { bar.show("cells", done, all); };
        if (!envelope::survey(slice, options, rows, watch, error)) {
            bar.clear();
            return refuse(error);
        }
        if (options.shard.isWhole()) {
            envelope::writeSummary(summary, slice, rows, options.engines);
            limits += envelope::limitLines(slice, rows, options.engines);
            drawn += envelope::drawMap(arguments.out, slice, rows, options.engines, error) + '\n';
        }
        if (!error.empty()) { return refuse("--out " + error); }
    }
    if (!options.shard.isWhole()) {
        std::cout << "shard " << arguments.shard << " is done; when all are, the same command without --shard\n";
        return kExitDone;
    }
    const std::filesystem::path directory = arguments.out;
    if (!writeFile(directory / "summary.txt", summary.str(), error) ||
        !writeFile(directory / "limits.csv", "slice,engine,y,inside\n" + limits, error)) {
        return refuse("--out " + error);
    }
    std::cout << summary.str() << '\n' << drawn;
    return kExitDone;
}

}  // namespace

void addEnvelopeCommand(Command app) {
    const Command command =
        app.command("envelope", "Maps of what the engine can do: where errors stay within their bounds");
    const auto arguments = std::make_shared<EnvelopeArguments>();
    std::vector<std::string> names;
    for (const envelope::Slice& slice : envelope::allSlices(envelope::Grain::coarse)) { names.push_back(slice.name); }
    command
        .option("--out", arguments->out,
                "Directory for rows, maps, limits and summary; rows that are there are not run again [envelope]")
        .type("DIR");
    command.option("--slice", arguments->slices, "Only this map; may be repeated")
        .type("NAME")
        .oneOf(names)
        .oneValueEach();
    command.flag("--coarse", arguments->coarse, "Fewer cells, a few seconds of work");
    command.flag("--box2d", arguments->box2d,
                 "Box2D 2.4.1 as well, and Box2D 3 where it was found when this was built");
    command.option("--threads", arguments->threads, "Cells at a time [all cores]").type("N").within(1, kMostThreads);
    command.option("--shard", arguments->shard, "Only the i-th of n parts of the cells, into files of their own")
        .type("i/n");
    command.runs([arguments] { return mapEnvelope(*arguments); });
}

}  // namespace swept
