#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace swept {

/// A line on stderr that counts a long run's steps and simulated seconds. Silent when stderr is no terminal, and during
/// the first second.
class Progress {
public:
    /// @param dt  simulated seconds of a step; 0: none are told
    Progress(std::string what, std::int64_t steps, double dt = 0);
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void update(std::int64_t step);

private:
    using Clock = std::chrono::steady_clock;
    std::string what_;
    std::int64_t steps_;
    double dt_;
    bool onTerminal_;
    bool shown_ = false;
    Clock::time_point start_;
    Clock::time_point next_;
};

}  // namespace swept
