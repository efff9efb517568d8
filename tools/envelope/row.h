#pragma once

#include <optional>
#include <string>
#include <vector>

#include "../tune/config.h"
#include "slice.h"

namespace swept::envelope {

/// A cell as one engine runs it.
struct Row {
    double x = 0;
    double y = 0;
    tune::Engine engine = tune::Engine::f32;
    double value = 0;     ///< error of the worst run; infinite when one of them has a verdict
    std::string verdict;  ///< empty when all went well; "not finite", "aborted", "never arrived", or what was refused

    bool isInside(const Slice& slice) const { return verdict.empty() && value <= slice.bound; }
};

/// Runs a cell of a slice.
Row runCell(const Slice& slice, double x, double y, tune::Engine engine);

/// The header line of a slice's file, with its line feed: it names the slice and its bound.
std::string csvHeader(const Slice& slice);
std::string csvLine(const Slice& slice, const Row& row);

/// The rows of one slice.
class Rows {
public:
    const Row* find(double x, double y, tune::Engine engine) const;
    /// Does nothing when the cell is there already.
    void add(const Row& row);
    std::size_t size() const { return rows_.size(); }

    /// Adds the rows of a file. A last line that was cut off is left out.
    /// @return false, and a line in `error`, when it is not such a file or of another slice
    bool parse(const Slice& slice, const std::string& text, const std::string& file, std::string& error);

private:
    std::vector<Row> rows_;
};

/// The largest x up to which all of a line of the map is inside; nothing when its first cell is not, or is not there.
std::optional<double> limitOf(const Slice& slice, const Rows& rows, double y, tune::Engine engine);

/// A line of the map: '#' inside, '.' outside, '?' not there; x ascending.
std::string lineOf(const Slice& slice, const Rows& rows, double y, tune::Engine engine);

}  // namespace swept::envelope
