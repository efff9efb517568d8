#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <set>

#include "source_tree.h"

namespace swept::house {
namespace {

namespace fs = std::filesystem;

TEST(TopLevel, HoldsWhatTheDesignNames) {
    const std::set<std::string> allowed = {
        "shapes",      "broadphase", "toi",       "solver",  "engine",         "samples",
        "tools",       "tests",      "README.md", "LICENSE", "CMakeLists.txt", "CMakePresets.json",
        "CHANGELOG.md"};
    std::set<std::string> found;
    for (const std::string& path : repositoryFiles()) { found.insert(path.substr(0, path.find('/'))); }
    for (const std::string& entry : found) {
        EXPECT_TRUE(entry.starts_with('.') || allowed.count(entry) != 0) << entry << " does not belong there";
    }
    for (const std::string& needed : allowed) { EXPECT_EQ(found.count(needed), 1U) << needed << " is missing"; }
}

TEST(Names, OfSourcesAreSnakeCase) {
    const std::regex snakeCase("[a-z][a-z0-9]*(_[a-z0-9]+)*\\.(h|cpp)");
    for (const SourceFile& file : allCppFiles()) {
        const std::string name = fs::path(file.path).filename().string();
        EXPECT_TRUE(std::regex_match(name, snakeCase)) << file.path;
    }
}

TEST(Texts, NameNoPlaceOfAParticularMachine) {
    // Spelled in pieces, so that this file does not accuse itself. A script may use /tmp through mktemp only.
    const std::string slash = "/";
    const std::vector<std::string> places = {slash + "home/", slash + "root/", slash + "work/", slash + "Users/",
                                             slash + "tmp/",  slash + "opt/",  slash + "mnt/"};
    const std::set<std::string> readable = {".h", ".cpp", ".txt", ".cmake", ".in", ".json", ".md", ".sh", ".jsonl", ""};
    for (const std::string& path : repositoryFiles()) {
        if (readable.count(fs::path(path).extension().string()) == 0) { continue; }
        const std::string text = readText(sourceRoot() / path);
        for (const std::string& place : places) {
            for (std::size_t at = text.find(place); at != std::string::npos; at = text.find(place, at + 1)) {
                // Inside a longer path (as in `a/opt/b`) it is no place of its own.
                const bool startsThere =
                    at == 0 || std::string_view(" \t\n\"'=(<:`").find(text[at - 1]) != std::string::npos;
                EXPECT_FALSE(startsThere)
                    << path << " names " << place << "…, line "
                    << 1 + std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n');
            }
        }
    }
}

/// A page without its fenced blocks: `[&](ShapeId)` in a program is no link.
std::string proseOf(const std::string& page) {
    const std::string fence = "\n```";
    std::string prose;
    std::size_t from = 0;
    for (std::size_t open = page.find(fence); open != std::string::npos; open = page.find(fence, from)) {
        prose += page.substr(from, open - from);
        const std::size_t close = page.find(fence, open + fence.size());
        EXPECT_NE(close, std::string::npos) << "a fenced block without an end";
        if (close == std::string::npos) { return prose; }
        from = close + fence.size();
    }
    return prose + page.substr(from);
}

TEST(Pages, LinkToWhatIsThere) {
    const std::regex link("\\]\\(([^)#]+)(#[^)]*)?\\)");
    int links = 0;
    for (const std::string& path : repositoryFiles()) {
        if (!path.ends_with(".md")) { continue; }
        const std::string text = proseOf(readText(sourceRoot() / path));
        for (auto at = std::sregex_iterator(text.begin(), text.end(), link); at != std::sregex_iterator(); ++at) {
            const std::string target = (*at)[1];
            if (target.find("://") != std::string::npos) { continue; }
            ++links;
            EXPECT_TRUE(fs::exists(sourceRoot() / fs::path(path).parent_path() / target))
                << path << " links to " << target;
        }
    }
    EXPECT_GT(links, 5);
}

/// Emscripten of Debian 12 comes with one that has none (shapes/bit_cast.h), and is not built in every run of the
/// tests.
TEST(Libraries, CastBitsWithoutTheStandardLibrary) {
    const std::vector<std::string> folders = {"shapes/", "toi/", "broadphase/", "solver/", "engine/"};
    int files = 0;
    for (const SourceFile& file : allCppFiles()) {
        const bool isOfLibrary = std::any_of(folders.begin(), folders.end(),
                                             [&](const std::string& folder) { return file.path.starts_with(folder); });
        if (!isOfLibrary || file.path == "shapes/bit_cast.h") { continue; }
        ++files;
        EXPECT_EQ(file.text.find("std::bit_cast"), std::string::npos) << file.path;
    }
    EXPECT_GT(files, 100);
}

TEST(Texts, HaveNoTrailingSpaceAndEndWithANewline) {
    for (const SourceFile& file : allCppFiles()) {
        EXPECT_TRUE(file.text.ends_with('\n')) << file.path;
        EXPECT_EQ(file.text.find(" \n"), std::string::npos) << file.path;
        EXPECT_EQ(file.text.find('\t'), std::string::npos) << file.path;
        EXPECT_EQ(file.text.find('\r'), std::string::npos) << file.path;
    }
}

}  // namespace
}  // namespace swept::house
