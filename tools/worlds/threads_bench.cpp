#include "threads_bench.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <span>

#include <swept/samples/scene_names.h>

#include "../bench/hand_over.h"
#include "../bench/text_table.h"
#include "../reference/peer_limits.h"
#include "../task_threads.h"
#include "scripted_world.h"
#include "world_bench.h"

namespace swept::worlds {
namespace {

constexpr const char* kOwn = "Swept2D f32";
constexpr std::array kSizes{10, 30, 100, 200, 500, 1000, 2000, 5000, 10'000, 20'000, 50'000};

/// What is measured with each engine.
struct Task {
    std::string scene;
    bool isPublished = false;
    std::size_t bodies = 0;
    std::function<BenchScene()> make;
};

bool isNamed(const char* scene, const ThreadsBenchSettings& settings, bool otherwise) {
    const auto& names = settings.scenes;
    return names.empty() ? otherwise : std::find(names.begin(), names.end(), scene) != names.end();
}

std::vector<Task> tasksOf(const ThreadsBenchSettings& settings) {
    std::vector<Task> tasks;
    for (const GrowingScene& scene : growingScenes()) {
        if (!isNamed(scene.name, settings, true)) { continue; }
        for (const int bodies : kSizes) {
            if (bodies < settings.fewestBodies || bodies > settings.mostBodies) { continue; }
            tasks.push_back({scene.name, false, static_cast<std::size_t>(bodies),
                             [make = scene.make, bodies] { return make(bodies); }});
        }
    }
    for (const SceneEntry& scene : allScenes()) {
        if (!isNamed(scene.name, settings, scene.isPublished)) { continue; }
        const auto make = [make = scene.make, size = settings.size] { return make(size); };
        tasks.push_back({scene.name, scene.isPublished, make().scene.bodies.size(), make});
    }
    return tasks;
}

double secondsOf(ScriptedWorld& world) {
    world.step();
    return world.world().lastStepWallSeconds();
}

double medianOf(std::vector<double>& values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

/// Step by step in turns, so that whatever else the machine does meets both.
void measure(ScriptedWorld& one, ScriptedWorld& several, int steps, ThreadsBenchRow& row) {
    std::vector<double> ones;
    std::vector<double> severals;
    for (int step = -one.bench().warmSteps; step < steps; ++step) {
        const bool oneFirst = step % 2 == 0;
        const double first = secondsOf(oneFirst ? one : several);
        const double second = secondsOf(oneFirst ? several : one);
        if (step < 0) { continue; }
        ones.push_back(oneFirst ? first : second);
        severals.push_back(oneFirst ? second : first);
    }
    row.oneSeconds = medianOf(ones);
    row.severalSeconds = medianOf(severals);
    row.quickestOne = ones.front();
    row.quickestSeveral = severals.front();
}

/// Geometric mean of what `several` threads gain in the published scenes; 0 without any.
double meanGain(std::span<const ThreadsBenchRow> rows, const std::string& engine) {
    double sum = 0;
    int count = 0;
    for (const ThreadsBenchRow& row : rows) {
        if (row.engine != engine || !row.isPublished) { continue; }
        sum += std::log(row.oneSeconds / row.severalSeconds);
        ++count;
    }
    return count == 0 ? 0 : std::exp(sum / count);
}

}  // namespace

std::size_t threadsRowCount(const ThreadsBenchSettings& settings) {
    return (settings.ownAlone ? 1 : 2) * tasksOf(settings).size();
}

std::vector<ThreadsBenchRow> benchThreads(const ThreadsBenchSettings& settings,
                                          const std::function<void(const ThreadsBenchRow&)>& watch) {
    const std::unique_ptr<TaskSystem> tasks = makeTaskSystem(settings.threads);
    const ThreadSpread spread;  // of both engines: their tasks run on the same threads
    EngineChoice own;
    own.isOurs = 1;
    own.profile = settings.profile;
    EngineChoice rival;
    rival.peer.engine = PeerEngine::box2d3;
    EngineChoice rivalOnSeveral = rival;
    rivalOnSeveral.peer.threads = settings.threads;

    std::vector<ThreadsBenchRow> rows;
    for (const Task& task : tasksOf(settings)) {
        const auto add = [&](const char* engine, bool isOwn, ScriptedWorld& one, ScriptedWorld& several) {
            ThreadsBenchRow row{task.scene, engine, isOwn, task.isPublished, task.bodies};
            const std::optional<double> before = bench::handOverSeconds(*tasks);
            measure(one, several, settings.steps, row);
            const std::optional<double> after = bench::handOverSeconds(*tasks);
            if (before && after) { row.handOver = std::max(*before, *after); }
            watch(row);
            rows.push_back(std::move(row));
        };
        const BenchScene bench = task.make();
        {
            ScriptedWorld one(bench, own, nullptr);
            ScriptedWorld several(bench, own, tasks.get());
            add(kOwn, true, one, several);
        }
        if (settings.ownAlone || !hasPeer(PeerEngine::box2d3) || !peerLacks(PeerEngine::box2d3, bench.scene).empty()) {
            continue;
        }
        ScriptedWorld one(bench, rival, nullptr);
        ScriptedWorld several(bench, rivalOnSeveral, nullptr);
        add(kRival, false, one, several);
    }
    return rows;
}

void writeThreadsTable(std::ostream& out, const std::vector<ThreadsBenchRow>& rows) {
    using bench::threeDigits;
    constexpr double kMicro = 1e6;
    bench::TextTable table({"scene", "engine", "bodies", "one, us", "several, us", "ratio", "quickest one, us",
                            "several, us", "ratio", "hand-over, ns"});
    for (const ThreadsBenchRow& row : rows) {
        table.add({row.scene, row.engine, std::to_string(row.bodies), threeDigits(kMicro * row.oneSeconds),
                   threeDigits(kMicro * row.severalSeconds), threeDigits(row.oneSeconds / row.severalSeconds),
                   threeDigits(kMicro * row.quickestOne), threeDigits(kMicro * row.quickestSeveral),
                   threeDigits(row.quickestOne / row.quickestSeveral),
                   row.handOver ? threeDigits(1e9 * *row.handOver) : "-"});
    }
    table.write(out);
    for (const char* const engine : {kOwn, kRival}) {
        if (const double gain = meanGain(rows, engine); gain > 0) {
            out << "published scenes, geometric mean of the ratios: " << engine << ' ' << threeDigits(gain) << '\n';
        }
    }
    out << "hand-over: what a cache line takes from one thread to another, the longer of before and after the row;\n"
           "where it grows, cores moved apart, and rows from before and after cannot be compared\n";
}

void writeThreadsCsv(std::ostream& csv, const std::vector<ThreadsBenchRow>& rows,
                     const ThreadsBenchSettings& settings) {
    csv << "scene,engine,profile,bodies,threads,steps,one,several,quickest_one,quickest_several,hand_over\n";
    for (const ThreadsBenchRow& row : rows) {
        csv << row.scene << ',' << row.engine << ','
            << (row.isOwn ? namesOf<SceneProfile>()[static_cast<std::size_t>(settings.profile)] : "") << ','
            << row.bodies << ',' << settings.threads << ',' << settings.steps << ',' << row.oneSeconds << ','
            << row.severalSeconds << ',' << row.quickestOne << ',' << row.quickestSeveral << ',';
        if (row.handOver) { csv << *row.handOver; }
        csv << '\n';
    }
}

}  // namespace swept::worlds
