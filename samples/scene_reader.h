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
    /// JSON pointer (RFC 6901) of the culprit, or "line 3, column 7" for a syntax error; empty, as the RFC has it, for
    /// the whole document, and when the file cannot be read.
    std::string pointer;
    std::string reason;
    std::string text() const;
};

/// A scene or the error, never both.
struct SceneResult {
    std::optional<SceneDescription> scene;
    SceneError error;
};

/// A JSON pointer and a JSON value, as given by `--set /settings/dt=0.01`; applied before validation. Objects missing
/// on the way are made (an omitted "settings" is one full of defaults); elements of arrays must exist, or be the next
/// one. Bodies and joints go by their names, too ("/bodies/ball/angle"), unless those read as an index.
using Override = std::pair<std::string, std::string>;

/// Strict: unknown and duplicate keys, wrong types, numbers that overflow and everything `validateScene` refuses are
/// errors.
/// @param file  used in errors only.
SceneResult readScene(std::string_view text, std::string_view file, const std::vector<Override>& overrides = {});
SceneResult readSceneFile(const std::string& path, const std::vector<Override>& overrides = {});

/// The scene as JSON; reading it back gives the same scene. Members at their defaults are left out, except body types.
std::string writeScene(const SceneDescription& scene);

/// The largest number (in magnitude) that a scene may hold: single precision reaches a little further.
inline constexpr double kLargestSceneNumber = 3e38;

/// What the format and the physics demand beyond syntax: names, ranges, geometry, masses, joint bodies.
/// @param largest  bound on every number; its inverse bounds from below what must be greater than 0. With the default
///                 every accepted scene can be held in single precision; a scene for f64 only may be given a larger
///                 one.
/// @return nothing, or the first error in document order (`file` empty).
std::optional<SceneError> validateScene(const SceneDescription& scene, double largest = kLargestSceneNumber);

/// The name used for a body or joint: its own, or `body<index>` / `joint<index>`.
std::string bodyName(const SceneDescription& scene, std::size_t index);
std::string jointName(const SceneDescription& scene, std::size_t index);

}  // namespace swept
