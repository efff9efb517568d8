#include <gtest/gtest.h>

#include <algorithm>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include "source_tree.h"

/// The libraries are for every compiler of C++20. What only some compilers have is behind a few headers, each of which
/// does without where it has to. Nor does the library of clang 14, used for WebAssembly, have all of C++20.

namespace swept::house {
namespace {

const std::set<std::string> kHeadersOfExtensions = {"shapes/bit_cast.h", "shapes/cache_line.h", "shapes/compiler.h",
                                                    "shapes/lanes.h", "engine/crew/spin_pause.h"};

struct Extension {
    const char* hint;  ///< without which a line need not be looked at closely
    const char* pattern;
    const char* example;
};
const Extension kExtensions[] = {
    {"__builtin_", "\\b__builtin_\\w+", "__builtin_prefetch(p);"},
    {"__attribute__", "\\b__attribute__\\b", "__attribute__((noinline)) void f();"},
    {"[[", "\\b(gnu|clang|msvc)::", "[[gnu::cold]] void f();"},
    {"__", "\\b__(declspec|forceinline)\\b", "__forceinline void f();"},
    {"asm", "\\b(__)?asm(__)?\\b", "asm volatile(\"\");"},
    {"typeof", "\\b(__)?typeof(__)?\\b", "__typeof__(a) b;"},
    {"int128", "\\b_?_?u?int128(_t)?\\b", "unsigned __int128 a;"},
    {"__", "\\b__(restrict|extension|label|real|imag)(__)?\\b", "float* __restrict__ a;"},
    {"pragma", "#\\s*pragma\\s+(GCC|clang|warning|omp)\\b", "#pragma GCC optimize(\"O3\")"},
    {"__", "\\b__(GNUC|clang|x86_64|i386|SSE\\w*|AVX\\w*|ARM_NEON|aarch64)__\\b", "#ifdef __x86_64__"},
    {"_M", "\\b(_MSC_VER|_M_X64|_M_IX86)\\b", "#ifdef _MSC_VER"},
    {"intrin", "<[a-z]*intrin\\.h>", "#include <immintrin.h>"},
    {"({", "(\\breturn|[=(,?:])\\s*\\(\\{", "const int a = ({ int b = 1; b; });"},
    {"ranges", "\\b(ranges|views)::|<ranges>", "return std::ranges::all_of(all, isGood);"},
    {"[0];", "^\\s*(?!return\\b)[\\w:<>]+[&*\\s]+\\w+\\[0\\];", "    int tail[0];"},
};

/// Without comments; strings of the libraries have no slashes.
std::string withoutComment(const std::string& line) { return line.substr(0, line.find("//")); }

std::vector<std::string> linesOf(const std::string& text) {
    std::vector<std::string> lines;
    for (std::size_t from = 0; from < text.size();) {
        const std::size_t end = std::min(text.find('\n', from), text.size());
        lines.push_back(text.substr(from, end - from));
        from = end + 1;
    }
    return lines;
}

/// A file of a library that is compiled, kernels that are included among them.
bool isCompiledForLibrary(const std::string& path) {
    return kLibraryFolders.count(path.substr(0, path.find('/'))) != 0 &&
           (path.ends_with(".h") || path.ends_with(".cpp") || path.ends_with(".inc"));
}

/// `line: what it says` of all that is beyond what every compiler has.
std::vector<std::string> extensionsIn(const std::string& text) {
    static const std::vector<std::regex> patterns = [] {
        std::vector<std::regex> made;
        for (const Extension& extension : kExtensions) { made.emplace_back(extension.pattern); }
        return made;
    }();
    std::vector<std::string> found;
    const std::vector<std::string> lines = linesOf(text);
    for (std::size_t i = 0; i < lines.size(); ++i) {
        const std::string code = withoutComment(lines[i]);
        for (std::size_t e = 0; e < patterns.size(); ++e) {
            if (code.find(kExtensions[e].hint) != std::string::npos && std::regex_search(code, patterns[e])) {
                found.push_back(std::to_string(i + 1) + ": " + code);
            }
        }
    }
    return found;
}

TEST(CompilerExtensions, AreFoundByTheirText) {
    for (const Extension& extension : kExtensions) {
        EXPECT_EQ(extensionsIn(extension.example).size(), 1U) << extension.example;
    }
    EXPECT_TRUE(extensionsIn("return polygon.vertices[0];\nlargest({a, b});\n// __builtin_prefetch\n").empty());
}

TEST(CompilerExtensions, AreBehindAFewHeaders) {
    int files = 0;
    std::set<std::string> users;
    for (const std::string& path : repositoryFiles()) {
        if (!isCompiledForLibrary(path)) { continue; }
        ++files;
        const std::vector<std::string> found = extensionsIn(readText(sourceRoot() / path));
        if (kHeadersOfExtensions.count(path) != 0) {
            if (!found.empty()) { users.insert(path); }
            continue;
        }
        for (const std::string& line : found) { ADD_FAILURE() << path << ':' << line; }
    }
    EXPECT_EQ(users, kHeadersOfExtensions) << "those that use something";
    EXPECT_GT(files, 300) << "the scan found hardly anything";
}

}  // namespace
}  // namespace swept::house
