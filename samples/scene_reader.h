#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "scene_description.h"

namespace swept {

/// Why a scene was refused. `text()` is what a user reads: "file.json: /bodies/1/mass: must be greater than 0".
struct SceneError {
    std::string file;
    std::string pointer;  ///< JSON pointer (RFC 6901) of the culprit, or "line 3, column 7" for a syntax error
    std::string reason;
    std::string text() const;
};

/// A scene or the error, never both.
struct SceneResult {
    std::optional<SceneDescription> scene;
    SceneError error;
};

/// A JSON pointer and a JSON value, as given by `--set /settings/dt=0.01`; applied before validation. The parent of the
/// place must exist; the key itself may be new.
using Override = std::pair<std::string, std::string>;

/// Strict: unknown and duplicate keys, wrong types, numbers that overflow and everything `validateScene` refuses are errors.
/// @param file  used in errors only.
SceneResult readScene(std::string_view text, std::string_view file, const std::vector<Override>& overrides = {});
SceneResult readSceneFile(const std::string& path, const std::vector<Override>& overrides = {});

/// The scene as JSON; reading it back gives the same scene. Members at their defaults are left out, except body types.
std::string writeScene(const SceneDescription& scene);

/// What the format and the physics demand beyond syntax: names, ranges, geometry, masses, joint bodies.
/// @return nothing, or the first error in document order (`file` empty).
std::optional<SceneError> validateScene(const SceneDescription& scene);

/// The name used for a body or joint: its own, or `body<index>` / `joint<index>`.
std::string bodyName(const SceneDescription& scene, std::size_t index);
std::string jointName(const SceneDescription& scene, std::size_t index);

}  // namespace swept
