#pragma once

#include <memory>
#include <string>

#include "runner.h"

// Our engine as a runner, in each precision (world_runner.cpp, compiled twice). The namespaces are not inline here, so
// that both can be named: for files that include no header of the engine.
namespace swept::f32 {
std::unique_ptr<Runner> makeWorldRunner(const SceneDescription& scene, const RunnerOptions& options,
                                        std::string& error);
}
namespace swept::f64 {
std::unique_ptr<Runner> makeWorldRunner(const SceneDescription& scene, const RunnerOptions& options,
                                        std::string& error);
}
