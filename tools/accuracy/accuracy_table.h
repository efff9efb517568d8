#pragma once

#include <iosfwd>
#include <span>

#include "accuracy_bench.h"

namespace swept::accuracy {

/// For a terminal: a table for each group, a line for each measure, a column for each contestant. Where a run did not
/// hold, the word for it stands in place of its numbers.
void writeTables(std::ostream& out, std::span<const Row> rows);

/// For a terminal: scene by scene, what each contestant's error costs, cheapest first.
void writeTradeTables(std::ostream& out, std::span<const Row> rows);

/// A record for each value, under a header; runs without values have one record with their verdict.
void writeCsv(std::ostream& out, std::span<const Row> rows);

}  // namespace swept::accuracy
