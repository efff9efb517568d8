#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include <swept/samples/scene_description.h>

namespace swept::worlds {

/// What a script does before a step: bodies by index.
struct SceneChange {
    struct Push {
        std::uint32_t body = 0;
        DVec2 velocity;
    };
    std::vector<std::uint32_t> removed;  ///< with their joints
    std::vector<std::uint32_t> added;    ///< as the scene describes them, with their joints; after the removal
    std::vector<Push> pushed;
};

/// A scene to be timed, and what happens to it on the way.
struct BenchScene {
    SceneDescription scene;
    std::vector<std::uint32_t> absent;  ///< bodies that are not there at the start
    /// @param step  0 before the first one; the same step gives the same change. Empty: nothing happens.
    std::function<SceneChange(std::int64_t step)> script;
    int warmSteps = 60;   ///< until the scene is what it is about
    int fullSteps = 500;  ///< of the published benchmark; of ours, long enough for its outcome
};

/// A scene by name.
struct SceneEntry {
    const char* name;
    const char* about;
    bool
        isPublished;  ///< one of the ten benchmark scenes of Box2D 3.3, from their parameters (its shared/benchmarks.c)
    /// @param size  of the number of moving bodies, 1 as published
    BenchScene (*make)(double size);
};

std::span<const SceneEntry> allScenes();
/// Of these, or of joint_scenes.h. Null when there is none of that name.
const SceneEntry* sceneNamed(const std::string& name);

// In scenes_piles.cpp, scenes_stacks.cpp, scenes_jointed.cpp, scenes_games.cpp and scenes_structures.cpp.
BenchScene makeCompounds(double size);
BenchScene makeJunkyard(double size);
BenchScene makeSmash(double size);
BenchScene makeSpinner(double size);
BenchScene makeTumbler(double size);
BenchScene makeWasher(double size);
BenchScene makeLargePyramid(double size);
BenchScene makeManyPyramids(double size);
BenchScene makeJointGrid(double size);
BenchScene makeRain(double size);
BenchScene makePlatformer(double size);
BenchScene makeCrates(double size);
BenchScene makeCratesAsleep(double size);
BenchScene makeWarehouse(double size);
BenchScene makeDisks(double size);
BenchScene makeBulletHell(double size);
BenchScene makeShootOut(double size);
BenchScene makeTray(double size);
BenchScene makeSoftBodies(double size);
BenchScene makeCloth(double size);
BenchScene makeRopes(double size);
BenchScene makeBeams(double size);

/// So many of a row or column, at least one: `count` at size 1.
int scaledCount(int count, double size);
/// The same where rows and columns are scaled alike.
int scaledSide(int count, double size);
/// A new scene: gravity 10, profile left to the contestant.
BenchScene emptyBench(const char* name, int warmSteps, int fullSteps);

}  // namespace swept::worlds
