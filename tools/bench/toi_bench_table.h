#pragma once

#include <iosfwd>
#include <span>
#include <string>

#include "toi_bench.h"

namespace swept::bench {

/// A method over all its families.
struct ToiBenchTotal {
    std::string method;
    ToiTally tally;
    int families = 0;        ///< on which it was asked at all
    double nanoseconds = 0;  ///< geometric mean over these families
    double ratio = 0;        ///< geometric mean of its time over that of `certified` on the same families
};

/// One for each method, in the order of the first family's rows.
std::vector<ToiBenchTotal> totalsOf(std::span<const ToiBenchRow> rows);

/// For a terminal: a block of lines for each family, at the end one of all families together.
void writeToiTable(std::ostream& out, std::span<const ToiBenchRow> rows);

/// A record for each row of the table (without the totals), under a header. Numbers read back exactly.
void writeToiCsv(std::ostream& out, std::span<const ToiBenchRow> rows, const ToiBenchSettings& settings);

}  // namespace swept::bench
