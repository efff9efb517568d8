#include <algorithm>

#include "bench_world.h"
#include "commands.h"
#include "options.h"
#include "scene_source.h"

namespace {

void addCommands(swept::Command program) {
    swept::addRunCommand(program);
    swept::addScenesCommand(program);
    swept::addQueryCommands(program);
    swept::addCompareCommand(program);
    swept::addInspectCommand(program);
    swept::addBenchCommand(program);
    swept::addModesCommand(program);
    swept::addTuneCommand(program);
    swept::addEnvelopeCommand(program);
    swept::addPeerChildCommand(program);
    swept::addWorldChildCommand(program);
}

}  // namespace

int main(int argc, char** argv) {
    const swept::ProgramTexts texts{
        "swept", "Swept2D: 2D rigid-body physics with continuous collision, and you know what it costs.",
        "swept " + swept::versionText(),
        "\"swept COMMAND --help\" tells more. Exit codes: 0 done, 1 the run failed its own check, 2 bad input."};
    return swept::runProgram(texts, addCommands, swept::expandOverrides({argv + std::min(argc, 1), argv + argc}));
}
