#pragma once

#include <string>

namespace swept::bench {

/// Where and how a measurement was made: processor, number of threads, compiler, build type; one line, for a human.
std::string machineText();

}  // namespace swept::bench
