#include "scene_reader.h"

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>
#include <vector>

#include "scene_json.h"

namespace swept {
namespace {

SceneResult failure(SceneError error, std::string_view file) {
    error.file = file;
    return {std::nullopt, std::move(error)};
}

/// Nobody wrote the 0 that the error is about.
std::string whyZero(const SceneError& error, const std::vector<JsonUnderflow>& underflows) {
    if (!error.reason.ends_with(", not 0") && !error.reason.ends_with(", not -0")) { return ""; }
    for (const JsonUnderflow& underflow : underflows) {
        if (underflow.where == error.pointer) { return " (" + underflow.number + " underflows)"; }
    }
    return "";
}

}  // namespace

std::string SceneError::text() const {
    std::string result = file;
    for (const std::string* part : {&pointer, &reason}) {
        if (part->empty()) { continue; }
        if (!result.empty()) { result += ": "; }
        result += *part;
    }
    return result;
}

SceneResult readScene(std::string_view text, std::string_view file, const std::vector<Override>& overrides) {
    JsonResult parsed = parseStrict(text);
    if (parsed.error) { return failure({"", parsed.error->where, parsed.error->reason}, file); }
    if (!parsed.value.is_object()) {
        return failure({"", "", "a scene must be an object {…}, not " + kindOf(parsed.value)}, file);
    }
    for (const Override& change : overrides) {
        if (auto error = applyOverride(parsed.value, change, parsed.underflows)) {
            return failure(std::move(*error), file);
        }
    }
    SceneDescription scene;
    if (auto error = sceneFromJson(parsed.value, scene)) { return failure(std::move(*error), file); }
    if (auto error = validateScene(scene)) {
        error->reason += whyZero(*error, parsed.underflows);
        return failure(std::move(*error), file);
    }
    return {std::move(scene), {}};
}

SceneResult readSceneFile(const std::string& path, const std::vector<Override>& overrides) {
    std::error_code ignored;
    if (std::filesystem::is_directory(path, ignored)) {
        return {std::nullopt, {path, "", "is a folder, not a scene file"}};
    }
    errno = 0;
    std::ifstream stream(path, std::ios::binary);
    std::ostringstream text;
    if (stream) { text << stream.rdbuf(); }
    if (!stream || text.bad()) {
        return {std::nullopt, {path, "", "cannot be read: " + std::generic_category().message(errno)}};
    }
    return readScene(text.str(), path, overrides);
}

}  // namespace swept
