#include <algorithm>
#include <limits>

#include "../number_text.h"
#include "checks.h"
#include "envelope.h"

namespace swept {
namespace {

/// Bodies nearer than this part of the smaller extent will be in contact from the start.
constexpr double kTouchRatio = 1.0 / 8;

const PlacedBody& bodyOf(const PlacedScene& placed, const PlacedPiece& piece) {
    return placed.bodies[static_cast<std::size_t>(piece.body)];
}

void checkOverlap(const PlacedScene& placed, const NearPair& pair, std::vector<Finding>& findings) {
    const PlacedPiece& a = placed.pieces[static_cast<std::size_t>(pair.pieceA)];
    const PlacedPiece& b = placed.pieces[static_cast<std::size_t>(pair.pieceB)];
    const double extent = std::min(a.extent, b.extent);
    const double depth = -pair.separation;
    if (depth <= envelope::kStartOverlap * extent) { return; }
    // A quarter of the extent a step is the fastest push out of an overlap.
    const double speed = std::min(depth, extent / 4) / placed.scene->settings.dt;
    findings.push_back({Severity::warning, "overlap", pointerOf(b),
                        bodyOf(placed, b).name + " starts " + metres(depth) + " inside " + bodyOf(placed, a).name +
                            " and is pushed out at up to " + roundedText(speed, 3) + " m/s",
                        "move one of them by " + metres(depth)});
}

void checkMasses(const PlacedScene& placed, const NearPair& pair, std::vector<Finding>& findings) {
    const PlacedPiece& a = placed.pieces[static_cast<std::size_t>(pair.pieceA)];
    const PlacedPiece& b = placed.pieces[static_cast<std::size_t>(pair.pieceB)];
    const PlacedBody& bodyA = bodyOf(placed, a);
    const PlacedBody& bodyB = bodyOf(placed, b);
    if (bodyA.mass == 0 || bodyB.mass == 0 || pair.separation > kTouchRatio * std::min(a.extent, b.extent)) { return; }
    const PlacedBody& heavy = bodyA.mass > bodyB.mass ? bodyA : bodyB;
    const PlacedBody& light = bodyA.mass > bodyB.mass ? bodyB : bodyA;
    const double ratio = heavy.mass / light.mass;
    const DVec2 apart = heavy.center - light.center;
    const bool isOnTop = dot(apart, placed.scene->gravity) < 0;
    if (ratio <= envelope::kContactMassRatio || !isOnTop) { return; }
    findings.push_back({Severity::warning, "mass-ratio", pointerOf(heavy),
                        heavy.name + " (" + roundedText(heavy.mass, 3) + " kg) rests on " + light.name + " (" +
                            roundedText(light.mass, 3) + " kg), " + roundedText(ratio, 3) +
                            " times lighter: it sinks in or crushes it",
                        "densities within a factor of " + roundedText(envelope::kContactMassRatio) +
                            ", or more /settings/subSteps (the error falls with their square)"});
}

/// A large piece of ground under something small: in f32 the small one is measured in coordinates of the large one.
void checkGround(const PlacedScene& placed, const NearPair& pair, std::vector<Finding>& findings) {
    const PlacedPiece& a = placed.pieces[static_cast<std::size_t>(pair.pieceA)];
    const PlacedPiece& b = placed.pieces[static_cast<std::size_t>(pair.pieceB)];
    const PlacedPiece& ground = bodyOf(placed, a).isDynamic() ? b : a;
    const PlacedPiece& mover = bodyOf(placed, a).isDynamic() ? a : b;
    if (bodyOf(placed, ground).isDynamic()) { return; }
    const double reach = radiusAbout(ground.polygon, Vec2{0, 0});
    const double rounding = reach * static_cast<double>(std::numeric_limits<float>::epsilon());
    if (rounding <= envelope::kToleranceRatio * mover.extent) { return; }
    findings.push_back({Severity::warning, "huge-ground", pointerOf(ground),
                        bodyOf(placed, ground).name + " reaches " + metres(reach) + " from its body's origin; under " +
                            bodyOf(placed, mover).name + " (" + metres(mover.extent) +
                            ") single precision places its surface to " + metres(rounding),
                        "several bodies with shorter pieces, or --precision f64"});
}

}  // namespace

void checkPairs(const PlacedScene& placed, std::vector<Finding>& findings) {
    double largest = 0;
    for (const PlacedPiece& piece : placed.pieces) {
        if (bodyOf(placed, piece).isDynamic()) { largest = std::max(largest, piece.extent); }
    }
    for (const NearPair& pair : nearPairs(placed, kTouchRatio * largest)) {
        checkOverlap(placed, pair, findings);
        checkMasses(placed, pair, findings);
        checkGround(placed, pair, findings);
    }
}

}  // namespace swept
