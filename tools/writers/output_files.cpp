#include "output_files.h"

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <utility>

#include <swept/samples/begun_file.h>

namespace swept {
namespace {

namespace fs = std::filesystem;

bool samePlace(const std::string& a, const std::string& b) {
    std::error_code error;
    const fs::path canonicalA = fs::weakly_canonical(fs::absolute(a, error), error);
    const fs::path canonicalB = fs::weakly_canonical(fs::absolute(b, error), error);
    return canonicalA == canonicalB || fs::equivalent(a, b, error);
}

/// Whether writing truncates something that can be lost: pipes and devices may be named twice.
bool isDevice(const std::string& path) {
    std::error_code ignored;
    const fs::file_status status = fs::status(path, ignored);
    return fs::exists(status) && !fs::is_regular_file(status) && !fs::is_directory(status);
}

/// Whether standard output goes into this very file: one would write over the other. (A pipe gets both in turn.)
bool isStandardOutput(const std::string& path) {
    std::error_code ignored;
    return !isDevice(path) && fs::equivalent(path, "/dev/stdout", ignored);
}

}  // namespace

void OutputFiles::protect(const std::string& path) {
    if (!path.empty()) { protected_.push_back(path); }
}

void OutputFiles::addFile(const std::string& flag, const std::string& path) {
    if (!path.empty()) { files_.push_back({flag, path, {}, {}}); }
}

void OutputFiles::addStream(const std::string& flag, const std::string& path) {
    addFile(flag, path);
    if (path == "-") { files_.back().isStandardOutput = true; }
}

void OutputFiles::addDirectory(const std::string& flag, const std::string& path,
                               std::function<bool(const std::string& name)> writes) {
    if (!path.empty()) { directories_.push_back({flag, path, {}, std::move(writes)}); }
}

bool OutputFiles::open(std::string& error) {
    bool opened = refuseClashes(error);
    for (const Place& place : directories_) { opened = opened && openDirectory(place, error); }
    for (Place& place : files_) { opened = opened && openFile(place, error); }
    if (!opened) {
        discard();
        return false;
    }
    // Only now that all can be written is anything of an earlier run cut off.
    isBegun_ = true;
    for (Place& place : files_) {
        if (place.isStandardOutput || isDevice(place.path)) {
            continue;
        }  // whoever reads a pipe would take it for its end
        place.stream.close();
        place.stream.clear();
        place.stream.open(place.path, std::ios::binary | std::ios::trunc);
    }
    return true;
}

bool OutputFiles::refuseClashes(std::string& error) const {
    // There it would be mixed with what the command tells.
    const auto refuseStandardOutput = [&error](const Place& place) {
        if (place.path != "-" || place.isStandardOutput) { return false; }
        error = place.flag + " -: cannot write to standard output; give a name (\"./-\" for a file called \"-\")";
        return true;
    };
    if (std::any_of(files_.begin(), files_.end(), refuseStandardOutput) ||
        std::any_of(directories_.begin(), directories_.end(), refuseStandardOutput)) {
        return false;
    }
    for (const std::string& input : protected_) {
        if (const Place* const place = directoryWriting(input)) {
            error = place->flag + ' ' + place->path + ": would overwrite the input " + input;
            return false;
        }
    }
    const Place* piped = nullptr;
    for (const Place& place : files_) {
        if (!place.isStandardOutput) { continue; }
        if (piped != nullptr) {
            error = place.flag + " -: standard output is that of " + piped->flag + " already; give a name";
            return false;
        }
        piped = &place;
    }
    for (std::size_t i = 0; i < files_.size(); ++i) {
        if (files_[i].isStandardOutput || isDevice(files_[i].path)) { continue; }
        if (isStandardOutput(files_[i].path)) {
            error = files_[i].flag + ' ' + files_[i].path + ": is where standard output goes; give another name";
            return false;
        }
        for (const std::string& input : protected_) {
            if (!samePlace(files_[i].path, input)) { continue; }
            error = files_[i].flag + ' ' + files_[i].path + ": would overwrite the input";
            return false;
        }
        for (std::size_t j = 0; j < i; ++j) {
            if (files_[j].isStandardOutput || !samePlace(files_[i].path, files_[j].path)) { continue; }
            error = files_[i].flag + ' ' + files_[i].path + ": is already the file of " + files_[j].flag;
            return false;
        }
        if (const Place* const place = directoryWriting(files_[i].path)) {
            error = files_[i].flag + ' ' + files_[i].path + ": is already a file of " + place->flag + ' ' + place->path;
            return false;
        }
    }
    return true;
}

/// The directory into which a file of this path is written anyway; null: there is none.
const OutputFiles::Place* OutputFiles::directoryWriting(const std::string& file) const {
    std::error_code ignored;
    const std::string name = fs::weakly_canonical(fs::absolute(file, ignored), ignored).filename().string();
    const auto isWriting = [&](const Place& place) {
        return place.writes && place.writes(name) && samePlace((fs::path(place.path) / name).string(), file);
    };
    const auto found = std::find_if(directories_.begin(), directories_.end(), isWriting);
    return found == directories_.end() ? nullptr : &*found;
}

bool OutputFiles::openDirectory(const Place& place, std::string& error) {
    const fs::path path = fs::path(place.path).lexically_normal();
    fs::path partial;
    for (const fs::path& part : path) {
        partial /= part;
        std::error_code failure;
        const bool isNew = !part.empty() && fs::create_directory(partial, failure);
        if (isNew) { created_.push_back(partial.string()); }
        std::error_code ignored;
        if (!fs::is_directory(partial, ignored)) {
            const std::string reason = failure ? failure.message() : "Not a directory";
            error = place.flag + ' ' + place.path + ": cannot be made a directory: " + reason;
            return false;
        }
    }
    // What a directory's permissions are worth shows only when something is written.
    const std::string probe = (path / ".swept_probe").string();
    errno = 0;
    if (!std::ofstream(probe)) {
        error = place.flag + ' ' + place.path + ": cannot be written to: " + std::strerror(errno);
        return false;
    }
    std::error_code ignored;
    fs::remove(probe, ignored);
    return true;
}

bool OutputFiles::openFile(Place& place, std::string& error) {
    if (place.isStandardOutput) { return true; }
    std::error_code ignored;
    const bool existed = fs::exists(place.path, ignored);
    errno = 0;
    place.stream.open(place.path, std::ios::binary | std::ios::app);
    if (!place.stream) {
        error = place.flag + ' ' + place.path + ": cannot be written: " + std::strerror(errno);
        return false;
    }
    if (!existed) { created_.push_back(place.path); }
    return true;
}

std::ostream* OutputFiles::stream(const std::string& path) {
    for (Place& place : files_) {
        if (path.empty() || place.path != path) { continue; }
        return place.isStandardOutput ? &std::cout : static_cast<std::ostream*>(&place.stream);
    }
    return nullptr;
}

bool OutputFiles::isWritten(std::string& error) const {
    for (const Place& place : files_) {
        if (place.isStandardOutput ? static_cast<bool>(std::cout) : static_cast<bool>(place.stream)) { continue; }
        error = place.isStandardOutput ? "" : incomplete(place);
        return false;
    }
    return true;
}

bool OutputFiles::close(std::string& error) {
    for (Place& place : files_) {
        if (!place.stream.is_open()) { continue; }
        place.stream.close();
        if (place.stream) { continue; }
        error = incomplete(place);
        discard();
        return false;
    }
    return true;
}

std::string OutputFiles::incomplete(const Place& place) {
    return place.flag + ' ' + place.path + ": could not be written to the end";
}

void OutputFiles::discard() {
    for (Place& place : files_) {
        if (place.isStandardOutput) { continue; }
        place.stream.close();
        if (isBegun_ && !isDevice(place.path)) { removeBegunFile(place.path); }
    }
    std::error_code ignored;
    for (; !created_.empty(); created_.pop_back()) { fs::remove(created_.back(), ignored); }
}

}  // namespace swept
