#pragma once

#include <iosfwd>
#include <string>

#include "../writers/report_writer.h"
#include "options.h"
#include "scene_source.h"

namespace swept {

/// `--json` of a command: what it found, for other programs; "-" is standard output.
/// @param what  ends the sentence of the help: "All findings"
void addJsonArgument(Command command, std::string& file, const std::string& what);

/// Where people are told, then: not in the midst of what another program reads.
std::ostream& toldBeside(const std::string& json);

/// What is run, for the head of the JSON.
RunFacts factsOf(const LoadedScene& loaded);

}  // namespace swept
