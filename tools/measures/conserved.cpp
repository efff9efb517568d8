#include "conserved.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

#include "posed_scene.h"

namespace swept::measures {
namespace {

template <class Condition>
bool anyBody(const PlacedScene& placed, const Condition& holds) {
    return std::any_of(placed.bodies.begin(), placed.bodies.end(), holds);
}

/// A joint that stores energy or brings it in: a spring or a motor of any kind.
bool isActive(const JointDescription& joint) {
    return std::visit(
        [](const auto& part) {
            using Part = std::decay_t<decltype(part)>;
            bool active = std::is_same_v<Part, MotorDescription> || std::is_same_v<Part, MouseDescription>;
            if constexpr (requires { part.hertz; }) { active = active || part.hertz.has_value(); }
            if constexpr (requires { part.linearHertz; }) {
                active = active || part.linearHertz.has_value() || part.angularHertz.has_value();
            }
            if constexpr (requires { part.motorSpeed; }) { active = active || part.motorSpeed.has_value(); }
            return active;
        },
        joint.joint);
}

bool drags(const ShapeDescription& shape) { return !shape.sensor && anySurface(shape, isBelt); }

bool isEnergyBroughtIn(const SceneDescription& scene, const PlacedScene& placed) {
    return std::any_of(scene.joints.begin(), scene.joints.end(), isActive) ||
           anyBody(placed, [](const PlacedBody& body) {
               const std::vector<ShapeDescription>& shapes = body.description->shapes;
               return body.description->type == SceneBodyType::kinematic ||
                      std::any_of(shapes.begin(), shapes.end(), drags);
           });
}

/// Whether some pair that may collide loses energy by rubbing, by rolling or by bouncing less than it came.
bool isEnergyLostInContacts(const PlacedScene& placed) {
    for (std::size_t i = 0; i < placed.pieces.size(); ++i) {
        for (std::size_t k = 0; k < i; ++k) {
            const FullSurface a = surfaceOf(placed, placed.pieces[i]);
            const FullSurface b = surfaceOf(placed, placed.pieces[k]);
            const bool isLossless = mixedRestitution(a, b) >= 1 && mixedFriction(a, b) == 0 &&
                                    std::max(a.rollingResistance, b.rollingResistance) == 0;
            if (!isLossless && mayCollide(placed, placed.pieces[i], placed.pieces[k])) { return true; }
        }
    }
    return false;
}

bool isDamped(const PlacedBody& body) {
    return body.isDynamic() && (body.description->linearDamping > 0 || body.description->angularDamping > 0);
}

/// J; see conserved.h.
double energyScale(const SceneDescription& scene, const PlacedScene& placed) {
    const DVec2 up = length(scene.gravity) > 0 ? (-1 / length(scene.gravity)) * scene.gravity : DVec2{0, 1};
    double lowest = 0;
    bool isFirst = true;
    for (const PlacedBody& body : placed.bodies) {
        const double height = dot(body.center, up);
        lowest = isFirst ? height : std::min(lowest, height);
        isFirst = false;
    }
    double energy = 0;
    for (const PlacedBody& body : placed.bodies) {
        if (body.isDynamic()) {
            const BodyDescription& description = *body.description;
            energy += 0.5 * body.mass * dot(description.velocity, description.velocity) +
                      0.5 * body.inertia * description.angularVelocity * description.angularVelocity +
                      body.mass * std::fabs(description.gravityScale) * length(scene.gravity) *
                          (dot(body.center, up) - lowest);
        }
    }
    return energy;
}

void measureEnergy(const SceneDescription& scene, const PlacedScene& placed, const Recording& recording,
                   Values& values) {
    const double scale = energyScale(scene, placed);
    if (isEnergyBroughtIn(scene, placed) || !(scale > 0)) { return; }
    double least = recording.samples.front().energy;
    double gain = 0;
    double drift = 0;
    for (const Sample& sample : recording.samples) {
        gain = std::max(gain, sample.energy - least);
        least = std::min(least, sample.energy);
        drift = std::max(drift, std::fabs(sample.energy - recording.samples.front().energy));
    }
    values[Measure::energyGain] = gain / scale;
    if (!anyBody(placed, isDamped) && !isEnergyLostInContacts(placed)) { values[Measure::energyDrift] = drift / scale; }
}

void measureMomentum(const SceneDescription& scene, const PlacedScene& placed, const Recording& recording,
                     Values& values) {
    const bool isOpen =
        anyBody(placed, [](const PlacedBody& body) { return !body.isDynamic(); }) || anyBody(placed, isDamped);
    DVec2 force;
    double scale = 0;
    for (const PlacedBody& body : placed.bodies) {
        force += (body.mass * body.description->gravityScale) * scene.gravity;
        scale += body.mass * length(body.description->velocity);
    }
    scale += length(force) * recording.duration();
    if (isOpen || !(scale > 0)) { return; }
    double drift = 0;
    for (const Sample& sample : recording.samples) {
        drift = std::max(drift, length(sample.momentum - recording.samples.front().momentum - sample.time * force));
    }
    values[Measure::momentumDrift] = drift / scale;
}

}  // namespace

void measureConserved(const SceneDescription& scene, const Recording& recording, Values& values) {
    const PlacedScene placed = place(scene);
    measureEnergy(scene, placed, recording, values);
    measureMomentum(scene, placed, recording, values);
}

}  // namespace swept::measures
