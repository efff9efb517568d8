#include "threads_bench.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>

#include <swept/samples/runner.h>
#include <swept/samples/scene_builder.h>
#include <swept/samples/scene_names.h>

#include "../task_threads.h"
#include "hand_over.h"
#include "text_table.h"
#ifdef SWEPT_BENCH_BOX2D3
#include "box2d3/box2d3_threads.h"
#endif

namespace swept::bench {
namespace {

using namespace build;

constexpr int kRows = 10;  ///< of a pyramid: 55 boxes
constexpr int kWarmSteps = 20;
constexpr std::array kSizes{10, 30, 100, 200, 500, 1000, 2000, 5000, 10'000, 20'000, 50'000};

SceneDescription emptyScene(const char* name) {
    SceneDescription scene = build::scene(name, {0, 5}, 20);
    scene.settings.sleep = false;
    return scene;
}

SceneDescription pyramids(int bodies) {
    SceneDescription scene = emptyScene("pyramids");
    addFixed(scene, "ground", {0, -0.5}, {box({2.0 * bodies + 20, 0.5})});
    int made = 0;
    for (int pyramid = 0; made < bodies; ++pyramid) {
        for (int row = 0; row < kRows && made < bodies; ++row) {
            for (int i = 0; i < kRows - row && made < bodies; ++i, ++made) {
                addDynamic(scene, "", {12.0 * pyramid + i + 0.5 * row, 0.5 + row}, {box({0.5, 0.5})});
            }
        }
    }
    return scene;
}

SceneDescription heap(int bodies) {
    SceneDescription scene = emptyScene("heap");
    const int columns = static_cast<int>(std::sqrt(2.0 * bodies)) + 1;
    const double width = 1.2 * columns;
    addFixed(scene, "bowl", {0, 0},
             {box({width, 0.5}, {0, -0.5}), box({0.5, width}, {-0.6 * width - 1, width}),
              box({0.5, width}, {0.6 * width + 1, width})});
    for (int i = 0; i < bodies; ++i) {
        const int row = i / columns;
        const DVec2 place{1.2 * (i % columns) - 0.6 * width + 0.1 * (row % 2), 1 + 1.2 * row};
        const std::array<ShapeDescription, 3> shapes{box({0.5, 0.4}), circle(0.5), capsule({-0.3, 0}, {0.3, 0}, 0.2)};
        addDynamic(scene, "", place, {shapes[static_cast<std::size_t>(i) % shapes.size()]});
    }
    return scene;
}

SceneDescription swarm(int bodies) {
    SceneDescription scene = emptyScene("swarm");
    scene.gravity = {0, 0};
    const double half = 2 * std::sqrt(static_cast<double>(bodies)) + 2;
    const auto wall = [](DVec2 halfSize, DVec2 center) { return withRestitution(box(halfSize, center), 1); };
    addFixed(scene, "walls", {0, 0},
             {wall({half, 1}, {0, -half}), wall({half, 1}, {0, half}), wall({1, half}, {-half, 0}),
              wall({1, half}, {half, 0})});
    Dice dice(7);
    for (int i = 0; i < bodies; ++i) {
        const DVec2 place{dice.range(2 - half, half - 2), dice.range(2 - half, half - 2)};
        addDynamic(scene, "", place, {withRestitution(circle(0.3), 1)}).velocity = {dice.range(-60, 60),
                                                                                    dice.range(-60, 60)};
    }
    return scene;
}

class SweptWorld final : public TimedWorld {
public:
    SweptWorld(const SceneDescription& scene, TaskSystem* tasks) {
        std::string error;
        runner_ = makeRunner(scene, {.tasks = tasks}, error);
    }
    void step() override { runner_->step(); }

private:
    std::unique_ptr<Runner> runner_;
};

double secondsOf(TimedWorld& world) {
    const auto start = std::chrono::steady_clock::now();
    world.step();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

double medianOf(std::vector<double>& values) {
    std::sort(values.begin(), values.end());
    return values[values.size() / 2];
}

/// Step by step in turns, so that whatever else the machine does meets both.
void measure(TimedWorld& one, TimedWorld& several, int steps, ThreadsBenchRow& row) {
    std::vector<double> ones;
    std::vector<double> severals;
    for (int step = -kWarmSteps; step < steps; ++step) {
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

bool isMeant(int bodies, const ThreadsBenchSettings& settings) {
    return settings.fewestBodies <= bodies && bodies <= settings.mostBodies;
}

bool isMeant(const ThreadsScene& scene, const ThreadsBenchSettings& settings) {
    const auto& names = settings.scenes;
    return names.empty() || std::find(names.begin(), names.end(), scene.name) != names.end();
}

}  // namespace

const std::vector<ThreadsScene>& threadsScenes() {
    static const std::vector<ThreadsScene> scenes{{"pyramids", pyramids}, {"heap", heap}, {"swarm", swarm}};
    return scenes;
}

std::size_t threadsRowCount(const ThreadsBenchSettings& settings) {
    const auto sizes = std::count_if(kSizes.begin(), kSizes.end(), [&](int size) { return isMeant(size, settings); });
    const auto scenes = std::count_if(threadsScenes().begin(), threadsScenes().end(),
                                      [&](const ThreadsScene& scene) { return isMeant(scene, settings); });
    return (settings.ownAlone ? 1 : 2) * static_cast<std::size_t>(scenes * sizes);
}

std::vector<ThreadsBenchRow> benchThreads(const ThreadsBenchSettings& settings,
                                          const std::function<void(const ThreadsBenchRow&)>& watch) {
    const std::unique_ptr<TaskSystem> tasks = makeTaskSystem(settings.threads);
    const ThreadSpread spread;  // of both engines: their tasks run on the same threads
    std::vector<ThreadsBenchRow> rows;
    const auto add = [&](ThreadsBenchRow row, TimedWorld& one, TimedWorld& several) {
        const std::optional<double> before = handOverSeconds(*tasks);
        measure(one, several, settings.steps, row);
        const std::optional<double> after = handOverSeconds(*tasks);
        if (before && after) { row.handOver = std::max(*before, *after); }
        watch(row);
        rows.push_back(std::move(row));
    };
    for (const ThreadsScene& scene : threadsScenes()) {
        if (!isMeant(scene, settings)) { continue; }
        for (const int bodies : kSizes) {
            if (!isMeant(bodies, settings)) { continue; }
            SceneDescription description = scene.make(bodies);
            description.settings.profile = settings.profile;
            SweptWorld one(description, nullptr);
            SweptWorld several(description, tasks.get());
            add({.scene = scene.name, .engine = "Swept2D f32", .isOwn = true, .bodies = bodies}, one, several);
#ifdef SWEPT_BENCH_BOX2D3
            if (settings.ownAlone) { continue; }
            const auto box2dOne = makeBox2d3Threads(description, 1);
            const auto box2dSeveral = makeBox2d3Threads(description, settings.threads);
            if (box2dOne != nullptr && box2dSeveral != nullptr) {
                add({.scene = scene.name, .engine = "Box2D 3", .bodies = bodies}, *box2dOne, *box2dSeveral);
            }
#endif
        }
    }
    return rows;
}

void writeThreadsTable(std::ostream& out, const std::vector<ThreadsBenchRow>& rows) {
    TextTable table({"scene", "engine", "bodies", "one, us", "several, us", "ratio", "quickest one, us", "several, us",
                     "ratio", "hand-over, ns"});
    for (const ThreadsBenchRow& row : rows) {
        table.add({row.scene, row.engine, std::to_string(row.bodies), threeDigits(1e6 * row.oneSeconds),
                   threeDigits(1e6 * row.severalSeconds), threeDigits(row.oneSeconds / row.severalSeconds),
                   threeDigits(1e6 * row.quickestOne), threeDigits(1e6 * row.quickestSeveral),
                   threeDigits(row.quickestOne / row.quickestSeveral),
                   row.handOver ? threeDigits(1e9 * *row.handOver) : "-"});
    }
    table.write(out);
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

}  // namespace swept::bench
