#pragma once

#include <fstream>
#include <mutex>
#include <string>

#include "row.h"

namespace swept::tune {

/// A part of the tracks: every `count`-th, from `index` on (0-based).
struct Shard {
    int index = 0;
    int count = 1;

    bool isWhole() const { return count == 1; }
    bool has(std::size_t track) const {
        return track % static_cast<std::size_t>(count) == static_cast<std::size_t>(index);
    }
};

/// @param text  "2/4"
/// @return false, and a line in `error`, when it is not one of 1/n … n/n
bool parseShard(const std::string& text, Shard& shard, std::string& error);

/// The file of rows in a directory: what is there is read, what is new is appended, line by line.
class Store {
public:
    Store(std::string directory, const Shard& shard);

    const std::string& path() const { return path_; }
    /// Reads what there is; with `gather` the files of all shards as well. Writes nothing.
    /// @return false, and a line in `error`, when a file cannot be read or is of another scene
    bool read(const Subject& subject, bool gather, Knowledge& known, std::string& error);
    /// Opens the file for appending, with its header if it is new, and without a last line that was cut off.
    bool open(std::string& error);
    /// Appends a line and hands it to the system at once; from any thread.
    void append(const std::string& line);
    /// Whether all could be written so far.
    bool good() const { return file_.good(); }

private:
    std::string directory_;
    std::string path_;
    std::ofstream file_;
    std::mutex mutex_;
};

}  // namespace swept::tune
