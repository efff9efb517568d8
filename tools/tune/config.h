#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <swept/samples/scene_description.h>

#include "../measures/recording.h"

namespace swept::tune {

/// Who runs the scene.
enum class Engine : std::uint8_t { f32, f64, box2d };
inline constexpr int kEngineCount = 3;
const char* nameOf(Engine engine);  ///< "f32", "f64", "Box2D 2.4.1"

/// One set of settings that tune tries. Of Box2D, `subSteps` are its velocity iterations, and the rest is the scene's.
struct Config {
    Engine engine = Engine::f32;
    int dtPower = 0;  ///< the step is that of the scene times 2^dtPower
    int subSteps = 16;
    int relaxPasses = 2;
    SceneContinuous continuous = SceneContinuous::subStep;
    std::optional<double> toiTolerance;  ///< metres; omitted: by extent
    SceneBroadphase broadphase = SceneBroadphase::automatic;

    bool operator==(const Config&) const = default;
};

/// What the scene itself asks for, in single precision; a profile is spelled out as sub-steps and passes.
Config ownConfig(const SceneDescription& scene);
/// The scene with these settings; sleep as it was.
SceneDescription withConfig(SceneDescription scene, const Config& config);
/// @param ticks  length in steps of the scene as it was given, even
measures::Pace paceOf(const SceneDescription& scene, const Config& config, std::int64_t ticks);
/// The settings as fields of a CSV record, without the engine: "0.0166,16,2,subStep,,automatic" in the order of
/// `kConfigColumns`.
std::string fieldsOf(const SceneDescription& scene, const Config& config);
inline constexpr const char* kConfigColumns =
    "engine,dtPower,dt,subSteps,relaxPasses,continuous,toiTolerance,broadphase";

}  // namespace swept::tune
