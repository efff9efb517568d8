#pragma once

#include <span>
#include <string>
#include <vector>

#include "../worlds/bench_scene.h"

namespace swept {

std::vector<std::string> namesOfScenes(std::span<const worlds::SceneEntry> scenes);
/// Of the contestants that are there.
std::vector<std::string> engineNames();

}  // namespace swept
