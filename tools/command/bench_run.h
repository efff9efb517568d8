#pragma once

#include <functional>
#include <iosfwd>
#include <string>
#include <utility>
#include <vector>

namespace swept {

/// Where a benchmark leaves more than its tables; empty: nowhere.
struct BenchPlaces {
    std::string csv;
    std::string plots;  ///< a directory
    /// Further files of it: the option that names one, and the path.
    std::vector<std::pair<std::string, std::string>> others;
};

/// What is particular about a benchmark. Each part has what `measure` found.
struct BenchRun {
    std::string title;              ///< what is measured, printed below the machine
    std::function<void()> measure;  ///< and prints the tables
    std::function<void(std::ostream&)> writeCsv;
    /// Writes the file of an option in `BenchPlaces::others`; may be empty when there are none.
    std::function<void(const std::string& option, std::ostream&)> writeOther;
    /// @return a line about what was drawn; one line in `error` when that failed
    std::function<std::string(const std::string& directory, std::string& error)> plot;
};

/// Opens all places before anything is measured, so that no hour of measuring ends at a wrong path.
/// @return exit code
int runBench(const BenchPlaces& places, const BenchRun& run);

}  // namespace swept
