#pragma once

#include <cstddef>
#include <string>

namespace swept::tune {

/// A bar on standard error that fills as work is done. Silent when that is no terminal, or when told to be.
class ProgressBar {
public:
    ProgressBar(std::string title, bool mayTalk);
    ~ProgressBar();
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    void show(const std::string& what, std::size_t done, std::size_t all);
    /// Takes the bar away, so that something else can be printed.
    void clear();

private:
    std::string title_;
    bool talks_;
    bool shown_ = false;
};

}  // namespace swept::tune
