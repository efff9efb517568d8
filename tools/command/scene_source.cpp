#include "scene_source.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <numeric>
#include <sstream>
#include <string_view>

#include <swept/samples/built_in/builtin_scenes.h>
#include <swept/samples/scene_names.h>
#include <swept/samples/scene_reader.h>

#include "../writers/number_text.h"

namespace swept {
namespace {

constexpr double kDefaultDuration = 10;  // seconds; of a built-in scene what its list says
constexpr const char* kStandardInput = "standard input";
// Beyond 2^53 steps a step number is no longer exact as a double, and the time of a step with it.
constexpr double kMostSteps = 9007199254740992.0;

/// Levenshtein distance: fewest insertions, deletions and replacements that turn one text into the other.
std::size_t editDistance(std::string_view from, std::string_view to) {
    std::vector<std::size_t> row(to.size() + 1);
    std::iota(row.begin(), row.end(), std::size_t{0});
    for (std::size_t i = 0; i < from.size(); ++i) {
        std::size_t diagonal = row[0];
        row[0] = i + 1;
        for (std::size_t j = 0; j < to.size(); ++j) {
            const std::size_t replaced = diagonal + (from[i] == to[j] ? 0 : 1);
            diagonal = row[j + 1];
            row[j + 1] = std::min({replaced, row[j] + 1, row[j + 1] + 1});
        }
    }
    return row.back();
}

/// "/settings/dt=0.01" as its two parts; the value may hold further equals signs.
std::optional<std::vector<Override>> splitOverrides(const std::vector<std::string>& typed, std::string& error) {
    std::vector<Override> overrides;
    for (const std::string& text : typed) {
        const std::size_t equals = text.find('=');
        if (equals == std::string::npos || text.front() != '/') {
            error = "--set " + text + ": expected /pointer=value, as /settings/dt=0.01 or /bodies/NAME/angle=0.5";
            return std::nullopt;
        }
        overrides.emplace_back(text.substr(0, equals), text.substr(equals + 1));
    }
    return overrides;
}

std::string unknownScene(const std::string& name) {
    std::string text = name + ": no such file, and no built-in scene of that name";
    std::error_code ignored;
    const std::string file = name + ".json";
    const std::string nearest = std::filesystem::is_regular_file(file, ignored) ? file : nearestSceneName(name);
    return text + (nearest.empty() ? " (\"swept scenes\" lists them)" : "; did you mean \"" + nearest + "\"?");
}

SceneResult readStandardInput(const std::vector<Override>& overrides) {
    std::ostringstream text;
    text << std::cin.rdbuf();
    if (std::cin.bad()) { return {std::nullopt, {kStandardInput, "", "cannot be read"}}; }
    return readScene(text.str(), kStandardInput, overrides);
}

/// @param duration  of a built-in scene becomes what shows it all, as "swept scenes" lists it
SceneResult readSource(const SceneArguments& arguments, const std::vector<Override>& overrides, double& duration) {
    if (arguments.scene == "-") { return readStandardInput(overrides); }
    std::error_code failure;
    const std::filesystem::file_status status = std::filesystem::status(arguments.scene, failure);
    if (std::filesystem::exists(status) && !std::filesystem::is_directory(status)) {
        return readSceneFile(arguments.scene, overrides);
    }
    if (const BuiltinScene* const builtin = findBuiltinScene(arguments.scene)) {
        duration = builtin->duration;
        return readScene(writeScene(builtin->make()), arguments.scene, overrides);
    }
    // It is not known to be missing: a folder on the way may not be entered, or a link leads nowhere.
    if (status.type() == std::filesystem::file_type::none) {
        return {std::nullopt, {arguments.scene, "", "cannot be read: " + failure.message()}};
    }
    // Only now: a folder of the name of a built-in scene does not hide that.
    return std::filesystem::exists(status) ? readSceneFile(arguments.scene, overrides) : SceneResult{};
}

/// round(S / dt), or the number of steps asked for.
/// @param shown  S where none is given, s
std::optional<std::int64_t> stepsOf(const SceneArguments& arguments, double shown, double dt, std::string& error) {
    if (arguments.steps) {
        if (*arguments.steps < 0) {
            error = "--steps: must not be negative";
            return std::nullopt;
        }
        constexpr auto kMost = static_cast<std::int64_t>(kMostSteps);
        if (*arguments.steps > kMost) {
            error = "--steps: must be at most " + std::to_string(kMost);
            return std::nullopt;
        }
        return arguments.steps;
    }
    const double duration = arguments.duration.value_or(shown);
    if (!std::isfinite(duration) || duration < 0) {
        error = "--duration: must be a finite number of seconds, at least 0";
        return std::nullopt;
    }
    const double steps = std::round(duration / dt);
    if (steps == 0 && duration > 0 && arguments.isRun) {
        std::cerr << "swept: warning: " << roundedText(duration) << " s is less than half a step of " << roundedText(dt)
                  << " s: no step is run\n";
    }
    if (!(steps <= kMostSteps)) {
        error = "--duration: too many steps of " + roundedText(dt) + " s";
        return std::nullopt;
    }
    return static_cast<std::int64_t>(steps);
}

}  // namespace

void addSceneArguments(Command command, SceneArguments& arguments) {
    command
        .option("scene", arguments.scene,
                "A scene file, \"-\" for standard input, or the name of a built-in scene (see: swept scenes)")
        .type("SCENE")
        .required();
    command
        .option("--duration", arguments.duration,
                "Simulated time; runs round(S/dt) steps [10; of a built-in scene what \"swept scenes\" lists]")
        .type("S");
    command.option("--steps", arguments.steps, "Number of steps, instead of --duration").type("N");
    command
        .option("--set", arguments.overrides,
                "Override a member of the scene before it is checked: a JSON pointer and a JSON value, for example "
                "/settings/dt=0.01 or /bodies/1/position=[0,5]; bodies and joints by index or by name, as "
                "/bodies/ball/position=[0,5]; may be repeated")
        .type("/PTR=JSON")
        .oneValueEach();
}

void addPrecisionArgument(Command command, SceneArguments& arguments) {
    command.option("--precision", arguments.precision, "Build of the engine [f32]").type("P").oneOf({"f32", "f64"});
}

std::optional<LoadedScene> loadScene(const SceneArguments& arguments, std::string& error) {
    if (arguments.duration && arguments.steps) {
        error = "--duration and --steps: give one of them, not both";
        return std::nullopt;
    }
    const auto overrides = splitOverrides(arguments.overrides, error);
    if (!overrides) { return std::nullopt; }
    double duration = kDefaultDuration;
    SceneResult result = readSource(arguments, *overrides, duration);
    if (!result.scene) {
        error = result.error.reason.empty() ? unknownScene(arguments.scene) : result.error.text();
        return std::nullopt;
    }
    const auto steps = stepsOf(arguments, duration, result.scene->settings.dt, error);
    if (!steps) { return std::nullopt; }
    std::error_code ignored;
    const bool isInput = arguments.scene == "-";
    const bool isFile = !isInput && std::filesystem::exists(arguments.scene, ignored) &&
                        !std::filesystem::is_directory(arguments.scene, ignored);
    return LoadedScene{std::move(*result.scene), isInput ? kStandardInput : arguments.scene,
                       isFile ? arguments.scene : std::string(), *steps,
                       arguments.precision == "f64" ? Precision::f64 : Precision::f32};
}

std::vector<std::string> bodyNames(const SceneDescription& scene) {
    std::vector<std::string> names;
    for (std::size_t i = 0; i < scene.bodies.size(); ++i) { names.push_back(bodyName(scene, i)); }
    return names;
}

std::string textOfScene(const SceneDescription& scene) {
    std::string json = writeScene(scene);
    if (json.empty() || json.back() != '\n') { json += '\n'; }
    return json;
}

std::optional<std::size_t> bodyOfName(const std::string& flag, const std::string& name,
                                      const std::vector<std::string>& names, std::string& error) {
    const auto found = std::find(names.begin(), names.end(), name);
    if (found != names.end()) { return static_cast<std::size_t>(found - names.begin()); }
    error = flag + ' ' + name + ": the scene has no body of that name" + shortSuggestion(name, names);
    return std::nullopt;
}

std::string nearestSceneName(const std::string& name) {
    std::string nearest;
    std::size_t fewest = name.size() / 2 + 1;  // more edits than that make another word
    for (const BuiltinScene& scene : builtinScenes()) {
        const std::size_t edits = editDistance(name, scene.name);
        if (edits < fewest) {
            fewest = edits;
            nearest = scene.name;
        }
    }
    return nearest;
}

std::vector<std::string> expandOverrides(const std::vector<std::string>& arguments) {
    std::vector<std::string> expanded;
    bool afterValue = false;  // the last two arguments were --set and its value
    for (const std::string& argument : arguments) {
        std::error_code ignored;
        const bool looksLikeOverride = argument.size() > 1 && argument.front() == '/' &&
                                       argument.find('=') != std::string::npos &&
                                       !std::filesystem::exists(argument, ignored);
        if (afterValue && looksLikeOverride) { expanded.emplace_back("--set"); }
        const bool isValue = !expanded.empty() && expanded.back() == "--set";
        expanded.push_back(argument);
        afterValue = isValue;
    }
    return expanded;
}

}  // namespace swept
