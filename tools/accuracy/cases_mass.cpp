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

/// Twenty planks between two posts, a V to begin with, and what falls on them: loops of joints with contacts. The
/// widest gap of a hinge between planks, m, at any time.
Case loadedBridge(const std::string& name, double density) {
    Case c{"mass", name, emptyScene(name), 600, {}, {}, false};
    constexpr int kPlanks = 20;
    constexpr double kHalf = 0.25;
    constexpr double kSlope = 0.28;  // rad
    const DVec2 down{std::cos(kSlope), -std::sin(kSlope)};
    const auto corner = [down](int i) {
        const int fromEnd = std::min(i, kPlanks - i);
        return DVec2{2 * kHalf * i * down.x, 2 * kHalf * fromEnd * down.y};
    };
    addFixed(c.scene, "left", corner(0), {circle(0.02)}).shapes[0].filter.mask = 0;
    addFixed(c.scene, "right", corner(kPlanks), {circle(0.02)}).shapes[0].filter.mask = 0;
    const int first = lastBody(c.scene) + 1;
    std::string before = "left";
    for (int i = 0; i < kPlanks; ++i) {
        const std::string plank = "plank" + std::to_string(i);
        BodyDescription& body = addDynamic(c.scene, plank, 0.5 * (corner(i) + corner(i + 1)), {box({kHalf, 0.05})});
        body.angle = i < kPlanks / 2 ? -kSlope : kSlope;
        body.shapes[0].filter.group = -1;
        hinge(c.scene, before, plank, corner(i));
        before = plank;
    }
    hinge(c.scene, before, "right", corner(kPlanks));
    for (int i = 0; i < 3; ++i) {
        addDynamic(c.scene, "", {corner(kPlanks / 2).x, 0.8 * i}, {withDensity(box({0.3, 0.3}), density)});
    }
    setSurface(c.scene, 0.6, 0);
    c.measures = {{"joint gap", "m", [first](const Frames& frames) {
                       double widest = 0;
                       for (const Frame& frame : frames) {
                           for (int i = 0; i + 1 < kPlanks; ++i) {
                               const BodyFrame& a = bodyAt(frame, first + i);
                               const BodyFrame& b = bodyAt(frame, first + i + 1);
                               const DVec2 ofA{kHalf * std::cos(a.angle), kHalf * std::sin(a.angle)};
                               const DVec2 ofB{kHalf * std::cos(b.angle), kHalf * std::sin(b.angle)};
                               widest = std::max(widest, length(b.position - ofB - (a.position + ofA)));
                           }
                       }
                       return widest;
                   }}};
    c.verdict = staysWithin(100);
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
    cases.push_back(loadedBridge("bridge", 1));
    cases.push_back(loadedBridge("bridge-R100", 100));
    return cases;
}

}  // namespace swept::accuracy
