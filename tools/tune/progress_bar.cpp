#include "progress_bar.h"

#include <unistd.h>

#include <cstdio>
#include <utility>

namespace swept::tune {

ProgressBar::ProgressBar(std::string title, bool mayTalk)
    : title_(std::move(title)), talks_(mayTalk && isatty(STDERR_FILENO) == 1) {}

ProgressBar::~ProgressBar() { clear(); }

void ProgressBar::show(const std::string& what, std::size_t done, std::size_t all) {
    if (!talks_ || all == 0) { return; }
    constexpr std::size_t kWidth = 30;
    const std::size_t filled = kWidth * done / all;
    const std::string bar = std::string(filled, '#') + std::string(kWidth - filled, '-');
    std::fprintf(stderr, "\r\x1b[K%s [%s] %s %zu of %zu", title_.c_str(), bar.c_str(), what.c_str(), done, all);
    std::fflush(stderr);
    shown_ = true;
}

void ProgressBar::clear() {
    if (shown_) { std::fputs("\r\x1b[K", stderr); }
    shown_ = false;
}

}  // namespace swept::tune
