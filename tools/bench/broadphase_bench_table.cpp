#include "broadphase_bench_table.h"

#include <algorithm>
#include <cmath>
#include <ostream>

#include "../writers/csv_writer.h"
#include "../writers/number_text.h"
#include "text_table.h"

namespace swept::bench {
namespace {

template <class Get>
auto distinctOf(std::span<const BroadphaseRow> rows, const Get& get) {
    std::vector<std::decay_t<decltype(get(rows.front()))>> values;
    for (const BroadphaseRow& row : rows) {
        if (std::find(values.begin(), values.end(), get(row)) == values.end()) { values.push_back(get(row)); }
    }
    return values;
}

const auto kSceneOfRow = [](const BroadphaseRow& row) { return row.scene; };
const auto kMethodOfRow = [](const BroadphaseRow& row) { return row.method; };
const auto kProxies = [](const BroadphaseRow& row) { return row.proxies; };

std::vector<BroadphaseRow> ofScene(std::span<const BroadphaseRow> rows, const std::string& scene) {
    std::vector<BroadphaseRow> found;
    std::copy_if(rows.begin(), rows.end(), std::back_inserter(found),
                 [&](const BroadphaseRow& row) { return row.scene == scene; });
    return found;
}

const BroadphaseRow* find(std::span<const BroadphaseRow> rows, const std::string& scene, const std::string& method,
                          std::uint32_t proxies) {
    const auto found = std::find_if(rows.begin(), rows.end(), [&](const BroadphaseRow& row) {
        return row.scene == scene && row.method == method && row.proxies == proxies;
    });
    return found == rows.end() ? nullptr : &*found;
}

bool isEngine(const std::string& method) { return method.starts_with("Box2D"); }

std::string threeDigitPercent(double share) { return threeDigits(100 * share) + " %"; }

std::string growthText(std::span<const GrowthRow> growth, const std::string& scene, const std::string& method) {
    for (const GrowthRow& row : growth) {
        if (row.scene == scene && row.method == method) { return threeDigits(row.exponent); }
    }
    return "-";
}

void writeDistribution(std::ostream& out, std::span<const BroadphaseRow> rows, std::span<const GrowthRow> growth) {
    const std::string& scene = rows.front().scene;
    const auto sizes = distinctOf(rows, kProxies);
    out << '\n' << scene << ": ns per renewed box to hand it over and to find new pairs, by number of proxies\n";
    std::vector<std::string> head = {""};
    for (const std::uint32_t size : sizes) { head.push_back(std::to_string(size)); }
    for (const char* const title : {"growth", "build", "bytes", "box query", "ray", "tests"}) { head.push_back(title); }
    TextTable table(head);
    for (const std::string& method : distinctOf(rows, kMethodOfRow)) {
        std::vector<std::string> line = {method};
        const BroadphaseRow* last = nullptr;
        bool agrees = true;
        for (const std::uint32_t size : sizes) {
            const BroadphaseRow* const row = find(rows, scene, method, size);
            line.push_back(row == nullptr ? "-" : threeDigits(row->time()));
            last = row == nullptr ? last : row;
            agrees = agrees && (row == nullptr || row->agrees);
        }
        line.push_back(growthText(growth, scene, method));
        for (const double value : {last->buildTime, last->bytes, last->boxQueryTime, last->rayTime, last->boxTests}) {
            line.push_back(threeDigits(value));
        }
        if (!agrees) { line.push_back("other pairs!"); }
        table.add(line);
    }
    table.write(out);
    for (const std::uint32_t size : sizes) {
        const BroadphaseRow* const row = find(rows, scene, rows.front().method, size);
        if (row == nullptr) { continue; }
        out << "  " << size << ": " << threeDigits(row->movedPerStep) << " boxes renewed and "
            << threeDigits(row->newPairs) << " new pairs a step, " << threeDigits(row->alivePairs) << " alive, "
            << threeDigitPercent(row->falseShare) << " of them false\n";
    }
}

void writePeer(std::ostream& out, std::span<const BroadphaseRow> rows) {
    const BroadphaseRow& first = rows.front();
    out << '\n'
        << first.scene << ": " << first.proxies << " proxies; a step: " << threeDigits(first.movedPerStep)
        << " boxes renewed, " << threeDigits(first.newPairs) << " new pairs; " << threeDigits(first.alivePairs)
        << " alive, " << threeDigitPercent(first.falseShare) << " of them false\n";
    TextTable table({"ns per renewed box", "hand over", "pairs", "both", "us a step", "Mpairs/s", "build", "bytes",
                     "box query", "ray", "tests"});
    for (const BroadphaseRow& row : rows) {
        std::vector<std::string> line = {row.method};
        for (const double value :
             {row.moveTime, row.pairTime, row.time(), 1e-3 * row.stepTime(), 1e-6 * row.newPairsPerSecond(),
              row.buildTime, row.bytes, row.boxQueryTime, row.rayTime, row.boxTests}) {
            line.push_back(threeDigits(value));
        }
        if (!row.agrees) { line.push_back("other pairs!"); }
        table.add(line);
    }
    table.write(out);
}

}  // namespace

std::vector<GrowthRow> growthOf(std::span<const BroadphaseRow> rows) {
    std::vector<GrowthRow> growth;
    for (const std::string& scene : distinctOf(rows, kSceneOfRow)) {
        const std::vector<BroadphaseRow> here = ofScene(rows, scene);
        for (const std::string& method : distinctOf(here, kMethodOfRow)) {
            double n = 0, x = 0, y = 0, xx = 0, xy = 0;
            for (const BroadphaseRow& row : here) {
                if (row.method != method || !(row.stepTime() > 0)) { continue; }
                const double logCount = std::log(row.proxies);
                const double logTime = std::log(row.stepTime());
                n += 1;
                x += logCount;
                y += logTime;
                xx += logCount * logCount;
                xy += logCount * logTime;
            }
            if (n >= 2) { growth.push_back({scene, method, (n * xy - x * y) / (n * xx - x * x)}); }
        }
    }
    return growth;
}

std::vector<RivalRow> rivalry(std::span<const BroadphaseRow> rows) {
    std::vector<RivalRow> result;
    const std::vector<std::string> methods = distinctOf(rows, kMethodOfRow);
    for (const std::string& rival : methods) {
        if (!isEngine(rival)) { continue; }
        for (const std::string& method : methods) {
            if (isEngine(method)) { continue; }
            RivalRow total;
            total.method = method;
            total.rival = rival;
            double logs = 0;
            for (const BroadphaseRow& row : rows) {
                const BroadphaseRow* const other =
                    row.method == method ? find(rows, row.scene, rival, row.proxies) : nullptr;
                if (other == nullptr) { continue; }
                const double ratio = other->time() / row.time();
                logs += std::log(ratio);
                if (total.cases == 0 || ratio < total.worst) {
                    total.worst = ratio;
                    total.worstCase = row.scene + ' ' + std::to_string(row.proxies);
                }
                ++total.cases;
            }
            if (total.cases > 0) {
                total.geometricMean = std::exp(logs / total.cases);
                result.push_back(total);
            }
        }
    }
    return result;
}

void writeDistributionTables(std::ostream& out, std::span<const BroadphaseRow> rows) {
    const std::vector<GrowthRow> growth = growthOf(rows);
    for (const std::string& scene : distinctOf(rows, kSceneOfRow)) {
        writeDistribution(out, ofScene(rows, scene), growth);
    }
}

void writePeerTables(std::ostream& out, std::span<const BroadphaseRow> rows) {
    for (const std::string& scene : distinctOf(rows, kSceneOfRow)) { writePeer(out, ofScene(rows, scene)); }
}

void writeRivalry(std::ostream& out, std::span<const BroadphaseRow> rows) {
    TextTable table({"times as fast as", "", "geometric mean", "least", "where", "cases"});
    bool isEmpty = true;
    for (const RivalRow& row : rivalry(rows)) {
        isEmpty = false;
        table.add({row.rival, row.method, threeDigits(row.geometricMean), threeDigits(row.worst), row.worstCase,
                   std::to_string(row.cases)});
    }
    if (!isEmpty) {
        out << '\n';
        table.write(out);
    }
}

void writeBroadphaseCsv(std::ostream& out, std::span<const BroadphaseRow> rows) {
    out << "scene,method,proxies,renewed_per_step,hand_over_ns,pairs_ns,build_ns,new_pairs_per_step,new_pairs_per_"
           "second,"
           "alive_pairs,false_share,box_tests,bytes,box_query_ns,box_hits,ray_ns,ray_hits,passes,agrees\n";
    for (const BroadphaseRow& row : rows) {
        std::string record = csvField(row.scene) + ',' + csvField(row.method) + ',' + std::to_string(row.proxies);
        for (const double value : {row.movedPerStep, row.moveTime, row.pairTime, row.buildTime, row.newPairs,
                                   row.newPairsPerSecond(), row.alivePairs, row.falseShare, row.boxTests, row.bytes,
                                   row.boxQueryTime, row.boxHits, row.rayTime, row.rayHits}) {
            record += ',';
            appendNumber(record, value);
        }
        out << record << ',' << row.passes << ',' << (row.agrees ? 1 : 0) << '\n';
    }
}

}  // namespace swept::bench
