#pragma once

#include <span>
#include <string>
#include <vector>

#include "../measures/measure.h"
#include "config.h"

namespace swept::tune {

/// What one set of settings costs, and how far it is off.
struct Row {
    Config config;
    std::string verdict;  ///< empty when the run went well; "not finite", "aborted", "refused"
    double cost = 0;  ///< s of processor time per simulated second: the fastest of a few runs that measure nothing else
    double work = 0;  ///< the same, guessed from what the engine counted: no clock in it, so a search may go by it
    measures::Values errors;
};

/// Work of the same engine within this factor counts as equal: what is counted leaves out as much.
inline constexpr double kWorkNoise = 1.05;

/// The scene and the length that rows belong to.
struct Subject {
    SceneDescription scene;
    std::int64_t ticks = 0;  ///< even, so that steps twice as long end where the others do

    /// The same for the same scene and length: 16 hexadecimal digits (64-bit FNV-1a of its JSON).
    std::string fingerprint() const;
};

/// What tune knows: rows, and the uncertainty of the reference that their errors are measured against.
struct Knowledge {
    std::vector<Row> rows;
    bool hasReference = false;
    std::string reference;  ///< where it comes from
    measures::Values uncertainty;

    const Row* find(const Config& config) const;
    /// Leaves out what is there already.
    void add(const Knowledge& more);
};

/// The header line of a file of rows, with its line feed.
std::string csvHeader();
std::string csvLine(const Subject& subject, const Row& row);
/// The reference as a record: its uncertainties stand where errors stand.
std::string csvLineOfReference(const Subject& subject, const Knowledge& known);

/// Reads a file of rows. A last line that was cut off is left out.
/// @return false, and a line in `error`, when it is not such a file or belongs to another scene or length.
bool parseCsv(const std::string& text, const std::string& file, const Subject& subject, Knowledge& known,
              std::string& error);

}  // namespace swept::tune
