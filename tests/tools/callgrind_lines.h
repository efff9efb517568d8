#pragma once

#include <map>
#include <string>
#include <utility>

namespace swept {

/// Instructions executed on a line of source: file and number, from 1.
using LineCosts = std::map<std::pair<std::string, int>, long long>;

/// Reads what callgrind wrote. Costs are the lines' own: those of calls count where the called code stands, and inlined
/// code counts where it was written.
/// @param text  a file of one thread, with line numbers, absolute or relative
LineCosts readCallgrind(const std::string& text);

}  // namespace swept
