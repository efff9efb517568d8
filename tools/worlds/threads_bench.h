#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include <swept/samples/scene_description.h>

namespace swept::bench {

/// A world that is stepped and timed.
class TimedWorld {
public:
    virtual ~TimedWorld() = default;
    virtual void step() = 0;
};

struct ThreadsBenchSettings {
    int threads = 2;
    std::vector<std::string> scenes;  ///< all of them if there are none
    int fewestBodies = 10;
    int mostBodies = 10'000;
    bool ownAlone = false;  ///< without Box2D 3
    int steps = 400;        ///< of a row, as many for each engine: to fall is another task than to lie
    SceneProfile profile = SceneProfile::accurate;  ///< of ours
};

/// One thread against several, of the same scene step by step in turns.
struct ThreadsBenchRow {
    std::string scene;
    std::string engine;
    bool isOwn = false;
    int bodies = 0;
    double oneSeconds = 0;      ///< of a step, median
    double severalSeconds = 0;  ///< likewise
    double quickestOne = 0;     ///< of any step: on a machine that others use too this says more
    double quickestSeveral = 0;
    std::optional<double> handOver{};  ///< s that a cache line takes from thread to thread, longer of before and after
};

/// Scenes of so many bodies each: pyramids at rest, mixed shapes that fall on a heap, fast disks between walls.
struct ThreadsScene {
    const char* name;
    SceneDescription (*make)(int bodies);
};
const std::vector<ThreadsScene>& threadsScenes();

/// Rows at most: without Box2D 3 there are half as many.
std::size_t threadsRowCount(const ThreadsBenchSettings& settings);
std::vector<ThreadsBenchRow> benchThreads(const ThreadsBenchSettings& settings,
                                          const std::function<void(const ThreadsBenchRow&)>& watch);
void writeThreadsTable(std::ostream& out, const std::vector<ThreadsBenchRow>& rows);
void writeThreadsCsv(std::ostream& csv, const std::vector<ThreadsBenchRow>& rows, const ThreadsBenchSettings& settings);

}  // namespace swept::bench
