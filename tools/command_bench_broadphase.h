#pragma once

#include <CLI/CLI.hpp>

namespace swept {

/// `swept bench broadphase` and `swept bench overlap`.
void addBenchBroadphase(CLI::App& bench, int& exitCode);

}  // namespace swept
