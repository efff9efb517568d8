#include <gtest/gtest.h>

#include <map>
#include <regex>
#include <set>

#include "code_scanner.h"
#include "source_tree.h"

/// A file has the standard headers of the names that it uses: its own, or those of a file of ours that it includes. The
/// precompiled headers and the neighbours in a piece of several files would hide that one is missing.

namespace swept::house {
namespace {

/// Names that only one header is sure to declare. Those that several do (`std::size_t`, `std::swap`) tell nothing.
const std::map<std::string, std::set<std::string>> kNamesOf = {
    {"algorithm", {"clamp",       "copy",           "count_if",    "fill",        "find",       "find_if",     "all_of",
                   "any_of",      "none_of",        "is_sorted",   "lower_bound", "max",        "max_element", "min",
                   "min_element", "minmax_element", "nth_element", "partition",   "remove_if",  "reverse",     "rotate",
                   "sort",        "stable_sort",    "transform",   "unique",      "upper_bound"}},
    {"array", {"array"}},
    {"atomic", {"atomic", "atomic_ref", "atomic_bool"}},
    {"bit", {"bit_cast", "bit_ceil", "bit_width", "countl_zero", "countr_zero", "has_single_bit", "popcount"}},
    {"charconv", {"from_chars", "to_chars"}},
    {"chrono", {"chrono"}},
    {"cmath",
     {"abs", "atan2", "ceil", "copysign", "cos", "exp", "floor", "fmod", "hypot", "isfinite", "isnan", "ldexp",
      "nextafter", "pow", "round", "sin", "sqrt"}},
    {"condition_variable", {"condition_variable"}},
    {"cstdint", {"int32_t", "int64_t", "int8_t", "uint16_t", "uint32_t", "uint64_t", "uint8_t", "uintptr_t"}},
    {"cstdio", {"FILE", "fopen", "fprintf", "fputs", "printf", "snprintf"}},
    {"cstring", {"memcmp", "memcpy", "memset", "strcmp", "strlen"}},
    {"filesystem", {"filesystem"}},
    {"fstream", {"ifstream", "ofstream"}},
    {"functional", {"function", "greater"}},
    {"iostream", {"cerr", "cin", "cout"}},
    {"limits", {"numeric_limits"}},
    {"map", {"map"}},
    {"memory", {"make_shared", "make_unique", "shared_ptr", "unique_ptr"}},
    {"mutex", {"lock_guard", "mutex", "unique_lock"}},
    {"numbers", {"numbers"}},
    {"numeric", {"accumulate", "iota", "partial_sum", "reduce"}},
    {"optional", {"nullopt", "optional"}},
    {"random",
     {"mt19937", "mt19937_64", "normal_distribution", "uniform_int_distribution", "uniform_real_distribution"}},
    {"set", {"set"}},
    {"span", {"span"}},
    {"sstream", {"istringstream", "ostringstream", "stringstream"}},
    {"string", {"stod", "stoi", "string", "to_string"}},
    {"string_view", {"string_view"}},
    {"thread", {"thread"}},
    {"tuple", {"make_tuple", "tie", "tuple"}},
    {"unordered_map", {"unordered_map"}},
    {"unordered_set", {"unordered_set"}},
    {"utility", {"exchange", "forward", "pair"}},
    {"variant", {"get_if", "holds_alternative", "monostate", "variant", "visit"}},
    {"vector", {"vector"}},
};

/// These bring others along, and the standard says so or no library leaves it out.
const std::map<std::string, std::set<std::string>> kBrings = {
    {"string", {"string_view"}},
    {"sstream", {"string", "string_view"}},
    {"fstream", {"string", "string_view"}},
    {"map", {"utility"}},
    {"unordered_map", {"utility"}},
    {"iostream", {"string", "string_view"}},
    {"variant", {"utility"}},
    {"optional", {"utility"}},
    {"tuple", {"utility"}},
    {"vector", {"utility"}},
    {"array", {"utility"}},
    {"algorithm", {"utility"}},
    {"memory", {"utility"}},
    {"functional", {"utility"}},
    {"random", {"cstdint"}},
    {"set", {"utility"}},
    {"span", {"array"}},
    {"string_view", {"utility"}},
    {"filesystem", {"string", "string_view", "chrono"}},
};

std::map<std::string, std::string> headerOfEachName() {
    std::map<std::string, std::string> headers;
    for (const auto& [header, names] : kNamesOf) {
        for (const std::string& name : names) { EXPECT_TRUE(headers.emplace(name, header).second) << name; }
    }
    return headers;
}

/// The standard headers that a file reads, its own and by way of files of ours.
class Reach {
public:
    Reach() {
        for (SourceFile& file : allCppFiles()) { files_.emplace(file.path, std::move(file)); }
    }

    const std::set<std::string>& of(const std::string& path) {
        const auto [at, isNew] = known_.try_emplace(path);
        if (!isNew) { return at->second; }
        std::set<std::string> headers;
        const auto file = files_.find(path);
        if (file == files_.end()) { return at->second; }
        for (const Include& include : includesIn(file->second.text)) {
            const std::string ours = includedFile(file->second, include);
            if (ours.empty()) {
                headers.insert(include.target);
                const auto brought = kBrings.find(include.target);
                if (brought != kBrings.end()) { headers.insert(brought->second.begin(), brought->second.end()); }
            } else {
                const std::set<std::string> more = of(ours);
                headers.insert(more.begin(), more.end());
            }
        }
        return known_[path] = std::move(headers);
    }

private:
    std::map<std::string, SourceFile> files_;
    std::map<std::string, std::set<std::string>> known_;
};

TEST(StandardHeaders, AreThereForTheNamesInUse) {
    const std::map<std::string, std::string> headers = headerOfEachName();
    const std::regex name("std::([a-z_0-9]+)");
    Reach reach;
    int uses = 0;
    for (const SourceFile& file : allCppFiles()) {
        const std::set<std::string>& had = reach.of(file.path);
        const std::string code = codeOnly(file.text);
        std::set<std::string> seen;
        for (auto at = std::sregex_iterator(code.begin(), code.end(), name); at != std::sregex_iterator(); ++at) {
            const auto header = headers.find((*at)[1]);
            if (header == headers.end() || !seen.insert(header->first).second) { continue; }
            ++uses;
            EXPECT_EQ(had.count(header->second), 1U)
                << file.path << " says std::" << header->first << " and includes no <" << header->second << '>';
        }
    }
    EXPECT_GT(uses, 1000) << "the scan found hardly anything";
}

}  // namespace
}  // namespace swept::house
