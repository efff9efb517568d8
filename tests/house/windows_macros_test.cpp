#include <gtest/gtest.h>

#include <algorithm>
#include <regex>

#include "code_scanner.h"
#include "source_tree.h"

/// Games include <windows.h> before our headers, and that defines some short words as macros. What is installed does
/// not use them: `(std::min)(a, b)` is no call of a macro, `std::min(a, b)` is.

namespace swept::house {
namespace {

/// Laid down by the package: all headers of these layers, of the engine those at its top.
bool isInstalled(const std::string& path) {
    if (!path.ends_with(".h") || path.starts_with("solver/")) { return false; }
    return !path.starts_with("engine/") || std::count(path.begin(), path.end(), '/') == 1;
}

TEST(InstalledHeaders, SurviveTheMacrosOfWindows) {
    const std::regex macro(
        "\\b(min|max)\\s*\\(|\\b(near|far|small|hyper|interface|IN|OUT|OPTIONAL|CONST|VOID|ERROR|DELETE|STRICT)\\b");
    int headers = 0;
    for (const std::string& folder : kLibraryFolders) {
        for (const SourceFile& file : cppFilesIn(folder)) {
            if (!isInstalled(file.path)) { continue; }
            ++headers;
            const std::string code = codeOnly(file.text);
            for (auto at = std::sregex_iterator(code.begin(), code.end(), macro); at != std::sregex_iterator(); ++at) {
                ADD_FAILURE() << file.path << " says " << at->str() << ", line "
                              << 1 + std::count(code.begin(), code.begin() + at->position(), '\n');
            }
        }
    }
    EXPECT_GT(headers, 80) << "the scan found hardly anything";
}

}  // namespace
}  // namespace swept::house
