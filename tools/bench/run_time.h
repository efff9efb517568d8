#pragma once

#include <cstdint>
#include <functional>
#include <memory>

#include <swept/samples/runner.h>

namespace swept::bench {

/// Processor time of a run, s: the fastest of three, each by a runner of its own, as an interruption only makes one
/// slower. Long runs are timed less often.
/// @param make  a runner that measures nothing else; one that is null ends the measurement
double fastestRun(const std::function<std::unique_ptr<Runner>()>& make, std::int64_t steps);

}  // namespace swept::bench
