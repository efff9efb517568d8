#pragma once

#include <optional>

#include <swept/engine/task_system.h>

namespace swept::bench {

/// Seconds that a cache line takes from the processor of one worker to that of another: what two threads gain hangs on
/// it more than on anything they do. Within one group of cores of a server it is 30 to 60 ns, across groups 150 to
/// 200, and a virtual machine's cores may be moved from the one to the other at any time.
/// @return nothing where two workers are not there at the same time
std::optional<double> handOverSeconds(TaskSystem& tasks);

}  // namespace swept::bench
