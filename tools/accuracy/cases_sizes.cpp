#include <cmath>

#include "case_parts.h"

namespace swept::accuracy {
namespace {

using build::addDynamic;
using build::addFixed;
using build::box;

std::string powerOfTen(double value) {
    const int exponent = static_cast<int>(std::lround(std::log10(value)));
    return "1e" + std::to_string(exponent);
}

/// Ten boxes of side s, their lowest at (x, x).
Case tenBoxes(const std::string& name, double side, double gravity, double x) {
    Case c{"sizes", name, emptyScene(name, gravity), 600, {}, {}, false};
    addFixed(c.scene, "ground", {x, x - 0.5 * side}, {box({20 * side, 0.5 * side})});
    for (int i = 0; i < 10; ++i) {
        addDynamic(c.scene, "", {x, x + (i + 0.5) * side}, {box({0.5 * side, 0.5 * side})});
    }
    setSurface(c.scene, 0.6, 0);
    c.measures = {sag("sag of a box", lastBody(c.scene), 10 * side), drift(c.scene, side), jitter(c.scene)};
    c.verdict = stands(c.scene, lastBody(c.scene), side, gravity);
    return c;
}

/// Ten bars of 10 by 0.01 m.
Case flatBars() {
    Case c{"sizes", "flat-bars", emptyScene("flat-bars"), 600, {}, {}, false};
    addFixed(c.scene, "ground", {0, -0.5}, {box({20, 0.5})});
    for (int i = 0; i < 10; ++i) { addDynamic(c.scene, "", {0, 0.01 * (i + 0.5)}, {box({5, 0.005})}); }
    setSurface(c.scene, 0.6, 0);
    c.measures = {worstMove(c.scene, 0.01), jitter(c.scene)};
    c.verdict = staysWithin(100);
    return c;
}

/// 1 m/s for ten seconds, x metres out.
Case flightFarOut(double x) {
    const std::string name = "flight-at-" + powerOfTen(x);
    Case c{"sizes", name, emptyScene(name, 0), 600, {}, {}, false};
    addDynamic(c.scene, "ball", {x, x}, {build::circle(0.5)}).velocity = {1, 0};
    c.measures = {{"missing way", "m", [](const Frames& frames) {
                       const double way = frames.back().bodies[0].position.x - frames.front().bodies[0].position.x;
                       return std::fabs(way - frames.back().time);
                   }}};
    return c;
}

/// A bar of 10 by 0.01 m, a little oblique, dropped on a segment: how far it lies from it in the end.
Case barDrop(const std::string& name, double height) {
    Case c{"sizes", name, emptyScene(name), 600, {}, {}, false};
    constexpr double kTilt = 0.05;
    addFixed(c.scene, "ground", {0, 0}, {build::segment({20, 0}, {-20, 0})});
    addDynamic(c.scene, "bar", {0, height + 5 * std::sin(kTilt)}, {box({5, 0.005})}).angle = kTilt;
    setSurface(c.scene, 0.6, 0);
    c.measures = {
        {"height", "m", [](const Frames& frames) { return std::fabs(frames.back().bodies[1].position.y - 0.005); }},
        jitter(c.scene)};
    c.verdict = staysWithin(100);
    return c;
}

}  // namespace

std::vector<Case> sizeCases() {
    std::vector<Case> cases;
    for (const double side : {1e-3, 1e-2, 0.1, 10.0, 100.0, 1000.0}) {
        cases.push_back(tenBoxes("size-" + powerOfTen(side), side, kGravity, 0));
    }
    for (const double side : {1e-3, 1e-2, 0.1, 10.0, 100.0, 1e3}) {
        cases.push_back(tenBoxes("units-" + powerOfTen(side), side, kGravity * side, 0));
    }
    for (const double x : {1e4, 1e5, 1e6, 1e7}) {
        cases.push_back(tenBoxes("stack-at-" + powerOfTen(x), 1, kGravity, x));
    }
    for (const double x : {1e4, 1e5, 1e6}) { cases.push_back(flightFarOut(x)); }
    cases.push_back(flatBars());
    cases.push_back(barDrop("bar-drop-0.5", 0.5));
    cases.push_back(barDrop("bar-drop-5", 5));
    return cases;
}

}  // namespace swept::accuracy
