#include <algorithm>
#include <limits>
#include <set>
#include <utility>
#include <vector>

#include "../writers/number_text.h"
#include "assemblies.h"
#include "checks.h"
#include "envelope.h"

namespace swept {
namespace {

/// Bodies nearer than this part of the smaller extent will be in contact from the start.
constexpr double kTouchRatio = 1.0 / 8;

bool isFast(const PlacedScene& placed) { return placed.scene->settings.profile == SceneProfile::fast; }

void checkOverlap(const PlacedScene& placed, const NearPair& pair, std::vector<Finding>& findings) {
    const PlacedPiece& a = placed.pieces[static_cast<std::size_t>(pair.pieceA)];
    const PlacedPiece& b = placed.pieces[static_cast<std::size_t>(pair.pieceB)];
    const double extent = std::min(a.extent, b.extent);
    const double depth = -pair.separation;
    if (depth <= envelope::kStartOverlap * extent) { return; }
    const double fastest = isFast(placed) ? envelope::kFastPush : envelope::kPush;
    const double speed = std::min(depth, fastest * extent) / placed.scene->settings.dt;
    findings.push_back({Severity::warning, "overlap", pointerOf(b),
                        bodyOf(placed, b).name + " starts " + metres(depth) + " inside " + bodyOf(placed, a).name +
                            " and is pushed out at up to " + roundedText(speed, 3) + " m/s",
                        "move one of them by " + metres(depth)});
}

/// What lies on what.
class Piles {
public:
    Piles(const PlacedScene& placed, const std::vector<NearPair>& pairs)
        : placed_(placed), together_(placed.bodies.size()), bodies_(placed.bodies.size()), contacts_(bodies_) {
        std::set<std::pair<int, int>> touching;
        for (const NearPair& pair : pairs) {
            if (!areTouching(pair)) { continue; }
            const PlacedBody& a = bodyOf(placed, pieceAt(pair.pieceA));
            const PlacedBody& b = bodyOf(placed, pieceAt(pair.pieceB));
            if (a.isDynamic() && b.isDynamic()) { together_.join(a.index, b.index); }
            touching.insert({a.index, b.index});
        }
        for (const PlacedBody& body : placed.bodies) { bodies_[rootOf(body)] += body.isDynamic() ? 1 : 0; }
        for (const auto& [a, b] : touching) {
            const PlacedBody& bodyA = placed.bodies[static_cast<std::size_t>(a)];
            ++contacts_[rootOf(bodyA.isDynamic() ? bodyA : placed.bodies[static_cast<std::size_t>(b)])];
        }
    }

    bool areTouching(const NearPair& pair) const {
        return pair.separation <= kTouchRatio * std::min(pieceAt(pair.pieceA).extent, pieceAt(pair.pieceB).extent);
    }
    /// Contacts close no loop, or few bodies are in it.
    bool isTowerOrSmall(const PlacedBody& body) const {
        const int bodies = bodies_[rootOf(body)];
        return contacts_[rootOf(body)] <= bodies || bodies <= envelope::kMostPileBodies;
    }

private:
    const PlacedPiece& pieceAt(int i) const { return placed_.pieces[static_cast<std::size_t>(i)]; }
    std::size_t rootOf(const PlacedBody& body) const { return static_cast<std::size_t>(together_.rootOf(body.index)); }

    const PlacedScene& placed_;
    Assemblies together_;
    std::vector<int> bodies_;  ///< by root, as are contacts
    std::vector<int> contacts_;
};

void checkMasses(const PlacedScene& placed, const Piles& piles, const NearPair& pair, std::vector<Finding>& findings) {
    const PlacedPiece& a = placed.pieces[static_cast<std::size_t>(pair.pieceA)];
    const PlacedPiece& b = placed.pieces[static_cast<std::size_t>(pair.pieceB)];
    const PlacedBody& bodyA = bodyOf(placed, a);
    const PlacedBody& bodyB = bodyOf(placed, b);
    if (bodyA.mass == 0 || bodyB.mass == 0 || !piles.areTouching(pair)) { return; }
    const PlacedBody& heavy = bodyA.mass > bodyB.mass ? bodyA : bodyB;
    const PlacedBody& light = bodyA.mass > bodyB.mass ? bodyB : bodyA;
    const double ratio = heavy.mass / light.mass;
    const DVec2 apart = heavy.center - light.center;
    const bool isOnTop = dot(apart, placed.scene->gravity) < 0;
    const bool isDirect = solvesAtOnce(placed) && piles.isTowerOrSmall(light);
    const double most = isDirect ? envelope::kDirectMassRatio : iteratedMassRatio(placed, light, light.extent);
    if (ratio <= most || !isOnTop) { return; }
    findings.push_back({Severity::warning, "mass-ratio", pointerOf(heavy),
                        heavy.name + " (" + roundedText(heavy.mass, 3) + " kg) rests on " + light.name + " (" +
                            roundedText(light.mass, 3) + " kg), " + roundedText(ratio, 3) +
                            " times lighter: once it moves, it sinks in or crushes it",
                        massRemedy(placed, most)});
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
    const std::vector<NearPair> pairs = nearPairs(placed, kTouchRatio * largest);
    const Piles piles(placed, pairs);
    for (const NearPair& pair : pairs) {
        checkOverlap(placed, pair, findings);
        checkMasses(placed, piles, pair, findings);
        checkGround(placed, pair, findings);
    }
}

}  // namespace swept
