#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <swept/samples/runner.h>
#include <swept/samples/scene_description.h>

#include "options.h"

namespace swept {

/// What every command that runs a scene asks for.
struct SceneArguments {
    std::string scene;
    std::optional<double> duration;      ///< seconds
    std::optional<std::int64_t> steps;   ///< excludes `duration`
    std::vector<std::string> overrides;  ///< "/pointer=value", as typed
    std::string precision = "f32";       ///< or "f64"
    bool isRun = true;                   ///< false: the scene is only looked at, however many steps it would be run for
};

void addSceneArguments(Command command, SceneArguments& arguments);
/// For the commands that run one build.
void addPrecisionArgument(Command command, SceneArguments& arguments);

struct LoadedScene {
    SceneDescription scene;
    std::string source;  ///< the file, or the name of the built-in scene: what errors are about
    std::string file;    ///< path of the file; empty for a built-in scene and for standard input
    std::int64_t steps = 0;
    Precision precision = Precision::f32;
};

/// Reads the scene ("-" is standard input; a file wins over a built-in scene of the same name), applies the overrides,
/// validates, and settles how many steps to run.
/// @return nothing, and one line in `error`, when anything is refused.
std::optional<LoadedScene> loadScene(const SceneArguments& arguments, std::string& error);

/// Names of all bodies, in scene order.
std::vector<std::string> bodyNames(const SceneDescription& scene);

/// A scene as a file has it, with a line feed at the end.
std::string textOfScene(const SceneDescription& scene);

/// Index of the body of that name.
/// @param flag   the option that asks for it, for errors.
/// @param names  of all bodies (`bodyNames`).
/// @return nothing, and one line in `error` that suggests a name, when there is none.
std::optional<std::size_t> bodyOfName(const std::string& flag, const std::string& name,
                                      const std::vector<std::string>& names, std::string& error);

/// The built-in scene whose name needs the fewest edits to become `name`; empty when none comes near.
std::string nearestSceneName(const std::string& name);

/// `--set a b` as `--set a --set b`: further arguments of the form `/pointer=value` that name no file belong to the
/// flag.
std::vector<std::string> expandOverrides(const std::vector<std::string>& arguments);

}  // namespace swept
