#include "world_names.h"

#include "../worlds/world_bench.h"

namespace swept {

std::vector<std::string> namesOfScenes(std::span<const worlds::SceneEntry> scenes) {
    std::vector<std::string> names;
    for (const worlds::SceneEntry& scene : scenes) { names.emplace_back(scene.name); }
    return names;
}

std::vector<std::string> engineNames() {
    std::vector<std::string> names;
    for (const worlds::Contestant& contestant : worlds::allContestants()) { names.push_back(contestant.name); }
    return names;
}

}  // namespace swept
