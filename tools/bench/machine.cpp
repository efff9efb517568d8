#include "machine.h"

#include <fstream>
#include <thread>

namespace swept::bench {
namespace {

/// As Linux tells it.
std::string processorName() {
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);) {
        const std::size_t colon = line.find(": ");
        if (line.starts_with("model name") && colon != std::string::npos) { return line.substr(colon + 2); }
    }
    return "unknown processor";
}

std::string compilerName() {
#if defined(__clang__)
    return "clang " __clang_version__;
#elif defined(__GNUC__)
    return "GCC " __VERSION__;
#else
    return "unknown compiler";
#endif
}

}  // namespace

std::string machineText() {
    const std::string buildType = SWEPT_BUILD_TYPE;
    return processorName() + ", " + std::to_string(std::thread::hardware_concurrency()) + " threads; " +
           compilerName() + ", " + (buildType.empty() ? "no build type" : buildType) + " build";
}

}  // namespace swept::bench
