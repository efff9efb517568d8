#pragma once

#include <cmath>
#include <string>
#include <vector>

#include "../writers/number_text.h"
#include "finding.h"
#include "placed_scene.h"

/// The parts of an inspection. Each appends what it finds, in the order of the scene.

namespace swept {

/// What the engine refuses to build, in one precision or both. @return whether f32 does, and f64 does not
bool checkRefusals(const SceneDescription& scene, std::vector<Finding>& findings);
/// Single bodies: units, size against the step, place, shape, speed.
void checkBodies(const PlacedScene& placed, std::vector<Finding>& findings);
/// Dynamic bodies so fast at the start, or by their motors, that others pass through them in a step: one finding.
void checkPassing(const PlacedScene& placed, std::vector<Finding>& findings);
/// Bodies that touch or overlap at the start, and the ground under them.
void checkPairs(const PlacedScene& placed, std::vector<Finding>& findings);
/// Chains that are the wrong way round for what is above them.
void checkChains(const PlacedScene& placed, std::vector<Finding>& findings);
/// Joints: masses, what they ask for at the start, what cannot be met.
void checkJoints(const PlacedScene& placed, std::vector<Finding>& findings);
/// Which features the scene can reach.
std::vector<Need> needsOf(const PlacedScene& placed);

/// Fastest that some point of a body can get on its own: by its start or its motors, and the fall to the lowest thing
/// of the scene, without what others hand on to it, or springs. m/s.
double reachableSpeed(const PlacedScene& placed, const PlacedBody& body);

/// The mode that holds for a body.
SceneContinuous modeOf(const PlacedScene& placed, const PlacedBody& body);

/// Whether a body is swept against dynamic ones.
bool isBullet(const PlacedScene& placed, const PlacedBody& body);

/// How many times heavier than a body its load may be where the two are iterated. Infinite without gravity.
/// @param size  of the lighter body, metres
double iteratedMassRatio(const PlacedScene& placed, const PlacedBody& light, double size);
/// Whether the profile solves towers and trees of joints all at once.
bool solvesAtOnce(const PlacedScene& placed);
/// What else to do about masses that are too far apart for `most`.
std::string massRemedy(const PlacedScene& placed, double most);

/// Angles are in radians. Whole multiples of five beyond a turn are what people mean in degrees.
inline constexpr double kFullTurn = 6.283185307179586;
inline bool isMultipleOfFive(double angle) { return std::fmod(angle, 5) == 0; }
inline std::string fromDegrees(double angle) { return roundedText(angle / 360 * kFullTurn); }

/// A length in words.
inline std::string metres(double x) { return roundedText(x, 3) + " m"; }

/// Magnitude of the gravity that acts on a body, m/s².
double gravityOf(const PlacedScene& placed, const PlacedBody& body);

}  // namespace swept
