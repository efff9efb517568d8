#include <CLI/CLI.hpp>
#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "commands.h"
#include "scene_source.h"

namespace {

/// CLI11 explains some mistakes over several lines; ours take one.
std::string firstLine(const std::string& text) { return text.substr(0, text.find('\n')); }

}  // namespace

int main(int argc, char** argv) {
    CLI::App app("Swept2D: 2D rigid-body physics in which nothing tunnels, and you know what it costs.", "swept");
    app.set_version_flag("--version", "swept " + swept::versionText());
    app.require_subcommand(1);
    app.footer("\"swept COMMAND --help\" tells more. Exit codes: 0 done, 1 the run failed its own check, 2 bad input.");
    int exitCode = swept::kExitDone;
    swept::addRunCommand(app, exitCode);
    swept::addScenesCommand(app, exitCode);
    swept::addQueryCommands(app, exitCode);
    swept::addCompareCommand(app, exitCode);
    swept::addInspectCommand(app, exitCode);
    swept::addBenchCommand(app, exitCode);
    swept::addModesCommand(app, exitCode);
    swept::addTuneCommand(app, exitCode);
    swept::addBox2dChildCommand(app, exitCode);
    std::vector<std::string> arguments = swept::expandOverrides({argv + std::min(argc, 1), argv + argc});
    if (arguments.empty()) {
        return swept::refuse("no command given (\"swept --help\" lists them)");
    }
    const auto isFirst = [&](const CLI::App* command) { return command->get_name() == arguments[0]; };
    if (!arguments[0].starts_with('-') && std::as_const(app).get_subcommands(isFirst).empty()) {
        return swept::refuse(arguments[0] + ": no such command (\"swept --help\" lists them)");
    }
    std::reverse(arguments.begin(), arguments.end());  // CLI11 takes them from the back
    try {
        app.parse(arguments);
    } catch (const CLI::Success& helpOrVersion) {
        return app.exit(helpOrVersion);
    } catch (const CLI::ParseError& mistake) {
        return swept::refuse(firstLine(mistake.what()));
    }
    return exitCode;
}
