#include "survey.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <sstream>

#include "../tune/team.h"

namespace swept::envelope {
namespace {

namespace fs = std::filesystem;

bool readRows(const Slice& slice, const fs::path& path, Rows& rows, std::string& error) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream all;
    all << file.rdbuf();
    if (!file || fs::is_directory(path)) {
        error = path.string() + ": cannot be read";
        return false;
    }
    return rows.parse(slice, all.str(), path.string(), error);
}

fs::path pathOf(const Slice& slice, const SurveyOptions& options) {
    const tune::Shard& shard = options.shard;
    const std::string part =
        shard.isWhole() ? "" : '.' + std::to_string(shard.index + 1) + "-of-" + std::to_string(shard.count);
    return fs::path(options.directory) / (slice.name + part + ".csv");
}

/// The slice's own file, and for the whole those of its parts.
bool readKnown(const Slice& slice, const SurveyOptions& options, Rows& own, Rows& all, std::string& error) {
    std::error_code ignored;
    const fs::path path = pathOf(slice, options);
    if (fs::exists(path, ignored) && !readRows(slice, path, own, error)) { return false; }
    all = own;
    if (!options.shard.isWhole()) { return true; }
    std::vector<fs::path> parts;
    for (const fs::directory_entry& entry : fs::directory_iterator(options.directory, ignored)) {
        const std::string name = entry.path().filename().string();
        if (name.starts_with(slice.name + '.') && name.ends_with(".csv") && name.find("-of-") != std::string::npos) {
            parts.push_back(entry.path());
        }
    }
    std::sort(parts.begin(), parts.end());
    return std::all_of(parts.begin(), parts.end(),
                       [&](const fs::path& part) { return readRows(slice, part, all, error); });
}

/// Opens for appending, without a last line that was cut off.
bool openRows(const Slice& slice, const SurveyOptions& options, std::ofstream& file, std::string& error) {
    std::error_code failure;
    fs::create_directories(options.directory, failure);
    const fs::path path = pathOf(slice, options);
    std::string text;
    if (fs::exists(path, failure)) {
        std::ostringstream all;
        all << std::ifstream(path, std::ios::binary).rdbuf();
        text = all.str();
        const std::size_t whole = text.rfind('\n');
        text.resize(whole == std::string::npos ? 0 : whole + 1);
        // Half a header is no header.
        text.resize(text.size() < csvHeader(slice).size() ? 0 : text.size());
        fs::resize_file(path, text.size(), failure);
    }
    errno = 0;
    file.open(path, std::ios::binary | std::ios::app);
    if (text.empty()) { file << csvHeader(slice) << std::flush; }
    if (!file) {
        error = path.string() + ": cannot be written: " + std::strerror(errno);
        return false;
    }
    return true;
}

std::vector<Row> wantedOf(const Slice& slice, const SurveyOptions& options) {
    std::vector<Row> wanted;
    std::size_t number = 0;
    for (const tune::Engine engine : options.engines) {
        for (const double y : slice.y.values) {
            for (const double x : slice.x.values) {
                if (options.shard.has(number++)) { wanted.push_back({x, y, engine, 0, ""}); }
            }
        }
    }
    return wanted;
}

}  // namespace

bool survey(const Slice& slice, const SurveyOptions& options, Rows& rows,
            const std::function<void(std::size_t done, std::size_t all)>& watch, std::string& error) {
    Rows own;
    std::ofstream file;
    if (!readKnown(slice, options, own, rows, error) || !openRows(slice, options, file, error)) { return false; }
    std::vector<Row> missing;
    for (const Row& cell : wantedOf(slice, options)) {
        const Row* const known = rows.find(cell.x, cell.y, cell.engine);
        if (known == nullptr) {
            missing.push_back(cell);
        } else if (own.find(cell.x, cell.y, cell.engine) == nullptr) {
            file << csvLine(slice, *known);
        }
    }
    std::mutex mutex;
    std::size_t done = 0;
    // In the order of the map, whichever thread is faster: a row waits for those before it.
    std::vector<bool> isDone(missing.size());
    std::size_t written = 0;
    tune::runParallel(missing.size(), options.threads, [&](std::size_t i) {
        const Row row = runCell(slice, missing[i].x, missing[i].y, missing[i].engine);
        const std::lock_guard lock(mutex);
        missing[i] = row;
        isDone[i] = true;
        for (; written < missing.size() && isDone[written]; ++written) { file << csvLine(slice, missing[written]); }
        file << std::flush;
        rows.add(row);
        watch(++done, missing.size());
    });
    if (!file.flush()) { error = pathOf(slice, options).string() + ": could not be written to the end"; }
    return error.empty();
}

}  // namespace swept::envelope
