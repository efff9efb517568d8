#include "store.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <filesystem>
#include <sstream>
#include <vector>

namespace swept::tune {
namespace {

namespace fs = std::filesystem;

bool readText(const fs::path& path, std::string& text, std::string& error) {
    std::ifstream file(path, std::ios::binary);
    std::ostringstream all;
    all << file.rdbuf();
    text = all.str();
    if (!file || fs::is_directory(path)) {
        error = path.string() + ": cannot be read";
        return false;
    }
    return true;
}

/// "tune.2-of-4.csv"
bool isOfShard(const std::string& name) {
    return name.starts_with("tune.") && name.ends_with(".csv") && name.find("-of-") != std::string::npos;
}

}  // namespace

bool parseShard(const std::string& text, Shard& shard, std::string& error) {
    const char* const end = text.data() + text.size();
    const auto [slash, failure] = std::from_chars(text.data(), end, shard.index);
    const bool hasIndex = failure == std::errc{} && slash != end && *slash == '/';
    const auto [stop, failed] = std::from_chars(hasIndex ? slash + 1 : end, end, shard.count);
    if (!hasIndex || failed != std::errc{} || stop != end || shard.index < 1 || shard.index > shard.count) {
        error = "--shard " + text + ": expected i/n with 1 <= i <= n, for example 2/4";
        return false;
    }
    --shard.index;
    return true;
}

Store::Store(std::string directory, const Shard& shard) : directory_(std::move(directory)) {
    const std::string part =
        shard.isWhole() ? "" : '.' + std::to_string(shard.index + 1) + "-of-" + std::to_string(shard.count);
    path_ = (fs::path(directory_) / ("tune" + part + ".csv")).string();
}

bool Store::read(const Subject& subject, bool gather, Knowledge& known, std::string& error) {
    std::vector<fs::path> files;
    std::error_code ignored;
    if (fs::exists(path_, ignored)) { files.emplace_back(path_); }
    if (gather) {
        if (!fs::is_directory(directory_, ignored)) {
            error = "--gather: " + directory_ + ": no such directory (--out names it)";
            return false;
        }
        for (const fs::directory_entry& entry : fs::directory_iterator(directory_)) {
            if (isOfShard(entry.path().filename().string())) { files.push_back(entry.path()); }
        }
        std::sort(files.begin(), files.end());
        if (files.empty()) {
            error = "--gather: " + directory_ + ": holds no file of rows";
            return false;
        }
    }
    for (const fs::path& file : files) {
        std::string text;
        if (!readText(file, text, error)) { return false; }
        // A run that was interrupted before its first line left nothing to be read.
        if (!text.empty() && !parseCsv(text, file.string(), subject, known, error)) { return false; }
    }
    return true;
}

bool Store::open(std::string& error) {
    std::error_code failure;
    fs::create_directories(directory_, failure);
    std::string text;
    if (fs::exists(path_, failure) && readText(path_, text, error)) {
        const std::size_t lastLine = text.rfind('\n');
        fs::resize_file(path_, lastLine == std::string::npos ? 0 : lastLine + 1, failure);
        text.resize(lastLine == std::string::npos ? 0 : lastLine + 1);
    }
    errno = 0;
    file_.open(path_, std::ios::binary | std::ios::app);
    if (!file_) {
        error = "--out " + directory_ + ": cannot be written: " + std::strerror(errno);
        return false;
    }
    if (text.empty()) { append(csvHeader()); }
    return true;
}

void Store::append(const std::string& line) {
    const std::lock_guard lock(mutex_);
    file_ << line << std::flush;
}

}  // namespace swept::tune
