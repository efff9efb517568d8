#pragma once

#include <string>

#include "options.h"

namespace swept {

inline constexpr int kExitDone = 0;
inline constexpr int kExitNotFinite = 1;  ///< the run failed its own check
inline constexpr int kExitBadInput = 2;   ///< also: an output that cannot be written

/// Each adds a command, or a few, below the one given.
void addRunCommand(Command app);
void addScenesCommand(Command app);
void addQueryCommands(Command app);
void addCompareCommand(Command app);
void addInspectCommand(Command app);
void addBenchCommand(Command app);
/// `swept bench continuous`, below `bench`.
void addContinuousBench(Command bench);
void addModesCommand(Command app);
void addTuneCommand(Command app);
void addEnvelopeCommand(Command app);
/// The child's side of the reference engine; not listed in the help.
void addPeerChildCommand(Command app);

/// Prints "swept: <text>" to standard error. @return kExitBadInput
int refuse(const std::string& text);

/// The program's version, "0.1.0".
std::string versionText();

}  // namespace swept
