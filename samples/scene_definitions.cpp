#include "scene_definitions.h"

#include <limits>

#include "scene_surfaces.h"

namespace swept::inline SWEPT_PRECISION {
namespace {

constexpr int kIndexBits = 32;

ContinuousMode continuousOf(SceneContinuous mode) {
    switch (mode) {
        case SceneContinuous::off:
            return ContinuousMode::off;
        case SceneContinuous::speedLimit:
            return ContinuousMode::speedLimit;
        case SceneContinuous::speculative:
            return ContinuousMode::speculative;
        case SceneContinuous::stop:
            return ContinuousMode::stop;
        case SceneContinuous::subStep:
            return ContinuousMode::subStep;
    }
    return ContinuousMode::subStep;  // unreachable, but GCC cannot know
}

BroadphaseKind broadphaseOf(SceneBroadphase kind) {
    switch (kind) {
        case SceneBroadphase::automatic:
            return BroadphaseKind::automatic;
        case SceneBroadphase::allPairs:
            return BroadphaseKind::allPairs;
        case SceneBroadphase::sortAndSweep:
            return BroadphaseKind::sortAndSweep;
        case SceneBroadphase::quadtree:
            return BroadphaseKind::quadtree;
        case SceneBroadphase::grid:
            return BroadphaseKind::grid;
        case SceneBroadphase::bvh:
            return BroadphaseKind::bvh;
        case SceneBroadphase::wideBvh:
            return BroadphaseKind::wideBvh;
    }
    return BroadphaseKind::automatic;  // unreachable, but GCC cannot know
}

BodyType typeOf(SceneBodyType type) {
    switch (type) {
        case SceneBodyType::fixed:
            return BodyType::fixed;
        case SceneBodyType::kinematic:
            return BodyType::kinematic;
        case SceneBodyType::dynamic:
            return BodyType::dynamic;
    }
    return BodyType::fixed;  // unreachable, but GCC cannot know
}

}  // namespace

WorldSettings worldSettingsOf(const SceneDescription& scene) {
    const SettingsDescription& given = scene.settings;
    WorldSettings settings;
    settings.gravity = toReal(scene.gravity);
    settings.profile = given.profile == SceneProfile::accurate ? Profile::accurate : Profile::fast;
    settings.subSteps = given.subSteps;
    settings.relaxPasses = given.relaxPasses;
    settings.continuous = continuousOf(given.continuous);
    settings.maxImpacts = given.maxImpacts;
    settings.maxSpeed = given.maxSpeed ? realOf(*given.maxSpeed) : std::numeric_limits<Real>::infinity();
    if (given.toiTolerance) { settings.toiTolerance = realOf(*given.toiTolerance); }
    settings.maxPenetration = realOf(given.maxPenetration.value_or(std::numeric_limits<double>::infinity()));
    settings.maxJointError = realOf(given.maxJointError.value_or(std::numeric_limits<double>::infinity()));
    settings.maxLostTime = given.maxLostTime.value_or(std::numeric_limits<double>::infinity());
    settings.sleep = given.sleep;
    settings.sleepSpeed = realOf(given.sleepSpeed);
    settings.broadphase = broadphaseOf(given.broadphase);
    return settings;
}

BodyDef bodyDefOf(const BodyDescription& given, std::size_t index) {
    BodyDef def;
    def.type = typeOf(given.type);
    def.position = given.position;
    def.angle = given.angle;
    def.velocity = toReal(given.velocity);
    def.angularVelocity = realOf(given.angularVelocity);
    def.linearDamping = realOf(given.linearDamping);
    def.angularDamping = realOf(given.angularDamping);
    def.gravityScale = realOf(given.gravityScale);
    def.mass = realOf(given.mass.value_or(0));
    def.inertia = realOf(given.inertia.value_or(0));
    def.fixedRotation = given.fixedRotation;
    def.bullet = given.bullet;
    def.awake = given.awake;
    def.allowSleep = given.allowSleep;
    def.enabled = given.enabled;
    if (given.continuous) { def.continuous = continuousOf(*given.continuous); }
    def.userData = index;
    return def;
}

ShapeDef shapeDefOf(const ShapeDescription& given, std::size_t body, std::size_t shape) {
    ShapeDef def;
    def.density = realOf(given.density);
    def.friction = realOf(given.friction);
    def.restitution = realOf(given.restitution);
    def.rollingResistance = realOf(given.rollingResistance);
    def.surfaceSpeed = realOf(given.surfaceSpeed);
    def.frictionMixing = given.frictionMixing;
    def.restitutionMixing = given.restitutionMixing;
    def.sensor = given.sensor;
    def.filter = {given.filter.category, given.filter.mask, given.filter.group};
    def.userData = (static_cast<std::uint64_t>(body) << kIndexBits) | shape;
    return def;
}

std::vector<Surface> surfacesOfSegments(const ShapeDescription& given) {
    std::vector<Surface> surfaces;
    if (ownSurfaces(given) == nullptr) { return surfaces; }
    for (const FullSurface& surface : surfacesOf(given)) {
        surfaces.push_back({.friction = realOf(surface.friction),
                            .restitution = realOf(surface.restitution),
                            .rollingResistance = realOf(surface.rollingResistance),
                            .surfaceSpeed = realOf(surface.surfaceSpeed),
                            .frictionMixing = surface.frictionMixing,
                            .restitutionMixing = surface.restitutionMixing});
    }
    return surfaces;
}

ShapeOrigin shapeOrigin(std::uint64_t userData) {
    return {static_cast<int>(userData >> kIndexBits), static_cast<int>(userData & 0xFFFFFFFFu)};
}

}  // namespace swept::inline SWEPT_PRECISION
