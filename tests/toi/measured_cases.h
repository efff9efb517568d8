#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "oracle.h"

namespace swept::test {

/// One of 300 queries of 15 families with certified brackets of the truth (data/toi_cases.jsonl, data/toi_truth.jsonl).
/// The truth brackets the first time at which the separation falls to a level: 0 (`contact`), or `target` (`atTarget`),
/// each with a `status` "hit", "miss", "overlap" (so from the start) or "graze" (undecidable); and its minimum
/// (`minSep`).
struct MeasuredCase {
    Query query;
    nlohmann::json truth;
    std::string id;
    std::string family;
};

std::vector<MeasuredCase> readMeasuredCases();

}  // namespace swept::test
