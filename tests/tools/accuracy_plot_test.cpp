#include <gtest/gtest.h>

#include <sstream>
#include <string>
#include <vector>

#include <swept/tools/accuracy/accuracy_plot.h>

#include "scratch_directory.h"

namespace swept::accuracy {
namespace {

Row rowOf(const std::string& scene, const std::string& contestant, double microseconds, double error) {
    Row row;
    row.scene = scene;
    row.contestant = contestant;
    row.microseconds = microseconds;
    row.values.push_back({"sag", "1", error});
    return row;
}

/// The lines of a script that begin with a text.
std::vector<std::string> linesOf(const std::string& script, const std::string& start) {
    std::istringstream in(script);
    std::vector<std::string> lines;
    for (std::string line; std::getline(in, line);) {
        if (line.starts_with(start)) { lines.push_back(line); }
    }
    return lines;
}

TEST(AccuracyPlot, ErrorsOfZeroStandBelowAllOthers) {
    const ScratchDirectory scratch;
    const std::vector<Row> rows{rowOf("exact", "ours", 10, 0), rowOf("exact", "theirs", 20, 3e-5),
                                rowOf("inexact", "ours", 10, 1e-9), rowOf("inexact", "theirs", 20, 0.1)};
    std::string error;
    (void)plotTrade(scratch.path("."), rows, error);
    EXPECT_EQ(error, "");
    EXPECT_NE(scratch.read("accuracy-trade.dat").find("\n10 0\n"), std::string::npos)
        << "the data say what was measured";
    const std::string script = scratch.read("accuracy-trade.gp");
    const std::vector<std::string> ranges = linesOf(script, "set yrange [");
    ASSERT_EQ(ranges.size(), 3U) << script;  // two panels and the legend
    EXPECT_LT(std::stod(ranges[0].substr(12)), 3e-6);
    EXPECT_EQ(ranges[1], "set yrange [*:*]");
    const std::vector<std::string> tics = linesOf(script, "set ytics add ('0' ");
    ASSERT_EQ(tics.size(), 1U);
    EXPECT_LT(std::stod(tics[0].substr(19)), 1e-5);
}

TEST(AccuracyPlot, TheLegendHasAPlaceOfItsOwn) {
    const ScratchDirectory scratch;
    std::string error;
    (void)plotTrade(scratch.path("."), std::vector<Row>{rowOf("one", "ours", 10, 0.5), rowOf("two", "ours", 10, 0.5)},
                    error);
    EXPECT_EQ(error, "");
    const std::string script = scratch.read("accuracy-trade.gp");
    EXPECT_NE(script.find("set multiplot layout 1,3\n"), std::string::npos) << script;
    EXPECT_EQ(linesOf(script, "plot ").size(), 3U);
    EXPECT_EQ(linesOf(script, "plot 'accuracy-trade.dat' index 0").size(), 1U) << "a panel has no legend";
    EXPECT_EQ(linesOf(script, "plot NaN").size(), 1U);
}

}  // namespace
}  // namespace swept::accuracy
