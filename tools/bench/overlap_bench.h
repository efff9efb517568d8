#pragma once

#include <cstdint>
#include <iosfwd>
#include <span>
#include <string>
#include <vector>

namespace swept::bench {

/// One rung of the ladder of bounding volumes on one family of pairs.
struct OverlapRow {
    std::string family;
    std::string rung;
    double nanoseconds = 0;  ///< a pair: the fastest of several passes
    double passing = 0;      ///< share of the pairs that it lets through
    double falseShare = 0;   ///< of the pairs that do not touch, those that it lets through
    double withGjk = 0;      ///< nanoseconds a pair if GJK judges what it lets through
    bool missesNone = true;  ///< lets every touching pair through
};

struct OverlapBenchSettings {
    int count = 2000;  ///< pairs a family
    std::uint64_t seed = 1;
    int passes = 15;
};

/// Every rung on every family. The pairs are what a broadphase hands over: placed anywhere where their enlarged boxes
/// overlap.
std::vector<OverlapRow> benchOverlap(const OverlapBenchSettings& settings);

void writeOverlapTable(std::ostream& out, std::span<const OverlapRow> rows);
void writeOverlapCsv(std::ostream& out, std::span<const OverlapRow> rows, const OverlapBenchSettings& settings);
/// @return what was drawn, or why not; `error` when something could not be written
std::string plotOverlap(const std::string& directory, std::span<const OverlapRow> rows, std::string& error);

}  // namespace swept::bench
