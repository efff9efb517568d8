#pragma once

#include <string>
#include <vector>

#include <swept/samples/frame.h>
#include <swept/samples/scene_builder.h>

#include "accuracy_case.h"

/// Words in which the cases are written.

namespace swept::accuracy {

inline constexpr double kGravity = 10;  ///< m/s², of all cases that have any

/// An empty scene at 60 Hz without sleep (sleep hides creep), with gravity straight down.
SceneDescription emptyScene(const std::string& name, double gravity = kGravity);

/// The same friction and restitution on every shape: what a pair has then does not depend on an engine's mixing rule.
void setSurface(SceneDescription& scene, double friction, double restitution);

/// Index of the body that was added last.
int lastBody(const SceneDescription& scene);

// Measures over dynamic bodies.

/// Largest distance of any dynamic body from its start at the end, as a part of `length`.
Measure worstMove(const SceneDescription& scene, double length);
/// Largest sideways distance of any dynamic body from its start at the end, as a part of `length`.
Measure drift(const SceneDescription& scene, double length);
/// Loss of height of one body at the end, as a part of `length`.
Measure sag(const std::string& name, int body, double length);
/// Fastest body over the last second: what "at rest" leaves, m/s.
Measure jitter(const SceneDescription& scene);

/// Stands: the top above 0.9 of its height, sideways drift below a side, no body above 0.01·√(g·side) at the end.
Verdict stands(const SceneDescription& scene, int top, double side, double gravity = kGravity);
/// No position beyond `limit` metres, nothing that is not finite.
Verdict staysWithin(double limit);

inline const BodyFrame& bodyAt(const Frame& frame, int body) { return frame.bodies[static_cast<std::size_t>(body)]; }
/// Frame nearest to a time.
const Frame& frameAt(const Frames& frames, double time);

}  // namespace swept::accuracy
