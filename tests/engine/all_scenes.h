#pragma once

#include <cstddef>
#include <vector>

#include <swept/samples/built_in/builtin_scenes.h>
#include <swept/samples/scene_description.h>

#include "mixed_scene.h"

namespace swept::test {

/// All built-in scenes and the mixed one, in both profiles.
inline std::vector<SceneDescription> allScenes() {
    std::vector<SceneDescription> scenes;
    for (const BuiltinScene& entry : builtinScenes()) { scenes.push_back(entry.make()); }
    scenes.push_back(scenes::mixedScene());
    const std::size_t count = scenes.size();
    for (std::size_t i = 0; i < count; ++i) {
        scenes.push_back(scenes[i]);
        scenes.back().settings.profile = SceneProfile::fast;
    }
    return scenes;
}

}  // namespace swept::test
