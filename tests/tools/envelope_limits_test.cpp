#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <sstream>

#include <swept/tools/envelope/map.h>
#include <swept/tools/tune/team.h>

/// The coarse maps against those that were committed. When one grew, take over limits.csv of
/// `swept envelope --coarse --out DIR`.

namespace swept::envelope {
namespace {

using Lines = std::map<std::string, std::string>;  ///< "stack,f32,1000": "####.."

Lines linesOf(std::istream& stream) {
    Lines lines;
    for (std::string line; std::getline(stream, line);) {
        const std::size_t comma = line.rfind(',');
        lines[line.substr(0, comma)] = line.substr(comma + 1);
    }
    return lines;
}

/// Cells before the first that is not inside. What lies behind a hole is luck.
std::size_t reachOf(const std::string& line) { return std::min(line.find_first_not_of('#'), line.size()); }

class EnvelopeLimits : public ::testing::TestWithParam<std::string> {};

TEST_P(EnvelopeLimits, DoNotShrink) {
    std::ifstream file(SWEPT_ENVELOPE_LIMITS);
    Lines committed = linesOf(file);
    for (const Slice& slice : allSlices(Grain::coarse)) {
        if (slice.name != GetParam()) { continue; }
        const std::vector<tune::Engine> engines{tune::Engine::f32, tune::Engine::f64};
        Rows rows;
        for (const tune::Engine engine : engines) {
            const std::size_t width = slice.x.values.size();
            std::vector<Row> cells(width * slice.y.values.size());
            tune::runParallel(cells.size(), 2, [&](std::size_t i) {
                cells[i] = runCell(slice, slice.x.values[i % width], slice.y.values[i / width], engine);
            });
            for (const Row& row : cells) { rows.add(row); }
        }
        std::istringstream text(limitLines(slice, rows, engines));
        for (const auto& [key, line] : linesOf(text)) {
            ASSERT_EQ(committed[key].size(), line.size()) << key << ": not committed, or another map";
            EXPECT_GE(reachOf(line), reachOf(committed[key]))
                << key << "\nnow  " << line << "\nthen " << committed[key];
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Slices, EnvelopeLimits, ::testing::Values("stack", "wall", "chain", "bullet", "rest"),
                         [](const auto& slice) { return slice.param; });

}  // namespace
}  // namespace swept::envelope
