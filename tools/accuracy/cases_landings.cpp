#include <algorithm>
#include <cmath>

#include "case_parts.h"

namespace swept::accuracy {
namespace {

using build::addDynamic;
using build::addFixed;
using build::box;

constexpr double kFall = 2.45;  ///< to where they land with 7 m/s
constexpr double kSpacing = 4;
constexpr double kTile = 0.4;
constexpr int kCrates = 12;

/// The fastest way up that any body had after it had come down, as a part of the speed with which it did. Nothing
/// bounces, so that is 0.
double rebound(const Frames& frames) {
    double worst = 0;
    for (std::size_t body = 1; body < frames.front().bodies.size(); ++body) {
        double down = 0;
        double up = 0;
        for (const Frame& frame : frames) {
            const double velocity = frame.bodies[body].velocity.y;
            down = std::max(down, -velocity);
            up = std::max(up, velocity);
        }
        worst = std::max(worst, up / down);
    }
    return worst;
}

/// Boxes beside each other, flush at y = 0.
void addTiles(SceneDescription& scene) {
    BodyDescription& floor = addFixed(scene, "floor", {0, 0}, {});
    const int tiles = static_cast<int>(std::ceil((kCrates + 1) * kSpacing / kTile));
    for (int i = 0; i < tiles; ++i) {
        floor.shapes.push_back(box({kTile / 2, 0.5}, {(i + 0.5) * kTile - kSpacing, -0.5}));
    }
}

/// Half of the sides of a crate.
double halfOf(int crate) { return 0.2 + 0.07 * crate; }

/// Crates of 0.4 to 1.9 m come down flat on tiles of 0.4 m.
Case flat() {
    Case c{"landings", "tiles-flat", emptyScene("tiles-flat"), 120, {}, {}, false};
    addTiles(c.scene);
    for (int i = 0; i < kCrates; ++i) {
        const double half = halfOf(i);
        addDynamic(c.scene, "", {i * kSpacing + 0.13 * i, kFall + half}, {box({half, half})});
    }
    setSurface(c.scene, 0.6, 0);
    c.measures = {{"rebound", "1", rebound}};
    c.verdict = staysWithin(1e3);
    return c;
}

/// The same crates, tilted by up to 0.3 rad: how deep a corner of one is in the floor, metres.
Case tilted() {
    Case c{"landings", "tiles-tilted", emptyScene("tiles-tilted"), 120, {}, {}, false};
    addTiles(c.scene);
    for (int i = 0; i < kCrates; ++i) {
        const double half = halfOf(i);
        BodyDescription& crate =
            addDynamic(c.scene, "", {i * kSpacing + 0.13 * i, kFall + 1.2 * half}, {box({half, half})});
        crate.angle = (i % 2 == 0 ? 0.025 : -0.025) * (i + 1);
    }
    setSurface(c.scene, 0.6, 0);
    c.measures = {{"depth", "m", [](const Frames& frames) {
                       double deepest = 0;
                       for (const Frame& frame : frames) {
                           for (int i = 0; i < kCrates; ++i) {
                               const BodyFrame& crate = bodyAt(frame, i + 1);
                               const double reach =
                                   halfOf(i) * (std::fabs(std::cos(crate.angle)) + std::fabs(std::sin(crate.angle)));
                               deepest = std::max(deepest, reach - crate.position.y);
                           }
                       }
                       return deepest;
                   }}};
    c.verdict = staysWithin(1e3);
    return c;
}

/// Five crates, one on another, come down on one floor.
Case tower() {
    constexpr int kHeight = 5;
    Case c{"landings", "dropped-tower", emptyScene("dropped-tower"), 120, {}, {}, false};
    addFixed(c.scene, "floor", {0, -0.5}, {box({10, 0.5})});
    for (int i = 0; i < kHeight; ++i) { addDynamic(c.scene, "", {0, 1.5 + 0.5 + i}, {box({0.5, 0.5})}); }
    setSurface(c.scene, 0.6, 0);
    c.measures = {{"rebound", "1", rebound}, drift(c.scene, 1)};
    c.verdict = staysWithin(1e3);
    return c;
}

}  // namespace

std::vector<Case> landingCases() { return {flat(), tilted(), tower()}; }

}  // namespace swept::accuracy
