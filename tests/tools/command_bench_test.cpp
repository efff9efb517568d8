#include <gtest/gtest.h>
#include <stdlib.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <vector>

#include <swept/toi/toi_method.h>
#include <swept/tools/toi/toi_families.h>

#include "csv_records.h"
#include "run_program.h"

namespace swept {
namespace {

using Record = std::map<std::string, std::string>;

/// None of the names has a comma.
std::vector<Record> namedRecordsOf(const std::string& csv) {
    std::istringstream in(csv);
    std::string line;
    std::getline(in, line);
    const std::vector<std::string> names = fieldsOf(line);
    std::vector<Record> records;
    while (std::getline(in, line)) {
        const std::vector<std::string> fields = fieldsOf(line);
        EXPECT_EQ(fields.size(), names.size()) << line;
        Record record;
        for (std::size_t i = 0; i < std::min(fields.size(), names.size()); ++i) { record[names[i]] = fields[i]; }
        records.push_back(record);
    }
    return records;
}

/// All but the times, which differ from run to run.
std::string withoutTimes(const std::string& csv) {
    std::istringstream in(csv);
    std::string result;
    for (std::string line; std::getline(in, line);) { result += line.substr(0, line.rfind(',')) + '\n'; }
    return result;
}

/// Gives the program, for the life of this, a search path on which there is nothing.
class EmptySearchPath {
public:
    EmptySearchPath() : before_(getenv("PATH")) { setenv("PATH", nowhere_.path("").c_str(), 1); }
    ~EmptySearchPath() { setenv("PATH", before_.c_str(), 1); }
    EmptySearchPath(const EmptySearchPath&) = delete;
    EmptySearchPath& operator=(const EmptySearchPath&) = delete;

private:
    ScratchDirectory nowhere_;
    std::string before_;
};

TEST(CommandBench, HasARecordForEveryMethodAndFamily) {
    const ScratchDirectory scratch;
    const auto result = runSwept({"bench", "toi", "--count", "10", "--seed", "3", "--csv", scratch.path("bench.csv")});
    ASSERT_EQ(result.exitCode, 0) << result.err;
    EXPECT_NE(result.out.find("10 queries a family, seed 3"), std::string::npos);
    EXPECT_NE(result.out.find(" build\n"), std::string::npos) << "the machine and the build are named";
    std::set<std::pair<std::string, std::string>> found;
    int tunnelled = 0;
    for (const Record& record : namedRecordsOf(scratch.read("bench.csv"))) {
        found.insert({record.at("family"), record.at("method")});
        EXPECT_EQ(record.at("seed"), "3");
        const int queries = std::stoi(record.at("queries"));
        int judged = 0;
        for (const char* const verdict :
             {"right", "missed", "late", "early", "false_overlap", "failed", "wrong_report", "undecided"}) {
            judged += std::stoi(record.at(verdict));
        }
        EXPECT_EQ(judged, queries) << "every answer has one verdict";
        if (queries > 0) { EXPECT_GT(std::stod(record.at("ns")), 0); }
        if (record.at("method") == "certified") { EXPECT_EQ(record.at("right"), "10") << record.at("family"); }
        tunnelled += record.at("method") == "discrete" ? std::stoi(record.at("missed")) : 0;
    }
    EXPECT_GT(tunnelled, 0) << "the judge finds what is known to be wrong";
    for (const ToiFamily family : kToiFamilies) {
        const std::string name(nameOf(family));
        EXPECT_NE(result.out.find('\n' + name + ' '), std::string::npos) << name;
        for (const ToiMethodInfo& method : kToiMethods) {
            EXPECT_EQ(found.count({name, std::string(method.name)}), 1U) << name << ' ' << method.name;
        }
        EXPECT_EQ(found.count({name, "Box2D 2.4.1"}), 1U) << name;
    }
}

TEST(CommandBench, TheSameSeedGivesTheSameVerdicts) {
    const ScratchDirectory scratch;
    for (const auto& [file, seed] : {std::pair{"one", "5"}, std::pair{"two", "5"}, std::pair{"other", "6"}}) {
        ASSERT_EQ(runSwept({"bench", "toi", "--count", "4", "--seed", seed, "--csv", scratch.path(file)}).exitCode, 0);
    }
    EXPECT_EQ(withoutTimes(scratch.read("one")), withoutTimes(scratch.read("two")));
    EXPECT_NE(withoutTimes(scratch.read("one")), withoutTimes(scratch.read("other")));
}

TEST(CommandBench, CertifiesTheDefaultMethod) {
    const auto result = runSwept({"bench", "toi", "--certify", "200", "--seed", "9"});
    EXPECT_EQ(result.exitCode, 0) << result.out;
    EXPECT_NE(result.out.find("right: 200\n"), std::string::npos) << result.out;
    EXPECT_NE(result.out.find("missed: 0\n"), std::string::npos);
    EXPECT_EQ(result.err, "") << "the progress line is for terminals";
}

TEST(CommandBench, WithoutGnuplotItLeavesTheScriptsAndSaysSo) {
    const ScratchDirectory scratch;
    const EmptySearchPath nothing;
    const auto result = runSwept({"bench", "toi", "--count", "1", "--plots", scratch.path("plots")});
    EXPECT_EQ(result.exitCode, 0) << result.err;
    EXPECT_NE(result.out.find("gnuplot is not installed"), std::string::npos) << result.out;
    for (const char* const name : {"toi-cost", "toi-iterations", "toi-turns"}) {
        const std::string file = std::string("plots/") + name;
        EXPECT_TRUE(scratch.has(file + ".dat")) << name;
        EXPECT_TRUE(scratch.has(file + ".gp")) << name;
        EXPECT_FALSE(scratch.has(file + ".png")) << name;
    }
}

TEST(CommandBench, APlotThatIsNotWrittenIsNoSuccess) {
    if (!std::filesystem::exists("/dev/full")) { GTEST_SKIP() << "this system has no /dev/full"; }
    const ScratchDirectory scratch;
    const std::string plots = scratch.path("plots");
    std::filesystem::create_directory(plots);
    std::filesystem::create_symlink("/dev/full", plots + "/toi-iterations.png");
    const auto result = runSwept({"bench", "toi", "--count", "1", "--plots", plots});
    if (result.out.find("gnuplot is not installed") != std::string::npos) { GTEST_SKIP() << result.out; }
    EXPECT_EQ(result.exitCode, 2);
    EXPECT_EQ(result.err, "swept: --plots " + plots + "/toi-iterations.png: could not be written to the end\n");
    EXPECT_GT(std::filesystem::file_size(plots + "/toi-cost.png"), 1000U);
}

TEST(CommandBench, RefusesWhatItCannotDo) {
    const std::vector<std::vector<std::string>> wrong = {
        {"bench"},
        {"bench", "nonsense"},
        {"bench", "toi", "--count", "0"},
        {"bench", "toi", "--count", "many"},
        {"bench", "toi", "--seed", "-1"},
        {"bench", "toi", "--certify", "0"},
        {"bench", "toi", "--certify", "10", "--count", "10"},
        {"bench", "toi", "--certify", "10", "--plots", "somewhere"},
        {"bench", "toi", "--count", "1", "--csv", "no/such/directory/bench.csv"},
    };
    for (const std::vector<std::string>& arguments : wrong) { expectRefused(arguments); }
}

}  // namespace
}  // namespace swept
