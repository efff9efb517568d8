#include <algorithm>
#include <cmath>
#include <numbers>

#include "case_parts.h"

namespace swept::accuracy {
namespace {

using build::addDynamic;
using build::addFixed;
using build::box;
using build::circle;
using build::hinge;
using build::withDensity;

std::string ratioText(double ratio) { return std::to_string(static_cast<long>(ratio)); }

/// A box of density R on `below` unit boxes of density 1.
Case heavyTop(int below, double ratio) {
    const std::string name = "heavy-top-" + std::to_string(below) + "-R" + ratioText(ratio);
    Case c{"mass", name, emptyScene(name), 600, {}, {}, false};
    addFixed(c.scene, "ground", {0, -0.5}, {box({20, 0.5})});
    for (int i = 0; i < below; ++i) { addDynamic(c.scene, "", {0, i + 0.5}, {box({0.5, 0.5})}); }
    addDynamic(c.scene, "top", {0, below + 0.5}, {withDensity(box({0.5, 0.5}), ratio)});
    setSurface(c.scene, 0.6, 0);
    c.measures = {sag("sag of a box", lastBody(c.scene), below), drift(c.scene, 1)};
    c.verdict = stands(c.scene, lastBody(c.scene), 1);
    return c;
}

constexpr int kLinks = 20;
constexpr double kLink = 0.5;
constexpr double kChainLength = kLinks * kLink + 0.5;

/// Farthest that the ball ever got from the pivot, beyond the length of the chain.
Measure stretch(int ball) {
    return {"stretch", "1", [ball](const Frames& frames) {
                double farthest = 0;
                for (const Frame& frame : frames) {
                    farthest = std::max(farthest, length(frame.bodies[static_cast<std::size_t>(ball)].position));
                }
                return std::max(0.0, farthest - kChainLength) / kChainLength;
            }};
}

/// Twenty links of 1 kg under a fixed pivot, then a ball of mass R: hanging, or let go level.
Case chain(double ratio, bool swung) {
    const std::string name = std::string(swung ? "chain-swung-R" : "chain-R") + ratioText(ratio);
    Case c{"mass", name, emptyScene(name), 600, {}, {}, false};
    const DVec2 along = swung ? DVec2{1, 0} : DVec2{0, -1};
    const double angle = swung ? 0 : -std::numbers::pi / 2;
    addFixed(c.scene, "pivot", {0, 0}, {circle(0.05)});
    std::string before = "pivot";
    for (int i = 0; i < kLinks; ++i) {
        const std::string link = "link" + std::to_string(i);
        BodyDescription& body = addDynamic(c.scene, link, (kLink * (i + 0.5)) * along, {box({0.25, 0.05})});
        body.angle = angle;
        body.mass = 1;
        hinge(c.scene, before, link, (kLink * i) * along);
        before = link;
    }
    addDynamic(c.scene, "ball", kChainLength * along, {circle(0.5)}).mass = ratio;
    hinge(c.scene, before, "ball", (kLink * kLinks) * along);
    // Neighbours overlap at their joints; the chain shall not collide with itself.
    for (BodyDescription& body : c.scene.bodies) { body.shapes[0].filter.group = -1; }
    c.measures = {stretch(lastBody(c.scene))};
    c.verdict = staysWithin(10 * kChainLength);
    return c;
}

}  // namespace

std::vector<Case> massCases() {
    std::vector<Case> cases;
    for (const int below : {1, 10}) {
        for (const double ratio : {10.0, 100.0, 1000.0, 1e4}) { cases.push_back(heavyTop(below, ratio)); }
    }
    for (const double ratio : {10.0, 100.0, 1000.0, 1e4, 1e6}) { cases.push_back(chain(ratio, false)); }
    for (const double ratio : {100.0, 1000.0, 1e4, 1e6}) { cases.push_back(chain(ratio, true)); }
    return cases;
}

}  // namespace swept::accuracy
