#pragma once

#include <functional>
#include <string>
#include <vector>

#include "../tune/store.h"
#include "row.h"

namespace swept::envelope {

struct SurveyOptions {
    std::string directory;
    std::vector<tune::Engine> engines;
    int threads = 1;
    tune::Shard shard;
};

/// Runs the cells of a slice that are not in its file yet, and appends them row by row: DIR/stack.csv, or of a part
/// DIR/stack.2-of-4.csv. The whole takes up the rows of all parts that lie there.
/// @param watch  called after each cell, with cells done and to be done
/// @return false, and a line in `error`, when a file cannot be read or written
bool survey(const Slice& slice, const SurveyOptions& options, Rows& rows,
            const std::function<void(std::size_t done, std::size_t all)>& watch, std::string& error);

}  // namespace swept::envelope
