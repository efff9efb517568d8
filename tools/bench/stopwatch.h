#pragma once

#include <ctime>

#include <algorithm>
#include <chrono>

namespace swept::bench {

/// Time of this thread: wall clock where that is less, since it is read faster; processor time where the thread was
/// interrupted.
class Stopwatch {
public:
    Stopwatch() : processor_(processorSeconds()), wall_(Clock::now()) {}

    struct Times {
        double own = 0;   ///< of this thread, seconds
        double wall = 0;  ///< by the wall clock alone, seconds
    };
    Times times() const {
        const double wall = std::chrono::duration<double>(Clock::now() - wall_).count();
        return {std::min(wall, processorSeconds() - processor_), wall};
    }
    double seconds() const { return times().own; }

private:
    using Clock = std::chrono::steady_clock;

    static double processorSeconds() {
        std::timespec now{};
        clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
        return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
    }

    double processor_;
    Clock::time_point wall_;
};

}  // namespace swept::bench
