#include "source_tree.h"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <memory>
#include <sstream>

namespace swept::house {

namespace fs = std::filesystem;

fs::path sourceRoot() { return SWEPT_SOURCE_ROOT; }

std::string readText(const fs::path& path) {
    std::ifstream in(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

std::string includedFile(const SourceFile& file, const Include& include) {
    if (include.quoted) {
        return (fs::path(file.path).parent_path() / include.target).lexically_normal().generic_string();
    }
    return include.target.starts_with("swept/") ? include.target.substr(6) : "";
}

std::vector<SourceFile> cppFilesIn(const std::string& folder) {
    std::vector<SourceFile> files;
    const fs::path top = sourceRoot() / folder;
    if (!fs::is_directory(top)) { return files; }
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(top)) {
        const std::string extension = entry.path().extension().string();
        if (!entry.is_regular_file() || (extension != ".h" && extension != ".cpp")) { continue; }
        files.push_back({fs::relative(entry.path(), sourceRoot()).generic_string(), readText(entry.path())});
    }
    std::sort(files.begin(), files.end(), [](const SourceFile& a, const SourceFile& b) { return a.path < b.path; });
    return files;
}

std::vector<SourceFile> allCppFiles() {
    std::vector<SourceFile> files;
    for (const char* const folder : kSourceFolders) {
        std::vector<SourceFile> some = cppFilesIn(folder);
        files.insert(files.end(), std::make_move_iterator(some.begin()), std::make_move_iterator(some.end()));
    }
    return files;
}

namespace {

struct ClosePipe {
    void operator()(std::FILE* pipe) const { pclose(pipe); }
};

/// What git lists; empty where there is no git or no repository.
std::vector<std::string> filesKnownToGit() {
    const std::string root = sourceRoot().string();
    const std::string command = "git -C '" + root + "' -c safe.directory='" + root + "' ls-files 2>/dev/null";
    std::vector<std::string> files;
    const std::unique_ptr<std::FILE, ClosePipe> pipe(popen(command.c_str(), "r"));
    if (pipe == nullptr) { return files; }
    std::string output;
    char buffer[4096];
    while (const std::size_t count = std::fread(buffer, 1, sizeof(buffer), pipe.get())) {
        output.append(buffer, count);
    }
    std::istringstream lines(output);
    for (std::string line; std::getline(lines, line);) {
        if (fs::exists(sourceRoot() / line)) { files.push_back(line); }
    }
    return files;
}

}  // namespace

std::vector<std::string> repositoryFiles() {
    if (fs::exists(sourceRoot() / ".git")) {
        std::vector<std::string> files = filesKnownToGit();
        if (!files.empty()) { return files; }
    }
    std::vector<std::string> files;
    for (auto at = fs::recursive_directory_iterator(sourceRoot()); at != fs::recursive_directory_iterator(); ++at) {
        const std::string name = at->path().filename().string();
        const bool isOurs = !name.starts_with("build") && name != "out" && (!name.starts_with('.') || name == ".ci");
        if (at->is_directory() && !isOurs) {
            at.disable_recursion_pending();
        } else if (at->is_regular_file()) {
            files.push_back(fs::relative(at->path(), sourceRoot()).generic_string());
        }
    }
    return files;
}

}  // namespace swept::house
