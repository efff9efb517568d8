#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <vector>

#include "code_scanner.h"
#include "source_tree.h"

/// The arrows of the house: who may include whom, and in which form.

namespace swept::house {
namespace {

namespace fs = std::filesystem;

const std::map<std::string, std::set<std::string>> kAllowed = {
    {"shapes", {}},
    {"broadphase", {"shapes"}},
    {"toi", {"shapes"}},
    {"solver", {"shapes"}},
    {"engine", {"shapes", "broadphase", "toi", "solver"}},
    {"samples", {"shapes", "broadphase", "toi", "engine"}},
    {"tests/oracle", {"shapes", "toi"}},
    {"tools", {"shapes", "broadphase", "toi", "solver", "engine", "samples", "tests/oracle"}},
    {"tests", {"shapes", "broadphase", "toi", "solver", "engine", "samples", "tools", "tests/oracle"}},
};

/// The oracle is a folder of its own among the tests: the benchmarks of tools/ judge by it too.
std::string folderOf(const std::string& path) {
    const std::string oracle = "tests/oracle";
    return path.starts_with(oracle + '/') ? oracle : path.substr(0, path.find('/'));
}

/// Headers of the C++ standard library have plain names; the C ones end in .h.
bool isStandard(const std::string& target) {
    return target.find_first_not_of("abcdefghijklmnopqrstuvwxyz_0123456789") == std::string::npos;
}

TEST(IncludeEdges, PointOneWay) {
    int edges = 0;
    for (const SourceFile& file : allCppFiles()) {
        const std::string from = folderOf(file.path);
        for (const Include& include : includesIn(file.text)) {
            const std::string target = includedFile(file, include);
            if (target.empty()) { continue; }
            const std::string to = folderOf(target);
            ++edges;
            EXPECT_TRUE(fs::is_regular_file(sourceRoot() / target))
                << file.path << ':' << include.line << " includes " << include.target << ", which is not there";
            EXPECT_TRUE(to == from || kAllowed.at(from).count(to) != 0)
                << file.path << ':' << include.line << ": " << from << " may not include " << to;
        }
    }
    EXPECT_GT(edges, 100) << "the scan found hardly anything";
}

/// The folders of a step, from below: what stands in engine/ itself is public, and below all of them.
const std::vector<std::string> kFoldersOfEngine = {"containers", "crew",   "state", "image",   "bodies",
                                                   "contacts",   "modes",  "solve", "islands", "flight",
                                                   "advance",    "stages", "calls"};

/// In that order; 0 is the public folder.
std::size_t floorOf(const std::string& path) {
    const std::string inside = path.substr(path.find('/') + 1);
    const std::size_t slash = inside.find('/');
    if (slash == std::string::npos) { return 0; }
    const auto found = std::find(kFoldersOfEngine.begin(), kFoldersOfEngine.end(), inside.substr(0, slash));
    EXPECT_NE(found, kFoldersOfEngine.end()) << path << " has no floor";
    return 1 + static_cast<std::size_t>(found - kFoldersOfEngine.begin());
}

/// So data know nobody who works on them, and what stages are made of does not know when it is called.
TEST(IncludeEdges, InTheEngineComeFromAbove) {
    int edges = 0;
    for (const SourceFile& file : cppFilesIn("engine")) {
        for (const Include& include : includesIn(file.text)) {
            const std::string target = includedFile(file, include);
            if (!target.starts_with("engine/")) { continue; }
            ++edges;
            EXPECT_LE(floorOf(target), floorOf(file.path))
                << file.path << ':' << include.line << " includes " << include.target;
        }
    }
    EXPECT_GT(edges, 300) << "the scan found hardly anything";
}

TEST(IncludeEdges, OfTheLibraryAreRelativeOrStandard) {
    for (const std::string& folder : kLibraryFolders) {
        for (const SourceFile& file : cppFilesIn(folder)) {
            for (const Include& include : includesIn(file.text)) {
                if (include.quoted) { continue; }
                const bool isAdapter = file.path == "engine/tbb_task_system.cpp";  // a target of its own
                const bool isOfMsvc = include.target == "intrin.h";                // CompilerExtensions says where
                EXPECT_TRUE(isStandard(include.target) || include.target.starts_with("hwy/") || isOfMsvc ||
                            (isAdapter && include.target.starts_with("oneapi/tbb/")))
                    << file.path << ':' << include.line << " includes <" << include.target
                    << ">: a library folder includes its own kind by relative path, and else the standard library";
            }
        }
    }
}

TEST(IncludeEdges, OfTheOracleAreTypesOfItsInput) {
    int edges = 0;
    for (const SourceFile& file : cppFilesIn("tests/oracle")) {
        for (const Include& include : includesIn(file.text)) {
            const std::string target = includedFile(file, include);
            if (target.empty() || folderOf(target) == "tests/oracle") { continue; }
            ++edges;
            EXPECT_TRUE(target == "toi/time_of_impact.h" || target == "shapes/dvec2.h")
                << file.path << " includes " << target << ": what judges the library shares no code with it";
        }
    }
    EXPECT_GT(edges, 0) << "the scan found nothing";
}

TEST(IncludeEdges, OfTheTableFormNoCycle) {
    for (const auto& [folder, below] : kAllowed) {
        std::set<std::string> reached = below;
        for (std::size_t before = 0; before != reached.size();) {
            before = reached.size();
            const std::set<std::string> last = reached;
            for (const std::string& each : last) { reached.insert(kAllowed.at(each).begin(), kAllowed.at(each).end()); }
        }
        EXPECT_EQ(reached.count(folder), 0U) << folder;
    }
}

/// So that nothing before it can lend it what it forgot to include.
TEST(Headers, OfTheLibraryComeFirstInTheirSources) {
    int sources = 0;
    for (const std::string& folder : kLibraryFolders) {
        for (const SourceFile& file : cppFilesIn(folder)) {
            const fs::path header = fs::path(file.path).replace_extension(".h");
            if (!file.path.ends_with(".cpp") || !fs::is_regular_file(sourceRoot() / header)) { continue; }
            const auto includes = includesIn(file.text);
            ASSERT_FALSE(includes.empty()) << file.path;
            EXPECT_EQ(includedFile(file, includes.front()), header.generic_string()) << file.path;
            ++sources;
        }
    }
    EXPECT_GT(sources, 50) << "the scan found hardly anything";
}

TEST(Headers, AreGuarded) {
    for (const SourceFile& file : allCppFiles()) {
        if (file.path.ends_with(".h")) { EXPECT_TRUE(file.text.starts_with("#pragma once\n")) << file.path; }
    }
}

}  // namespace
}  // namespace swept::house
