#include "progress.h"

#include <unistd.h>

#include <cstdio>
#include <utility>

namespace swept {

Progress::Progress(std::string what, std::int64_t steps)
    : what_(std::move(what)),
      steps_(steps),
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
    std::fprintf(stderr, "\r\x1b[K%s: step %lld of %lld, %.0f s left", what_.c_str(), static_cast<long long>(step),
                 static_cast<long long>(steps_), left);
    std::fflush(stderr);
}

}  // namespace swept
