#pragma once

#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "code_scanner.h"

namespace swept::house {

/// A text file of the repository.
struct SourceFile {
    std::string path;  ///< from the source root, with forward slashes
    std::string text;
};

/// The root of the tree under test.
std::filesystem::path sourceRoot();

/// Folders that hold our sources.
inline constexpr const char* kSourceFolders[] = {"shapes", "broadphase", "toi",   "solver",
                                                 "engine", "samples",    "tools", "tests"};

/// Those of the libraries.
inline const std::set<std::string> kLibraryFolders = {"shapes", "broadphase", "toi", "solver", "engine"};

/// C++ files (.h and .cpp) in a folder of the root and below, sorted by path.
std::vector<SourceFile> cppFilesIn(const std::string& folder);

/// C++ files of all source folders.
std::vector<SourceFile> allCppFiles();

/// Every file that belongs to the repository: as git lists them, or where there is no git all but build trees, output
/// and dot-folders. Paths from the root.
std::vector<std::string> repositoryFiles();

std::string readText(const std::filesystem::path& path);

/// The file of our own that an include names, from the source root; empty when it names a foreign one.
std::string includedFile(const SourceFile& file, const Include& include);

}  // namespace swept::house
