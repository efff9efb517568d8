#include "config.h"

#include <cmath>

#include <swept/samples/scene_names.h>

#include "../reference/box2d_runner.h"
#include "../reference/peer_limits.h"
#include "../writers/number_text.h"

namespace swept::tune {
namespace {

/// What the profiles stand for (engine/state/profile.h).
struct Effort {
    int subSteps;
    int relaxPasses;
};
Effort effortOf(SceneProfile profile) { return profile == SceneProfile::fast ? Effort{4, 1} : Effort{16, 2}; }

}  // namespace

const char* nameOf(Engine engine) {
    switch (engine) {
        case Engine::f32:
            return "f32";
        case Engine::f64:
            return "f64";
        case Engine::box2d:
            return "Box2D 2.4.1";
        case Engine::box2d3:
            return "Box2D 3 stiff";
    }
    return "";  // unreachable, but GCC cannot know
}

bool isThere(Engine engine) { return engine != Engine::box2d3 || hasPeer(PeerEngine::box2d3); }

PeerSettings peerSettingsOf(Engine engine, int subSteps) {
    PeerSettings settings;
    if (engine == Engine::box2d3) {
        settings.engine = PeerEngine::box2d3;
        settings.subSteps = subSteps;
        settings.isStiff = 1;
    } else {
        settings.iterations = iterationsOf(subSteps);
    }
    return settings;
}

Config ownConfig(const SceneDescription& scene) {
    const SettingsDescription& settings = scene.settings;
    const Effort effort = effortOf(settings.profile);
    Config config;
    config.subSteps = settings.subSteps.value_or(effort.subSteps);
    config.relaxPasses = settings.relaxPasses.value_or(effort.relaxPasses);
    config.continuous = settings.continuous;
    config.toiTolerance = settings.toiTolerance;
    config.broadphase = settings.broadphase;
    return config;
}

SceneDescription withConfig(SceneDescription scene, const Config& config) {
    SettingsDescription& settings = scene.settings;
    settings.dt = std::ldexp(settings.dt, config.dtPower);
    settings.subSteps = config.subSteps;
    settings.relaxPasses = config.relaxPasses;
    settings.continuous = config.continuous;
    settings.toiTolerance = config.toiTolerance;
    settings.broadphase = config.broadphase;
    return scene;
}

measures::Pace paceOf(const SceneDescription& scene, const Config& config, std::int64_t ticks) {
    measures::Pace pace{scene.settings.dt, ticks, 1, 1};
    (config.dtPower > 0 ? pace.ticksPerStep : pace.stepsPerTick) = 1 << std::abs(config.dtPower);
    return pace;
}

std::string fieldsOf(const SceneDescription& scene, const Config& config) {
    std::string text = std::string(nameOf(config.engine)) + ',' + std::to_string(config.dtPower) + ',';
    appendNumber(text, std::ldexp(scene.settings.dt, config.dtPower));
    text += ',' + std::to_string(config.subSteps) + ',' + std::to_string(config.relaxPasses) + ',';
    text += namesOf<SceneContinuous>()[static_cast<std::size_t>(config.continuous)];
    text += ',';
    if (config.toiTolerance) { appendNumber(text, *config.toiTolerance); }
    text += ',';
    text += namesOf<SceneBroadphase>()[static_cast<std::size_t>(config.broadphase)];
    return text;
}

}  // namespace swept::tune
