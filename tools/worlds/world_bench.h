#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "bench_scene.h"
#include "world_child.h"

namespace swept::worlds {

/// What a step took, of the repeats of a run. The fastest is the least disturbed, but favours an engine whose times
/// vary.
enum class Repeats : std::uint8_t { median, fastest };

struct WorldBenchSettings {
    std::vector<std::string> scenes;   ///< names; empty: all
    std::vector<std::string> engines;  ///< names of contestants; empty: all
    double size = 0.25;                ///< of the number of moving bodies
    int steps = 60;                    ///< that are timed, after those in which the scene becomes what it is about
    bool full = false;                 ///< instead: all steps of the published benchmark, from the first one
    int repeats = 3;                   ///< runs of each
    Repeats counts = Repeats::median;  ///< which of them counts, for each step
    double seconds = 5;                ///< of processor time; what has used them up in a scene is stopped
    std::string executable = "/proc/self/exe";
};

/// An engine with the settings it is judged by.
struct Contestant {
    std::string name;  ///< "fast f32", "Box2D 3" …
    WorldRequest request;
};
/// All that are there: ours, and the reference engines that were found when this was built.
std::vector<Contestant> allContestants();

/// What all ratios are of.
inline constexpr const char* kRival = "Box2D 3";

/// One contestant on one scene.
struct WorldRow {
    std::string scene;
    std::string contestant;
    bool isPublished = false;  ///< the scene is one of the ten
    std::size_t bodies = 0;    ///< in the scene, static ones too
    std::size_t joints = 0;
    std::vector<StepTime> times;     ///< of the timed steps, by `counts` of the repeats; fewer when it was stopped
    std::optional<Quality> quality;  ///< over the timed steps
    double startEnergy = 0;          ///< joules, before the first step
    double memory = 0;               ///< most in use beyond the scene itself, bytes
    std::string verdict;             ///< empty when all went well; "stopped", "aborted", "-" when refused
    std::string refusal;             ///< why, in words

    /// Means of the timed steps, seconds; 0 without any.
    double perStep() const;
    /// The one step that took longest, seconds; 0 without any.
    double longestStep() const;
    /// Engines take these from the wall clock: where a step was interrupted, they are parts of its processor time.
    PeerStages stages() const;
};

/// What a step took by its repeats, at least one, in any order: the one of them that counts, with its stages; of an
/// even number the two in the middle share the median.
StepTime timeOfRepeats(std::vector<StepTime> repeats, Repeats counts);

/// How many times as long `row` takes as `rival`, over the steps that both have; 0 when there is none.
double ratioOf(const WorldRow& row, const WorldRow& rival);

/// All contestants on one scene, in turns of a few steps.
std::vector<WorldRow> benchScene(const SceneEntry& entry, const WorldBenchSettings& settings);

/// All scenes that the settings ask for. @param progress  called after each with what was measured so far
std::vector<WorldRow> benchWorlds(const WorldBenchSettings& settings,
                                  const std::function<void(const std::vector<WorldRow>&)>& progress);

}  // namespace swept::worlds
