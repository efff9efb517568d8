#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <swept/samples/scene_description.h>

#include "../measures/recording.h"
#include "../reference/peer_settings.h"

namespace swept::tune {

/// Who runs the scene.
enum class Engine : std::uint8_t { f32, f64, box2d, box2d3 };
inline constexpr int kEngineCount = 4;
const char* nameOf(Engine engine);  ///< "f32", "f64", "Box2D 2.4.1", "Box2D 3 stiff"
inline bool isOurs(Engine engine) { return engine == Engine::f32 || engine == Engine::f64; }
/// Whether this build has it: Box2D 3 only where CMake found one.
bool isThere(Engine engine);
/// Of another engine: that one as it is run here, with so many sub-steps (iterations for velocities in Box2D 2.4.1).
/// Box2D 3 has contacts and joints as stiff as those allow: with its own stiffness its error would not fall with them.
PeerSettings peerSettingsOf(Engine engine, int subSteps);

/// One set of settings that tune tries. Of other engines only step and `subSteps` differ; of Box2D 2.4.1 those are
/// iterations for velocities.
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

/// Whether mode `a` keeps more out of walls than `b`, or does so with less harm: the format lists them by that.
inline bool isStronger(SceneContinuous a, SceneContinuous b) { return a > b; }

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
