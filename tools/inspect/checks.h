#pragma once

#include <string>
#include <vector>

#include "../number_text.h"
#include "finding.h"
#include "placed_scene.h"

/// The parts of an inspection. Each appends what it finds, in the order of the scene.

namespace swept {

/// Single bodies: units, size against the step, place, shape, speed.
void checkBodies(const PlacedScene& placed, std::vector<Finding>& findings);
/// Bodies that touch or overlap at the start, and the ground under them.
void checkPairs(const PlacedScene& placed, std::vector<Finding>& findings);
/// Joints: masses, what they ask for at the start, what cannot be met.
void checkJoints(const PlacedScene& placed, std::vector<Finding>& findings);
/// Which features the scene can reach.
std::vector<Need> needsOf(const PlacedScene& placed);

/// Fastest that some point of a body can get on its own: its start and the fall to the lowest thing of the scene,
/// without what others hand on to it. m/s.
double reachableSpeed(const PlacedScene& placed, const PlacedBody& body);

/// The mode that holds for a body.
SceneContinuous modeOf(const PlacedScene& placed, const PlacedBody& body);

/// A length in words.
inline std::string metres(double x) { return roundedText(x, 3) + " m"; }

/// Magnitude of the gravity that acts on a body, m/s².
double gravityOf(const PlacedScene& placed, const PlacedBody& body);

}  // namespace swept
