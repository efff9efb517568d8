#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <functional>
#include <map>
#include <set>
#include <utility>

#include "code_scanner.h"
#include "declared_names.h"
#include "source_tree.h"

/// A header, and a source of the libraries, includes the headers of ours whose names it uses, itself or by way of
/// others, so that it compiles alone whatever was read before it: in pieces of several files nobody would notice.
/// Judged by the text: of 150 includes taken out one at a time it misses one of the 136 that break a header (what is
/// declared in advance where the whole is needed), which the headers that are compiled one by one in a build with the
/// long tests find.

namespace swept::house {
namespace {

/// What templates call for types that they do not know.
const std::set<std::pair<std::string, std::string>> kFoundByArgument = {
    {"solver/joints/joint_constraint.h", "reactionOf"},
};

struct ScannedFile {
    SourceFile file;
    std::string code;
    std::vector<std::string_view> tokens;
    DeclaredNames names;
};

/// What games compile, mostly one by one. Not so the kernels for several instruction sets: they are read once for each,
/// inside of names of their own.
bool isLibrarySource(const std::string& path) {
    const bool isOfLibrary = kLibraryFolders.count(path.substr(0, path.find('/'))) != 0;
    return isOfLibrary && path.ends_with(".cpp") && !path.ends_with("_simd.cpp") && !path.ends_with("_scalar.cpp");
}

std::string directoryOf(const std::string& path) { return path.substr(0, path.rfind('/')); }

/// All files of ours, and what each declares.
class Tree {
public:
    Tree() {
        for (SourceFile& file : allCppFiles()) {
            ScannedFile& scanned = files_[file.path];
            scanned.code = codeOnly(file.text);
            scanned.file = std::move(file);
            scanned.tokens = tokensOf(scanned.code);
            scanned.names = declaredIn(scanned.tokens);
        }
        for (const auto& [path, scanned] : files_) {
            if (!path.ends_with(".h")) { continue; }
            for (const std::string& name : scanned.names.things) { thingsOf_[name].insert(path); }
            for (const std::string& name : scanned.names.functions) { functionsOf_[name].insert(path); }
        }
    }

    const std::map<std::string, ScannedFile>& files() const { return files_; }

    /// A file and all files of ours that it reads.
    const std::set<std::string>& reachOf(const std::string& path) {
        const auto [at, isNew] = reach_.try_emplace(path);
        if (!isNew) { return at->second; }
        std::set<std::string> reach = {path};
        const auto found = files_.find(path);
        if (found != files_.end()) {
            for (const Include& include : includesIn(found->second.file.text)) {
                const std::string ours = includedFile(found->second.file, include);
                if (ours.empty()) { continue; }
                const std::set<std::string>& more = reachOf(ours);
                reach.insert(more.begin(), more.end());
            }
        }
        return reach_[path] = std::move(reach);
    }

    /// The headers that a name is from, where it is used as what it is there; empty if it is none of ours.
    std::set<std::string> homesOf(const ScannedFile& user, std::size_t at) const {
        const std::vector<std::string_view>& tokens = user.tokens;
        const std::string_view before = at > 0 ? tokens[at - 1] : std::string_view();
        const bool isOfSwept = before == "::" && at > 1 && tokens[at - 2] == "swept";
        if (before == "." || before == "->" || (before == "::" && !isOfSwept)) { return {}; }
        const std::string_view name = tokens[at];
        const bool isUpper = std::isupper(static_cast<unsigned char>(name[0])) != 0;
        const bool isConstant =
            name.size() > 1 && name[0] == 'k' && std::isupper(static_cast<unsigned char>(name[1])) != 0;
        const bool isCalled = at + 1 < tokens.size() && tokens[at + 1] == "(";
        if (!isUpper && !isConstant && !isCalled) { return {}; }
        const auto& homes = isUpper || isConstant ? thingsOf_ : functionsOf_;
        const auto found = homes.find(name);
        if (found == homes.end()) { return {}; }
        std::set<std::string> visible;
        for (const std::string& home : found->second) {
            // Programs and tests beside each other do not know each other.
            const bool isShared = !home.starts_with("tools/") && !home.starts_with("tests/");
            if (isShared || directoryOf(home) == directoryOf(user.file.path)) { visible.insert(home); }
        }
        return visible;
    }

    bool isDeclaredFor(const std::string& path, std::string_view name) {
        for (const std::string& read : reachOf(path)) {
            const auto found = files_.find(read);
            if (found == files_.end()) { continue; }
            const DeclaredNames& names = found->second.names;
            if (names.functions.count(name) != 0 || names.anywhere.count(name) != 0) { return true; }
        }
        return false;
    }

private:
    std::map<std::string, ScannedFile> files_;
    std::map<std::string, std::set<std::string>, std::less<>> thingsOf_;
    std::map<std::string, std::set<std::string>, std::less<>> functionsOf_;
    std::map<std::string, std::set<std::string>> reach_;
};

TEST(OwnHeaders, AreThereForTheNamesInUse) {
    Tree tree;
    int uses = 0;
    for (const auto& [path, scanned] : tree.files()) {
        if (!path.ends_with(".h") && !isLibrarySource(path)) { continue; }
        std::set<std::string_view> seen;
        for (std::size_t at = 0; at < scanned.tokens.size(); ++at) {
            const std::set<std::string> homes = tree.homesOf(scanned, at);
            const std::string_view name = scanned.tokens[at];
            if (homes.empty() || !seen.insert(name).second || kFoundByArgument.count({path, std::string(name)}) != 0) {
                continue;
            }
            ++uses;
            EXPECT_TRUE(tree.isDeclaredFor(path, name))
                << path << " uses " << name << " and does not include " << *homes.begin();
        }
    }
    EXPECT_GT(uses, 3000) << "the scan found hardly anything";
}

/// Else its names are of a precision that is called "SWEPT_PRECISION", where nothing else was read before.
TEST(OwnHeaders, KnowTheirPrecision) {
    Tree tree;
    int users = 0;
    for (const auto& [path, scanned] : tree.files()) {
        const std::vector<std::string_view>& tokens = scanned.tokens;
        if (std::find(tokens.begin(), tokens.end(), "SWEPT_PRECISION") == tokens.end()) { continue; }
        ++users;
        EXPECT_TRUE(tree.reachOf(path).contains("shapes/real.h")) << path << " does not include shapes/real.h";
    }
    EXPECT_GT(users, 500);
}

}  // namespace
}  // namespace swept::house
