#pragma once

#include <cstdint>
#include <string>

namespace swept::bench {

enum class GnuplotState : std::uint8_t { drawn, notInstalled, refused };

/// Runs the gnuplot of the search path on a script, inside a directory.
GnuplotState runGnuplot(const std::string& directory, const std::string& script);

}  // namespace swept::bench
