#pragma once

#include <CLI/CLI.hpp>

namespace swept {

/// `swept bench accuracy`.
void addBenchAccuracy(CLI::App& bench, int& exitCode);

}  // namespace swept
