#include "world_table.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ostream>
#include <set>

#include "../bench/text_table.h"
#include "../writers/csv_writer.h"
#include "../writers/number_text.h"

namespace swept::worlds {
namespace {

constexpr double kMilli = 1e3;
constexpr double kMicro = 1e6;
constexpr double kMega = 1.0 / (1024 * 1024);

template <class Get>
std::vector<std::string> distinct(const std::vector<WorldRow>& rows, const Get& get) {
    std::vector<std::string> values;
    for (const WorldRow& row : rows) {
        if (std::find(values.begin(), values.end(), get(row)) == values.end()) { values.push_back(get(row)); }
    }
    return values;
}
std::string sceneOf(const WorldRow& row) { return row.scene; }
std::string contestantOf(const WorldRow& row) { return row.contestant; }

const WorldRow* find(const std::vector<WorldRow>& rows, const std::string& scene, const std::string& contestant) {
    const auto found = std::find_if(rows.begin(), rows.end(), [&](const WorldRow& row) {
        return row.scene == scene && row.contestant == contestant;
    });
    return found == rows.end() ? nullptr : &*found;
}

std::vector<std::string> with(std::vector<std::string> head, const std::vector<std::string>& more) {
    head.insert(head.end(), more.begin(), more.end());
    return head;
}

/// Two digits, in a form that stays short over many decades.
std::string errorText(double value) {
    char text[32];
    const bool isPlain = value == 0 || (std::fabs(value) >= 1e-3 && std::fabs(value) < 1e3);
    std::snprintf(text, sizeof text, isPlain ? "%.2g" : "%.1e", value);
    return text;
}

/// Of what was stopped, with a star; of what was not timed, why.
std::string timeText(const WorldRow& row, double time) {
    if (row.times.empty()) { return row.verdict.empty() ? "-" : row.verdict; }
    return bench::threeDigits(time) + (row.verdict.empty() ? "" : "*");
}

/// What a scene has, and how many.
struct CountColumn {
    const char* title;
    std::size_t WorldRow::*count;
};
constexpr CountColumn kBodies{"bodies", &WorldRow::bodies};

/// A line for each scene, a column for each contestant. @param textOf  what stands there of a row
template <class TextOf>
void writeByScene(std::ostream& out, const std::vector<WorldRow>& rows, const char* title, const CountColumn& counted,
                  const TextOf& textOf) {
    const auto contestants = distinct(rows, contestantOf);
    out << '\n' << title << '\n';
    bench::TextTable table(with({"scene", counted.title}, contestants));
    for (const std::string& scene : distinct(rows, sceneOf)) {
        std::vector<std::string> line{scene, std::to_string(find(rows, scene, contestants.front())->*counted.count)};
        for (const std::string& contestant : contestants) { line.push_back(textOf(*find(rows, scene, contestant))); }
        table.add(line);
    }
    table.write(out);
}

/// Geometric mean of what is there. @param wanted  "" for all scenes, else only the published ones
std::string meanRatio(const std::vector<WorldRow>& rows, const std::string& contestant, bool publishedOnly) {
    double sum = 0;
    int count = 0;
    for (const WorldRow& row : rows) {
        if (row.contestant != contestant || (publishedOnly && !row.isPublished)) { continue; }
        const double ratio = ratioOf(row, *find(rows, row.scene, kRival));
        if (ratio > 0) {
            sum += std::log(ratio);
            ++count;
        }
    }
    return count == 0 ? "-" : bench::threeDigits(std::exp(sum / count)) + " of " + std::to_string(count);
}

void writeRatios(std::ostream& out, const std::vector<WorldRow>& rows) {
    auto contestants = distinct(rows, contestantOf);
    if (std::erase(contestants, kRival) == 0 || contestants.empty()) { return; }
    out << "\nTime over that of " << kRival << " (below 1: faster)\n";
    bench::TextTable table(with({"scene"}, contestants));
    for (const std::string& scene : distinct(rows, sceneOf)) {
        std::vector<std::string> line{scene};
        for (const std::string& contestant : contestants) {
            const WorldRow& row = *find(rows, scene, contestant);
            const double ratio = ratioOf(row, *find(rows, scene, kRival));
            line.push_back(ratio > 0 ? bench::threeDigits(ratio) + (row.verdict.empty() ? "" : "*") : "-");
        }
        table.add(line);
    }
    const bool arePublished =
        std::any_of(rows.begin(), rows.end(), [](const WorldRow& row) { return row.isPublished; });
    for (const bool publishedOnly : {true, false}) {
        if (publishedOnly && !arePublished) { continue; }
        std::vector<std::string> line{publishedOnly ? "geometric mean, published" : "geometric mean, all"};
        for (const std::string& contestant : contestants) {
            line.push_back(meanRatio(rows, contestant, publishedOnly));
        }
        table.add(line);
    }
    table.write(out);
}

double sumOf(const PeerStages& stages) {
    return stages.pairs + stages.collide + stages.islands + stages.solve + stages.continuous + stages.finish;
}

void writeStages(std::ostream& out, const std::vector<WorldRow>& rows) {
    out << "\nStages, milliseconds a step\n";
    bench::TextTable table({"scene", "engine", "pairs", "collide", "islands", "solve", "continuous", "finish", "sum"});
    for (const WorldRow& row : rows) {
        if (!(sumOf(row.stages()) > 0)) { continue; }
        std::vector<std::string> line{row.scene, row.contestant};
        const PeerStages s = row.stages();
        for (const double stage : {s.pairs, s.collide, s.islands, s.solve, s.continuous, s.finish, sumOf(s)}) {
            line.push_back(bench::threeDigits(kMilli * stage));
        }
        table.add(line);
    }
    table.write(out);
}

void writeQuality(std::ostream& out, const std::vector<WorldRow>& rows) {
    out << "\nOutcome (overlaps from the poses alone; energy: change since the start, part of that then)\n";
    bench::TextTable table(
        {"scene", "engine", "deepest, m", "mean overlap, m", "joint gap, m", "energy", "memory, MB"});
    for (const WorldRow& row : rows) {
        if (!row.quality) { continue; }
        const double energy =
            row.startEnergy != 0 ? (row.quality->energy - row.startEnergy) / std::fabs(row.startEnergy) : 0;
        table.add({row.scene, row.contestant, errorText(row.quality->deepest), errorText(row.quality->mean),
                   errorText(row.quality->jointError), errorText(energy),
                   row.memory > 0 ? bench::threeDigits(kMega * row.memory) : "-"});
    }
    table.write(out);
}

void writeRefusals(std::ostream& out, const std::vector<WorldRow>& rows) {
    std::set<std::string> told;
    for (const WorldRow& row : rows) {
        if (!row.refusal.empty() && told.insert(row.scene + row.refusal).second) {
            out << row.scene << ", " << row.contestant << ": " << row.refusal << '\n';
        }
    }
}

}  // namespace

void writeWorldTables(std::ostream& out, const std::vector<WorldRow>& rows) {
    if (rows.empty()) { return; }
    writeByScene(out, rows, "Milliseconds a step (*: stopped, of fewer steps)", kBodies,
                 [](const WorldRow& row) { return timeText(row, kMilli * row.perStep()); });
    writeRatios(out, rows);
    writeByScene(out, rows, "Longest of the steps, milliseconds", kBodies,
                 [](const WorldRow& row) { return timeText(row, kMilli * row.longestStep()); });
    writeStages(out, rows);
    writeQuality(out, rows);
    writeRefusals(out, rows);
}

void writeJointTables(std::ostream& out, const std::vector<WorldRow>& rows) {
    if (rows.empty()) { return; }
    constexpr CountColumn kJoints{"joints", &WorldRow::joints};
    writeByScene(
        out, rows, "Microseconds a step for each joint (*: stopped, of fewer steps)", kJoints,
        [](const WorldRow& row) { return timeText(row, kMicro * row.perStep() / static_cast<double>(row.joints)); });
    writeRatios(out, rows);
    writeByScene(out, rows, "Widest gap of a joint, every 20 steps, millimetres (springs and motors have none)",
                 kJoints,
                 [](const WorldRow& row) { return row.quality ? errorText(kMilli * row.quality->jointError) : "-"; });
    writeRefusals(out, rows);
}

void writeGrowthTable(std::ostream& out, const std::vector<WorldRow>& rows) {
    if (rows.empty()) { return; }
    const auto contestants = distinct(rows, contestantOf);
    out << "\nGrowth: microseconds a step and body\n";
    bench::TextTable table(with({"scene", "bodies"}, contestants));
    for (const std::string& scene : distinct(rows, sceneOf)) {
        std::set<std::size_t> sizes;
        for (const WorldRow& row : rows) {
            if (row.scene == scene) { sizes.insert(row.bodies); }
        }
        for (const std::size_t bodies : sizes) {
            std::vector<std::string> line{scene, std::to_string(bodies)};
            for (const WorldRow& row : rows) {
                if (row.scene == scene && row.bodies == bodies) {
                    const double perBody = kMicro * row.perStep() / static_cast<double>(bodies);
                    line.push_back(row.times.empty() ? row.verdict : bench::threeDigits(perBody));
                }
            }
            table.add(line);
        }
    }
    table.write(out);
}

void writeWorldCsv(std::ostream& out, const std::vector<WorldRow>& rows) {
    out << "scene,engine,bodies,steps,secondsPerStep,longestStep,pairs,collide,islands,solve,continuous,finish,deepest,"
           "meanOverlap,"
           "jointGap,startEnergy,endEnergy,memory,verdict\n";
    for (const WorldRow& row : rows) {
        const Quality quality = row.quality.value_or(Quality{});
        std::string line = csvField(row.scene) + ',' + csvField(row.contestant) + ',' + std::to_string(row.bodies) +
                           ',' + std::to_string(row.times.size());
        const PeerStages s = row.stages();
        for (const double number :
             {row.perStep(), row.longestStep(), s.pairs, s.collide, s.islands, s.solve, s.continuous, s.finish,
              quality.deepest, quality.mean, quality.jointError, row.startEnergy, quality.energy, row.memory}) {
            line += ',';
            appendNumber(line, number);
        }
        out << line << ',' << csvField(row.verdict) << '\n';
    }
}

}  // namespace swept::worlds
