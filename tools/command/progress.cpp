#include "progress.h"

#include <unistd.h>

#include <cstdio>
#include <utility>

#include "../writers/number_text.h"

namespace swept {

Progress::Progress(std::string what, std::int64_t steps, double dt)
    : what_(std::move(what)),
      steps_(steps),
      dt_(dt),
      onTerminal_(isatty(STDERR_FILENO) == 1),
      start_(Clock::now()),
      next_(start_ + std::chrono::seconds(1)) {}

Progress::~Progress() {
    if (shown_) { std::fputs("\r\x1b[K", stderr); }  // leaves an empty line for what comes next
}

void Progress::update(std::int64_t step) {
    if (!onTerminal_) { return; }
    const Clock::time_point now = Clock::now();
    if (now < next_) { return; }
    next_ = now + std::chrono::milliseconds(200);
    shown_ = true;
    const double spent = std::chrono::duration<double>(now - start_).count();
    const double left = step > 0 ? spent * static_cast<double>(steps_ - step) / static_cast<double>(step) : 0;
    const auto timeOf = [this](std::int64_t steps) { return roundedText(dt_ * static_cast<double>(steps), 3); };
    const std::string simulated = dt_ > 0 ? ", " + timeOf(step) + " of " + timeOf(steps_) + " s simulated" : "";
    std::fprintf(stderr, "\r\x1b[K%s: step %lld of %lld%s, %.0f s left", what_.c_str(), static_cast<long long>(step),
                 static_cast<long long>(steps_), simulated.c_str(), left);
    std::fflush(stderr);
}

}  // namespace swept
