#include <algorithm>
#include <cmath>

#include "case_parts.h"

namespace swept::accuracy {
namespace {

using build::addDynamic;
using build::addFixed;
using build::circle;
using build::segment;

constexpr double kBounceRadius = 0.1;
constexpr int kBounces = 20;

/// The free flights of a ball: when and how high above the floor each of them peaks, told from one frame of each.
struct Apex {
    double time;
    double height;
};
std::vector<Apex> apexesOf(const Frames& frames) {
    std::vector<Apex> apexes;
    double before = 1;  // the ball begins at its first apex
    for (const Frame& frame : frames) {
        const BodyFrame& ball = frame.bodies[1];
        if (apexes.empty() || (before < 0 && ball.velocity.y >= 0)) {
            const double rise = ball.velocity.y / kGravity;
            apexes.push_back({frame.time + rise, ball.position.y - kBounceRadius + 0.5 * rise * ball.velocity.y});
        }
        before = ball.velocity.y;
    }
    return apexes;
}

std::string speedText(double speed) {
    const auto tenths = std::lround(speed * 10);
    return std::to_string(tenths / 10) + "." + std::to_string(tenths % 10);
}

/// A ball that meets the floor at `speed`, e = 1.
Case drop(double speed) {
    const std::string name = "drop-" + speedText(speed);
    const double period = 2 * speed / kGravity;
    Case c{"bounce", name, emptyScene(name), std::lround((kBounces + 1) * period * 60), {}, {}, false};
    addFixed(c.scene, "floor", {0, 0}, {segment({-10, 0}, {10, 0})});
    addDynamic(c.scene, "ball", {0, kBounceRadius + 0.5 * speed * speed / kGravity}, {circle(kBounceRadius)});
    setSurface(c.scene, 0, 1);
    const auto lost = [period](const Frames& frames) {
        const std::vector<Apex> apexes = apexesOf(frames);
        const std::size_t bounces = apexes.size() - 1;
        return bounces == 0
                   ? period
                   : std::fabs((apexes.back().time - apexes.front().time) / static_cast<double>(bounces) - period);
    };
    const auto height = [](const Frames& frames) {
        const std::vector<Apex> apexes = apexesOf(frames);
        double worst = apexes.size() < 2 ? 1 : 0;
        for (const Apex& apex : apexes) { worst = std::max(worst, std::fabs(apex.height / apexes.front().height - 1)); }
        return worst;
    };
    c.measures = {{"time of a bounce", "s", lost}, {"height", "1", height}};
    c.verdict = staysWithin(1e4);
    c.isLong = speed > 50;
    return c;
}

/// A ball between two walls without gravity: the part of the expected impacts that do not happen in 10 s.
Case pingPong(double speed) {
    const std::string name = "ping-pong-" + std::to_string(static_cast<int>(speed));
    Case c{"bounce", name, emptyScene(name, 0), 600, {}, {}, false};
    addFixed(c.scene, "walls", {0, 0}, {segment({-5, -5}, {-5, 5}), segment({5, -5}, {5, 5})});
    addDynamic(c.scene, "ball", {0.37, 0}, {circle(kBounceRadius)}).velocity = {speed, 0};
    setSurface(c.scene, 0, 1);
    c.measures = {{"impacts missed", "1", [speed](const Frames& frames) {
                       const double gap = 10 - 2 * kBounceRadius;
                       const double exact = std::floor((speed * frames.back().time + 0.37 + 0.5 * gap) / gap);
                       int made = 0;
                       for (std::size_t i = 1; i < frames.size(); ++i) {
                           made += frames[i].bodies[1].velocity.x * frames[i - 1].bodies[1].velocity.x < 0 ? 1 : 0;
                       }
                       return std::fabs(made - exact) / exact;
                   }}};
    c.verdict = staysWithin(5);
    return c;
}

}  // namespace

std::vector<Case> bounceCases() {
    return {drop(0.7),    drop(3.1),    drop(10.3),    drop(31.7),   drop(97),
            pingPong(10), pingPong(30), pingPong(100), pingPong(300)};
}

std::vector<Case> allCases() {
    std::vector<Case> cases;
    for (const auto& make : {stackCases, massCases, sizeCases, knownCases, bounceCases, heldCases, landingCases}) {
        for (Case& c : make()) { cases.push_back(std::move(c)); }
    }
    return cases;
}

}  // namespace swept::accuracy
