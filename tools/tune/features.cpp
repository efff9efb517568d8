#include <algorithm>
#include <array>
#include <vector>

#include <swept/samples/scene_surfaces.h>

#include "ablation.h"

namespace swept::tune {
namespace {

template <class Condition>
bool anyShape(const SceneDescription& scene, const Condition& holds) {
    return std::any_of(scene.bodies.begin(), scene.bodies.end(), [&](const BodyDescription& body) {
        return std::any_of(body.shapes.begin(), body.shapes.end(), holds);
    });
}

template <class Condition>
bool anyDynamicBody(const SceneDescription& scene, const Condition& holds) {
    return std::any_of(scene.bodies.begin(), scene.bodies.end(),
                       [&](const BodyDescription& body) { return body.type == SceneBodyType::dynamic && holds(body); });
}

template <class Change>
void eachShape(SceneDescription& scene, const Change& change) {
    for (BodyDescription& body : scene.bodies) {
        for (ShapeDescription& shape : body.shapes) { change(shape); }
    }
}

template <class Condition>
bool anySurfaceThat(const SceneDescription& scene, const Condition& holds) {
    return anyShape(scene, [&](const ShapeDescription& shape) { return !shape.sensor && anySurface(shape, holds); });
}

/// Of shapes and of segments of chains, which then are as their shape.
template <class Change>
void eachSurface(SceneDescription& scene, const Change& change) {
    eachShape(scene, [&](ShapeDescription& shape) {
        change(shape);
        if (std::vector<SurfaceDescription>* const own = ownSurfaces(shape)) {
            for (SurfaceDescription& surface : *own) { change(surface); }
        }
    });
}

/// What profile `fast` stands for.
constexpr int kFastSubSteps = 4;

constexpr std::array<Feature, 13> kFeatures{{
    {"continuous collision", false,
     [](const SceneDescription& scene, const Config& config) {
         return config.continuous != SceneContinuous::off ||
                anyDynamicBody(scene, [](const BodyDescription& body) { return body.continuous.has_value(); });
     },
     [](SceneDescription& scene, Config& config) {
         config.continuous = SceneContinuous::off;
         for (BodyDescription& body : scene.bodies) { body.continuous.reset(); }
     }},
    {"bullets", false,
     [](const SceneDescription& scene, const Config&) {
         return anyDynamicBody(scene, [](const BodyDescription& body) { return body.bullet; });
     },
     [](SceneDescription& scene, Config&) {
         for (BodyDescription& body : scene.bodies) { body.bullet = false; }
     }},
    {"more than 4 sub-steps", false,
     [](const SceneDescription&, const Config& config) { return config.subSteps > kFastSubSteps; },
     [](SceneDescription&, Config& config) { config.subSteps = kFastSubSteps; }},
    {"relaxation", false, [](const SceneDescription&, const Config& config) { return config.relaxPasses > 0; },
     [](SceneDescription&, Config& config) { config.relaxPasses = 0; }},
    {"sleep", false, [](const SceneDescription& scene, const Config&) { return scene.settings.sleep; },
     [](SceneDescription& scene, Config&) { scene.settings.sleep = false; }},
    {"restitution", true, [](const SceneDescription& scene, const Config&) { return anySurfaceThat(scene, bounces); },
     [](SceneDescription& scene, Config&) { eachSurface(scene, [](auto& surface) { surface.restitution = 0; }); }},
    {"friction", true, [](const SceneDescription& scene, const Config&) { return anySurfaceThat(scene, rubs); },
     [](SceneDescription& scene, Config&) { eachSurface(scene, [](auto& surface) { surface.friction = 0; }); }},
    {"surface speed", true, [](const SceneDescription& scene, const Config&) { return anySurfaceThat(scene, isBelt); },
     [](SceneDescription& scene, Config&) { eachSurface(scene, [](auto& surface) { surface.surfaceSpeed = 0; }); }},
    {"mixing rules", true,
     [](const SceneDescription& scene, const Config&) {
         return anyShape(scene, [](const ShapeDescription& shape) { return !shape.sensor && hasMixingRule(shape); });
     },
     [](SceneDescription& scene, Config&) {
         eachSurface(scene, [](auto& surface) {
             surface.frictionMixing = MixingRule::usual;
             surface.restitutionMixing = MixingRule::usual;
         });
     }},
    {"rolling resistance", true,
     [](const SceneDescription& scene, const Config&) { return anySurfaceThat(scene, resistsRolling); },
     [](SceneDescription& scene, Config&) {
         eachSurface(scene, [](auto& surface) { surface.rollingResistance = 0; });
     }},
    {"rotation", true,
     [](const SceneDescription& scene, const Config&) {
         return anyDynamicBody(scene, [](const BodyDescription& body) { return !body.fixedRotation; });
     },
     [](SceneDescription& scene, Config&) {
         for (BodyDescription& body : scene.bodies) {
             if (body.type != SceneBodyType::dynamic) { continue; }
             body.fixedRotation = true;
             body.angularVelocity = 0;  // a scene in which such a body spins is refused
         }
     }},
    {"joints", true, [](const SceneDescription& scene, const Config&) { return !scene.joints.empty(); },
     [](SceneDescription& scene, Config&) { scene.joints.clear(); }},
    {"sensors", true,
     [](const SceneDescription& scene, const Config&) {
         return anyShape(scene, [](const ShapeDescription& shape) { return shape.sensor; });
     },
     [](SceneDescription& scene, Config&) {
         // They stay as weights, but see nothing.
         eachShape(scene, [](ShapeDescription& shape) { shape.filter.mask = shape.sensor ? 0 : shape.filter.mask; });
     }},
}};

}  // namespace

std::span<const Feature> allFeatures() { return kFeatures; }

}  // namespace swept::tune
