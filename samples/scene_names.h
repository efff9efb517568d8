#pragma once

#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

#include "scene_description.h"

/// The words of the scene format, and the phrases that help a user who mistyped one.

namespace swept {

/// The names of an enumeration in the order of its values. Specialised for every enumeration of the format.
template <class Enumeration>
requires std::is_enum_v<Enumeration> std::span<const std::string_view> namesOf();
template <>
std::span<const std::string_view> namesOf<SceneBodyType>();
template <>
std::span<const std::string_view> namesOf<SceneContinuous>();
template <>
std::span<const std::string_view> namesOf<SceneProfile>();
template <>
std::span<const std::string_view> namesOf<SceneBroadphase>();
template <>
std::span<const std::string_view> namesOf<MixingRule>();

/// Keys that name the geometry of a shape, in the order of the alternatives of `Geometry`.
std::span<const std::string_view> geometryNames();
/// Joint types that a scene can hold, in the order of the alternatives of `JointGeometry`.
std::span<const std::string_view> jointTypeNames();

/// `"a", "b" or "c"`.
std::string listOf(std::span<const std::string_view> names);

/// The name that `word` was probably meant to be: the nearest by edit distance (a swap of neighbours counts as one
/// edit, case does not count), if that is small for the length of the word; else empty.
std::string_view nearestName(std::string_view word, std::span<const std::string_view> names);

/// `; did you mean "friction"?`, or, when nothing is near, `; known here: …`.
std::string suggestion(std::string_view word, std::span<const std::string_view> names);

/// The same for names of a user's own: of many, only the first few are listed.
std::string shortSuggestion(std::string_view word, const std::vector<std::string>& names);

/// The shortest decimal that reads back as the same double; `nan`, `inf` and `-inf` as such.
std::string shortestNumber(double value);

/// `[1, 0.5]`.
std::string textOf(DVec2 vector);

/// A string in double quotes with JSON escapes, cut after 60 characters: for messages.
std::string inQuotes(std::string_view text);

}  // namespace swept
