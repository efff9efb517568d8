#pragma once

#include <optional>
#include <vector>

#include "json_strict.h"
#include "scene_description.h"
#include "scene_reader.h"

/// Between JSON values and scenes; `readScene` and `writeScene` put text around them.

namespace swept {

/// Fills a scene from a JSON value: types, keys, words and whole numbers are checked, what `validateScene` looks at is
/// not.
/// @return nothing, or the first error in the order of the document (`file` empty).
std::optional<SceneError> sceneFromJson(const Json& value, SceneDescription& scene);

/// Members at their defaults are left out, except body types.
Json sceneToJson(const SceneDescription& scene);

/// Applies one `--set`. Objects missing on the way are made (an omitted "settings" is one full of defaults); elements
/// of arrays must exist, or be the one behind the last ("-" or its index); of bodies and joints, names do for indices.
/// @param underflows  those of the value are added
/// @return nothing, or why the pointer or the value cannot be used (`file` empty).
std::optional<SceneError> applyOverride(Json& document, const Override& change, std::vector<JsonUnderflow>& underflows);

/// Laid out to be read: whatever fits a line stands on one line; numbers as the shortest decimals that read back as the
/// same double. Ends with a line break.
std::string formatJson(const Json& value);

}  // namespace swept
