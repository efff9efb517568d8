#include "bench_run.h"

#include <fstream>
#include <iostream>

#include "../bench/machine.h"
#include "../writers/output_files.h"
#include "commands.h"

namespace swept {

int runBench(const BenchPlaces& places, const BenchRun& run) {
    OutputFiles files;
    files.addFile("--csv", places.csv);
    for (const auto& [option, path] : places.others) { files.addFile(option, path); }
    if (!places.plots.empty()) { files.addDirectory("--plots", places.plots); }
    std::string error;
    if (!files.open(error)) { return refuse(error); }
    std::cout << bench::machineText() << '\n' << run.title << '\n' << std::flush;
    run.measure();
    std::cout << std::flush;
    if (std::ostream* const csv = files.stream(places.csv)) { run.writeCsv(*csv); }
    for (const auto& [option, path] : places.others) {
        if (std::ostream* const file = files.stream(path)) { run.writeOther(option, *file); }
    }
    if (!files.close(error)) { return refuse(error); }
    if (places.plots.empty()) { return kExitDone; }
    const std::string told = run.plot(places.plots, error);
    if (!error.empty()) { return refuse("--plots " + error); }
    std::cout << told << '\n';
    return kExitDone;
}

}  // namespace swept
