#include "bench_scene.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "joint_scenes.h"

namespace swept::worlds {
namespace {

constexpr std::array<SceneEntry, 22> kScenes{{
    {"compounds", "3000 bodies of two triangles fall into a tub", true, makeCompounds},
    {"joint-grid", "10 000 circles on a net of hinges", true, makeJointGrid},
    {"junkyard", "8000 pentagons, stirred by a pusher", true, makeJunkyard},
    {"large-pyramid", "one pyramid of 5050 boxes", true, makeLargePyramid},
    {"many-pyramids", "400 pyramids of 55 boxes", true, makeManyPyramids},
    {"rain", "ragdolls fall on tiles, come and go", true, makeRain},
    {"smash", "a hammer into 9600 sleeping boxes, no gravity", true, makeSmash},
    {"spinner", "6076 bodies of three kinds around a driven blade", true, makeSpinner},
    {"tumbler", "2025 boxes in a driven drum", true, makeTumbler},
    {"washer", "8100 boxes in a kinematic drum with paddles", true, makeWasher},
    {"platformer", "a level of 400 tiles with 20 moving platforms and 60 riders", false, makePlatformer},
    {"crates", "500 crates at rest in stacks of ten, kept awake", false, makeCrates},
    {"crates-asleep", "the same, allowed to sleep", false, makeCratesAsleep},
    {"warehouse", "20 disks on the move beside 10 000 sleeping crates, one of them kicked every ten steps", false,
     makeWarehouse},
    {"disks", "10 000 circles that fall and never meet", false, makeDisks},
    {"bullet-hell", "5000 circles among walls and posts, no gravity", false, makeBulletHell},
    {"shoot-out", "1600 bullets among 576 crates adrift, no gravity", false, makeShootOut},
    {"tray", "1024 boxes, disks and capsules that come to rest in a tray", false, makeTray},
    {"soft-bodies", "200 soft bodies of 25 disks and 72 springs, in a heap", false, makeSoftBodies},
    {"cloth", "6400 knots on rods, hung from their upper edge", false, makeCloth},
    {"ropes", "200 ropes of 20 hinged links, let go level, that touch nothing", false, makeRopes},
    {"beams", "200 beams of ten welded boxes, in a heap", false, makeBeams},
}};

}  // namespace

std::span<const SceneEntry> allScenes() { return kScenes; }

const SceneEntry* sceneNamed(const std::string& name) {
    for (const std::span<const SceneEntry> scenes : {allScenes(), jointScenes()}) {
        const auto found =
            std::find_if(scenes.begin(), scenes.end(), [&](const SceneEntry& entry) { return name == entry.name; });
        if (found != scenes.end()) { return &*found; }
    }
    return nullptr;
}

int scaledCount(int count, double size) { return std::max(1, static_cast<int>(std::lround(count * size))); }
int scaledSide(int count, double size) { return scaledCount(count, std::sqrt(size)); }

BenchScene emptyBench(const char* name, int warmSteps, int fullSteps) {
    BenchScene bench;
    bench.scene.name = name;
    bench.scene.gravity = {0, -10};
    bench.warmSteps = warmSteps;
    bench.fullSteps = fullSteps;
    return bench;
}

}  // namespace swept::worlds
