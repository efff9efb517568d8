#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace swept {

inline constexpr int kExitDone = 0;
inline constexpr int kExitNotFinite = 1;  ///< the run failed its own check
inline constexpr int kExitBadInput = 2;   ///< also: an output that cannot be written

/// Each adds a sub-command whose callback leaves its exit code in `exitCode`.
void addRunCommand(CLI::App& app, int& exitCode);
void addScenesCommand(CLI::App& app, int& exitCode);
void addQueryCommands(CLI::App& app, int& exitCode);
void addCompareCommand(CLI::App& app, int& exitCode);
void addInspectCommand(CLI::App& app, int& exitCode);
void addBenchCommand(CLI::App& app, int& exitCode);
/// `swept bench continuous`, below `bench`.
void addContinuousBench(CLI::App& bench, int& exitCode);
void addTuneCommand(CLI::App& app, int& exitCode);
void addModesCommand(CLI::App& app, int& exitCode);
/// The child's side of the reference engine; not listed in the help.
void addBox2dChildCommand(CLI::App& app, int& exitCode);

/// Prints "swept: <text>" to standard error. @return kExitBadInput
int refuse(const std::string& text);

/// The program's version, "0.1.0".
std::string versionText();

}  // namespace swept
