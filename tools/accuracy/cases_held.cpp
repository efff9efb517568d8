#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "case_parts.h"

namespace swept::accuracy {
namespace {

using build::addDynamic;
using build::addFixed;
using build::box;
using build::circle;
using build::hinge;
using build::weld;

constexpr double kPlateSpacing = 2;
constexpr double kPlateRestitution = 0.9;
constexpr double kStrikerRadius = 0.05;
constexpr double kStrikerMass = 1;
constexpr double kPlateHalf = 0.3;  ///< of a plate, 4 cm thick
constexpr double kPlateHalfThick = 0.02;
constexpr double kPlateArea = 4 * kPlateHalf * kPlateHalfThick;

/// A plate at `x` that weighs so much, and above it, `aside` of its middle, a ball that comes down. Bodies 2i + 1 and
/// 2i + 2.
void addPlateAndBall(SceneDescription& scene, const std::string& name, double x, double mass, double aside,
                     double speed) {
    BodyDescription& plate = addDynamic(scene, name, {x, 0}, {box({kPlateHalf, kPlateHalfThick})});
    plate.shapes[0].density = mass / kPlateArea;
    BodyDescription& ball = addDynamic(scene, "", {x + aside, 0.2}, {circle(kStrikerRadius)});
    ball.velocity = {0, -speed};
    ball.shapes[0].density = kStrikerMass / (std::numbers::pi * kStrikerRadius * kStrikerRadius);
}

/// Largest error of a ball's speed at the end, as a part of that with which it came.
/// @param exact  by ball, m/s
Measure errorOfBalls(const std::vector<double>& exact, double speed) {
    return {"speed", "1", [exact, speed](const Frames& frames) {
                double worst = 0;
                for (std::size_t i = 0; i < exact.size(); ++i) {
                    const double velocity = frames.back().bodies[2 * i + 2].velocity.y;
                    worst = std::max(worst, std::fabs(velocity - exact[i]) / speed);
                }
                return worst;
            }};
}

/// Balls of 3 m/s on plates of a tenth to a hundred times their mass that are welded to the level.
Case plates() {
    constexpr double kSpeed = 3;
    Case c{"held", "held-plate", emptyScene("held-plate", 0), 20, {}, {}, false};
    addFixed(c.scene, "level", {0, 0}, {});
    std::vector<double> exact;
    for (const double ratio : {0.1, 0.5, 1.0, 3.0, 10.0, 100.0}) {
        const double x = kPlateSpacing * static_cast<double>(exact.size());
        const std::string name = "plate" + std::to_string(exact.size());
        addPlateAndBall(c.scene, name, x, ratio * kStrikerMass, kPlateHalf / 2, kSpeed);
        weld(c.scene, "level", name, {x - kPlateHalf, 0});
        exact.push_back(kPlateRestitution * kSpeed);
    }
    setSurface(c.scene, 0, kPlateRestitution);
    c.measures = {errorOfBalls(exact, kSpeed)};
    c.verdict = staysWithin(1e3);
    return c;
}

/// Balls of 2 m/s on bars that turn about one of their ends: J = (1 + e)·v / (1/m + d²/I).
Case flaps() {
    constexpr double kSpeed = 2;
    Case c{"held", "held-flap", emptyScene("held-flap", 0), 15, {}, {}, false};
    addFixed(c.scene, "level", {0, 0}, {});
    std::vector<double> exact;
    for (const double mass : {0.5, 3.0, 24.0}) {
        for (const double lever : {0.15, 0.3, 0.5}) {
            const double x = kPlateSpacing * static_cast<double>(exact.size());
            const std::string name = "flap" + std::to_string(exact.size());
            addPlateAndBall(c.scene, name, x, mass, lever - kPlateHalf, kSpeed);
            hinge(c.scene, "level", name, {x - kPlateHalf, 0});
            const double inertia =
                mass * ((kPlateHalf * kPlateHalf + kPlateHalfThick * kPlateHalfThick) / 3 + kPlateHalf * kPlateHalf);
            const double impulse = (1 + kPlateRestitution) * kSpeed / (1 / kStrikerMass + lever * lever / inertia);
            exact.push_back(impulse / kStrikerMass - kSpeed);
        }
    }
    setSurface(c.scene, 0, kPlateRestitution);
    c.measures = {errorOfBalls(exact, kSpeed)};
    c.verdict = staysWithin(1e3);
    return c;
}

}  // namespace

std::vector<Case> heldCases() { return {plates(), flaps()}; }

}  // namespace swept::accuracy
