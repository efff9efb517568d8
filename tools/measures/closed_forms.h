#pragma once

#include <functional>
#include <optional>
#include <string>

#include <swept/samples/scene_description.h>

namespace swept::measures {

/// The exact motion of a scene: where a body's origin is, at which time.
struct ClosedForm {
    std::string name;  ///< "free flight", "bouncing ball", "pendulum"
    std::function<DVec2(int body, double time)> position;
};

/// Recognises, from the scene alone, those motions that can be written down:
/// - *free flight*: no two shapes may collide and there are no joints; parabolas, with damping.
/// - *bouncing ball*: one disk, not turning, above the top of one static box that is level; gravity straight down; no
///   damping; with restitution, until its bounces cannot be seen.
/// - *pendulum*: one body on one hinge to a static one, nothing collides; the equation of the physical pendulum,
/// integrated
///   by Runge and Kutta's fourth-order method in steps so short that its error is below 1e-9 m.
/// @param duration  seconds that the form must reach
std::optional<ClosedForm> closedFormOf(const SceneDescription& scene, double duration);

}  // namespace swept::measures
