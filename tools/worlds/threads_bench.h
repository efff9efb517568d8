#pragma once

#include <functional>
#include <optional>
#include <ostream>
#include <span>
#include <string>
#include <vector>

#include "bench_scene.h"

namespace swept::worlds {

/// A scene of any number of bodies.
struct GrowingScene {
    const char* name;
    BenchScene (*make)(int bodies);
};
/// Pyramids at rest, mixed shapes that fall on a heap, fast disks between walls.
std::span<const GrowingScene> growingScenes();

struct ThreadsBenchSettings {
    int threads = 2;
    /// Of `growingScenes` and `allScenes`; empty: the growing ones and the published ones.
    std::vector<std::string> scenes;
    int fewestBodies = 10;  ///< of growing scenes
    int mostBodies = 10'000;
    double size = 0.25;     ///< of the number of moving bodies in the others, 1 as published
    bool ownAlone = false;  ///< without Box2D 3
    int steps = 400;        ///< of a row, as many for each engine: to fall is another task than to lie
    SceneProfile profile = SceneProfile::accurate;  ///< of ours
};

/// One thread against several, of the same scene step by step in turns.
struct ThreadsBenchRow {
    std::string scene;
    std::string engine;
    bool isOwn = false;
    bool isPublished = false;   ///< one of the ten benchmark scenes of Box2D 3.3
    std::size_t bodies = 0;     ///< in a growing scene those that move, else all
    double oneSeconds = 0;      ///< of a step, median
    double severalSeconds = 0;  ///< likewise
    double quickestOne = 0;     ///< of any step: on a machine that others use too this says more
    double quickestSeveral = 0;
    std::optional<double> handOver{};  ///< s that a cache line takes from thread to thread, longer of before and after
};

/// Rows at most: without Box2D 3 there are half as many.
std::size_t threadsRowCount(const ThreadsBenchSettings& settings);
std::vector<ThreadsBenchRow> benchThreads(const ThreadsBenchSettings& settings,
                                          const std::function<void(const ThreadsBenchRow&)>& watch);
void writeThreadsTable(std::ostream& out, const std::vector<ThreadsBenchRow>& rows);
void writeThreadsCsv(std::ostream& csv, const std::vector<ThreadsBenchRow>& rows, const ThreadsBenchSettings& settings);

}  // namespace swept::worlds
