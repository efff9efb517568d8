#include "broadphase_margin.h"

#include <ostream>

#include "../writers/csv_writer.h"
#include "../writers/number_text.h"
#include "broadphase_peer_scenes.h"
#include "text_table.h"

namespace swept::bench {
namespace {

constexpr float kExtentRatios[] = {0, 1.F / 32, 1.F / 16, 1.F / 8, 1.F / 4, 1.F / 2, 1};
constexpr float kStepsAhead[] = {0, 2, 4, 8};

double movedBounds(const Motion& motion, std::size_t warmSteps) {
    double moved = 0;
    for (std::size_t i = warmSteps; i < motion.steps.size(); ++i) {
        moved += static_cast<double>(motion.steps[i].moved.size());
    }
    return moved;
}

MarginRow measured(const Motion& motion, std::size_t warmSteps, const MarginRule& rule, double seconds) {
    BoxTrace trace = enlarged(motion, rule);
    trace.warmSteps = warmSteps;
    BroadphaseContestants contestants;
    contestants.push_back(makeOurBroadphase(BroadphaseKind::automatic));
    const BroadphaseRow row = benchTrace(contestants, motion, trace, seconds).front();
    const double moved = movedBounds(motion, warmSteps);
    const double steps = static_cast<double>(trace.steps.size() - warmSteps);
    MarginRow result{motion.name, rule};
    result.renewedShare = static_cast<double>(trace.timedMoves()) / moved;
    result.falsePairs = row.falseShare < 1 ? row.falseShare / (1 - row.falseShare) : 0;
    result.nsPerMoved = row.stepTime() * steps / moved;
    return result;
}

}  // namespace

std::vector<MarginRow> benchMargins(const BroadphaseBenchSettings& settings, const BroadphaseProgress& progress) {
    constexpr std::uint32_t kCount = 5000;
    constexpr int kSteps = 60;
    constexpr double kSeconds = 0.05;
    std::vector<RecordedScene> scenes;
    progress("margins");
    for (const BoxScene scene : {BoxScene::uniform, BoxScene::raining}) {
        scenes.push_back({makeBoxScene(scene, kCount, kSteps, settings.seed), 20});
    }
    for (const PeerScene scene : {PeerScene::tumbler, PeerScene::compounds}) {
        progress(nameOf(scene));
        scenes.push_back(recordPeerScene(scene));
    }
    std::vector<MarginRow> rows;
    for (const RecordedScene& scene : scenes) {
        for (const float ahead : kStepsAhead) {
            for (const float ratio : kExtentRatios) {
                rows.push_back(measured(scene.motion, scene.warmSteps, {ratio, ahead}, kSeconds));
            }
        }
    }
    return rows;
}

void writeMarginTable(std::ostream& out, std::span<const MarginRow> rows) {
    out << "\nMargins: boxes renewed of those that moved / false pairs per true one / ns of a step per box that "
           "moved\n";
    std::vector<std::string> head = {"margin over extent"};
    for (const float ratio : kExtentRatios) { head.push_back(threeDigits(static_cast<double>(ratio))); }
    TextTable table(head);
    std::vector<std::string> line;
    for (const MarginRow& row : rows) {
        if (row.rule.extentRatio == kExtentRatios[0]) {
            if (!line.empty()) { table.add(line); }
            line = {row.scene + ", " + threeDigits(static_cast<double>(row.rule.stepsAhead)) + " steps ahead"};
        }
        line.push_back(threeDigits(row.renewedShare) + " / " + threeDigits(row.falsePairs) + " / " +
                       threeDigits(row.nsPerMoved));
    }
    table.add(line);
    table.write(out);
}

void writeMarginCsv(std::ostream& out, std::span<const MarginRow> rows) {
    out << "scene,extent_ratio,steps_ahead,renewed_share,false_per_true,ns_per_moved\n";
    for (const MarginRow& row : rows) {
        std::string record = csvField(row.scene);
        for (const double value : {static_cast<double>(row.rule.extentRatio), static_cast<double>(row.rule.stepsAhead),
                                   row.renewedShare, row.falsePairs, row.nsPerMoved}) {
            record += ',';
            appendNumber(record, value);
        }
        out << record << '\n';
    }
}

}  // namespace swept::bench
